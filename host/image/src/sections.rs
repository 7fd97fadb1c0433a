//! The sections of an image, by `size` of binutils.

use std::path::Path;
use std::process::Command;

use crate::toolchain::output;

/// The size of a section of an ARM image, in bytes.
///
/// # Errors
/// No image, or no such section.
pub fn section(image: &Path, name: &str) -> Result<u64, String> {
    let table = output(Command::new("arm-none-eabi-size").arg("-A").arg(image))?;
    let line = table.lines().find(|line| line.split_whitespace().next() == Some(name));
    let size = line.and_then(|line| line.split_whitespace().nth(1)?.parse().ok());
    size.ok_or_else(|| format!("{} has no section {name}", image.display()))
}

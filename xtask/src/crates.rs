//! The kernel's crates, by package: one list for every step that names them.

use std::process::Command;

/// Packages of the kernel, each after those that it needs.
pub const KERNEL: [&str; 4] = ["signorini-kernel", "signorini-bound", "signorini-contact", DEVICE];
/// The package that has all of them behind its features.
pub const DEVICE: &str = "signorini-device";

/// The command with `--package` for each crate of the kernel.
pub fn of_kernel(mut command: Command) -> Command {
    command.args(KERNEL.iter().flat_map(|package| ["--package", package]));
    command
}

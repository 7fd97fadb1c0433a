//! Environments of Python, each in a folder below `target/python`.

use std::path::PathBuf;
use std::process::Command;

use signorini_image::cargo::{root, target_dir};
use signorini_image::toolchain::output;
use signorini_image::tools::ensured;

/// The Python of the environment `name`, made just now where need be and possible, after `pip install` with these words; `variables` are
/// for what pip runs.
///
/// # Errors
/// No Python, or a package that pip does not find or cannot build.
pub fn with(name: &str, words: &[&str], variables: &[(&str, PathBuf)]) -> Result<PathBuf, String> {
    let folder = target_dir("python").join(name);
    let python = folder.join("bin/python");
    if !python.exists() {
        // What a failed attempt has left has a Python and no pip: it is cleared.
        let words = ["-m", "venv", "--clear"];
        let make = || output(Command::new("python3").args(words).arg(&folder)).map(drop);
        ensured(&["python3-venv"], make).inspect_err(|_| drop(std::fs::remove_dir_all(&folder)))?;
    }
    let mut pip = Command::new(&python);
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(words);
    pip.envs(variables.iter().map(|(name, value)| (name, value))).current_dir(root());
    output(&mut pip)?;
    Ok(python)
}

//! The program `signorini` of this checkout, as `cargo run --release` and the tests have it.

use std::env;
use std::env::consts::EXE_SUFFIX;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

use signorini_image::cargo::{build, cargo, root, target_dir};

/// Where it is, built once a run; the program that `SIGNORINI` names in the environment is taken as it is.
pub fn path() -> Result<PathBuf, String> {
    static BUILT: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    BUILT
        .get_or_init(|| match env::var_os("SIGNORINI") {
            Some(program) => Ok(program.into()),
            None => {
                let mut command = cargo(&["build", "--release", "--locked", "-p", "signorini"]);
                command.arg("--bin").arg("signorini").env("CARGO_TARGET_DIR", target_dir(""));
                build(command, false)?;
                Ok(target_dir("").join(format!("release/signorini{EXE_SUFFIX}")))
            }
        })
        .clone()
}

/// The program `scene_data` of the package of tests, with these words.
pub fn scene_data(words: &[&str]) -> Result<Command, String> {
    static BUILT: OnceLock<Result<(), String>> = OnceLock::new();
    BUILT
        .get_or_init(|| {
            let mut command = cargo(&["build", "--release", "--locked", "-p", "signorini-tests"]);
            command.arg("--bin").arg("scene_data").env("CARGO_TARGET_DIR", target_dir(""));
            build(command, false)
        })
        .clone()?;
    let mut command = Command::new(target_dir("").join("release/scene_data"));
    command.args(words).current_dir(root());
    Ok(command)
}

/// The program with these words, from the root of the checkout.
pub fn signorini(words: &[&str]) -> Result<Command, String> {
    let mut command = Command::new(path()?);
    command.args(words).current_dir(root());
    Ok(command)
}

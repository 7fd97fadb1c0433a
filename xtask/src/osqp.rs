//! `cargo xtask osqp`: builds the program that times OSQP, a peer of the trade study.
//!
//! It is a workspace of its own, because its build needs cmake and the project's shall not.

use std::process::{Command, ExitCode};

use crate::cargo::{cargo, run, target_dir};
use crate::setup::install_packages;
use crate::toolchain::output;

/// The verb: the last line of its output is the program's path.
pub fn command(arguments: &[&str]) -> ExitCode {
    if let [extra, ..] = arguments {
        if ["--help", "-h"].contains(extra) {
            println!("Usage: cargo xtask osqp\n\nBuilds tests/osqp and prints the program's path.");
            return ExitCode::SUCCESS;
        }
        eprintln!("error: `osqp` takes no argument, not `{extra}`");
        return ExitCode::from(2);
    }
    match build() {
        Ok(path) => {
            println!("{path}");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::FAILURE
        }
    }
}

fn build() -> Result<String, String> {
    let has_cmake = || output(Command::new("cmake").arg("--version"));
    if let Err(why) = has_cmake() {
        install_packages(&["cmake"]).map_err(|remedy| format!("{why}; {remedy}"))?;
        has_cmake()?;
    }
    let target = target_dir("osqp");
    let words = ["build", "--release", "--locked", "--manifest-path", "tests/osqp/Cargo.toml"];
    let mut command = cargo(&words);
    command.arg("--target-dir").arg(&target);
    run(command)?;
    Ok(target.join("release/signorini-osqp").display().to_string())
}

//! `cargo xtask osqp`: builds the program that times OSQP, a peer of the trade study.
//!
//! It is a workspace of its own, because its build needs cmake and the project's shall not.

use std::process::Command;

use clap::Args;

use crate::baked::Failure;
use crate::steps::Steps;
use signorini_image::cargo::{cargo, run as run_cargo, target_dir};
use signorini_image::tools::{answer, ensured};

/// The package of the program.
pub const MANIFEST: &str = "tests/osqp/Cargo.toml";

/// The processors that it is built for.
#[derive(Debug, Args)]
pub struct Options {
    /// Builds it for AVX2 on x86-64, whatever RUSTFLAGS says
    #[arg(long)]
    wide: bool,
}

/// The verb: the last line of its output is the program's path.
pub fn run(options: &Options) -> Result<(), Failure> {
    println!("{}", build(options.wide)?);
    Ok(())
}

/// Studies leave OSQP out where it cannot be built, and go on: here that is a failure.
pub fn check(steps: &mut Steps) {
    steps.check("the program that times OSQP", || build(false).map(drop));
}

/// Registers of four f64 on x86-64, which build scripts hand on to C compilers. Cargo's own environment would replace them.
const WIDE: &str =
    r#"target.'cfg(target_arch = "x86_64")'.rustflags=["-C", "target-feature=+avx2,+fma"]"#;

/// `cargo` with these words and wide registers.
fn widened(words: &[&str]) -> Command {
    let mut command = cargo(&["--config", WIDE]);
    command.args(words).env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    command
}

fn build(is_wide: bool) -> Result<String, String> {
    ensured(&["cmake"], || answer(&["cmake"]))?;
    // Each kind has a folder: of two studies at the same time neither gets the other's program.
    let target = target_dir("osqp").join(if is_wide { "wide" } else { "" });
    let words = ["build", "--release", "--locked", "--manifest-path", MANIFEST];
    let mut command = if is_wide { widened(&words) } else { cargo(&words) };
    if !is_wide {
        command.env("RUSTFLAGS", "");
    }
    command.arg("--target-dir").arg(&target);
    run_cargo(command)?;
    Ok(target.join("release/signorini-osqp").display().to_string())
}

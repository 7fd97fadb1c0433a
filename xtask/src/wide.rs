//! `cargo xtask wide`: any command of cargo, with registers of four f64 on x86-64.
//!
//! What `cargo build` makes runs on every x86-64. Benchmarks against other solvers want what the machine has, for the kernel
//! and for all that is compared with it: build scripts hand these features on to C compilers. rustc never contracts sums,
//! so the kernel's results are the same to the bit either way.

use std::process::{Command, ExitCode};

use signorini_image::cargo::{cargo, run, target_dir};

const HELP: &str = "\
Usage: cargo xtask wide COMMAND [WORDS]

Runs `cargo COMMAND WORDS` for AVX2 and FMA on x86-64, whatever RUSTFLAGS says, and builds into a target folder of its
own. On other processors it changes nothing but that folder.

Examples:
  cargo xtask wide run --release -- trade meshes/scenes/levee.toml
  cargo xtask wide bench
";

/// What builds have to take over and cargo's own environment must not replace.
const FLAGS: &str =
    r#"target.'cfg(target_arch = "x86_64")'.rustflags=["-C", "target-feature=+avx2,+fma"]"#;

/// The verb.
pub fn command(words: &[&str]) -> ExitCode {
    let Some((&verb, words)) = words.split_first() else {
        eprintln!("error: no command of cargo given\n\n{HELP}");
        return ExitCode::from(2);
    };
    if ["--help", "-h"].contains(&verb) {
        print!("{HELP}");
        return ExitCode::SUCCESS;
    }
    if !is_there() {
        eprintln!("error: this processor has no AVX2: run `cargo {verb}` itself");
        return ExitCode::from(2);
    }
    let mut command = widened(&[verb]);
    command.arg("--target-dir").arg(target_dir("wide")).args(words);
    // Paths among the words are from where this was called.
    if let Ok(here) = std::env::current_dir() {
        command.current_dir(here);
    }
    match run(command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: cargo {verb}: {why}");
            ExitCode::FAILURE
        }
    }
}

/// `cargo` with these words and wide registers.
pub fn widened(words: &[&str]) -> Command {
    let mut command = cargo(&["--config", FLAGS]);
    command.args(words);
    // Either of them would replace the flags.
    command.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    command
}

/// Whether what is built will run here.
#[cfg(target_arch = "x86_64")]
fn is_there() -> bool {
    std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
}

/// Whether what is built will run here.
#[cfg(not(target_arch = "x86_64"))]
fn is_there() -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_come_before_the_command_and_nothing_replaces_them() {
        let command = widened(&["build"]);
        let words: Vec<_> = command.get_args().collect();
        assert_eq!(words, ["--config", FLAGS, "build"]);
        let removed = |name: &str| command.get_envs().any(|(key, to)| key == name && to.is_none());
        assert!(removed("RUSTFLAGS") && removed("CARGO_ENCODED_RUSTFLAGS"));
    }
}

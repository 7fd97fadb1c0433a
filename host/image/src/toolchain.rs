//! The toolchain that builds for a microcontroller: rustup's where it has the target, otherwise one
//! that has the library's source, from which it builds `core` itself.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::cargo::cargo;

/// How to build for a target.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Toolchain {
    /// The toolchain that runs this program has the target.
    Installed,
    /// The toolchain in this folder builds `core` from source.
    FromSource(PathBuf),
}

/// Where Debian's packages `rustc-web` and `cargo-web` put theirs.
const DEBIAN: &str = "/usr/bin";

impl Toolchain {
    /// The toolchain for `triple`.
    ///
    /// # Errors
    /// There is none.
    pub fn find(triple: &str) -> Result<Self, String> {
        if sysroot("rustc").is_some_and(|root| root.join("lib/rustlib").join(triple).is_dir()) {
            return Ok(Self::Installed);
        }
        let folders = env::var_os("PATH").unwrap_or_default();
        let has_source = |folder: &PathBuf| {
            folder.join("cargo").is_file()
                && sysroot(folder.join("rustc"))
                    .is_some_and(|root| root.join("lib/rustlib/src/rust/library/core").is_dir())
        };
        env::split_paths(&folders)
            .chain([PathBuf::from(DEBIAN)])
            .find(has_source)
            .map(Self::FromSource)
            .ok_or_else(|| format!("no toolchain builds for {triple}; run `cargo xtask setup`"))
    }

    /// `cargo` with these words, for `triple`.
    pub fn cargo(&self, words: &[&str], triple: &str) -> Command {
        let mut command = match self {
            Self::Installed => cargo(words),
            Self::FromSource(folder) => from_source(folder, words),
        };
        command.args(["--target", triple]);
        command
    }

    /// Its name and version, such as `rustc 1.96.0`.
    ///
    /// # Errors
    /// It does not answer.
    pub fn version(&self) -> Result<String, String> {
        let rustc = match self {
            Self::Installed => PathBuf::from("rustc"),
            Self::FromSource(folder) => folder.join("rustc"),
        };
        Ok(first_words(&output(Command::new(rustc).arg("--version"))?, 2))
    }
}

fn from_source(folder: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(folder.join("cargo"));
    let paths = env::var_os("PATH").unwrap_or_default();
    let paths = [folder.to_owned()].into_iter().chain(env::split_paths(&paths));
    // Its own rustc before rustup's, and nothing of the cargo that runs this program.
    command.env("PATH", env::join_paths(paths).unwrap_or_default());
    for name in ["RUSTC", "RUSTDOC", "CARGO", "RUSTUP_TOOLCHAIN", "RUSTFLAGS"] {
        command.env_remove(name);
    }
    // Building `core` is a feature of nightly toolchains, which this variable unlocks.
    command.env("RUSTC_BOOTSTRAP", "1");
    command.args(words).arg("-Zbuild-std=core").current_dir(crate::cargo::root());
    command
}

fn sysroot(rustc: impl AsRef<Path>) -> Option<PathBuf> {
    let root = output(Command::new(rustc.as_ref()).args(["--print", "sysroot"])).ok()?;
    Some(PathBuf::from(root.trim()))
}

/// The triple of this machine.
///
/// # Errors
/// No rustc, or one that names none.
pub fn host() -> Result<String, String> {
    let about = output(Command::new("rustc").arg("-vV"))?;
    let host = about.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc -vV names no host".to_owned())
}

/// Standard output of a command that succeeds.
///
/// # Errors
/// It does not start, or fails: what it said.
pub fn output(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().display().to_string();
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(format!("{name}: {}", String::from_utf8_lossy(&output.stderr).trim()))
    }
}

/// The first words of a text.
pub fn first_words(text: &str, count: usize) -> String {
    text.split_whitespace().take(count).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_version_is_two_words() {
        let said = "rustc 1.96.0 (ac68faa20 2026-05-25) (built from a source tarball)\n";
        assert_eq!(first_words(said, 2), "rustc 1.96.0");
    }

    #[test]
    fn an_unknown_target_names_the_remedy() {
        let found = Toolchain::find("no-such-target");
        assert!(matches!(found, Ok(Toolchain::FromSource(_)) | Err(_)), "{found:?}");
        if let Err(why) = found {
            assert!(why.contains("cargo xtask setup"), "{why}");
        }
    }
}

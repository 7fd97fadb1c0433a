//! Stamps: groups of steps that passed with what they read are not run again.
//!
//! A stamp holds a hash of every file that the group reads, of the versions of the tools, and of the task runner itself.
//! Continuous integration sets `CI` and has none.

use std::env;
use std::fs;
use std::hash::{DefaultHasher, Hash as _, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

use signorini_image::cargo::{root, target_dir};
use signorini_image::files;
use signorini_image::toolchain::output;

/// Every group reads these beside its own.
const ALWAYS: [&str; 4] = ["Cargo.toml", "Cargo.lock", "xtask", "host/image"];
/// Folders that no group reads: what builds leave.
const LEFT: [&str; 4] = ["target", ".git", "__pycache__", ".pytest_cache"];
/// Programs whose versions count where they are there.
const TOOLS: [&str; 6] =
    ["rustc", "cargo", "qemu-system-arm", "arm-none-eabi-gcc", "python3", "/usr/bin/rustc"];

/// A group with what it reads.
#[derive(Debug)]
pub struct Stamp {
    file: PathBuf,
    hash: u64,
}

impl Stamp {
    /// The stamp of a group for the files below these paths, as they are; none in continuous integration.
    pub fn of(name: &str, reads: &[&str]) -> Option<Self> {
        if env::var_os("CI").is_some() {
            return None;
        }
        let mut hash = DefaultHasher::new();
        for path in ALWAYS.iter().chain(reads) {
            read(&root().join(path), &mut hash).ok()?;
        }
        for tool in TOOLS {
            output(Command::new(tool).arg("--version")).ok().hash(&mut hash);
        }
        env::var("RUSTFLAGS").ok().hash(&mut hash);
        let file = target_dir("stamps").join(name.replace([' ', '/', ','], "-"));
        Some(Self { file, hash: hash.finish() })
    }

    /// How many checks passed, where they did with the same files.
    pub fn passed(&self) -> Option<usize> {
        let text = fs::read_to_string(&self.file).ok()?;
        let (hash, passed) = text.trim().split_once(' ')?;
        (hash == format!("{:016x}", self.hash)).then(|| passed.parse().ok())?
    }

    /// Writes that so many checks passed. Without a stamp they run again.
    pub fn keep(&self, passed: usize) {
        let folder = self.file.parent().unwrap_or(Path::new("."));
        let made = fs::create_dir_all(folder);
        let text = format!("{:016x} {passed}\n", self.hash);
        let _ = made.and_then(|()| fs::write(&self.file, text));
    }
}

/// Names and bytes of a file, or of all files below a folder.
fn read(path: &Path, hash: &mut impl Hasher) -> Result<(), String> {
    let files = files::below(path, &LEFT)?;
    files.len().hash(hash);
    files.iter().try_for_each(|file| {
        file.hash(hash);
        fs::read(file).map(|bytes| bytes.hash(hash)).map_err(|error| error.to_string())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hash_of(folder: &Path) -> u64 {
        let mut hash = DefaultHasher::new();
        read(folder, &mut hash).expect("readable");
        hash.finish()
    }

    #[test]
    fn names_and_bytes_count_and_what_builds_leave_does_not() {
        let folder = env::temp_dir().join(format!("stamps-{}", std::process::id()));
        fs::create_dir_all(folder.join("target")).expect("a folder");
        fs::write(folder.join("a.rs"), "one").expect("a file");
        let before = hash_of(&folder);
        fs::write(folder.join("target/b.rs"), "two").expect("a file");
        assert_eq!(hash_of(&folder), before);
        fs::write(folder.join("a.rs"), "other").expect("a file");
        assert_ne!(hash_of(&folder), before);
        fs::write(folder.join("a.rs"), "one").expect("a file");
        assert_eq!(hash_of(&folder), before);
        fs::rename(folder.join("a.rs"), folder.join("c.rs")).expect("moved");
        assert_ne!(hash_of(&folder), before);
        fs::remove_dir_all(folder).expect("removed");
    }

    #[test]
    fn a_stamp_is_of_its_hash_alone() {
        let file = env::temp_dir().join(format!("stamp-{}/of", std::process::id()));
        let stamp = Stamp { file: file.clone(), hash: 7 };
        assert_eq!(stamp.passed(), None);
        stamp.keep(12);
        assert_eq!(stamp.passed(), Some(12));
        assert_eq!(Stamp { file, hash: 8 }.passed(), None);
    }
}

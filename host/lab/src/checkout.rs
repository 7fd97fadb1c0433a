//! The checkout of the sources, for what works on it: standard scenes and their records, boards, OSQP.
//!
//! It is found when the program runs: a checkout that is copied with its programs is another one.

use std::env;
use std::path::{Path, PathBuf};

use signorini_scene::error::{Error, InputError, Result};

/// What a checkout has at its root, and none of its folders has.
const SIGNS: [&str; 3] = ["Cargo.toml", "xtask/Cargo.toml", "meshes/scenes"];

/// The root: the nearest folder at or above the current one that is a checkout, else the nearest above this program.
///
/// # Errors
/// There is none: where it was looked for, and what is missing there.
pub fn root() -> Result<PathBuf> {
    let here = env::current_dir().map_err(Error::io(Path::new(".")))?;
    above(&here).or_else(|| above(&env::current_exe().ok()?)).ok_or_else(|| missing(&here).into())
}

/// The nearest of `start` and the folders above it with all signs.
fn above(start: &Path) -> Option<PathBuf> {
    let is_root = |folder: &&Path| SIGNS.iter().all(|sign| folder.join(sign).exists());
    start.ancestors().find(is_root).map(Path::to_owned)
}

fn missing(start: &Path) -> InputError {
    let message = format!(
        "no checkout of the sources: neither {} nor a folder above it has {}",
        start.display(),
        SIGNS.join(", ")
    );
    InputError::new(message).hint("run this command inside of one")
}

/// The scene files below `folder`, in the order of their names.
///
/// # Errors
/// A folder that cannot be read, or without scenes.
pub fn scenes(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).map_err(Error::io(&folder))? {
            let path = entry.map_err(Error::io(&folder))?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                found.push(path);
            }
        }
    }
    if found.is_empty() {
        let message = format!("{}: no scene found", folder.display());
        return Err(InputError::new(message).hint("run from a complete checkout").into());
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_is_a_checkout_of_its_own() {
        let copy = tempfile::tempdir().unwrap();
        let inner = copy.path().join("meshes/scenes");
        for folder in [&inner, &copy.path().join("xtask")] {
            std::fs::create_dir_all(folder).unwrap();
        }
        std::fs::write(copy.path().join("Cargo.toml"), "").unwrap();
        assert_eq!(above(&inner), None);
        let why = missing(&inner).message().to_owned();
        assert!(why.contains("meshes/scenes nor") && why.contains("xtask/Cargo.toml"), "{why}");
        std::fs::write(copy.path().join("xtask/Cargo.toml"), "").unwrap();
        assert_eq!(above(&inner).as_deref(), Some(copy.path()));
    }

    #[test]
    fn tests_run_inside_of_one() {
        assert!(root().is_ok_and(|root| root.join("kernel/src").is_dir()));
    }
}

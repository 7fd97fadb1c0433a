//! Files and folders, with their names in what is said of failures.

use std::fs;
use std::path::{Path, PathBuf};

/// The outcome of a call on a file, its name before the words for a failure.
///
/// # Errors
/// That of `done`.
pub fn named<T>(path: &Path, done: std::io::Result<T>) -> Result<T, String> {
    done.map_err(|error| format!("{}: {error}", path.display()))
}

/// The text of a file.
///
/// # Errors
/// A file that cannot be read.
pub fn text(path: &Path) -> Result<String, String> {
    named(path, fs::read_to_string(path))
}

/// Writes a file, and its folder where there is none.
///
/// # Errors
/// A file that cannot be written.
pub fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    folder(path.parent().unwrap_or(Path::new(".")))?;
    named(path, fs::write(path, bytes))
}

/// A folder, made where there is none.
///
/// # Errors
/// A folder that cannot be made.
pub fn folder(path: &Path) -> Result<PathBuf, String> {
    named(path, fs::create_dir_all(path)).map(|()| path.to_owned())
}

/// A folder without what was in it.
///
/// # Errors
/// A folder that cannot be removed or made.
pub fn emptied(path: &Path) -> Result<PathBuf, String> {
    if path.is_dir() {
        named(path, fs::remove_dir_all(path))?;
    }
    folder(path)
}

/// The files and folders that lie in a folder.
///
/// # Errors
/// A folder that cannot be read.
pub fn within(path: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = named(path, fs::read_dir(path))?;
    entries.map(|entry| named(path, entry).map(|entry| entry.path())).collect()
}

/// A file, or those below a folder in the order of their paths, without what has one of the names that are `left` out.
///
/// # Errors
/// A folder that cannot be read.
pub fn below(path: &Path, left: &[&str]) -> Result<Vec<PathBuf>, String> {
    if path.file_name().is_some_and(|name| left.iter().any(|left| name == *left)) {
        return Ok(Vec::new());
    }
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let mut entries = within(path)?;
    entries.sort_unstable();
    let files: Result<Vec<_>, _> = entries.iter().map(|entry| below(entry, left)).collect();
    Ok(files?.concat())
}

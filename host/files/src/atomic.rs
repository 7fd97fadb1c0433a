//! Writing a file so that its final name never shows a part of it.
//!
//! The bytes go to a temporary file in the same folder (a rename does not cross devices), reach the
//! disk, and only then take the name. Whoever reads meanwhile sees the old file or the new one.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use signorini_scene::error::{Error, InputError, Result};

/// Replaces the contents of `path` by `bytes`, or leaves what was there when anything fails.
///
/// Missing parent folders are made. The file gets the permissions of any new file (a temporary one
/// would be readable by its owner alone). A symbolic link stays and its target is replaced. What is
/// no regular file, such as a pipe or `/dev/stdout`, has no old contents to protect: it is written
/// directly.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    replace(path, bytes).map_err(Error::io(path))
}

/// Refuses a folder for files, named by `option`, that is a file or would lie in one.
///
/// # Errors
/// Such a place.
pub fn writable(option: &str, folder: &Path) -> Result<()> {
    if folder.ancestors().find(|path| path.exists()).is_some_and(|path| !path.is_dir()) {
        let message = format!("{option} {}: is a file, expected a directory", folder.display());
        let hint = "name a directory, or one that does not exist yet";
        return Err(InputError::new(message).hint(hint).into());
    }
    Ok(())
}

/// Refuses a place for a file, named by `option`, that is a folder or would lie in a file.
///
/// # Errors
/// Such a place.
pub fn writable_file(option: &str, file: &Path) -> Result<()> {
    if file.is_dir() {
        let message = format!("{option} {}: is a directory, expected a file", file.display());
        return Err(InputError::new(message).hint("name a file in it, or another place").into());
    }
    file.parent().map_or(Ok(()), |folder| writable(option, folder))
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = match fs::metadata(path) {
        Ok(existing) if !existing.is_file() => return fs::write(path, bytes),
        Ok(_) => fs::canonicalize(path)?,
        Err(_) => path.to_owned(),
    };
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut file = new_file(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(&target)?;
    Ok(())
}

/// A temporary file that, like any new file, is readable by whom the umask allows.
fn new_file(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(<fs::Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666));
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn makes_folders_and_replaces_what_was_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a/b/summary.json");
        write_atomically(&path, b"a longer first version").unwrap();
        write_atomically(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(names(path.parent().unwrap()), ["summary.json"]);
    }

    #[test]
    fn a_failure_names_the_file_and_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let error = write_atomically(folder.path(), b"x").unwrap_err();
        assert!(error.to_string().starts_with(&folder.path().display().to_string()));
        let below_a_file = folder.path().join("file/inner");
        fs::write(folder.path().join("file"), b"kept").unwrap();
        assert!(matches!(write_atomically(&below_a_file, b"x"), Err(Error::Io { .. })));
        assert_eq!(names(folder.path()), ["file"]);
        assert_eq!(fs::read(folder.path().join("file")).unwrap(), b"kept");
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_any_new_file_and_links_stay() {
        use std::os::unix::fs::{MetadataExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        write_atomically(&ours, b"x").unwrap();
        fs::write(&plain, b"x").unwrap();
        assert_eq!(fs::metadata(&ours).unwrap().mode(), fs::metadata(&plain).unwrap().mode());

        let link = folder.path().join("link");
        symlink(&ours, &link).unwrap();
        write_atomically(&link, b"through the link").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&ours).unwrap(), b"through the link");
    }
}

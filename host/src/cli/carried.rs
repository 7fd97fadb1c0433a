//! The sources that the program carries: the kernel and what makes a library for C of it, put into a folder of this user where no
//! checkout is.

use std::env;
use std::path::{Path, PathBuf};

use signorini_image::{checkout, files, lock};
use signorini_scene::error::{InputError, Result};

/// Paths from the root of a checkout, and texts.
const FILES: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/carried.rs"));

/// The workspace that a library for C belongs to, which has images as members too.
const WORKSPACE: &str = "tests/firmware/Cargo.toml";
const MEMBERS: [&str; 2] =
    [r#"["board", "images", "rtic", "scene", "../../host/c"]"#, r#"["../../host/c"]"#];

/// Finds the sources: the checkout, else what the program carries, which stands in for it from now on.
///
/// # Errors
/// There is no checkout, and no folder to put files into.
pub(super) fn sources() -> Result<()> {
    let Err(no_checkout) = checkout::find() else { return Ok(()) };
    let folder = place();
    put(&folder).map_err(|why| {
        let message = format!("{no_checkout}; nor can sources be put elsewhere: {why}");
        InputError::new(message)
            .hint("run this command inside of a checkout, or name a folder in XDG_CACHE_HOME")
    })?;
    checkout::stand_in(folder);
    Ok(())
}

/// A folder of these sources alone, where this user's programs keep what they can make again.
fn place() -> PathBuf {
    let named =
        |variable| env::var_os(variable).map(PathBuf::from).filter(|path| path.is_absolute());
    let home = || Some(named("HOME")?.join(".cache"));
    let caches = named("XDG_CACHE_HOME").or_else(home).or_else(|| named("LOCALAPPDATA"));
    let version = format!("{}-{:016x}", env!("CARGO_PKG_VERSION"), mark());
    caches.unwrap_or_else(env::temp_dir).join("signorini").join(version)
}

/// A number of paths and texts: FNV-1a.
fn mark() -> u64 {
    let bytes = FILES.iter().flat_map(|(path, text)| path.bytes().chain(text.bytes()));
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Writes what is not there, or has been changed since.
fn put(folder: &Path) -> std::result::Result<(), String> {
    let _turn = lock::hold(&folder.join("lock"))?;
    FILES.iter().try_for_each(|(path, text)| {
        let (place, text) = (folder.join(path), text_of(path, text));
        // Cargo has taken what is not needed out of the lock file.
        let is_kept = path.ends_with("Cargo.lock") && place.is_file();
        match is_kept || files::text(&place).is_ok_and(|there| there == text) {
            true => Ok(()),
            false => files::write(&place, text),
        }
    })
}

/// The text of a file as it is put there.
fn text_of(path: &str, text: &str) -> String {
    let [all, one] = MEMBERS;
    if path == WORKSPACE { text.replace(all, one) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn what_is_carried_is_what_a_library_is_built_from() {
        let has = |path: &str| FILES.iter().any(|(own, _)| *own == path);
        for package in ["kernel", "kernel/bound", "kernel/contact", "kernel/device", "host/c"] {
            assert!(has(&format!("{package}/Cargo.toml")), "{package}");
            assert!(has(&format!("{package}/src/lib.rs")), "{package}");
        }
        let workspace = FILES.iter().find(|(path, _)| *path == WORKSPACE).expect("a manifest").1;
        assert!(has("Cargo.toml") && has("tests/firmware/Cargo.lock"));
        assert_ne!(text_of(WORKSPACE, workspace), workspace, "other members");
    }

    #[test]
    fn what_was_changed_or_lost_is_put_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let manifest = folder.path().join("kernel/Cargo.toml");
        put(folder.path()).expect("files");
        let whole = fs::read_to_string(&manifest).expect("a manifest");
        fs::write(&manifest, "").expect("a file");
        fs::remove_file(folder.path().join("host/c/build.rs")).expect("a file");
        put(folder.path()).expect("files");
        assert_eq!(fs::read_to_string(&manifest).expect("a manifest"), whole);
        assert!(folder.path().join("host/c/build.rs").is_file());
    }
}

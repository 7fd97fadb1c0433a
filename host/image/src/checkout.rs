//! The checkout that this program works in, or what stands in for it: found when it runs, since a checkout that is copied with
//! its programs is another one.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Files and folders that a checkout has at its root, and none of its folders has.
const SIGNS: [&str; 3] = ["xtask/Cargo.toml", "kernel/Cargo.toml", "meshes/scenes"];

/// The root of the checkout, found once: at or above the folder of the package that cargo runs, of the current folder,
/// or of this program.
///
/// # Errors
/// There is none: where it was looked for, and what is missing there.
pub fn find() -> Result<&'static Path, String> {
    static FOUND: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    let found = FOUND.get_or_init(|| locate(&starts())).as_ref();
    found.map(PathBuf::as_path).map_err(Clone::clone)
}

/// The folder that stands in for a checkout where there is none.
static STAND_IN: OnceLock<PathBuf> = OnceLock::new();

/// Makes a folder stand in for a checkout where there is none: it has the sources of a library for C, in the same places.
pub fn stand_in(folder: PathBuf) {
    // The first one stays: a program has one such folder.
    let _ = STAND_IN.set(folder);
}

/// The root of the kernel's sources: the checkout, or what stands in for it.
///
/// # Errors
/// There is neither: where a checkout was looked for, and what is missing there.
pub fn sources() -> Result<&'static Path, String> {
    find().or_else(|why| STAND_IN.get().map(PathBuf::as_path).ok_or(why))
}

/// The root of the sources, for who comes after [`find`] or [`sources`] has been asked.
pub fn root() -> &'static Path {
    sources().unwrap_or(Path::new("."))
}

/// The word that holds cargo to a lock file. What stands in for a checkout has fewer members than its lock file knows: cargo keeps the
/// versions there, and drops the rest first.
pub fn locked() -> Option<&'static str> {
    find().is_ok().then_some("--locked")
}

fn starts() -> Vec<PathBuf> {
    let package = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    package.into_iter().chain(env::current_dir()).chain(env::current_exe()).collect()
}

/// The nearest of the first start, and the folders above it, that is a checkout; else of the next one.
fn locate(starts: &[PathBuf]) -> Result<PathBuf, String> {
    let is_root = |folder: &&Path| SIGNS.iter().all(|sign| folder.join(sign).exists());
    let found = starts.iter().find_map(|start| start.ancestors().find(is_root));
    found.map(Path::to_owned).ok_or_else(|| {
        let here = env::current_dir().unwrap_or_default();
        format!(
            "no checkout of the sources: neither {} nor a folder above it has {}",
            here.display(),
            SIGNS.join(" and ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn paths_follow_a_copy() {
        let copy = env::temp_dir().join(format!("checkout-{}", std::process::id()));
        let inner = copy.join("tests/firmware");
        for folder in ["tests/firmware", SIGNS[2], "xtask", "kernel"] {
            fs::create_dir_all(copy.join(folder)).unwrap();
        }
        for sign in &SIGNS[..2] {
            fs::write(copy.join(sign), "").unwrap();
        }
        assert_eq!(locate(std::slice::from_ref(&inner)), Ok(copy.clone()));
        assert_eq!(locate(&["/".into(), copy.join("xtask")]), Ok(copy.clone()));
        fs::remove_file(copy.join(SIGNS[1])).unwrap();
        let why = locate(&[inner]).unwrap_err();
        assert!(why.contains(SIGNS[1]) && why.contains("no checkout"), "{why}");
        fs::remove_dir_all(copy).unwrap();
    }

    #[test]
    fn this_checkout_is_found() {
        assert!(find().is_ok_and(|root| root.join("tests/firmware/Cargo.toml").is_file()));
    }
}

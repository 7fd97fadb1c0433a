//! The checkout that this program works in: found when it runs, since a copied one brings its programs along.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// What a checkout has at its root, and none of its folders has.
const SIGNS: [&str; 2] = ["xtask/Cargo.toml", "kernel/Cargo.toml"];

/// The root of the checkout, found once.
pub fn find() -> Result<&'static Path, String> {
    static FOUND: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    let found = FOUND.get_or_init(|| locate(&start()?)).as_ref();
    found.map(PathBuf::as_path).map_err(Clone::clone)
}

/// The same for who comes after [`find`] has been asked: `main` does so first of all.
pub fn root() -> &'static Path {
    find().unwrap_or(Path::new("."))
}

/// The folder of this package, which cargo names as it runs it; else the current one.
fn start() -> Result<PathBuf, String> {
    let is_own = env::var("CARGO_PKG_NAME").is_ok_and(|name| name == env!("CARGO_PKG_NAME"));
    match env::var_os("CARGO_MANIFEST_DIR").filter(|_| is_own) {
        Some(folder) => Ok(folder.into()),
        None => env::current_dir().map_err(|error| format!("the current folder: {error}")),
    }
}

/// The nearest of `start` and the folders above it that is a checkout.
fn locate(start: &Path) -> Result<PathBuf, String> {
    let is_root = |folder: &&Path| SIGNS.iter().all(|sign| folder.join(sign).is_file());
    start.ancestors().find(is_root).map(Path::to_owned).ok_or_else(|| {
        let signs = SIGNS.join(" and ");
        format!("no checkout: neither {} nor a folder above it has {signs}", start.display())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn paths_follow_a_copy() {
        let copy = env::temp_dir().join(format!("xtask-copy-{}", std::process::id()));
        for sign in SIGNS {
            let file = copy.join(sign);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, "").unwrap();
        }
        let inner = copy.join("tests/firmware");
        fs::create_dir_all(&inner).unwrap();
        assert_eq!(locate(&inner), Ok(copy.clone()));
        assert_eq!(locate(&copy.join("xtask")), Ok(copy.clone()));
        fs::remove_file(copy.join(SIGNS[1])).unwrap();
        let why = locate(&inner).unwrap_err();
        assert!(why.contains(SIGNS[1]) && why.contains("tests/firmware"), "{why}");
        fs::remove_dir_all(copy).unwrap();
    }

    #[test]
    fn this_checkout_is_found() {
        assert!(find().is_ok_and(|root| root.join("tests/firmware/Cargo.toml").is_file()));
    }
}

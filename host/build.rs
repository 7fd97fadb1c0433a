//! Lists the sources that the program carries: files below `carried`, most of them links to where they stand in the checkout.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// A manifest's name here: what has one of its true name is a package, and part of no other's archive.
const MANIFEST: &str = "manifest.toml";

fn main() -> io::Result<()> {
    let folder = |variable| PathBuf::from(env::var_os(variable).unwrap_or_default());
    let carried = folder("CARGO_MANIFEST_DIR").join("carried");
    let mut list = String::from("[\n");
    put_files(&carried, &carried, &mut list)?;
    fs::write(folder("OUT_DIR").join("carried.rs"), list + "]\n")
}

/// Puts a line for each file below a folder: its path and its text.
fn put_files(root: &Path, folder: &Path, list: &mut String) -> io::Result<()> {
    println!("cargo:rerun-if-changed={}", folder.display());
    let entries = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut entries = entries.collect::<io::Result<Vec<_>>>()?;
    entries.sort_unstable();
    for path in entries {
        if path.is_dir() {
            put_files(root, &path, list)?;
            continue;
        }
        let own = path.strip_prefix(root).unwrap_or(&path);
        let own = match path.ends_with(MANIFEST) {
            true => own.with_file_name("Cargo.toml"),
            false => own.to_owned(),
        };
        // A path with slashes, whatever this system writes.
        let own = own.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/");
        let _ = writeln!(list, "({own:?}, include_str!({path:?})),");
    }
    Ok(())
}

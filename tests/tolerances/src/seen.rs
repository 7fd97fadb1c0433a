//! The largest deviation of every entry, written down where `cargo xtask test` asks for it.
//!
//! ```text
//!   kernel::PATCH  1e-12  0e0  3.1e-14      entry, value, worst of longer runs, seen; tabs between
//! ```
//!
//! A process appends a line to a file of its own whenever a comparison is further off than all before.

use std::collections::BTreeMap;
use std::fs::OpenOptions;
use std::io::{Error, Write};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use crate::Tolerance;

/// The variable that names the folder for these files; without it nothing is written.
const FOLDER: &str = "SIGNORINI_SEEN";

/// By path of the entry.
static LARGEST: Mutex<BTreeMap<&str, f64>> = Mutex::new(BTreeMap::new());

/// Notes that a comparison by `entry` was off by `deviation`.
pub fn record(entry: &Tolerance, deviation: f64) {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let mut largest = LARGEST.lock().unwrap_or_else(PoisonError::into_inner);
    let before = largest.entry(entry.path).or_insert(-1.0);
    if deviation > *before {
        *before = deviation;
        let file = PathBuf::from(folder).join(std::process::id().to_string());
        append(&file, entry, deviation)
            .unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    }
}

fn append(file: &PathBuf, entry: &Tolerance, deviation: f64) -> Result<(), Error> {
    let Tolerance { path, value, worst, .. } = entry;
    let path = path.split_once("::").map_or(*path, |(_, path)| path);
    let mut file = OpenOptions::new().create(true).append(true).open(file)?;
    file.write_all(format!("{path}\t{value:e}\t{worst:e}\t{deviation:e}\n").as_bytes())
}

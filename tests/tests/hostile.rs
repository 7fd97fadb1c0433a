//! Arbitrary bytes: what fuzzing has found and collected, replayed, and some that nobody has chosen.

use std::fs;
use std::path::{Path, PathBuf};

use signorini_tests::hostile::{constructors, expression, mesh, scene, tick};
use signorini_tests::random::Random;

type Entry = fn(&[u8]);

const ENTRIES: [(&str, Entry); 5] = [
    ("mesh", mesh),
    ("scene", scene),
    ("expression", expression),
    ("constructors", constructors),
    ("tick", tick),
];

/// The files in a folder of `tests/fuzz`, in the order of their names.
fn files(folder: &str, target: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(folder).join(target);
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

#[test]
fn what_fuzzing_has_found_stays_mended() {
    for (target, entry) in ENTRIES {
        for file in files("found", target) {
            println!("{}", file.display());
            entry(&fs::read(&file).expect("a file"));
        }
    }
}

#[test]
fn corpora_are_replayed() {
    for (target, entry) in ENTRIES {
        let files = files("corpus", target);
        assert!(files.len() >= 20, "{target}: {} files", files.len());
        for file in files {
            println!("{}", file.display());
            entry(&fs::read(&file).expect("a file"));
        }
    }
}

#[test]
fn bytes_that_nobody_has_chosen() {
    let random = &mut Random::new(9);
    for (target, entry) in ENTRIES {
        for _ in 0..RUNS {
            let length = random.below(400);
            let data: Vec<_> = (0..length).map(|_| random.bits() as u8).collect();
            println!("{target}: {data:?}");
            entry(&data);
        }
    }
}

/// A test of the functions themselves: libFuzzer chooses better.
const RUNS: u32 = 500;

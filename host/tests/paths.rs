//! The pages name files that there are.

use std::fs;
use std::path::{Path, PathBuf};

use crate::command::{repository, text};

/// Where paths of the repository start, as pages write them.
const FOLDERS: [&str; 6] = ["docs/", "host/", "kernel/", "meshes/", "tests/", "xtask/"];

fn pages(folder: &Path, all: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            pages(&path, all);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            all.push(path);
        }
    }
}

/// Code spans that are paths to files, one for each word in braces; `NAME` stands for any.
fn paths(page: &str) -> impl Iterator<Item = String> {
    let spans = page.split('`').skip(1).step_by(2);
    let is_path = |span: &&str| FOLDERS.iter().any(|folder| span.starts_with(folder));
    let is_one = |span: &&str| !span.contains(['*', '<', ' ', '\n']) && !span.contains("NAME");
    spans.filter(is_path).filter(is_one).flat_map(expanded)
}

fn expanded(path: &str) -> Vec<String> {
    match path.split_once('{').and_then(|(head, rest)| Some((head, rest.split_once('}')?))) {
        Some((head, (words, tail))) => {
            words.split(',').flat_map(|word| expanded(&format!("{head}{word}{tail}"))).collect()
        }
        None => vec![path.to_owned()],
    }
}

#[test]
fn files_that_pages_name_exist() {
    let mut all: Vec<_> =
        ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "kernel/README.md"].map(repository).into();
    pages(&repository("docs"), &mut all);
    let mut count = 0;
    for page in all {
        for path in paths(&text(&page)) {
            count += 1;
            assert!(repository(&path).exists(), "{}: {path}", page.display());
        }
    }
    assert!(count > 50, "{count} paths");
}

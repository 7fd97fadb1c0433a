//! The pages name files that there are.

use std::fs;
use std::path::{Path, PathBuf};

/// Where paths of the repository start, as pages write them.
const FOLDERS: [&str; 6] = ["docs/", "host/", "kernel/", "meshes/", "tests/", "xtask/"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

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

/// Code spans that are paths to files; `NAME` stands for any.
fn paths(page: &str) -> impl Iterator<Item = &str> {
    let spans = page.split('`').skip(1).step_by(2);
    let is_path = |span: &&str| FOLDERS.iter().any(|folder| span.starts_with(folder));
    let is_one = |span: &&str| !span.contains(['*', '<', '{', ' ', '\n']) && !span.contains("NAME");
    spans.filter(is_path).filter(is_one)
}

#[test]
fn files_that_pages_name_exist() {
    let mut all: Vec<_> = ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "kernel/README.md"]
        .map(|page| root().join(page))
        .into();
    pages(&root().join("docs"), &mut all);
    let mut count = 0;
    for page in all {
        let text = fs::read_to_string(&page).expect("a page");
        for path in paths(&text) {
            count += 1;
            assert!(root().join(path).exists(), "{}: {path}", page.display());
        }
    }
    assert!(count > 50, "{count} paths");
}

//! The pages name files that there are, and their links lead somewhere.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::command::{repository, text};

/// Where paths of the repository start, as pages write them.
const FOLDERS: [&str; 6] = ["docs/", "host/", "kernel/", "meshes/", "tests/", "xtask/"];

/// Pages beside those of `docs` and of the tests' firmware.
const PAGES: [&str; 10] = [
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "host/python/README.md",
    "kernel/README.md",
    "kernel/device/README.md",
    "meshes/README.md",
    "tests/fixtures/gmsh/README.md",
];

/// All pages.
fn all_pages() -> Vec<PathBuf> {
    let mut all = PAGES.map(repository).to_vec();
    for folder in ["docs", "tests/firmware"] {
        pages(&repository(folder), &mut all);
    }
    all
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
    let mut count = 0;
    for page in all_pages() {
        for path in paths(&text(&page)) {
            count += 1;
            assert!(repository(&path).exists(), "{}: {path}", page.display());
        }
    }
    assert!(count > 50, "{count} paths");
}

/// The lines outside of blocks of code.
fn prose(page: &str) -> Vec<&str> {
    let mut is_code = false;
    let is_prose = |line: &&str| {
        let is_fence = line.trim_start().starts_with("```");
        is_code ^= is_fence;
        !is_code && !is_fence
    };
    page.lines().filter(is_prose).collect()
}

/// The targets of the links, but for those to other hosts.
fn links(page: &str) -> Vec<String> {
    let text: String = prose(page).join("\n").split('`').step_by(2).collect();
    let targets = text.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
    let is_here = |target: &&str| !target.contains("://") && !target.starts_with("mailto:");
    targets.filter(is_here).map(str::to_owned).collect()
}

/// What a link may have behind `#`: the headings, as GitHub makes anchors of them.
fn anchors(page: &str) -> BTreeSet<String> {
    let mut counts = BTreeMap::<String, usize>::new();
    let headings = prose(page).into_iter().filter(|line| line.starts_with('#'));
    let anchor = |line: &str| {
        let words = line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
        let is_kept = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_');
        let name: String = words.chars().filter(|letter| is_kept(*letter)).collect();
        let count = counts.entry(name.clone()).and_modify(|count| *count += 1).or_default();
        if *count == 0 { name } else { format!("{name}-{count}") }
    };
    headings.map(anchor).collect()
}

#[test]
fn links_of_pages_lead_somewhere() {
    let mut count = 0;
    for page in all_pages() {
        for link in links(&text(&page)) {
            count += 1;
            let (file, anchor) = link.split_once('#').unwrap_or((link.as_str(), ""));
            let target = match file {
                "" => page.clone(),
                file => page.parent().expect("a folder").join(file),
            };
            assert!(target.exists(), "{}: {link}", page.display());
            let is_there = anchor.is_empty() || anchors(&text(&target)).contains(anchor);
            assert!(is_there, "{}: {link}", page.display());
        }
    }
    assert!(count > 130, "{count} links");
}

#[test]
fn anchors_are_those_of_headings() {
    let page = "# A, and `b`\n```sh\n# no heading [a](b)\n```\n## Why?\n## Why?\n[c](d#why-1), `[e](f)`, [`g`](h)";
    assert_eq!(anchors(page).into_iter().collect::<Vec<_>>(), ["a-and-b", "why", "why-1"]);
    assert_eq!(links(page), ["d#why-1", "h"]);
}

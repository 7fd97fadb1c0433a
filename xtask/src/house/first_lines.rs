//! The page of modules: a table per crate of what each module says of itself in its first line.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crate::snapshot::snapshot;
use crate::steps::Steps;
use signorini_image::cargo::root;

const PAGE: &str = "docs/modules.md";
const HEAD: &str = "\
# Modules

Each file says in its first line what it holds. `cargo xtask house --bless` writes this page from these lines, a table per crate in
the order in which they depend on each other. A folder stands with the line of its `mod.rs`, and what is in it below.
";
/// Each crate after those that it depends on.
const CRATES: [&str; 18] = [
    "kernel",
    "kernel/bound",
    "kernel/contact",
    "kernel/device",
    "host/scene",
    "host/problem",
    "host/reference",
    "host/certify",
    "host/solve",
    "host/condense",
    "host/intervals",
    "host/files",
    "host/draw",
    "host/image",
    "host/bake",
    "host/session",
    "host/lab",
    "host",
];

/// One step: the page is what the files say.
pub fn run(steps: &mut Steps) {
    let bless = steps.blesses();
    steps.lint("the page of modules", || snapshot(PAGE, &page()?, bless));
}

fn page() -> Result<String, String> {
    let mut text = HEAD.to_owned();
    for of in CRATES {
        let mut rows = modules(&root().join(of).join("src"), "")?;
        rows.sort();
        let _ = write!(text, "\n## `{of}`\n\n| module | what it holds |\n|---|---|\n");
        for (name, path) in rows {
            let _ = writeln!(text, "| `{name}` | {} |", first_sentence(&path)?);
        }
    }
    Ok(text)
}

/// The modules in a folder and in those within it: names as paths, which begin with `above`, and files.
fn modules(of: &Path, above: &str) -> Result<Vec<(String, PathBuf)>, String> {
    let mut found = Vec::new();
    let entries = fs::read_dir(of).map_err(|error| format!("{}: {error}", of.display()))?;
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if ["lib", "main", "mod", "tests", "bin"].contains(&&*name) {
            continue;
        }
        let name = format!("{above}{name}");
        if path.is_dir() {
            let own = path.join("mod.rs");
            found.extend(modules(&path, &format!("{name}::"))?);
            found.extend(own.is_file().then_some((name, own)));
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            found.push((name, path));
        }
    }
    Ok(found)
}

/// The first sentence of a file's `//!` lines.
fn first_sentence(path: &Path) -> Result<String, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
    let said = lines.map_while(|line| (!line.trim().is_empty()).then(|| line.trim()));
    let said = said.collect::<Vec<_>>().join(" ");
    let end = said.find(". ").map_or(said.len(), |at| at + 1);
    match said.get(..end).unwrap_or(&said).trim_end_matches([':', ' ']) {
        "" => Err(format!(
            "{} does not begin with a line of its own on what it holds",
            path.display()
        )),
        sentence => Ok(sentence.replace('|', "\\|")),
    }
}

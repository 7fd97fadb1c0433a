//! The page of modules: a table per crate of what each module says of itself in its first line.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::snapshot::snapshot;
use crate::steps::Steps;
use signorini_image::cargo::root;
use signorini_image::files;

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
        let mut rows = modules(&root().join(of).join("src"))?;
        rows.sort();
        let _ = write!(text, "\n## `{of}`\n\n| module | what it holds |\n|---|---|\n");
        for (name, path) in rows {
            let _ = writeln!(text, "| `{name}` | {} |", first_sentence(&path)?);
        }
    }
    Ok(text)
}

/// The modules below a folder: names as paths, and files.
fn modules(of: &Path) -> Result<Vec<(String, PathBuf)>, String> {
    let files = files::below(of, &["lib.rs", "main.rs", "tests", "tests.rs", "bin"])?;
    let name = |path: &Path| {
        let file = path.strip_prefix(of).ok()?.to_str()?.strip_suffix(".rs")?;
        Some(file.trim_end_matches("/mod").replace('/', "::"))
    };
    Ok(files.into_iter().filter_map(|path| Some((name(&path)?, path))).collect())
}

/// The first sentence of a file's `//!` lines.
fn first_sentence(path: &Path) -> Result<String, String> {
    let text = files::text(path)?;
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

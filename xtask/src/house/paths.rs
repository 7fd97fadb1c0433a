//! Paths that pages name: each `folder/file.rs` in a page of Markdown is a file of the repository.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::steps::Steps;
use signorini_image::cargo::root;
use signorini_image::toolchain::output;

/// Stands for a name that the reader chooses.
const PLACEHOLDER: &str = "NAME.rs";

/// One step.
pub fn run(steps: &mut Steps) {
    steps.lint("pages name files that there are", || {
        let pages = output(Command::new("git").args(["ls-files", "*.md"]).current_dir(root()))?;
        let missing: Vec<_> = pages.lines().flat_map(|page| missing_in(page, root())).collect();
        if missing.is_empty() { Ok(()) } else { Err(missing.join("; ")) }
    });
}

fn missing_in(page: &str, root: &Path) -> Vec<String> {
    let folder = root.join(page);
    let folder = folder.parent().unwrap_or(root);
    let is_there = |path: &String| match path.strip_suffix(PLACEHOLDER) {
        Some(place) => root.join(place).is_dir(),
        None => root.join(path).is_file() || folder.join(path).is_file(),
    };
    let text = fs::read_to_string(root.join(page)).unwrap_or_default();
    let absent = paths(&text).into_iter().filter(|path| !is_there(path));
    absent.map(|path| format!("{page}: no file {path}")).collect()
}

/// The paths to Rust files between back quotes, one for each word in braces.
fn paths(text: &str) -> Vec<String> {
    let quoted = text.lines().flat_map(|line| line.split('`').skip(1).step_by(2));
    let named =
        quoted.filter(|word| word.ends_with(".rs") && word.contains('/') && !word.contains(' '));
    named.flat_map(expanded).collect()
}

fn expanded(path: &str) -> Vec<String> {
    match path.split_once('{').and_then(|(head, rest)| Some((head, rest.split_once('}')?))) {
        Some((head, (words, tail))) => {
            words.split(',').flat_map(|word| expanded(&format!("{head}{word}{tail}"))).collect()
        }
        None => vec![path.to_owned()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_one_for_each_word_in_braces() {
        let text = "see `a/{b,c/d}.rs` and `e.rs`, `f g/h.rs`, or\n`i/NAME.rs`";
        assert_eq!(paths(text), ["a/b.rs", "a/c/d.rs", "i/NAME.rs"]);
    }
}

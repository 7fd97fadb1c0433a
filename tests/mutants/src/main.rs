//! Judges mutants of the kernel by its tests. `cargo xtask mutants` calls it and keeps the record.
//!
//! cargo-mutants lists the mutants; here all of them are compiled at once, each behind a switch that the
//! environment turns on, and a mutant costs no more than the tests that come past it: milliseconds where
//! a build for each would take seconds.
//!
//! ```text
//!   signorini-mutants LIST ROOT WORK FILE…
//!   {"outcome":"caught","file":"kernel/src/psor.rs","what":"replace < with <= in defect","line":"if own «<» b {","by":"exact"}
//! ```

mod edits;
mod error;
mod judge;
mod mutant;
mod shared;
mod suite;
mod switch;
mod tree;
mod viable;

use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use error::{Result, failed};
use judge::{Judge, Outcome};
use mutant::{Mutant, Span};
use tree::Tree;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [list, root, work, files @ ..] = &arguments[..] else {
        return Err(failed("usage: signorini-mutants LIST ROOT WORK FILE..."));
    };
    let (work, workers) = (Path::new(work), std::thread::available_parallelism()?.get());
    let mutants = Mutant::list(&fs::read_to_string(list)?)?;
    let tree = Tree::new(Path::new(root), work)?;
    let target = work.join("build");
    let start = Instant::now();
    let known = viable::make_viable(&tree, &mutants, &work.join("checks"))?;
    eprintln!(
        "{:.0?}: {} of {} mutants compile",
        start.elapsed(),
        mutants.len() - known.unviable.len(),
        mutants.len()
    );
    let tests = suite::suite(&tree.built, &target, workers)?;
    eprintln!("{:.0?}: {} tests reach mutants", start.elapsed(), tests.len());
    let judge = Judge::new(&tests);
    for file in files {
        let of_file: Vec<_> = mutants.iter().filter(|mutant| mutant.file == *file).collect();
        let text = fs::read_to_string(Path::new(root).join(file))?;
        let has_switch = |mutant: &&Mutant| known.is_open(mutant.id);
        let switched: Vec<_> = of_file.iter().copied().filter(has_switch).collect();
        let mut judged = judge.all(&switched, workers)?.into_iter();
        for mutant in of_file {
            let (outcome, by) = if has_switch(&mutant) {
                judged.next().unwrap_or((Outcome::Missed, String::new()))
            } else if known.unviable.contains(&mutant.id) {
                (Outcome::Unviable, String::new())
            } else {
                (Outcome::Unswitched, String::new())
            };
            println!("{}", told(mutant, outcome, &by, &text));
        }
        eprintln!("{:.0?}: {file}", start.elapsed());
    }
    Ok(())
}

/// What became of a mutant of this text, and the test that decided.
fn told(mutant: &Mutant, outcome: Outcome, by: &str, text: &str) -> serde_json::Value {
    let what = mutant.name.splitn(4, ':').nth(3).unwrap_or_default();
    let what = what.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = text.lines().nth(mutant.span.start.line - 1).unwrap_or_default();
    let (file, line) = (&mutant.file, marked(line, mutant.span));
    serde_json::json!({ "outcome": outcome, "file": file, "what": what, "line": line, "by": by })
}

/// The line in which a span begins, its place between marks.
fn marked(line: &str, Span { start, end }: Span) -> String {
    let columns: Vec<char> = line.chars().collect();
    let to = if end.line == start.line { end.column - 1 } else { columns.len() };
    let to = to.min(columns.len());
    let from = (start.column - 1).min(to);
    let part = |range: std::ops::Range<usize>| columns[range].iter().collect::<String>();
    let text = format!("{}«{}»{}", part(0..from), part(from..to), part(to..columns.len()));
    text.trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mutant::SourcePosition;

    #[test]
    fn places_are_marked() {
        let place = |line, column| SourcePosition { line, column };
        let span = |from, to| Span { start: place(1, from), end: to };
        assert_eq!(marked("    ψ < b", span(7, place(1, 8))), "ψ «<» b");
        assert_eq!(marked("  first", span(3, place(2, 1))), "«first»");
        assert_eq!(marked("", span(5, place(1, 9))), "«»");
    }
}

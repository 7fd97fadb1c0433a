//! `cargo xtask house`: rules of the house that no compiler holds, each with the names of those that break it.
//!
//! Source files are read as syntax; tests within them may do as they like.

mod first_lines;
mod rules;
mod sources;

use crate::steps::Steps;
use rules::Rule;
use sources::Source;

/// A step per rule.
pub fn run(steps: &mut Steps) {
    let sources = Source::all();
    for Rule { name, broken_by } in &rules::RULES {
        steps.lint(name, || {
            let sources = sources.as_ref().map_err(Clone::clone)?;
            let culprits = broken_by(sources);
            if culprits.is_empty() { Ok(()) } else { Err(culprits.join("; ")) }
        });
    }
    first_lines::run(steps);
}

//! `signorini extremes`: every scale pushed until something gives, and what gives said in so many words.
//!
//! ```text
//!   axis, plan ─► Case ─► posed (solution, grid: scene and mesh at that scale) ─► attempt (read, check, solve)
//!                   └───► the same at scale 1 ─► measure (exact solution, direct solver) ─► judge ─► record
//!   record ─► section
//! ```
//! Every case is a scene file and a mesh file that go through the reader, the checks and the default
//! options of [`signorini_solve`], on a thread of its own that may panic or be left alone after its limit of time. The
//! outcomes are defined in `judge`.

mod attempt;
mod axis;
mod case;
mod flush;
mod grid;
mod judge;
mod kept;
mod measure;
mod plan;
mod posed;
pub mod random;
pub(crate) mod record;
pub(crate) mod section;
mod solution;
mod watch;

use std::cmp::Reverse;
use std::time::{Duration, Instant};

use crate::record_file::{csv, json, word};
use crate::trade::journal::digest;
use attempt::{Attempt, attempt};
use case::ExtremeCase;
use flush::flushed;
use judge::{Answered, Outcome, failed, lost, ratio};
use measure::{Measured, measure, of_ticks};
use record::{Record, Row, definitions, text};
use section::section;
use watch::watched;

pub use kept::{Findings, Kept};

use signorini_draw::extremes_page;
use signorini_problem::threads::on_two_threads;
use signorini_scene::{Error, Result};

/// Longer than any case takes by a factor of some ten, on a machine that has other work: what has no answer by then hangs.
const LIMIT: Duration = Duration::from_secs(900);

/// The cases of all studies, or those whose name contains `only`.
pub fn cases(only: Option<&str>) -> Vec<ExtremeCase> {
    let mut cases = plan::cases();
    cases.retain(|case| only.is_none_or(|only| case.name().contains(only)));
    cases
}

/// Runs the cases that are not yet `kept` in two threads, the largest first; calls `done` after each.
pub fn run(cases: &[ExtremeCase], kept: &Kept, done: impl Fn() + Sync) -> Result<Findings> {
    let mut order: Vec<usize> = (0..cases.len()).collect();
    order.sort_by_key(|&at| Reverse(cases[at].posed.grid.n));
    let found = |&at: &usize| {
        let case = &cases[at];
        let key = format!("{}, {:016x}", case.name(), digest(&format!("{case:?}")));
        Ok((at, kept.row(&key, || row(case))?))
    };
    let mut rows = on_two_threads(&order, found, done)?;
    rows.sort_by_key(|&(at, _)| at);
    let cases = rows.into_iter().map(|(_, row)| row).collect();
    let record = Record { definitions: definitions(), seconds: kept.seconds(), cases };
    let made_by = format!("signorini {}; {:.0} s", env!("CARGO_PKG_VERSION"), record.seconds);
    let page = extremes_page(&section(&record), &made_by);
    let wrong = (0..).zip(&record.cases).filter(|(_, row)| row.outcome == Outcome::Wrong);
    Ok(Findings {
        files: vec![
            ("extremes.json", json(&record).into_bytes()),
            ("extremes.csv", csv("extremes.csv", &record.cases)?),
            ("extremes.html", page.into_bytes()),
        ],
        text: text(&record),
        wrong: wrong.map(|(at, _)| at).collect(),
    })
}

/// Remains of a case: the answer, how wrong it is, and how long it took.
type Left = (Result<(Attempt, Measured)>, f64);

fn row(case: &ExtremeCase) -> Result<Row> {
    let folder = tempfile::tempdir().map_err(Error::io(&std::env::temp_dir()))?;
    let (place, own) = (folder.path().to_owned(), case.clone());
    let left = watched(LIMIT, move || -> Left {
        let start = Instant::now();
        let found = match own.effort.flush {
            true => flushed(|| attempt(&own, &place)),
            false => attempt(&own, &place),
        };
        let seconds = start.elapsed().as_secs_f64();
        (found.and_then(|found| measured(&own, found)), seconds)
    });
    let (answer, seconds, (outcome, note)) = match left {
        Ok((Ok((attempt, measured)), seconds)) => {
            let (scalar, status) = (case.scalar, attempt.answer.status);
            let (success, status) = (status.is_success(), status.name());
            let verdict = Answered { success, status, scalar, measured }.verdict();
            (Some((attempt, measured)), seconds, verdict)
        }
        Ok((Err(error), seconds)) => (None, seconds, failed(error)),
        Err(why) => (None, LIMIT.as_secs_f64(), lost(why)),
    };
    Ok(Row { outcome, note, seconds, ..described(case, answer.as_ref()) })
}

fn measured(case: &ExtremeCase, attempt: Attempt) -> Result<(Attempt, Measured)> {
    let found = match case.effort.ticks {
        0 => measure(case, &attempt),
        _ => of_ticks(case, &attempt),
    };
    // What cannot be posed at scale 1 is a mistake of this study, not of the input.
    let found = found.map_err(|error| Error::Check(format!("not measured: {error}")))?;
    Ok((attempt, found))
}

/// The numbers of a case; those that are not finite are left out.
fn described(case: &ExtremeCase, answer: Option<&(Attempt, Measured)>) -> Row {
    let row = Row {
        axis: case.axis.clone(),
        value: case.value,
        axis2: case.across.as_ref().map(|(axis, _)| axis.clone()),
        value2: case.across.as_ref().map(|&(_, value)| value),
        scalar: word(&case.scalar),
        ..Row::default()
    };
    let Some((attempt, measured)) = answer else { return row };
    let finite = |number: f64| number.is_finite().then_some(number);
    let (bound, error) = (measured.bound.and_then(finite), finite(measured.error));
    let [error_u, error_flux] = measured.of_fields.map_or([None; 2], |of| of.map(finite));
    Row {
        error_over_bound: error.zip(bound).and_then(|(error, bound)| ratio(error, bound)),
        sweeps: Some(attempt.answer.sweeps),
        unknowns: Some(attempt.unknowns),
        status: Some(attempt.answer.status.name().to_owned()),
        error,
        bound,
        reference_bound: measured.reference.and_then(|of| of.bound).and_then(finite),
        energy: measured.reference.and_then(|of| finite(of.energy)),
        error_u,
        error_flux,
        ..row
    }
}

//! The findings of a run, as `extremes.json` and `extremes.csv` hold them and as the terminal shows them.

use std::fmt::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::judge::{DIGITS, FAR, INTEGRATED, Outcome, USEFUL, counts};
use crate::record_file::{self, word};
use signorini_draw::{Column, Table};
use signorini_scene::Result;

/// The committed record, from the root of the checkout.
pub const RECORD: &str = "host/benches/extremes/extremes.json";

/// A run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Record {
    pub definitions: Vec<Definition>,
    pub seconds: f64,
    pub cases: Vec<Row>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Definition {
    pub outcome: Outcome,
    pub means: String,
}

#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Row {
    /// The axis, and which of several studies along it.
    pub axis: String,
    pub value: f64,
    pub axis2: Option<String>,
    /// The place on that.
    pub value2: Option<f64>,
    /// `f64`, `f32`.
    pub scalar: String,
    pub outcome: Outcome,
    /// True error over bound; none without a bound.
    pub error_over_bound: Option<f64>,
    /// Sweeps of the solve; of ticks the most that one took; none where nothing was solved.
    pub sweeps: Option<u32>,
    /// Edges not on D.
    pub unknowns: Option<usize>,
    pub status: Option<String>,
    /// The true error that the bound is for, at scale 1; without a bound ‖A^½∇_h(u − u_h)‖.
    pub error: Option<f64>,
    /// The bound, at scale 1.
    pub bound: Option<f64>,
    /// The bound of the exact discrete solution in f64, at scale 1.
    pub reference_bound: Option<f64>,
    /// ‖A^½∇_h u_h‖ of the exact discrete solution, at scale 1.
    pub energy: Option<f64>,
    /// |u − u_h|₁ on trapezoids.
    pub error_u: Option<f64>,
    /// ‖σ − σ_h‖ on trapezoids.
    pub error_flux: Option<f64>,
    /// Wall-clock seconds of the attempt alone, files included.
    pub seconds: f64,
    pub note: String,
}

/// The sentences of the record and of the report.
pub fn definitions() -> Vec<Definition> {
    let [double, single] = DIGITS;
    let far = FAR;
    let words = [
        format!(
            "success is claimed, the true error is at most the bound (to {INTEGRATED:e}, and to what \
             fewer points change in its integral), \
             and the bound is at most {USEFUL} times that of the exact discrete solution (or {double:e} of the \
             energy norm in f64, {single:e} in f32) and no larger than the energy norm itself"
        ),
        "the true error is at most the bound, but the bound is wider than that or no success is claimed; or there \
         is no bound, and the answer says so"
            .to_owned(),
        "the input was refused before work began, with a message that says why".to_owned(),
        format!(
            "an error above its bound, a number that is not finite, success claimed without a bound for more than \
             {far} times the error of the exact discrete solution, a refusal after work, a panic, no end"
        ),
    ];
    let both = Outcome::ALL.into_iter().zip(words);
    both.map(|(outcome, means)| Definition { outcome, means }).collect()
}

impl Record {
    /// Reads the record at `path`; none where there is no file.
    pub fn read(path: &Path) -> Result<Option<Self>> {
        record_file::read(path, "extremes", "signorini extremes")
    }

    /// How many cases have this outcome.
    pub fn count(&self, outcome: Outcome) -> usize {
        self.cases.iter().filter(|case| case.outcome == outcome).count()
    }

    /// How many cases ended in which way, in words.
    pub fn counts(&self) -> String {
        counts(|of| self.count(of))
    }

    /// The studies in their order: the cases along an axis, or a pair of them.
    pub fn studies(&self) -> impl Iterator<Item = &[Row]> {
        self.cases.chunk_by(|a, b| (&a.axis, &a.axis2) == (&b.axis, &b.axis2))
    }
}

/// The cases of a study in one scalar.
struct Line<'r> {
    name: String,
    scalar: &'static str,
    cases: Vec<&'r Row>,
}

/// A line for each study: how many cases ended in which way, and the most sweeps; then what is wrong.
pub fn text(record: &Record) -> String {
    let mut columns = vec![
        Column::words("extremes", |line: &Line| line.name.clone()),
        Column::words("scalar", |line: &Line| line.scalar.to_owned()),
    ];
    columns.extend(Outcome::ALL.map(|outcome| {
        Column::number(&word(&outcome), move |line: &Line| {
            match line.cases.iter().filter(|case| case.outcome == outcome).count() {
                0 => "·".to_owned(),
                some => some.to_string(),
            }
        })
    }));
    columns.push(Column::number("most sweeps", |line: &Line| {
        let sweeps = line.cases.iter().filter_map(|case| case.sweeps).max();
        sweeps.map_or("–".to_owned(), |sweeps| sweeps.to_string())
    }));
    let mut text = Table::new(&columns, lines(record)).text() + "\n";
    for case in record.cases.iter().filter(|case| case.outcome == Outcome::Wrong) {
        let _ = writeln!(text, "wrong: {}: {}", place(case), case.note);
    }
    let _ = write!(text, "{} cases: {}", record.cases.len(), record.counts());
    text
}

fn lines(record: &Record) -> Vec<Line<'_>> {
    let mut lines = Vec::new();
    for study in record.studies() {
        for (scalar, name) in [("f64", heading(&study[0])), ("f32", String::new())] {
            let cases = study.iter().filter(|case| case.scalar == scalar).collect();
            lines.push(Line { name, scalar, cases });
        }
    }
    lines
}

/// The axis of a case, and what it is crossed with.
pub(super) fn heading(Row { axis, axis2, .. }: &Row) -> String {
    axis2.as_ref().map_or(axis.clone(), |across| format!("{axis} × {across}"))
}

/// Where a case lies, in words.
pub(super) fn place(case: &Row) -> String {
    let across = case.axis2.as_ref().zip(case.value2);
    let across = across.map(|(axis, value)| format!(", {axis} {value:e}")).unwrap_or_default();
    format!("{} {:e}{across}, {}", case.axis, case.value, case.scalar)
}

#[cfg(test)]
pub(super) mod tests;

//! A run as the terminal shows it.

use std::fmt::Write;

use super::judge::Outcome;
use super::record::{Record, Row};
use signorini_draw::{Column, Table};

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
        Column::number(outcome.name(), move |line: &Line| {
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
    for (axis, across, cases) in record.studies() {
        let name = across.map_or(axis.to_owned(), |across| format!("{axis} × {across}"));
        for (scalar, name) in [("f64", name), ("f32", String::new())] {
            let cases = cases.iter().copied().filter(|case| case.scalar == scalar).collect();
            lines.push(Line { name, scalar, cases });
        }
    }
    lines
}

/// Where a case lies, in words.
pub(super) fn place(case: &Row) -> String {
    let across = case.axis2.as_ref().zip(case.value2);
    let across = across.map(|(axis, value)| format!(", {axis} {value:e}")).unwrap_or_default();
    format!("{} {:e}{across}, {}", case.axis, case.value, case.scalar)
}

#[cfg(test)]
mod tests {
    use super::super::record::tests::fixture;
    use super::*;

    #[test]
    fn a_line_a_study_and_scalar_and_one_for_each_that_is_wrong() {
        let text = text(&fixture());
        assert_eq!(text.lines().count(), 1 + 4 + 1 + fixture().count(Outcome::Wrong) + 1, "{text}");
        assert!(text.contains("unit of length × load < 1"));
        assert!(text.contains("wrong: contrast 1e9, f64: note 3"));
        assert!(
            text.ends_with("20 cases: 6 correct, 6 certified-poor, 4 typed-error, 4 wrong"),
            "{text}"
        );
    }
}

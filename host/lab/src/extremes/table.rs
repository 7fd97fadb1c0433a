//! A run as the terminal shows it.

use std::fmt::Write;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::judge::Outcome;
use super::record::{Record, Row};

/// A line a study: how many cases ended in which way, and the most sweeps; then what is wrong.
pub fn text(record: &Record) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    let outcomes = Outcome::ALL.map(Outcome::name);
    table.set_header(["extremes", "scalar"].into_iter().chain(outcomes).chain(["most sweeps"]));
    for (axis, across, cases) in record.studies() {
        let name = across.map_or(axis.to_owned(), |across| format!("{axis} × {across}"));
        for scalar in ["f64", "f32"] {
            let cases: Vec<&&Row> = cases.iter().filter(|case| case.scalar == scalar).collect();
            let count = |outcome| cases.iter().filter(|case| case.outcome == outcome).count();
            let counts = Outcome::ALL.map(|outcome| match count(outcome) {
                0 => "·".to_owned(),
                some => some.to_string(),
            });
            let sweeps = cases.iter().filter_map(|case| case.sweeps).max();
            let sweeps = sweeps.map_or("–".to_owned(), |sweeps| sweeps.to_string());
            let first = if scalar == "f64" { name.clone() } else { String::new() };
            table.add_row([first, scalar.to_owned()].into_iter().chain(counts).chain([sweeps]));
        }
    }
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut text = format!("{}\n\n", table.trim_fmt());
    for case in record.cases.iter().filter(|case| case.outcome == Outcome::Wrong) {
        let _ = writeln!(text, "wrong: {}: {}", place(case), case.note);
    }
    let counts =
        Outcome::ALL.map(|outcome| format!("{} {}", record.count(outcome), outcome.name()));
    let _ = write!(text, "{} cases: {}", record.cases.len(), counts.join(", "));
    text
}

/// Where a case lies, in words.
pub(super) fn place(case: &Row) -> String {
    let across = case.axis2.as_ref().zip(case.value2);
    let across = across.map(|(axis, value)| format!(", {axis} {value:e}")).unwrap_or_default();
    format!("{} {:e}{across}, {}", case.axis, case.value, case.scalar)
}

#[cfg(test)]
mod tests {
    use super::super::record::fixture;
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

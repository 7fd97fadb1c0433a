//! A study as the terminal shows it.

use std::fmt::Write;

use super::digits::grouped;
use super::listings::{baselines, front, math, skipped};
use super::picture::target_name;
use super::record::Trade;

/// The front, other solvers, micromath, what was skipped, and last what to take.
pub fn text(trade: &Trade) -> String {
    let measured = grouped(trade.points.len() as u64);
    let mut text = format!(
        "{} ({}) on the {}: what nothing beats among {measured} settings\n{}",
        trade.title,
        trade.scene,
        target_name(&trade.target),
        front(trade).text()
    );
    let _ = writeln!(text, "errors: true ones, {}; force: of the contact force", trade.truth);
    let further = [
        ("Other solvers on the same matrices", baselines(trade)),
        ("What micromath does to the solution", math(trade)),
    ];
    for (heading, table) in further.iter().filter(|(_, table)| !table.rows.is_empty()) {
        let _ = write!(text, "\n{heading}\n{}", table.text());
    }
    trade.notes.iter().for_each(|note| text += &format!("* {note}\n"));
    let skipped = skipped(trade).map_or(String::new(), |skipped| skipped + "\n");
    let _ = write!(text, "\n{skipped}{}\n", trade.recommendation.text);
    text
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::trade;
    use super::*;

    #[test]
    fn a_person_can_read_it() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/src/trade/table.txt");
        let found = text(&trade("levee", 40));
        let expected = std::fs::read_to_string(file).unwrap_or_default();
        assert_eq!(found, expected, "found:\n{found}");
    }

    #[test]
    fn nothing_found_is_said_in_few_lines() {
        let mut trade = trade("levee", 0);
        trade.baselines.clear();
        trade.math.clear();
        trade.skipped = 0;
        let text = text(&trade);
        assert!(!text.contains("Other solvers") && !text.contains("not measured"), "{text}");
        assert!(text.lines().count() < 8, "{text}");
    }
}

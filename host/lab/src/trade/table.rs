//! A study as the terminal shows it.

use std::fmt::Write;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::digits::grouped;
use super::listings::{baselines, front, math, skipped};
use super::picture::target_name;
use super::record::Trade;
use signorini_draw::Listing;

/// The front, other solvers, micromath, what was skipped, and last what to take.
pub fn text(trade: &Trade) -> String {
    let measured = grouped(trade.points.len() as u64);
    let mut text = format!(
        "{} ({}) on the {}: what nothing beats among {measured} settings\n{}",
        trade.title,
        trade.scene,
        target_name(&trade.target),
        lines(&front(trade))
    );
    let _ = writeln!(text, "errors: true ones, {}; force: of the contact force", trade.truth);
    let further = [
        ("Other solvers on the same matrices", baselines(trade)),
        ("What micromath does to the solution", math(trade)),
    ];
    for (heading, table) in further.iter().filter(|(_, table)| !table.rows.is_empty()) {
        let _ = write!(text, "\n{heading}\n{}", lines(table));
    }
    trade.notes.iter().for_each(|note| text += &format!("* {note}\n"));
    let skipped = skipped(trade).map_or(String::new(), |skipped| skipped + "\n");
    let _ = write!(text, "\n{skipped}{}\n", trade.recommendation.text);
    text
}

/// The table, an arrow before the row that stands out.
pub(super) fn lines(listing: &Listing) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    let mut header = listing.header.clone();
    let mut rows = listing.rows.clone();
    if let Some(marked) = listing.marked {
        header.insert(0, String::new());
        for (at, row) in rows.iter_mut().enumerate() {
            row.insert(0, if at == marked { "→" } else { "" }.to_owned());
        }
    }
    table.set_header(header);
    table.add_rows(rows);
    for (column, cells) in table.column_iter_mut().skip(listing.marked.iter().len()).enumerate() {
        let words = listing.rows.iter().any(|row| !is_number(row.get(column)));
        let alignment = if words { CellAlignment::Left } else { CellAlignment::Right };
        cells.set_cell_alignment(alignment);
    }
    format!("{}\n", table.trim_fmt())
}

/// Whether a cell is no word.
fn is_number(cell: Option<&String>) -> bool {
    cell.is_none_or(|cell| !cell.chars().next().is_some_and(char::is_alphabetic))
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

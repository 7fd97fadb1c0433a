//! Tables: of rows that pass or fail, and of rows one of which may stand out.

use std::fmt::Write;

use super::frame::mark;
use super::svg::escape;
use super::{Listing, ScenePanel, Table};

/// A table whose rows are marked as passed or failed; names of scenes link to their panels.
pub fn checked(table: &Table, scenes: &[ScenePanel]) -> String {
    let cells: Vec<&[String]> = table.rows.iter().map(|row| row.cells.as_slice()).collect();
    let columns = Columns::new(&table.header, &cells);
    let mut html = columns.head("<th></th>");
    for row in &table.rows {
        let class = if row.passed { "" } else { " class=\"failed\"" };
        let _ = write!(html, "<tr{class}><td>{}</td>", mark(row.passed));
        html += &columns.row(&row.cells, |cell| {
            let scene = scenes.iter().position(|scene| scene.name == cell);
            scene.map(|scene| format!("<a href=\"#scene-{scene}\">{}</a>", escape(cell)))
        });
    }
    html + FOOT
}

/// A table of facts.
pub fn listing(listing: &Listing) -> String {
    let cells: Vec<&[String]> = listing.rows.iter().map(Vec::as_slice).collect();
    let columns = Columns::new(&listing.header, &cells);
    let mut html = columns.head("");
    for (at, row) in listing.rows.iter().enumerate() {
        html += if listing.marked == Some(at) { "<tr class=\"marked\">" } else { "<tr>" };
        html += &columns.row(row, |_| None);
    }
    html + FOOT
}

const FOOT: &str = "</tbody>\n</table>\n</div>\n";

/// Names of columns, and which hold numbers.
struct Columns<'t> {
    header: &'t [String],
    numeric: Vec<bool>,
}

impl<'t> Columns<'t> {
    fn new(header: &'t [String], rows: &[&[String]]) -> Self {
        let numeric = |column: usize| rows.iter().all(|row| is_number(row.get(column)));
        Self { header, numeric: (0..header.len()).map(numeric).collect() }
    }

    fn class(&self, column: usize) -> &'static str {
        if self.numeric.get(column) == Some(&true) { " class=\"number\"" } else { "" }
    }

    /// Everything before the rows, with what goes before the first name.
    fn head(&self, first: &str) -> String {
        let mut html = format!("<div class=\"scroll\">\n<table>\n<thead><tr>{first}");
        for (column, name) in self.header.iter().enumerate() {
            let _ = write!(html, "<th{}>{}</th>", self.class(column), escape(name));
        }
        html + "</tr></thead>\n<tbody>\n"
    }

    /// The cells of a row to its end; `link` may make more than text of the first one.
    fn row(&self, cells: &[String], link: impl Fn(&str) -> Option<String>) -> String {
        let mut html = String::new();
        for (column, cell) in cells.iter().enumerate() {
            let linked = if column == 0 { link(cell) } else { None };
            let text = linked.unwrap_or_else(|| escape(cell));
            let _ = write!(html, "<td{}>{text}</td>", self.class(column));
        }
        html + "</tr>\n"
    }
}

/// Numbers, and what stands for a missing one, are aligned to the right.
fn is_number(cell: Option<&String>) -> bool {
    let text = cell.map_or("", |cell| cell.trim_start_matches(['+', '-', '−', '–', '<', '≤', ' ']));
    text.is_empty() || text.starts_with(|first: char| first.is_ascii_digit())
}

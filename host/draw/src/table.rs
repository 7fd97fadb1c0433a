//! Tables: one list of columns makes a table for the terminal and for a page.
//!
//! ```text
//!   columns, rows ─► Table ─┬─► text: the terminal
//!                           └─► html: the report
//! ```

use std::fmt::Write;
use std::iter::once;

use super::ScenePanel;
use super::markup::{mark, typeset};
use super::svg::escape;

/// A column: its name, whether its cells are words or numbers, and how a cell is read off a row.
pub struct Column<'c, R> {
    heading: Heading,
    cell: Box<dyn Fn(&R) -> String + 'c>,
}

/// The head of a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Heading {
    /// Name on the terminal, where room is short.
    pub name: String,
    /// Name on a page, where it may take several lines.
    pub title: String,
    /// Whether the cells are numbers, aligned to the right.
    pub has_numbers: bool,
}

impl<'c, R> Column<'c, R> {
    /// A column of words.
    pub fn words(name: &str, cell: impl Fn(&R) -> String + 'c) -> Self {
        let heading = Heading { name: name.to_owned(), title: name.to_owned(), has_numbers: false };
        Self { heading, cell: Box::new(cell) }
    }

    /// A column of numbers, with the unit in its name.
    pub fn number(name: &str, cell: impl Fn(&R) -> String + 'c) -> Self {
        let column = Self::words(name, cell);
        Self { heading: Heading { has_numbers: true, ..column.heading }, ..column }
    }

    /// Gives the column another name on a page.
    #[must_use]
    pub fn titled(self, title: &str) -> Self {
        Self { heading: Heading { title: title.to_owned(), ..self.heading }, ..self }
    }
}

/// A filled table.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Table {
    /// The heads of the columns.
    pub headings: Vec<Heading>,
    /// The rows.
    pub rows: Vec<TableRow>,
}

/// A row of a table.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TableRow {
    /// A text for each column.
    pub cells: Vec<String>,
    /// The note on the row.
    pub mark: Mark,
}

/// The note on a row as a whole.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mark {
    /// Nothing.
    #[default]
    None,
    /// The row stands out.
    Chosen,
    /// Everything that the row claims holds.
    Passed,
    /// Something that the row claims does not hold.
    Failed,
}

impl Table {
    /// Reads the cells of `columns` off `rows`.
    pub fn new<R>(columns: &[Column<R>], rows: impl IntoIterator<Item = R>) -> Self {
        Self::marked(columns, rows, |_| Mark::None)
    }

    /// Reads the cells of `columns` off `rows`, each of which `passed` or failed.
    pub fn checked<R>(
        columns: &[Column<R>],
        rows: impl IntoIterator<Item = R>,
        passed: impl Fn(&R) -> bool,
    ) -> Self {
        let mark = |row: &R| if passed(row) { Mark::Passed } else { Mark::Failed };
        Self::marked(columns, rows, mark)
    }

    fn marked<R>(
        columns: &[Column<R>],
        rows: impl IntoIterator<Item = R>,
        mark: impl Fn(&R) -> Mark,
    ) -> Self {
        let cells = |row: &R| columns.iter().map(|column| (column.cell)(row)).collect();
        let rows = rows.into_iter().map(|row| TableRow { cells: cells(&row), mark: mark(&row) });
        let headings = columns.iter().map(|column| column.heading.clone()).collect();
        Self { headings, rows: rows.collect() }
    }

    /// Lets a row stand out, if there is one to choose.
    #[must_use]
    pub fn choosing(mut self, at: Option<usize>) -> Self {
        if let Some(row) = at.and_then(|at| self.rows.get_mut(at)) {
            row.mark = Mark::Chosen;
        }
        self
    }

    /// The lines of a terminal: an arrow before a chosen row, whether it passed behind a checked one.
    pub fn text(&self) -> String {
        let mut columns: Vec<Vec<String>> = Vec::new();
        for (at, Heading { name, has_numbers, .. }) in self.headings.iter().enumerate() {
            let cells = self.rows.iter().map(|row| row.cells.get(at).map_or("", String::as_str));
            columns.push(padded(*has_numbers, once(name.as_str()).chain(cells)));
        }
        let marks = |arrow: bool| self.rows.iter().map(move |row| row.mark.word(arrow));
        if self.has(Mark::Chosen) {
            columns.insert(0, padded(false, once("").chain(marks(true))));
        }
        if self.is_checked() {
            columns.push(padded(true, once("ok").chain(marks(false))));
        }
        let line = |at: usize| columns.iter().map(|cells| cells[at].as_str()).collect::<String>();
        (0..=self.rows.len()).map(|at| format!("{}\n", line(at).trim_end())).collect()
    }

    /// The table of a page; names of `scenes` in the first column link to their panels.
    pub fn html(&self, scenes: &[ScenePanel]) -> String {
        let mut html = "<div class=\"scroll\">\n<table>\n<thead><tr>".to_owned();
        for Heading { title, has_numbers, .. } in &self.headings {
            let _ = write!(html, "<th{}>{}</th>", class(*has_numbers), typeset(title));
        }
        html += "</tr></thead>\n<tbody>\n";
        for row in &self.rows {
            let [open, mark] = row.mark.html();
            html += open;
            for (at, (cell, heading)) in row.cells.iter().zip(&self.headings).enumerate() {
                let scene = scenes.iter().position(|scene| at == 0 && scene.name == *cell);
                let link = |scene| format!("<a href=\"#scene-{scene}\">{}</a>", escape(cell));
                let text = scene.map_or_else(|| escape(cell), link);
                let mark = if at == 0 { mark } else { "" };
                let _ = write!(html, "<td{}>{mark}{text}</td>", class(heading.has_numbers));
            }
            html += "</tr>\n";
        }
        html + "</tbody>\n</table>\n</div>\n"
    }

    fn has(&self, mark: Mark) -> bool {
        self.rows.iter().any(|row| row.mark == mark)
    }

    fn is_checked(&self) -> bool {
        self.has(Mark::Passed) || self.has(Mark::Failed)
    }
}

impl Mark {
    /// Its word on the terminal, as an arrow or as a verdict.
    fn word(self, arrow: bool) -> &'static str {
        match (self, arrow) {
            (Self::Chosen, true) => "→",
            (Self::Passed, false) => "yes",
            (Self::Failed, false) => "NO",
            _ => "",
        }
    }

    /// The beginning of its row on a page, and of the first cell there.
    fn html(self) -> [&'static str; 2] {
        match self {
            Self::None => ["<tr>", ""],
            Self::Chosen => ["<tr class=\"marked\">", ""],
            Self::Passed => ["<tr>", mark(true)],
            Self::Failed => ["<tr class=\"failed\">", mark(false)],
        }
    }
}

/// Cells of equal width, numbers aligned to the right.
fn padded<'t>(has_numbers: bool, cells: impl Iterator<Item = &'t str> + Clone) -> Vec<String> {
    let width = cells.clone().map(|cell| cell.chars().count()).max().unwrap_or(0);
    let pad = |cell| match has_numbers {
        true => format!(" {cell:>width$} "),
        false => format!(" {cell:<width$} "),
    };
    cells.map(pad).collect()
}

fn class(has_numbers: bool) -> &'static str {
    if has_numbers { " class=\"number\"" } else { "" }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns<'c>() -> [Column<'c, (&'c str, u32)>; 2] {
        [
            Column::words("scene", |row: &(&str, u32)| row.0.to_owned()),
            Column::number("n", |row: &(&str, u32)| row.1.to_string()).titled("number < 3"),
        ]
    }

    #[test]
    fn words_stand_left_and_numbers_right() {
        let table = Table::new(&columns(), [("a", 100), ("π½", 2)]);
        assert_eq!(table.text(), " scene    n\n a      100\n π½       2\n");
        let chosen = table.clone().choosing(Some(1)).text();
        assert_eq!(chosen, "    scene    n\n    a      100\n →  π½       2\n");
        assert_eq!(table.clone().choosing(None), table);
        assert_eq!(table.choosing(Some(2)).text().matches('→').count(), 0);
    }

    #[test]
    fn rows_that_fail_are_marked_and_scenes_linked() {
        let table = Table::checked(&columns(), [("a", 1), ("b", 2)], |row| row.1 < 2);
        assert_eq!(table.text(), " scene  n   ok\n a      1  yes\n b      2   NO\n");
        let html = table.html(&[ScenePanel { name: "b".to_owned(), ..ScenePanel::default() }]);
        assert!(html.contains("<tr><th>scene</th><th class=\"number\">number &lt; 3</th>"));
        let [passed, failed] = [true, false].map(mark);
        assert!(html.contains(&format!("<tr><td>{passed}a</td>")), "{html}");
        assert!(html.contains(&format!("<tr class=\"failed\"><td>{failed}<a href=\"#scene-0\">")));
        assert!(html.contains("b</a></td><td class=\"number\">2</td>"));
    }
}

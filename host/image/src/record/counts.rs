//! Instructions of every stage by board and kind of data: `host/bake/records/cost.txt`.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::fields;

/// How the head of a board's table ends.
const HEAD: &str = ": instructions";

/// Instructions per unit, by board, kind and stage.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Counts(BTreeMap<(String, String, String), f64>);

impl Counts {
    /// Adds a count.
    pub fn insert(&mut self, board: &str, kind: &str, stage: &str, count: f64) {
        self.0.insert((board.to_owned(), kind.to_owned(), stage.to_owned()), count);
    }

    /// A count, if there is one.
    pub fn get(&self, board: &str, kind: &str, stage: &str) -> Option<f64> {
        self.0.get(&(board.to_owned(), kind.to_owned(), stage.to_owned())).copied()
    }

    /// A board's table: a row per stage (with its unit), a column per kind.
    pub fn table(&self, board: &str, kinds: &[&str], stages: &[(String, String)]) -> String {
        let mut text = format!("{:<36}{:<8}", format!("{board}{HEAD}"), "per");
        kinds.iter().for_each(|kind| text += &format!("{kind:>16}"));
        text += "\n";
        for (stage, unit) in stages {
            let _ = write!(text, "{stage:<36}{unit:<8}");
            for kind in kinds {
                let count = self.get(board, kind, stage);
                let count = count.map_or("-".to_owned(), |count| format!("{count:.2}"));
                let _ = write!(text, "{count:>16}");
            }
            text += "\n";
        }
        text + "\n"
    }

    /// The counts of a record, which may have lines before its tables.
    ///
    /// # Errors
    /// A line that has not a field for each column.
    pub fn read(record: &str) -> Result<Self, String> {
        let mut counts = Self::default();
        let mut heads: Vec<&str> = Vec::new();
        let lines = record.lines().filter(|line| !line.is_empty());
        for line in lines.skip_while(|line| !line.contains(HEAD)) {
            let fields = fields(line);
            if fields.first().is_some_and(|first| first.ends_with(HEAD)) {
                heads = fields;
            } else {
                counts.take(&heads, &fields).ok_or(format!("no row of {heads:?}: `{line}`"))?;
            }
        }
        Ok(counts)
    }

    /// The counts of a line; `-` is none.
    fn take(&mut self, heads: &[&str], fields: &[&str]) -> Option<()> {
        let board = heads.first()?.strip_suffix(HEAD)?;
        let stage = fields.first().filter(|_| fields.len() == heads.len())?;
        for (kind, field) in heads.iter().zip(fields).skip(2).filter(|(_, field)| **field != "-") {
            self.insert(board, kind, stage, field.parse().ok()?);
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_stages() -> (Counts, String) {
        let mut counts = Counts::default();
        counts.insert("M4F", "f32 quads", "sweep", 33.75);
        counts.insert("M4F", "f64 quads", "sweep", 1417.0);
        counts.insert("M4F", "f64 quads", "rows, pattern", 458.5);
        let stages = [("sweep", "unknown"), ("rows, pattern", "unknown")];
        let stages = stages.map(|(stage, unit)| (stage.to_owned(), unit.to_owned()));
        let table = counts.table("M4F", &["f32 quads", "f64 quads"], &stages);
        (counts, table)
    }

    #[test]
    fn what_is_written_is_read() {
        let (counts, table) = two_stages();
        assert_eq!(Counts::read(&format!("rustc 1.96.0, QEMU 7.2\n\n{table}")), Ok(counts));
    }

    #[test]
    fn a_line_that_lacks_a_column_is_an_error() {
        let (_, table) = two_stages();
        let why = Counts::read(&table.replace("1417.00", "")).unwrap_err();
        assert!(why.contains("sweep"), "{why}");
        let why = Counts::read(&table.replace("1417.00", "many")).unwrap_err();
        assert!(why.contains("many"), "{why}");
    }
}

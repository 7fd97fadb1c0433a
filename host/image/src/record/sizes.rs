//! The sizes of images of baked scenes, by what the scenes contain: `host/bake/records/size.txt`.

use std::fmt::Write as _;

use super::fields;
use crate::footprint::{Footprint, Statics};

/// The subject of a row.
const HEAD: &str = "scene (f32)";

/// The table of these rows.
pub fn write(rows: &[(&str, Footprint)]) -> String {
    let mut table = format!("{HEAD:<36}{:>8}{:>9}{:>9}{:>8}\n", "code", "data", "RAM", "stack");
    for (name, Footprint { statics: Statics { code, data, ram }, stack }) in rows {
        let _ = writeln!(table, "{name:<36}{code:>8}{data:>9}{ram:>9}{stack:>8}");
    }
    table
}

/// The rows of a record, which may have lines before its table.
///
/// # Errors
/// No table, a column that it lacks, a line that is no row.
pub fn read(record: &str) -> Result<Vec<(String, Footprint)>, String> {
    let mut lines = record.lines().skip_while(|line| !line.starts_with(HEAD));
    let heads = fields(lines.next().ok_or(format!("no line begins with `{HEAD}`"))?);
    let rows = lines.take_while(|line| !line.is_empty());
    rows.map(|line| row(&heads, line).ok_or(format!("no row of {heads:?}: `{line}`"))).collect()
}

fn row(heads: &[&str], line: &str) -> Option<(String, Footprint)> {
    let fields = fields(line);
    let of = |head: &str| {
        let at = heads.iter().position(|known| *known == head)?;
        fields.get(at)?.parse().ok()
    };
    let statics = Statics { code: of("code")?, data: of("data")?, ram: of("RAM")? };
    let found = Footprint { statics, stack: of("stack")? };
    (fields.len() == heads.len()).then(|| (fields[0].to_owned(), found))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let statics = Statics { code: 7728, data: 1672, ram: 24 };
        let rows = [("linear, condensed", Footprint { statics, stack: 248 })];
        let table = write(&rows);
        let read_back = read(&format!("rustc 1.96.0, QEMU 7.2\n\n{table}"));
        assert_eq!(read_back, Ok(vec![(rows[0].0.to_owned(), rows[0].1)]));
    }

    #[test]
    fn columns_go_by_their_heads() {
        let moved =
            "scene (f32)   stack  code  RAM  data\nlevee, condensed   652   31352  9468  40872\n";
        let statics = Statics { code: 31352, data: 40872, ram: 9468 };
        let footprint = Footprint { statics, stack: 652 };
        assert_eq!(read(moved), Ok(vec![("levee, condensed".to_owned(), footprint)]));
        let why = read(&moved.replace("RAM", "ram")).unwrap_err();
        assert!(why.contains("levee, condensed"), "{why}");
        let why = read(&moved.replace("40872", "")).unwrap_err();
        assert!(why.contains("no row"), "{why}");
        assert_eq!(read("scene"), Err(format!("no line begins with `{HEAD}`")));
    }
}

//! `$PhysicalNames`: `dimension tag "name"`, a line each, text in every encoding.

use std::collections::hash_map::Entry;

use super::cursor::Cursor;
use crate::mesh::assemble::draft::{Names, Parsed};

/// Reads the names, by dimension and physical tag.
pub(super) fn names(cursor: &mut Cursor) -> Parsed<Names> {
    let count = cursor.count_line("the number of physical names", 2)?;
    let mut names = Names::new();
    for _ in 0..count {
        cursor.skip_blank_lines();
        let at = cursor.at();
        let line = cursor.line();
        let Some((dimension, tag, name)) = split(line) else {
            let message = "expected a physical name: dimension, tag and the name in quotes";
            return Err(cursor.error(at, message).into());
        };
        match names.entry((dimension, tag)) {
            Entry::Vacant(place) => place.insert(name),
            Entry::Occupied(_) => {
                let message =
                    format!("physical group {tag} of dimension {dimension} is named twice");
                return Err(cursor.error(at, message).into());
            }
        };
    }
    Ok(names)
}

/// The parts of a line. Gmsh writes quotes inside a name as they are: the last one closes.
fn split(line: &[u8]) -> Option<(u8, i32, String)> {
    let (head, quoted) = std::str::from_utf8(line).ok()?.split_once('"')?;
    let mut head = head.split_ascii_whitespace();
    let (dimension, tag) = (head.next()?.parse().ok()?, head.next()?.parse().ok()?);
    let name = quoted.strip_suffix('"')?;
    (head.next().is_none() && dimension <= 3).then(|| (dimension, tag, name.to_owned()))
}

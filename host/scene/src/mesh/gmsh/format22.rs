//! Formats 2.0 to 2.2: nodes and elements in one list each, every element with its physical tag.
//!
//! ```text
//! $Nodes                 $Elements
//! count                  count
//! tag x y z              tag type tags… nodes…        (ASCII; tags… = how many, then each)
//! ```
//! In binary the counts stay text, integers have 32 bits, and elements come in blocks
//! `type how-many how-many-tags` with records `tag tags… nodes…`. The first tag is the physical
//! group, 0 for none; an element in several groups is written once for each.

use super::cursor::{Cursor, Encoding};
use super::raw::{self, kind, point};
use crate::mesh::assemble::draft::{Element, Node, Parsed};

/// Reads `$Nodes`.
pub(super) fn nodes(cursor: &mut Cursor) -> Parsed<Vec<Node>> {
    let count = cursor.count_line("the number of nodes", 4)?;
    let mut nodes = Vec::with_capacity(count);
    for _ in 0..count {
        cursor.begin();
        let at = cursor.at();
        let tag = cursor.natural("a node tag")?;
        nodes.push(Node { tag, at, point: point(cursor, tag)? });
        cursor.end()?;
    }
    Ok(nodes)
}

/// Reads `$Elements`.
pub(super) fn elements(cursor: &mut Cursor) -> Parsed<Vec<Element>> {
    let count = cursor.count_line("the number of elements", 2)?;
    let mut elements = Vec::with_capacity(count);
    while elements.len() < count {
        cursor.begin();
        if cursor.encoding == Encoding::Ascii {
            let at = cursor.at();
            let tag = cursor.natural("an element number")?;
            let code = cursor.int("an element type")?;
            let labels = cursor.natural("the number of tags")?;
            elements.push(element(cursor, at, tag, code, labels)?);
        } else {
            block(cursor, &mut elements, count)?;
        }
    }
    Ok(elements)
}

/// Reads a binary block of elements.
fn block(cursor: &mut Cursor, elements: &mut Vec<Element>, count: usize) -> Parsed<()> {
    let start = cursor.at();
    let code = cursor.int("an element type")?;
    let many = cursor.natural("the number of elements in a block")?;
    let labels = cursor.natural("the number of tags")?;
    if many == 0 || many > (count - elements.len()) as u64 {
        let left = count - elements.len();
        let message = format!("a block of {many} elements, expected 1 to {left}");
        return Err(cursor.error(start, message).into());
    }
    for _ in 0..many {
        let at = cursor.at();
        let tag = cursor.natural("an element number")?;
        elements.push(element(cursor, at, tag, code, labels)?);
    }
    Ok(())
}

/// Reads the tags and nodes of an element.
fn element(cursor: &mut Cursor, at: u32, tag: u64, code: i32, labels: u64) -> Parsed<Element> {
    let kind = kind(code, tag, at, cursor)?;
    let mut label = 0;
    for k in 0..labels {
        let next = cursor.int("a tag of the element")?;
        label = if k == 0 { next } else { label };
    }
    let nodes = raw::nodes(cursor, kind, Cursor::natural)?;
    Ok(Element { tag, nodes, label, at, kind })
}

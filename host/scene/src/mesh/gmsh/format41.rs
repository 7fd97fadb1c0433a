//! Format 4.1: nodes and elements in blocks by geometrical entity, which knows the physical tags.
//!
//! ```text
//! $Entities                                        $Nodes                    $Elements
//! points curves surfaces volumes                   blocks count min max      blocks count min max
//! tag x y z physical…                              dim entity parametric n   dim entity type n
//! tag minx miny minz maxx maxy maxz physical… …    n tags, then n points     tag nodes…
//! ```
//! physical… and … (the bounding entities) are how many, then each. In binary counts and the tags
//! of nodes and elements have 64 bits, all other integers 32. A parametric node has one more
//! number for each dimension of its entity.

use super::cursor::Cursor;
use super::raw::{self, point};
use crate::mesh::assemble::draft::{Element, Groups, Node, Parsed};

/// Reads `$Entities`. A negative physical tag is the group of an entity turned round.
pub(super) fn entities(cursor: &mut Cursor) -> Parsed<Groups> {
    cursor.begin();
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = cursor.count("the number of entities", 1)?;
    }
    cursor.end()?;
    let mut entities = Groups::new();
    for (dimension, count) in (0..).zip(counts) {
        for _ in 0..count {
            cursor.begin();
            let tag = cursor.int("the tag of an entity")?;
            for _ in 0..if dimension == 0 { 3 } else { 6 } {
                cursor.float("a coordinate of an entity")?;
            }
            let mut physical = tags(cursor, "a physical tag")?;
            if dimension > 0 {
                tags(cursor, "the tag of a bounding entity")?;
            }
            cursor.end()?;
            physical.iter_mut().for_each(|tag| *tag = tag.saturating_abs());
            physical.sort_unstable();
            physical.dedup();
            entities.insert((dimension, tag), physical);
        }
    }
    Ok(entities)
}

/// Reads how many tags there are, and each.
fn tags(cursor: &mut Cursor, what: &str) -> Parsed<Vec<i32>> {
    let count = cursor.count("the number of tags", 1)?;
    (0..count).map(|_| cursor.int(what)).collect()
}

/// Reads `$Nodes`.
pub(super) fn nodes(cursor: &mut Cursor) -> Parsed<Vec<Node>> {
    let (blocks, count) = header(cursor, "the number of nodes", 4)?;
    let mut nodes = Vec::with_capacity(count);
    for _ in 0..blocks {
        cursor.begin();
        let start = cursor.at();
        let dimension = cursor.int("the dimension of an entity")?;
        cursor.int("the tag of an entity")?;
        let parameters = match (cursor.int("0 or 1 (parametric)")?, dimension) {
            (0, _) => 0,
            (1, 0..=3) => dimension,
            (flag, _) => {
                let message = format!("dimension {dimension}, parametric {flag}: no such nodes");
                return Err(cursor.error(start, message).into());
            }
        };
        let many = cursor.count("the number of nodes in a block", 4)?;
        cursor.end()?;
        block(cursor, &mut nodes, many, parameters)?;
    }
    complete(cursor, nodes, count, "nodes")
}

/// Reads a block of nodes: first all tags, then all points.
fn block(cursor: &mut Cursor, nodes: &mut Vec<Node>, many: usize, extra: i32) -> Parsed<()> {
    let first = nodes.len();
    for _ in 0..many {
        cursor.begin();
        let at = cursor.at();
        nodes.push(Node { tag: cursor.size("a node tag")?, at, point: [0.0; 3] });
        cursor.end()?;
    }
    for node in &mut nodes[first..] {
        cursor.begin();
        node.point = point(cursor, node.tag)?;
        for _ in 0..extra {
            cursor.float("a parametric coordinate")?;
        }
        cursor.end()?;
    }
    Ok(())
}

/// Reads `$Elements`.
pub(super) fn elements(cursor: &mut Cursor) -> Parsed<Vec<Element>> {
    let (blocks, count) = header(cursor, "the number of elements", 2)?;
    let mut elements = Vec::with_capacity(count);
    for _ in 0..blocks {
        cursor.begin();
        let dimension = cursor.int("the dimension of an entity")?;
        let label = cursor.int("the tag of an entity")?;
        let code = cursor.int("an element type")?;
        let many = cursor.count("the number of elements in a block", 2)?;
        cursor.end()?;
        for _ in 0..many {
            cursor.begin();
            let at = cursor.at();
            let tag = cursor.size("an element tag")?;
            let kind = raw::kind(code, tag, at, cursor)?;
            if i32::from(kind.dimension()) != dimension {
                let message = format!("element {tag}, a {}, in an entity", kind.name());
                let message = format!("{message} of dimension {dimension}");
                return Err(cursor.error(at, message).into());
            }
            let nodes = raw::nodes(cursor, kind, Cursor::size)?;
            elements.push(Element { tag, nodes, label, at, kind });
        }
    }
    complete(cursor, elements, count, "elements")
}

/// Reads the numbers of blocks and of records; the least and the largest tag are of no interest.
fn header(cursor: &mut Cursor, what: &str, numbers: usize) -> Parsed<(usize, usize)> {
    cursor.begin();
    let blocks = cursor.count("the number of blocks", 4)?;
    let count = cursor.count(what, numbers)?;
    cursor.size("the least tag")?;
    cursor.size("the largest tag")?;
    cursor.end()?;
    Ok((blocks, count))
}

/// The records, if there are as many as announced.
fn complete<T>(cursor: &Cursor, records: Vec<T>, count: usize, what: &str) -> Parsed<Vec<T>> {
    if records.len() == count {
        return Ok(records);
    }
    let message = format!("{count} {what} are announced, the blocks hold {}", records.len());
    Err(cursor.error(cursor.at(), message).into())
}

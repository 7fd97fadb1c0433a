//! The sections of a file as they stand in it, the same for both formats.

use std::collections::hash_map::Entry;
use std::ops::RangeInclusive;

use super::cursor::Cursor;
use crate::error::InputError;
use crate::mesh::assemble::draft::{Draft, Element, Groups, Kind, Names, Node, Parsed};

/// The sections that were found.
#[derive(Default)]
pub(super) struct Raw {
    pub(super) names: Option<Names>,
    /// The physical tags of each geometrical entity.
    pub(super) entities: Option<Groups>,
    /// Whether labels of elements are physical tags (formats 2.0 to 2.2), not entities.
    pub(super) labels_are_physical: bool,
    pub(super) nodes: Option<Vec<Node>>,
    pub(super) elements: Option<Vec<Element>>,
}

impl Raw {
    /// The lists of a mesh, with errors at places of `cursor`.
    pub(super) fn draft<'a>(
        self,
        cursor: &Cursor,
        error: &'a dyn Fn(u32, String) -> InputError,
    ) -> Parsed<Draft<'a>> {
        let nodes = self.nodes.ok_or_else(|| missing("$Nodes"))?;
        let elements = self.elements.ok_or_else(|| missing("$Elements"))?;
        let is_complete = self.entities.is_some();
        let mut groups = self.entities.unwrap_or_default();
        for element in elements.iter().filter(|element| element.kind != Kind::Point) {
            let (dimension, label) = (element.kind.dimension(), element.label);
            if let Entry::Vacant(group) = groups.entry((dimension, label)) {
                if is_complete {
                    let title = element.title();
                    let message = format!(
                        "{title} is in entity {label} of dimension {dimension}, which is not listed"
                    );
                    return Err(cursor.error(element.at, message).into());
                }
                // Formats 2.0 to 2.2, where 0 is none, or 4.1 without entities and so without groups.
                let is_group = self.labels_are_physical && label != 0;
                group.insert(is_group.then_some(label).into_iter().collect());
            }
        }
        let names = self.names.unwrap_or_default();
        Ok(Draft { nodes, elements, groups, names, length: cursor.length(), error })
    }
}

fn missing(section: &str) -> Box<InputError> {
    let error = InputError::new(format!("expected a section {section}, found none"));
    error.hint("save as MSH 4.1, or as 2.2 without parametric coordinates").into()
}

/// The kind of Gmsh's number, or an error that names the element.
pub(super) fn kind(code: i32, tag: u64, at: u32, cursor: &Cursor) -> Parsed<Kind> {
    match code {
        1 => Ok(Kind::Line),
        2 => Ok(Kind::Triangle),
        3 => Ok(Kind::Quad),
        15 => Ok(Kind::Point),
        _ => {
            let (name, hint) = foreign(code);
            let message = format!(
                "element {tag} is {name} (type {code}), expected a 3-node triangle, \
                 a 4-node quad, a 2-node line or a point"
            );
            Err(cursor.error(at, message).hint(hint).into())
        }
    }
}

/// Reads the nodes that end the record of an element, by the way their tags are written.
pub(super) fn nodes<'a>(
    cursor: &mut Cursor<'a>,
    kind: Kind,
    tag: fn(&mut Cursor<'a>, &str) -> Parsed<u64>,
) -> Parsed<[u64; 4]> {
    let mut nodes = [0; 4];
    for node in &mut nodes[..kind.corners()] {
        *node = tag(cursor, "a node tag")?;
    }
    cursor.end()?;
    Ok(nodes)
}

/// Reads the three coordinates of a node.
pub(super) fn point(cursor: &mut Cursor, tag: u64) -> Parsed<[f64; 3]> {
    let at = cursor.at();
    let mut point = [0.0; 3];
    for coordinate in &mut point {
        *coordinate = cursor.float("a coordinate")?;
    }
    match point.iter().find(|coordinate| !coordinate.is_finite()) {
        None => Ok(point),
        Some(value) => {
            Err(cursor.error(at, format!("node {tag} has the coordinate {value}")).into())
        }
    }
}

/// Names of Gmsh's other element types, and how to avoid them.
fn foreign(code: i32) -> (&'static str, &'static str) {
    let first_order = "mesh with `Mesh.ElementOrder = 1` (command line: `-order 1`)";
    let plane = "mesh in two dimensions (command line: `-2`) and save only curves and surfaces";
    match code {
        8 => ("a line of second order", first_order),
        9 => ("a triangle of second order", first_order),
        10 | 16 => ("a quad of second order", first_order),
        20..=28 | 36..=39 => ("of higher order", first_order),
        4 => ("a tetrahedron", plane),
        5 => ("a hexahedron", plane),
        6 => ("a prism", plane),
        7 => ("a pyramid", plane),
        11..=14 | 17..=19 | 29..=31 | 92 | 93 => ("a volume of higher order", plane),
        _ => ("of an unknown kind", "only plane meshes of first order are read"),
    }
}

/// Reads `$PhysicalNames`, by dimension and physical tag: `dimension tag "name"`, a line each, text in every encoding. Without a
/// dimension, as in format 2.0, a name is that of every group with its tag.
pub(super) fn names(cursor: &mut Cursor, may_lack_dimension: bool) -> Parsed<Names> {
    let count = cursor.count_line("the number of physical names", 2)?;
    let mut names = Names::new();
    for _ in 0..count {
        cursor.skip_blank_lines();
        let at = cursor.at();
        let line = cursor.line();
        let Some((dimensions, tag, name)) = split(line, may_lack_dimension) else {
            let message = "expected a physical name: dimension, tag and the name in quotes";
            return Err(cursor.error(at, message).into());
        };
        for dimension in dimensions {
            if names.insert((dimension, tag), name.to_owned()).is_some() {
                let message =
                    format!("physical group {tag} of dimension {dimension} is named twice");
                return Err(cursor.error(at, message).into());
            }
        }
    }
    Ok(names)
}

/// The dimensions, the tag and the name of a line. Gmsh writes quotes inside a name as they are: the last one closes.
fn split(line: &[u8], may_lack_dimension: bool) -> Option<(RangeInclusive<u8>, i32, &str)> {
    let (head, quoted) = std::str::from_utf8(line).ok()?.split_once('"')?;
    let (name, head) = (quoted.strip_suffix('"')?, head.split_ascii_whitespace());
    match head.collect::<Vec<_>>()[..] {
        [tag] if may_lack_dimension => Some((0..=3, tag.parse().ok()?, name)),
        [dimension, tag] => {
            let dimension = dimension.parse().ok().filter(|&dimension| dimension <= 3)?;
            Some((dimension..=dimension, tag.parse().ok()?, name))
        }
        _ => None,
    }
}

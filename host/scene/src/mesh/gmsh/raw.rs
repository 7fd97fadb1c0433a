//! The sections of a file as they stand in it: tags unresolved, nothing checked against the rest.

use std::collections::HashMap;

use super::cursor::{Cursor, Parsed};

/// What the file holds, the same for both formats.
#[derive(Default)]
pub(super) struct Raw {
    pub(super) names: Option<HashMap<(u8, i32), String>>,
    pub(super) entities: Option<Entities>,
    /// Whether labels of elements are physical tags (format 2.2), not entities.
    pub(super) labels_are_physical: bool,
    pub(super) nodes: Option<Vec<Node>>,
    pub(super) elements: Option<Vec<Element>>,
}

/// The physical tags of each geometrical entity, by dimension and tag.
pub(super) type Entities = HashMap<(u8, i32), Vec<i32>>;

/// A node under its tag.
pub(super) struct Node {
    pub(super) tag: u64,
    pub(super) at: u32,
    pub(super) point: [f64; 3],
}

/// An element under its tag; `nodes` beyond those of its kind are 0.
pub(super) struct Element {
    pub(super) tag: u64,
    pub(super) nodes: [u64; 4],
    /// The physical tag in format 2.2, the geometrical entity in 4.1.
    pub(super) label: i32,
    pub(super) at: u32,
    pub(super) kind: Kind,
}

/// The elements that a plane mesh of first order is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Point,
    Line,
    Triangle,
    Quad,
}

impl Kind {
    /// The kind of Gmsh's number, or an error that names the element.
    pub(super) fn of(code: i32, tag: u64, at: u32, cursor: &Cursor) -> Parsed<Self> {
        match code {
            1 => Ok(Self::Line),
            2 => Ok(Self::Triangle),
            3 => Ok(Self::Quad),
            15 => Ok(Self::Point),
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

    pub(super) fn dimension(self) -> u8 {
        match self {
            Self::Point => 0,
            Self::Line => 1,
            Self::Triangle | Self::Quad => 2,
        }
    }

    pub(super) fn corners(self) -> usize {
        match self {
            Self::Point => 1,
            Self::Line => 2,
            Self::Triangle => 3,
            Self::Quad => 4,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Line => "line",
            Self::Triangle => "triangle",
            Self::Quad => "quad",
        }
    }
}

impl Element {
    /// Reads the nodes that end the record, by the way their tags are written.
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

    /// The element as a person would look it up.
    pub(super) fn title(&self) -> String {
        format!("{} {}", self.kind.name(), self.tag)
    }
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

/// What Gmsh calls the other element types, and how to avoid them.
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

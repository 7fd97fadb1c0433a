//! The lists of a mesh file, whatever its format: nodes, elements and groups, under the file's own numbers.

use std::collections::HashMap;

use crate::error::InputError;

/// The result of a step from bytes to a mesh; the file's name is added at the end.
pub(in crate::mesh) type Parsed<T> = Result<T, Box<InputError>>;

/// The physical tags behind each label of an element, by dimension and label.
pub(in crate::mesh) type Groups = HashMap<(u8, i32), Vec<i32>>;

/// The names of physical groups, by dimension and physical tag.
pub(in crate::mesh) type Names = HashMap<(u8, i32), String>;

/// The lists of a file: references unresolved, nothing checked against the rest.
pub(in crate::mesh) struct Draft<'a> {
    pub(in crate::mesh) nodes: Vec<Node>,
    pub(in crate::mesh) elements: Vec<Element>,
    /// Holds every label of a line or cell.
    pub(in crate::mesh) groups: Groups,
    pub(in crate::mesh) names: Names,
    /// Bytes of the file, which bound what is made of it.
    pub(in crate::mesh) length: usize,
    /// The error at a place of the file.
    pub(in crate::mesh) error: &'a dyn Fn(u32, String) -> InputError,
}

/// A node under its tag.
pub(in crate::mesh) struct Node {
    pub(in crate::mesh) tag: u64,
    /// Its place in the file, for errors.
    pub(in crate::mesh) at: u32,
    pub(in crate::mesh) point: [f64; 3],
}

/// An element under its tag; `nodes`, by tag, beyond those of its kind are 0.
pub(in crate::mesh) struct Element {
    pub(in crate::mesh) tag: u64,
    pub(in crate::mesh) nodes: [u64; 4],
    /// The key of its groups.
    pub(in crate::mesh) label: i32,
    /// Its place in the file, for errors.
    pub(in crate::mesh) at: u32,
    pub(in crate::mesh) kind: Kind,
}

/// The elements that a plane mesh of first order is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mesh) enum Kind {
    Point,
    Line,
    Triangle,
    Quad,
}

impl Kind {
    /// Dimension, number of corners, name.
    fn facts(self) -> (u8, usize, &'static str) {
        match self {
            Self::Point => (0, 1, "point"),
            Self::Line => (1, 2, "line"),
            Self::Triangle => (2, 3, "triangle"),
            Self::Quad => (2, 4, "quad"),
        }
    }

    pub(in crate::mesh) fn dimension(self) -> u8 {
        self.facts().0
    }

    pub(in crate::mesh) fn corners(self) -> usize {
        self.facts().1
    }

    pub(in crate::mesh) fn name(self) -> &'static str {
        self.facts().2
    }
}

impl Element {
    /// The element as a person would look it up.
    pub(in crate::mesh) fn title(&self) -> String {
        format!("{} {}", self.kind.name(), self.tag)
    }
}

impl Draft<'_> {
    /// The error at a place of the file.
    pub(super) fn error(&self, at: u32, message: impl Into<String>) -> InputError {
        (self.error)(at, message.into())
    }

    /// The physical tags of an element: none, one or several.
    pub(super) fn tags(&self, element: &Element) -> &[i32] {
        self.groups.get(&(element.kind.dimension(), element.label)).map_or(&[], Vec::as_slice)
    }
}

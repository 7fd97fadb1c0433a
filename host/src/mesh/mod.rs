//! A mesh as it was read: coordinates in f64, cells by kind, physical groups by name.

pub mod check;
pub mod gmsh;
pub mod shape;
pub mod structured;

/// Cells and named groups, before any scene gives the names a meaning.
///
/// Cells are numbered triangles first, then quads: cell `c` is triangle `c` below
/// `triangles.len()` and quad `c - triangles.len()` from there on.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertex coordinates; every vertex belongs to a cell.
    pub vertices: Vec<[f64; 2]>,
    /// Vertices of the triangles, counterclockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Vertices of the quads, counterclockwise.
    pub quads: Vec<[u32; 4]>,
    /// Physical surfaces with the cells in them; a cell may be in several or in none.
    pub surfaces: Vec<Surface>,
    /// Physical curves with the edges in them; an edge may be in several or in none.
    pub curves: Vec<Curve>,
}

/// A physical surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Its name, or its tag in decimal where the file gives no name.
    pub name: String,
    /// Its cells, ascending, without repetition.
    pub cells: Vec<u32>,
}

/// A physical curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name, or its tag in decimal where the file gives no name.
    pub name: String,
    /// The vertices of its edges, lower index first, ascending, without repetition.
    pub edges: Vec<[u32; 2]>,
}

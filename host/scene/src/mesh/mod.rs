//! A mesh as it was read: coordinates in f64, cells by kind, physical groups by name.

pub mod adapted;
pub mod adaptive;
pub mod arrays;
mod assemble;
pub mod check;
pub mod coincident;
pub mod cut;
mod foreign;
pub mod gmsh;
mod matching;
mod outer;
pub mod pairing;
mod read;
pub mod shape;
pub mod structured;
#[cfg(test)]
mod tests;

pub use read::{parse, read};

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

impl Mesh {
    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.triangles.len() + self.quads.len()
    }

    /// The vertices of each cell.
    pub fn corners(&self) -> impl Iterator<Item = &[u32]> {
        let triangles = self.triangles.iter().map(|cell| &cell[..]);
        triangles.chain(self.quads.iter().map(|cell| &cell[..]))
    }

    /// The surfaces of a mesh whose cell `c` lies in cell `origins[c]` of this one.
    pub fn inherited(&self, origins: &[u32]) -> Vec<Surface> {
        let inherited = |surface: &Surface| {
            let mut inside = vec![false; self.cells()];
            surface.cells.iter().for_each(|&cell| inside[cell as usize] = true);
            let cells = (0..).zip(origins).filter(|&(_, &origin)| inside[origin as usize]);
            Surface { name: surface.name.clone(), cells: cells.map(|(cell, _)| cell).collect() }
        };
        self.surfaces.iter().map(inherited).collect()
    }
}

/// A physical curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name, or its tag in decimal where the file gives no name.
    pub name: String,
    /// The vertices of its edges, lower index first, ascending, without repetition.
    pub edges: Vec<[u32; 2]>,
}

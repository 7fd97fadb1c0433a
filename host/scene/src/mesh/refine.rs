//! Uniform refinement: every edge is halved, every cell becomes four of its kind.
//!
//! ```text
//!         c                 d ───n── c
//!        ╱ ╲                │   │    │       vertices stay; then the midpoints of the edges, in the
//!       n───m               o───z────m       order of `check::edges`; then the centres z of the
//!      ╱ ╲ ╱ ╲              │   │    │       quads. Of cell k become 4k … 4k + 2 or 3 at its
//!     a───l───b             a ──l─── b       corners, in a triangle then the middle one, 4k + 3.
//! ```
//! z is the mean of the corners, where both lines between opposite midpoints meet: the quads remain
//! strictly convex. Neighbours share midpoints, so the mesh remains conforming.

use super::check::{edge_number, numbered_edges};
use super::{Curve, Mesh};
use crate::error::{InputError, Result};

/// Numbers of cells above are refused: a slip of the pen, or a job for another machine.
pub const MOST_CELLS: usize = 4_000_000;

/// `mesh`, refined once.
///
/// # Errors
/// Cells that don't meet as they may, curves off the edges, or more than [`MOST_CELLS`].
pub fn refined(mesh: &Mesh) -> Result<Mesh> {
    let cells = 4 * mesh.cells();
    check_count(cells, "refine less often")?;
    let edges = numbered_edges(mesh)?;
    let halves = Halves { vertices: mesh.vertices.len(), edges: &edges };
    let centre = |quad: usize| (halves.vertices + edges.len() + quad) as u32;
    let triangles = mesh.triangles.iter().flat_map(|&corners| halves.of_triangle(corners));
    let quads = mesh.quads.iter().enumerate();
    let quads = quads.flat_map(|(quad, &corners)| halves.of_quad(corners, centre(quad)));
    let midpoints = edges.iter().map(|ends| mean(&mesh.vertices, ends));
    let centres = mesh.quads.iter().map(|corners| mean(&mesh.vertices, corners));
    let origins: Vec<_> = (0..cells as u32).map(|cell| cell / 4).collect();
    Ok(Mesh {
        vertices: mesh.vertices.iter().copied().chain(midpoints).chain(centres).collect(),
        triangles: triangles.collect(),
        quads: quads.collect(),
        surfaces: mesh.inherited(&origins),
        curves: mesh.curves.iter().map(|curve| halves.of_curve(curve)).collect::<Result<_>>()?,
    })
}

/// Refuses to make so many cells.
pub(super) fn check_count(cells: usize, hint: &str) -> Result<()> {
    let message =
        format!("the refined mesh would have {cells} cells, expected at most {MOST_CELLS}");
    let error = || InputError::new(message).hint(hint).into();
    if cells > MOST_CELLS { Err(error()) } else { Ok(()) }
}

/// The mean of some of the vertices.
pub(super) fn mean(vertices: &[[f64; 2]], corners: &[u32]) -> [f64; 2] {
    let share = 1.0 / corners.len() as f64;
    let part = |axis: usize| corners.iter().map(move |&at| share * vertices[at as usize][axis]);
    [0, 1].map(|axis| part(axis).sum())
}

/// The midpoints of edges.
struct Halves<'a> {
    /// The number of the first midpoint.
    vertices: usize,
    /// The edges in the order of their midpoints.
    edges: &'a [[u32; 2]],
}

impl Halves<'_> {
    /// The midpoint of an edge, if it is one.
    fn find(&self, [a, b]: [u32; 2]) -> Option<u32> {
        let edge = self.edges.binary_search(&[a.min(b), a.max(b)]).ok()?;
        Some(self.midpoint(edge as u32))
    }

    fn midpoint(&self, edge: u32) -> u32 {
        self.vertices as u32 + edge
    }

    /// The midpoints of a cell's sides, the first between corners 0 and 1.
    fn of_sides<const N: usize>(&self, corners: [u32; N]) -> [u32; N] {
        // The edges were made of these very sides.
        std::array::from_fn(|k| self.find([corners[k], corners[(k + 1) % N]]).unwrap_or(u32::MAX))
    }

    fn of_triangle(&self, [a, b, c]: [u32; 3]) -> [[u32; 3]; 4] {
        let [l, m, n] = self.of_sides([a, b, c]);
        [[a, l, n], [l, b, m], [n, m, c], [m, n, l]]
    }

    fn of_quad(&self, [a, b, c, d]: [u32; 4], z: u32) -> [[u32; 4]; 4] {
        let [l, m, n, o] = self.of_sides([a, b, c, d]);
        [[a, l, z, o], [l, b, m, z], [z, m, c, n], [o, z, n, d]]
    }

    fn of_curve(&self, curve: &Curve) -> Result<Curve> {
        let mut edges = Vec::with_capacity(2 * curve.edges.len());
        for &[a, b] in &curve.edges {
            let middle = self.midpoint(edge_number(self.edges, curve, [a, b])?);
            edges.extend([[a, middle], [b, middle]]);
        }
        edges.sort_unstable();
        Ok(Curve { name: curve.name.clone(), edges })
    }
}

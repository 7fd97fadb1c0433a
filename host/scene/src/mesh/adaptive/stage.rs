//! One round's forest with the mesh that closure makes of it: its own cells, and the pieces of those with hanging
//! nodes.

use super::closure::Pieces;
use super::forest::{Cell, Edges, Forest, NONE};
use super::red::Grown;
use crate::error::{InputError, Result};
use crate::mesh::check::{check_count, edge_number, numbered_edges};
use crate::mesh::shape::{Orientation, mean, orientation};
use crate::mesh::{Curve, Mesh};

/// The state that a round begins with.
#[derive(Debug, Clone)]
pub(super) struct Stage {
    pub(super) forest: Forest,
    /// The edges of each curve.
    curves: Vec<Vec<u32>>,
    pub(super) mesh: Mesh,
    pub(super) places: Places,
}

impl Stage {
    /// The base mesh, where each cell is its own root.
    pub(super) fn first(base: &Mesh) -> Result<Self> {
        let (forest, curves) = Self::forest(base)?;
        let (.., places) = closed(&base.vertices, &forest);
        Ok(Self { forest, curves, mesh: base.clone(), places })
    }

    /// The forest of a mesh, and the edges of each curve.
    pub(super) fn forest(base: &Mesh) -> Result<(Forest, Vec<Vec<u32>>)> {
        let edges = numbered_edges(base)?;
        let on_edges = |curve: &Curve| {
            curve.edges.iter().map(|&ends| edge_number(&edges, curve, ends)).collect()
        };
        let curves = base.curves.iter().map(on_edges).collect::<Result<_>>()?;
        let triangles = roots(&edges, &base.triangles, 0);
        let quads = roots(&edges, &base.quads, base.triangles.len() as u32);
        Ok((Forest { edges: Edges::of(&edges), triangles, quads }, curves))
    }

    /// The next stage, and for each of its mesh's cells the cell of this forest that it lies in.
    pub(super) fn next(&self, base: &Mesh, grown: Grown) -> Result<(Self, Vec<u32>)> {
        let Grown { vertices, forest, parents } = grown;
        let (triangles, quads, places) = closed(&vertices, &forest);
        let curves: Vec<_> = self.curves.iter().map(|curve| forest.edges.halved(curve)).collect();
        let mesh = Mesh {
            curves: curves_of(base, &forest, &curves),
            vertices,
            triangles,
            quads,
            surfaces: Vec::new(),
        };
        check(&mesh)?;
        let mut next = Self { forest, curves, mesh, places };
        next.mesh.surfaces = base.inherited(&next.roots());
        let families = next.of_cells(&parents);
        Ok((next, families))
    }

    /// For each cell of the mesh the cell of the base mesh that it lies in.
    pub(super) fn roots(&self) -> Vec<u32> {
        let triangles = self.forest.triangles.iter().map(|cell| cell.root);
        let quads = self.forest.quads.iter().map(|cell| cell.root);
        self.of_cells(&triangles.chain(quads).collect::<Vec<_>>())
    }

    /// The forest's facts, for each cell of the mesh.
    fn of_cells(&self, known: &[u32]) -> Vec<u32> {
        let mut of_mesh = vec![0; self.mesh.cells()];
        for (cell, &known) in (0..).zip(known) {
            self.places.of(cell).for_each(|piece| of_mesh[piece as usize] = known);
        }
        of_mesh
    }
}

/// The curves of the base mesh with these edges.
pub(super) fn curves_of(base: &Mesh, forest: &Forest, edges: &[Vec<u32>]) -> Vec<Curve> {
    let of_curve = |(curve, edges): (&Curve, &Vec<u32>)| {
        let mut edges: Vec<_> = edges.iter().map(|&edge| forest.edges.ends(edge)).collect();
        edges.sort_unstable();
        Curve { name: curve.name.clone(), edges }
    };
    base.curves.iter().zip(edges).map(of_curve).collect()
}

/// Cells of the base mesh on its edges, numbered from `first`.
fn roots<const N: usize>(edges: &[[u32; 2]], cells: &[[u32; N]], first: u32) -> Vec<Cell<N>> {
    let cell = |(root, &corners): (u32, &[u32; N])| {
        // The edges were made of these very sides.
        let sides = std::array::from_fn(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % N]);
            edges.binary_search(&[a.min(b), a.max(b)]).map_or(NONE, |edge| edge as u32)
        });
        Cell { corners, sides, root }
    };
    (first..).zip(cells).map(cell).collect()
}

/// Which conforming cells each cell of the forest consists of.
#[derive(Debug, Clone)]
pub(super) struct Places {
    /// Where the triangles of each begin, then where the last ones end.
    triangles: Vec<u32>,
    /// The quads' pieces, all triangles counted before them.
    quads: Vec<u32>,
}

impl Places {
    /// The conforming cells that a cell of the forest consists of.
    pub(super) fn of(&self, cell: u32) -> impl Iterator<Item = u32> + use<> {
        let cell = cell as usize;
        let triangles = self.triangles[cell]..self.triangles[cell + 1];
        triangles.chain(self.quads[cell]..self.quads[cell + 1])
    }
}

/// The cells of a forest closed, in the order of the forest.
fn closed(vertices: &[[f64; 2]], forest: &Forest) -> (Vec<[u32; 3]>, Vec<[u32; 4]>, Places) {
    let mut pieces = Pieces::over(vertices);
    let mut ends = vec![(0, 0)];
    let midpoint = |side: u32| forest.edges.midpoint(side);
    let end = |pieces: &Pieces| (pieces.triangles.len() as u32, pieces.quads.len() as u32);
    for cell in &forest.triangles {
        pieces.add_triangle(cell.corners, cell.sides.map(midpoint));
        ends.push(end(&pieces));
    }
    for cell in &forest.quads {
        pieces.add_quad(cell.corners, cell.sides.map(midpoint));
        ends.push(end(&pieces));
    }
    let before = pieces.triangles.len() as u32;
    let (of_triangles, of_quads) = ends.into_iter().map(|(t, q)| (t, before + q)).unzip();
    let Pieces { triangles, quads, .. } = pieces;
    (triangles, quads, Places { triangles: of_triangles, quads: of_quads })
}

/// Whether the mesh keeps its contract still: not too many cells, each strictly convex within rounding.
///
/// # Errors
/// One that is not, with its place.
fn check(mesh: &Mesh) -> Result<()> {
    check_count(mesh.cells(), "refine fewer cells")?;
    let is_convex = |cell: &&[u32]| {
        let points: Vec<_> = cell.iter().map(|&vertex| mesh.vertices[vertex as usize]).collect();
        orientation(&points) == Ok(Orientation::Counterclockwise)
    };
    let Some(wrong) = mesh.corners().find(|cell| !is_convex(cell)) else { return Ok(()) };
    let [x, y] = mean(&mesh.vertices, wrong);
    let message =
        format!("a cell at ({x}, {y}) is too small to be refined: rounding hides its shape");
    Err(InputError::new(message).hint("refine less often, or move the origin nearer").into())
}

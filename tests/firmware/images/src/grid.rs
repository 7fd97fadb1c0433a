//! The mesh on which costs are counted: 16 × 8 squares of (−1, 1) × (0, 1), their inner corners moved,
//! contact below, u given above, no flux at the sides. Cut into triangles it has 392 unknowns.

use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::edges::{Block, Edges};
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};
use signorini_kernel::{Error, Real};

/// Squares in a row, and edges of contact and of u given.
pub const COLUMNS: usize = 16;
const LINES: usize = 8;
/// Vertices.
pub const VERTICES: usize = (COLUMNS + 1) * (LINES + 1);
/// Squares; twice as many triangles.
pub const SQUARES: usize = COLUMNS * LINES;
/// More edges than either kind of cells has.
pub const EDGES: usize = 408;

/// How far to the right a vertex stands.
pub fn column(vertex: u16) -> usize {
    usize::from(vertex) % (COLUMNS + 1)
}

/// Memory of the mesh and its numbering.
pub struct Grid<R, const T: usize, const Q: usize> {
    vertices: [[R; 2]; VERTICES],
    triangles: [[u16; 3]; T],
    quads: [[u16; 4]; Q],
    of_triangles: [[u16; 3]; T],
    of_quads: [[u16; 4]; Q],
    half_edges: [[u16; 2]; 6 * SQUARES],
}

impl<R: Real, const T: usize, const Q: usize> Grid<R, T, Q> {
    /// T and Q say what it consists of: 2 × [`SQUARES`] triangles, or [`SQUARES`] quads.
    pub fn new() -> Self {
        let mut grid = Self {
            vertices: [[R::ZERO; 2]; VERTICES],
            triangles: [[0; 3]; T],
            quads: [[0; 4]; Q],
            of_triangles: [[0; 3]; T],
            of_quads: [[0; 4]; Q],
            half_edges: [[0; 2]; 6 * SQUARES],
        };
        for (at, vertex) in grid.vertices.iter_mut().enumerate() {
            *vertex = place(at % (COLUMNS + 1), at / (COLUMNS + 1));
        }
        let corners = |square: usize| {
            let left = (square / COLUMNS * (COLUMNS + 1) + square % COLUMNS) as u16;
            let above = left + COLUMNS as u16 + 1;
            [left, left + 1, above + 1, above]
        };
        for (square, pair) in grid.triangles.chunks_exact_mut(2).enumerate() {
            let [a, b, c, d] = corners(square);
            pair.copy_from_slice(&[[a, b, c], [a, c, d]]);
        }
        for (square, quad) in grid.quads.iter_mut().enumerate() {
            *quad = corners(square);
        }
        grid
    }

    /// Numbers the edges.
    ///
    /// # Errors
    /// None.
    pub fn number(&mut self) -> Result<(Mesh<'_, R, u16>, Edges<'_, u16>), Error> {
        let mesh = Mesh::new(&self.vertices, &self.triangles, &self.quads)?;
        let (mut at_vertex, mut next) = ([[0; 2]; VERTICES], [0; 6 * SQUARES]);
        let buffers = NumberingBuffers {
            of_triangles: &mut self.of_triangles,
            of_quads: &mut self.of_quads,
            half_edges: &mut self.half_edges,
            at_vertex: &mut at_vertex,
            next: &mut next,
        };
        let line = |vertex: u16| usize::from(vertex) / (COLUMNS + 1);
        let numbered = number(&mesh, buffers, |ends| {
            Some(match ends.map(line) {
                [0, 0] => Block::Contact,
                [LINES, LINES] => Block::Dirichlet,
                _ => Block::Free,
            })
        })?;
        let counts = numbered.counts();
        let half_edges = self.half_edges.get(..counts.edges()).unwrap_or(&[]);
        Ok((mesh, Edges::new(&self.of_triangles, &self.of_quads, half_edges, counts)?))
    }
}

/// The corner in this column and line.
fn place<R: Real>(column: usize, line: usize) -> [R; 2] {
    let number = |count: usize| R::from_count(count as u32);
    let inner = column > 0 && column < COLUMNS && line > 0 && line < LINES;
    let moved = |hash: usize| if inner { number(hash % 8) / number(32) } else { R::ZERO };
    let x = number(column) + moved(7 * column + 3 * line);
    let y = number(line) + moved(3 * column + 5 * line);
    [x / number(LINES) - R::ONE, y / number(LINES)]
}

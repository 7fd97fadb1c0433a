//! A small plate that several tests share.

pub mod factor;
pub mod foundation;

use signorini_kernel::Error;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::edges::Edges;

use crate::numbering::{Numbering, Side};

/// Squares along x and y, of side 1; every other one is cut into two triangles.
const SQUARES: [usize; 2] = [5, 4];

/// The numbered mesh; sides are bottom, right, top, left.
pub struct Plate {
    sides: [Side; 4],
    pub vertices: Vec<[f64; 2]>,
    pub triangles: Vec<[u16; 3]>,
    pub quads: Vec<[u16; 4]>,
    numbering: Numbering,
}

impl Plate {
    pub fn new(sides: [Side; 4]) -> Result<Self, Error> {
        let (triangles, quads) = cells();
        let [nx, ny] = SQUARES;
        let place = |at: usize| [(at % (nx + 1)) as f64, (at / (nx + 1)) as f64];
        let vertices: Vec<_> = (0..(nx + 1) * (ny + 1)).map(place).collect();
        let mesh = Mesh::new(&vertices, &triangles, &quads)?;
        let numbering = Numbering::new(&mesh, |ends| side(&vertices, ends, sides).block())?;
        Ok(Self { sides, vertices, triangles, quads, numbering })
    }

    pub fn mesh(&self) -> Result<Mesh<'_, f64, u16>, Error> {
        Mesh::new(&self.vertices, &self.triangles, &self.quads)
    }

    pub fn edges(&self) -> Result<Edges<'_, u16>, Error> {
        self.numbering.edges()
    }

    pub fn side(&self, ends: [u16; 2]) -> Side {
        side(&self.vertices, ends, self.sides)
    }

    /// The ends of an edge.
    pub fn ends(&self, edge: usize) -> Result<[[f64; 2]; 2], Error> {
        let ends = self.edges()?.endpoints(&self.mesh()?, edge);
        Ok(ends.map(|vertex| self.vertices[usize::from(vertex)]))
    }
}

fn cells() -> (Vec<[u16; 3]>, Vec<[u16; 4]>) {
    let [nx, ny] = SQUARES;
    let vertex = |i: usize, j: usize| (j * (nx + 1) + i) as u16;
    let (mut triangles, mut quads) = (Vec::new(), Vec::new());
    for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
        let [a, b] = [vertex(i, j), vertex(i + 1, j)];
        let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
        if (i + j) % 2 == 0 {
            triangles.extend([[a, b, c], [a, c, d]]);
        } else {
            quads.push([a, b, c, d]);
        }
    }
    (triangles, quads)
}

fn side(vertices: &[[f64; 2]], ends: [u16; 2], sides: [Side; 4]) -> Side {
    let [p, q] = ends.map(|vertex| vertices[usize::from(vertex)]);
    let [nx, ny] = SQUARES.map(|n| n as f64);
    let on = [p[1] + q[1] == 0.0, p[0] + q[0] == 2.0 * nx, p[1] + q[1] == 2.0 * ny];
    sides[on.iter().position(|&on| on).unwrap_or(3)]
}

//! A small mesh with numbered edges, owned: any arrays that the kernel takes, or a sound grid.

use signorini_kernel::Error;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::edges::{Block, Edges};

use super::bytes::{Bits, Bytes};
use super::numbering::Numbering;

/// Squares along each side of a grid, at most.
const MOST: usize = 3;

/// The numbered mesh.
pub struct Plate<R> {
    pub vertices: Vec<[R; 2]>,
    pub triangles: Vec<[u16; 3]>,
    pub quads: Vec<[u16; 4]>,
    numbering: Numbering,
}

impl<R: Bits> Plate<R> {
    /// Any coordinates and corners.
    pub fn arbitrary(bytes: &mut Bytes) -> Result<Self, Error> {
        let [vertices, triangles, quads] = [10, 8, 6].map(|most| bytes.below(most));
        let points = bytes.groups(vertices);
        let mut corner = || match bytes.below(64) {
            0 => bytes.bits() as u16,
            k => (k % (vertices + 1).max(2)) as u16,
        };
        let triangles = (0..triangles).map(|_| [(); 3].map(|()| corner())).collect();
        let quads = (0..quads).map(|_| [(); 4].map(|()| corner())).collect();
        Self::numbered(points, triangles, quads, bytes)
    }

    /// A grid of squares, whole or cut, whose vertices `moves` shifts; an edge at least is given.
    pub fn grid(bytes: &mut Bytes, moves: bool) -> Result<Self, Error> {
        let (nx, ny) = (1 + bytes.below(MOST), 1 + bytes.below(MOST));
        let vertex = |i: usize, j: usize| (j * (nx + 1) + i) as u16;
        let shift = |bytes: &mut Bytes| match moves {
            true => f64::from(bytes.byte() as i8) / 512.0,
            false => 0.0,
        };
        let place = |at: usize| [(at % (nx + 1)) as f64, (at / (nx + 1)) as f64];
        let places = (0..(nx + 1) * (ny + 1)).map(place);
        let vertices = places.map(|at| at.map(|x| R::narrow(x + shift(bytes)))).collect();
        let (mut triangles, mut quads) = (Vec::new(), Vec::new());
        for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
            let [a, b] = [vertex(i, j), vertex(i + 1, j)];
            let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
            match bytes.below(3) {
                0 => triangles.extend([[a, b, c], [a, c, d]]),
                1 => triangles.extend([[a, b, d], [b, c, d]]),
                _ => quads.push([a, b, c, d]),
            }
        }
        Self::numbered(vertices, triangles, quads, bytes)
    }

    fn numbered(
        vertices: Vec<[R; 2]>,
        triangles: Vec<[u16; 3]>,
        quads: Vec<[u16; 4]>,
        bytes: &mut Bytes,
    ) -> Result<Self, Error> {
        let mesh = Mesh::new(&vertices, &triangles, &quads)?;
        // The first one is given, whatever the others are.
        let mut first = true;
        let block = |_| match (std::mem::take(&mut first), bytes.below(8)) {
            (true, _) | (_, 0) => Block::Dirichlet,
            (_, 1..=3) => Block::Free,
            _ => Block::Contact,
        };
        let numbering = Numbering::new(&mesh, block)?;
        Ok(Self { vertices, triangles, quads, numbering })
    }

    /// The mesh.
    pub fn mesh(&self) -> Result<Mesh<'_, R, u16>, Error> {
        Mesh::new(&self.vertices, &self.triangles, &self.quads)
    }

    /// Its edges.
    pub fn edges(&self) -> Result<Edges<'_, u16>, Error> {
        self.numbering.edges()
    }
}

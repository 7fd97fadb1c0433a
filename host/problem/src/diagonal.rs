//! The diagonal of K and the load b alone: what tells the size of a problem's numbers before it is assembled.

use signorini_kernel::Error;
use signorini_kernel::assembly;
use signorini_kernel::error::Array;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{Edges, Side};

use super::Problem;
use super::element_matrices::ElementMatrices;

impl Problem {
    /// Terms on the diagonal of K beyond the element matrices, in f64.
    ///
    /// # Errors
    /// Records of the boundary that are not admissible.
    pub fn diagonal_terms(&self, edges: &Edges<u32>) -> Result<DiagonalTerms<'_, f64, u32>, Error> {
        Ok(DiagonalTerms::new(&self.loads.boundary(edges)?))
    }

    /// The diagonal of K, and b, with the bits of [`super::Assembled`].
    ///
    /// # Errors
    /// As for [`super::Assembled::system`].
    pub fn diagonal_and_load(&self) -> Result<[Vec<f64>; 2], Error> {
        let (edges, loads) = (self.topology.edges()?, &self.loads);
        let boundary = loads.boundary(&edges)?;
        let matrices = ElementMatrices::of(self)?;
        let unknowns = edges.counts().unknowns();
        let own = |half: &u32| match edges.side(*half as usize) {
            Side::Triangle(at, side) => of_side(&matrices.triangles[at], &TRIANGLE[side]),
            Side::Quad(at, side) => of_side(&matrices.quads[at], &QUAD[side]),
        };
        let pairs = self.topology.half_edges.iter().take(unknowns);
        let sum = |pair: &[u32; 2]| {
            let halves = pair.iter().filter(|&&half| half != u32::MAX);
            halves.map(own).fold(0.0, |sum, own| sum + own)
        };
        let mut diagonal: Vec<f64> = pairs.map(sum).collect();
        self.diagonal_terms(&edges)?.entries().for_each(|(edge, term)| diagonal[edge] += term);
        let mut load = vec![0.0; unknowns];
        assembly::load(&edges, loads.cells(), &boundary, &mut load)?;
        finite(Array::MatrixValues, matrices.entries())?;
        finite(Array::MatrixValues, diagonal.iter())?;
        finite(Array::Load, load.iter())?;
        finite(Array::LowerBounds, loads.gap.iter())?;
        match diagonal.iter().position(|own| *own <= 0.0) {
            Some(at) => Err(Error::OutOfRange { of: Array::RowPointers, at }),
            None => Ok([diagonal, load]),
        }
    }
}

/// Where the entries of a row stand in an element matrix, but for the diagonal one.
const TRIANGLE: [[usize; 2]; 3] = [[0, 2], [0, 1], [2, 1]];
/// Positions of the entries of a row in the matrix of a quad, but for the diagonal one.
const QUAD: [[usize; 3]; 4] = [[0, 1, 2], [0, 3, 4], [1, 3, 5], [2, 4, 5]];

/// Rows add up to 0.
fn of_side(matrix: &[f64], others: &[usize]) -> f64 {
    others.iter().fold(0.0, |sum, &at| sum - matrix[at])
}

fn finite<'n>(of: Array, mut numbers: impl Iterator<Item = &'n f64>) -> Result<(), Error> {
    match numbers.position(|number| !number.is_finite()) {
        Some(at) => Err(Error::NotFinite { of, at }),
        None => Ok(()),
    }
}

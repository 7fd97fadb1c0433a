//! Defects straight from the element matrices: no matrix is kept beside the factor.
//!
//! ```text
//!   d_i = b_i − Σ_T Σ_j K^T_ij (u_j − u_i) − c_i u_i,       c_i what K_ii has beyond the K^T_ii
//! ```
//! Each difference is weighed with the entry of its own element, not of a sum: the defect is exact for element
//! matrices that are changed by a few ε.

use super::contact::Defect;
use super::factor::Factor;
use signorini_kernel::element::{crouzeix_raviart, rannacher_turek};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Real, features};

/// What a defect is made of (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Balance<'a, R, I> {
    /// Cells by the edges of their sides.
    pub edges: &'a Edges<'a, I>,
    /// K^T
    pub stiffness: Stiffness<'a, R>,
    /// c, what K has on its diagonal beyond the K^T.
    pub diagonal: DiagonalTerms<'a, R, I>,
    /// b, one entry an unknown.
    pub load: &'a [R],
}

impl<R: Real, I: Index> Defect<R, I> for Balance<'_, R, I> {
    fn measure(&self, factor: &Factor<R, I>, u: &[R], places: &mut [R]) {
        self.defects(factor, u, places);
    }
}

impl<R: Real, I: Index> Balance<'_, R, I> {
    /// The defect of u, one entry an edge, in `places`, one entry an unknown.
    #[inline(never)]
    pub fn defects(&self, factor: &Factor<R, I>, u: &[R], places: &mut [R]) {
        for (unknown, &load) in self.load.iter().enumerate() {
            write(places, factor.place(unknown), load);
        }
        // Dirichlet edges have no place.
        let mut take = |edge: usize, flow: R| {
            if let Some(defect) = places.get_mut(factor.place(edge)) {
                *defect -= flow;
            }
        };
        if features::TRIANGLES {
            for (sides, k) in self.edges.of_triangles().iter().zip(self.stiffness.triangles) {
                let flows = crouzeix_raviart::product(k, &sides.map(|side| read(u, side.at())));
                sides.iter().zip(flows).for_each(|(side, flow)| take(side.at(), flow));
            }
        }
        if features::QUADS {
            for (sides, k) in self.edges.of_quads().iter().zip(self.stiffness.quads) {
                let flows = rannacher_turek::product(k, &sides.map(|side| read(u, side.at())));
                sides.iter().zip(flows).for_each(|(side, flow)| take(side.at(), flow));
            }
        }
        self.diagonal.products(u).for_each(|(edge, product)| take(edge, product));
    }
}

//! Terms on the diagonal of K beyond the element matrices.
//!
//! ```text
//!   K_ii = Σ_T K^T_ii + c_i,     c_i = ∫h on a Robin edge, and in a step of time what cells store ([`crate::storage`])
//! ```
//! Rows of element matrices add up to 0, so that only c opposes a constant u. It is what a defect written with differences
//! u_j − u_i leaves out, what holds a part that has no Dirichlet edge, and what weighs against a shift of a whole part.
//! Assembly, defects, shifts and the check for solutions ask here and know no condition by its name: another term on the
//! diagonal, that of a reaction say, is a field here and an argument where [`DiagonalTerms::new`] is called.

use crate::index::{Index, read};
use crate::mesh::boundary::{Boundary, Robin};
use crate::{Real, features};

/// All c_i that are not 0 (borrowed), in the unit of K: none is negative.
#[derive(Debug, Clone, Copy)]
pub struct DiagonalTerms<'a, R, I> {
    robin: &'a [Robin<R, I>],
    /// Every c_i from the first edge on, in a step of time.
    all: &'a [R],
}

impl<'a, R: Real, I: Index> DiagonalTerms<'a, R, I> {
    /// Terms of the conditions on the boundary.
    pub fn new(boundary: &Boundary<'a, R, I>) -> Self {
        // A build without transfer laws shall not even look for them.
        Self { robin: if features::ROBIN { boundary.robin() } else { &[] }, all: &[] }
    }

    /// Terms of a step in time: `all` holds c_i of each unknown, that of a transfer law among it.
    pub fn in_step(all: &'a [R]) -> Self {
        Self { robin: &[], all }
    }

    /// (i, c_i) in the order of the edges, each edge once at most; one that is left out has c_i = 0.
    pub fn entries(self) -> impl Iterator<Item = (usize, R)> {
        self.of_laws().chain(self.of_step().iter().copied().enumerate())
    }

    /// The entries of a steady problem; none in a step of time.
    pub fn of_laws(self) -> impl Iterator<Item = (usize, R)> {
        // A build without transfer laws shall hold no loop over them.
        let robin = if features::ROBIN { self.robin } else { &[] };
        robin.iter().map(|record| (record.edge.at(), record.coefficient))
    }

    /// c_i of each unknown in a step of time; nothing in a steady problem.
    pub fn of_step(self) -> &'a [R] {
        if features::STORAGE { self.all } else { &[] }
    }

    /// (i, c_i u_i), the share of c in Ku, for `u` with one entry an edge: a defect b − Ku is less by it.
    pub fn products(self, u: &[R]) -> impl Iterator<Item = (usize, R)> {
        self.entries().map(|(edge, term)| (edge, term * read(u, edge)))
    }

    /// The edges with c_i > 0, each of which makes the solution unique in its connected part.
    pub fn holding(self) -> impl Iterator<Item = usize> {
        self.entries().filter(|(_, term)| *term > R::ZERO).map(|(edge, _)| edge)
    }
}

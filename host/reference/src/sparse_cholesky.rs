//! K = L Lᵀ for a sparse K in a given order of elimination, by faer's supernodal factorisation.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::{SupernodalLltRef, SupernodeRef};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::ReferenceError;

/// L and the structure it is stored in.
pub(super) struct SparseCholesky {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

impl SparseCholesky {
    /// Factors `matrix` (its lower triangle is read), eliminating in the order of `order`.
    pub fn new(
        matrix: SparseColMatRef<'_, u32, f64>,
        order: PermRef<'_, u32>,
    ) -> Result<Self, ReferenceError> {
        let symbolic = factorize_symbolic_cholesky(
            matrix.symbolic(),
            Side::Lower,
            SymmetricOrdering::Custom(order),
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                ..Default::default()
            },
        )?;
        let mut values = Vec::new();
        values.try_reserve_exact(symbolic.len_val()).map_err(|_| FaerError::OutOfMemory)?;
        values.resize(symbolic.len_val(), 0.0);
        let mut cholesky = Self { symbolic, values };
        cholesky.factorise(matrix)?;
        Ok(cholesky)
    }

    fn factorise(&mut self, matrix: SparseColMatRef<'_, u32, f64>) -> Result<(), ReferenceError> {
        let scratch = self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
        let outcome = self.symbolic.factorize_numeric_llt(
            &mut self.values,
            matrix,
            Side::Lower,
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Spec::default(),
        );
        match outcome {
            Ok(_) => Ok(()),
            Err(LltError::NonPositivePivot { index }) => {
                Err(ReferenceError::NotPositiveDefinite { unknown: self.unknown_at(index) })
            }
        }
    }

    /// K⁻¹ applied to the columns of `rhs`, each of length `n`.
    pub fn solve_in_place(&self, rhs: &mut [f64], n: usize) -> Result<(), FaerError> {
        let columns = rhs.len().checked_div(n).unwrap_or(0);
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq);
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, n, columns),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        Ok(())
    }

    /// How many numbers L is stored in.
    pub fn stored(&self) -> usize {
        self.values.len()
    }

    /// The entries of L as (row, column, value) in the order of elimination: column by column, each
    /// from its diagonal down.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let factor = match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                Some(SupernodalLltRef::new(symbolic, &self.values))
            }
            // Supernodes are forced wherever there is anything to eliminate.
            SymbolicCholeskyRaw::Simplicial(_) => None,
        };
        factor.into_iter().flat_map(|factor| {
            let supernodes =
                (0..factor.symbolic().n_supernodes()).map(move |s| factor.supernode(s));
            supernodes.flat_map(supernode_entries)
        })
    }

    /// The unknown that is eliminated at `position`.
    pub fn unknown_at(&self, position: usize) -> usize {
        self.symbolic.perm().map_or(position, |order| order.arrays().0[position] as usize)
    }
}

/// A supernode is a dense trapezoid: its own columns as rows, then the rows of its pattern.
fn supernode_entries(
    supernode: SupernodeRef<'_, u32, f64>,
) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
    let (start, values) = (supernode.start(), supernode.val());
    let width = values.ncols();
    let row_at = move |i: usize| match i.checked_sub(width) {
        None => start + i,
        Some(below) => supernode.pattern()[below] as usize,
    };
    (0..width)
        .flat_map(move |j| (j..values.nrows()).map(move |i| (row_at(i), start + j, values[(i, j)])))
}

//! K = L Lᵀ for a sparse K by faer's supernodal factorisation, in a fill-reducing order of elimination that keeps the
//! contact unknowns last.
//!
//! Approximate minimum degree orders the free block alone; the contact unknowns follow. The fill
//! towards C is not seen by the ordering, which costs little as C is a curve.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::perm::Perm;
use faer::sparse::linalg::cholesky::supernodal::{SupernodalLltRef, SupernodeRef};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, amd};
use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::ReferenceError;
use super::problem::Matrix;

/// L and the structure it is stored in.
pub(super) struct SparseCholesky {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

impl SparseCholesky {
    /// Factors the matrix with the pattern of `matrix` and these `values` (their lower triangle is read), contact last.
    pub fn new(matrix: &Matrix, values: &[f64]) -> Result<Self, ReferenceError> {
        let (n, col_ptr, row_idx) = (matrix.unknowns(), &matrix.row_ptr, &matrix.col_idx);
        let pattern = SymbolicSparseColMatRef::new_unsorted_checked(n, n, col_ptr, None, row_idx);
        let order = contact_last(matrix)?;
        let symbolic = factorize_symbolic_cholesky(
            pattern,
            Side::Lower,
            SymmetricOrdering::Custom(order.as_ref()),
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                ..Default::default()
            },
        )?;
        let mut memory = Vec::new();
        memory.try_reserve_exact(symbolic.len_val()).map_err(|_| FaerError::OutOfMemory)?;
        memory.resize(symbolic.len_val(), 0.0);
        let mut cholesky = Self { symbolic, values: memory };
        cholesky.factorise(SparseColMatRef::new(pattern, values))?;
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

/// The order of elimination: position → unknown.
fn contact_last(matrix: &Matrix) -> Result<Perm<u32>, FaerError> {
    let (n, free) = (matrix.unknowns(), matrix.free);
    let is_free = |column: &u32| (*column as usize) < free;
    let columns = (0..free).map(|row| matrix.columns(row).iter().copied().filter(is_free));
    let both = minimum_degree(columns)?.map(|mut order| {
        order.extend(free as u32..n as u32);
        order.into_boxed_slice()
    });
    let [order, position] = both;
    Ok(Perm::new_checked(order, position, n))
}

/// Approximate minimum degree on a symmetric pattern, given column by column: the order (position → unknown) and its inverse.
///
/// # Errors
/// A pattern beyond 32 bits, or too little memory.
pub fn minimum_degree(
    columns: impl Iterator<Item = impl Iterator<Item = u32>>,
) -> Result<[Vec<u32>; 2], FaerError> {
    let (mut col_ptr, mut row_idx) = (vec![0], Vec::new());
    for column in columns {
        row_idx.extend(column);
        col_ptr.push(u32::try_from(row_idx.len()).map_err(|_| FaerError::IndexOverflow)?);
    }
    let n = col_ptr.len() - 1;
    let pattern = SymbolicSparseColMatRef::new_unsorted_checked(n, n, &col_ptr, None, &row_idx);
    let scratch = amd::order_maybe_unsorted_scratch::<u32>(n, row_idx.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
    let (control, stack) = (amd::Control::default(), MemStack::new(&mut memory));
    let (mut order, mut position) = (vec![0; n], vec![0; n]);
    amd::order_maybe_unsorted(&mut order, &mut position, pattern, control, stack)?;
    Ok([order, position])
}

//! L, D and S of a matrix in memory of their own, the free unknowns eliminated in any order.

use signorini_contact::dense::blocks::{Block, SIDE, count};
use signorini_device::sparse::elimination::PatternBuffers;
use signorini_device::sparse::factor::FactorBuffers;
use signorini_device::sparse::{Factor, Pattern};
use signorini_kernel::csr::Csr;
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_kernel::{Error, Index, Real};

pub struct Ldlt<R, I> {
    counts: EdgeCounts,
    pub places: Vec<I>,
    pub pointers: Vec<u32>,
    rows: Vec<I>,
    pub values: Vec<R>,
    pub inverse: Vec<R>,
    pub schur: Vec<Block<R>>,
}

impl<R: Real, I: Index> Ldlt<R, I> {
    /// `None` where a pivot vanishes.
    pub fn new(matrix: &Csr<R, I>, counts: EdgeCounts, order: &[I]) -> Result<Option<Self>, Error> {
        let scratch = || vec![I::FIRST; counts.free];
        let (mut places, mut parent, mut pointers) =
            (scratch(), scratch(), vec![0; counts.free + 1]);
        let buffers = PatternBuffers {
            place: &mut places,
            parent: &mut parent,
            visited: &mut scratch(),
            pointers: &mut pointers,
        };
        let pattern = Pattern::new(matrix, counts, order, buffers)?;
        let entries = pattern.entries();
        let (mut rows, mut values) = (vec![I::FIRST; entries], vec![R::ZERO; entries]);
        let mut inverse = vec![R::ZERO; counts.free];
        let mut schur = vec![[[R::ZERO; SIDE]; SIDE]; count(counts.contact)];
        let buffers = FactorBuffers {
            rows: &mut rows,
            values: &mut values,
            inverse: &mut inverse,
            ends: &mut vec![0; counts.free],
            path: &mut scratch(),
            visited: &mut scratch(),
            row: &mut vec![R::ZERO; counts.unknowns()],
        };
        let is_found = Factor::new(matrix, pattern, buffers, &mut schur)?.is_some();
        Ok(is_found.then_some(Self { counts, places, pointers, rows, values, inverse, schur }))
    }

    pub fn factor(&self) -> Factor<'_, R, I> {
        let Self { counts, places, pointers, rows, values, inverse, .. } = self;
        Factor::baked(places, pointers, rows, values, inverse, *counts)
    }
}

//! Rows that own their memory and know whether it is laid out: symbolic once, numeric every tick.

use super::{Row, Rows};
use crate::mesh::edges::{EdgeCounts, Edges};
use crate::{Error, Index, Real};

/// Memory that becomes the rows of a mesh.
pub trait LayOut<R, I, const WIDTH: usize> {
    /// The rows of `edges`.
    ///
    /// # Errors
    /// As for [`Rows::new`].
    fn lay_out(&mut self, edges: &Edges<I>) -> Result<Rows<'_, R, I, WIDTH>, Error>;
}

/// Plain slices: laid out at each call, since nothing guarantees their offsets.
impl<R: Real, I: Index, const WIDTH: usize, T: AsMut<[Row<R, I, WIDTH>]>> LayOut<R, I, WIDTH>
    for T
{
    fn lay_out(&mut self, edges: &Edges<I>) -> Result<Rows<'_, R, I, WIDTH>, Error> {
        Rows::new(edges, self.as_mut())
    }
}

/// Memory for the rows of one mesh; can initialise a `static`.
///
/// Its bits may be any: what a tick finds there may be from before a reset. An offset that is none of the mesh has all of
/// them laid out anew, and everything else is set before it is read. `laid_out` tells which numbering the offsets belong to by its sizes: every offset names an entry of an
/// array over `laid_out.edges()` edges. Zeros, as it starts and as a failed pass leaves it, belong to no mesh.
#[derive(Debug)]
pub struct OwnedRows<R, I, const WIDTH: usize, const UNKNOWNS: usize> {
    rows: [Row<R, I, WIDTH>; UNKNOWNS],
    laid_out: EdgeCounts,
}

impl<R: Real, I: Index, const WIDTH: usize, const UNKNOWNS: usize>
    OwnedRows<R, I, WIDTH, UNKNOWNS>
{
    /// Memory that belongs to no mesh yet.
    pub const fn new() -> Self {
        let laid_out = EdgeCounts { free: 0, contact: 0, dirichlet: 0 };
        Self { rows: [Row::EMPTY; UNKNOWNS], laid_out }
    }

    /// The rows of `edges`: laid out at the first call, and as the last call left them ever after. Always
    /// of the same mesh: another one of the same sizes would find the neighbours of the first.
    ///
    /// # Errors
    /// As for [`Rows::new`].
    pub fn of(&mut self, edges: &Edges<I>) -> Result<Rows<'_, R, I, WIDTH>, Error> {
        let counts = edges.counts();
        if self.laid_out != counts || !are_inside(&self.rows, counts) {
            self.laid_out = EdgeCounts::default();
            Rows::new(edges, &mut self.rows)?;
            self.laid_out = counts;
        }
        Ok(Rows { rows: &mut self.rows, counts, omega: R::ONE })
    }

    /// Rows where there is room for more of them than `edges` has unknowns.
    ///
    /// # Errors
    /// As for [`Rows::new`]; too little room.
    pub fn within(&mut self, edges: &Edges<I>) -> Result<Rows<'_, R, I, WIDTH>, Error> {
        let counts = edges.counts();
        let (of, needed) = (crate::error::Array::Rows, counts.unknowns());
        let rows = self.rows.get_mut(..needed);
        let rows = rows.ok_or(Error::Capacity { of, needed, limit: UNKNOWNS })?;
        if self.laid_out != counts || !are_inside(rows, counts) {
            self.laid_out = EdgeCounts::default();
            Rows::new(edges, rows)?;
            self.laid_out = counts;
        }
        Ok(Rows { rows, counts, omega: R::ONE })
    }

    /// Forgets the mesh: the next one has a numbering of its own.
    pub fn forget(&mut self) {
        self.laid_out = EdgeCounts::default();
    }
}

/// Whether every offset names an entry of an array over the edges: it is at most that of the last, and a multiple of an entry's size, which
/// is a power of two.
fn are_inside<R, I: Index, const WIDTH: usize>(
    rows: &[Row<R, I, WIDTH>],
    counts: EdgeCounts,
) -> bool {
    let (mut largest, mut bits) = (0, 0);
    for row in rows {
        for offset in &row.offsets {
            largest = offset.at().max(largest);
            bits |= offset.at();
        }
    }
    let size = size_of::<R>();
    bits % size == 0 && largest / size < counts.edges().max(1)
}

impl<R: Real, I: Index, const WIDTH: usize, const UNKNOWNS: usize> LayOut<R, I, WIDTH>
    for OwnedRows<R, I, WIDTH, UNKNOWNS>
{
    fn lay_out(&mut self, edges: &Edges<I>) -> Result<Rows<'_, R, I, WIDTH>, Error> {
        self.of(edges)
    }
}

impl<R: Real, I: Index, const WIDTH: usize, const UNKNOWNS: usize> Default
    for OwnedRows<R, I, WIDTH, UNKNOWNS>
{
    fn default() -> Self {
        Self::new()
    }
}

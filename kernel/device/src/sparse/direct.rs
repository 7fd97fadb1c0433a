//! The exact solver on a matrix that was factored here: S is scaled in place, defects come from its rows.

use super::contact::{Defect, Exact, Factored, Memory, SLACK, Solved};
use super::factor::Factor;
use signorini_contact::dense::blocks::{Block, Blocks, SIDE, count};
use signorini_contact::dense::tableau::InitialTableau;
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::refinement::defects;
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::system::{Residual, System};

/// What a solve did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolveSummary<R> {
    /// How it ended: `Converged`, `RoundingLimit` where corrections are down to rounding, or `Stalled` where they
    /// stopped to shrink before that.
    pub status: Status,
    /// The residual of u.
    pub residual: Residual<R>,
    /// Exchanges.
    pub pivots: u32,
    /// Substitutions with the factor.
    pub rounds: u32,
}

/// Memory of S and its contact problem: P and B as in [`Factored`].
#[derive(Debug)]
pub struct DirectMemory<'a, R> {
    /// S as the factor left it: B blocks. Becomes scaled.
    pub schur: &'a mut [Block<R>],
    /// Becomes 1/√S_ii: P entries.
    pub scale: &'a mut [R],
    /// Zeros, P of them: where exchanges begin.
    pub none: &'a mut [bool],
    /// That of the exchanges.
    pub contact: Memory<'a, R>,
    /// Scratch, one entry an unknown.
    pub places: &'a mut [R],
}

/// A factor with its contact problem and the memory for both, ready for any number of loads.
#[derive(Debug)]
pub struct Direct<'a, R, I> {
    exact: Exact<'a, R, I>,
    places: &'a mut [R],
}

impl<'a, R: Real, I: Index> Direct<'a, R, I> {
    /// Takes a factor and the S that it left in `memory.schur`. `None` where S has no positive diagonal.
    ///
    /// # Errors
    /// Memory of the wrong length.
    pub fn new(
        factor: Factor<'a, R, I>,
        memory: DirectMemory<'a, R>,
    ) -> Result<Option<Self>, Error> {
        let DirectMemory { schur, scale, none, contact, places } = memory;
        Blocks::new(schur, factor.counts().contact)?;
        if !normalise(schur, scale, factor.counts().contact) {
            return Ok(None);
        }
        none.fill(false);
        let start = InitialTableau { blocks: schur, exchanged: none };
        let mut exact = Exact::new(Factored { factor, schur, scale, start }, contact)?;
        exact.restart()?;
        Ok(Some(Self { exact, places }))
    }

    /// Solves `system`, from any `u`, which becomes the answer together with its low part `low`; `diagonal` is what K has
    /// on its diagonal beyond the element matrices, and the tolerances of `settings` tell whether the answer is good
    /// enough. `None` where there is no answer that this scalar can hold: no solution, or a matrix that is singular in
    /// it; u is of no use then.
    ///
    /// # Errors
    /// Arrays of the wrong length, a system with other edges than the factor's.
    pub fn solve(
        &mut self,
        system: &System<R, I>,
        diagonal: DiagonalTerms<R, I>,
        settings: &Settings<R>,
        u: &mut [R],
        low: &mut [R],
    ) -> Result<Option<SolveSummary<R>>, Error> {
        same_length(Array::Scratch, low.len(), u.len())?;
        let rows = Rows { system, diagonal };
        let Some(solved) = self.exact.solve(&rows, system.law(), self.places, u, low)? else {
            return Ok(None);
        };
        let residual = system.residual(u);
        let Residual { largest, range, load, rounding, .. } = &residual;
        if [largest, range, load, rounding].iter().any(|size| !size.finite()) {
            return Ok(None);
        }
        let status = match settings.is_met(&residual, R::ONE) {
            true => Status::Converged,
            false if solved.has_digits() && is_solution(&solved, &residual) => {
                Status::RoundingLimit
            }
            false => Status::Stalled,
        };
        let Solved { pivots, rounds, .. } = solved;
        Ok(Some(SolveSummary { status, residual, pivots, rounds }))
    }
}

/// Whether nothing but rounding is left, as far as a factor can tell that may be another matrix's.
fn is_solution<R: Real>(solved: &Solved<R>, residual: &Residual<R>) -> bool {
    solved.contracts() || residual.largest <= R::from_count(SLACK) * residual.rounding
}

/// Defects from the rows of K.
struct Rows<'s, 'a, R, I> {
    system: &'s System<'a, R, I>,
    diagonal: DiagonalTerms<'s, R, I>,
}

impl<R: Real, I: Index> Defect<R, I> for Rows<'_, '_, R, I> {
    fn measure(&self, factor: &Factor<R, I>, u: &[R], places: &mut [R]) {
        for (unknown, defect) in defects(self.system, u).enumerate() {
            write(places, factor.place(unknown), defect);
        }
        for (edge, product) in self.diagonal.products(u) {
            if let Some(defect) = places.get_mut(factor.place(edge)) {
                *defect -= product;
            }
        }
    }
}

/// S to a diagonal of 1, `scale` to 1/√S_ii; false where an entry on the diagonal is not positive.
pub fn normalise<R: Real>(schur: &mut [Block<R>], scale: &mut [R], order: usize) -> bool {
    let mut positive = true;
    scale.fill(R::ZERO);
    for (row, scale) in scale.iter_mut().enumerate().take(order) {
        let position = count(row / SIDE * SIDE) + row / SIDE;
        let line = schur.get(position).and_then(|block| block.get(row % SIDE));
        let diagonal = line.map_or(R::ZERO, |line| read(line, row % SIDE));
        *scale = R::ONE / diagonal.rounded_sqrt();
        positive &= diagonal > R::ZERO && scale.finite();
    }
    let mut blocks = schur.iter_mut();
    for row in 0..order.div_ceil(SIDE) {
        for (column, block) in blocks.by_ref().take(row + 1).enumerate() {
            for (r, line) in block.iter_mut().enumerate() {
                for (c, entry) in line.iter_mut().enumerate() {
                    *entry *= read(scale, row * SIDE + r) * read(scale, column * SIDE + c);
                }
            }
        }
    }
    positive
}

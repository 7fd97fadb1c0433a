//! The exact solver on a matrix that was factored here: S is scaled once, defects come from the rows of K.

use signorini_contact::dense::blocks::{Block, padded};
use signorini_contact::dense::tableau::InitialTableau;
use signorini_device::sparse::contact::{Defect, SLACK};
use signorini_device::sparse::factor::normalise;
use signorini_device::sparse::{Exact, Factor, Factored, Solved};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::{Index, write};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::refinement::defects;
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::system::{Residual, System};

use super::ldlt::{Exchanges, exchanges};

/// The outcome of a solve.
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

/// S scaled to a diagonal of 1, and the memory of its exchanges.
#[derive(Debug)]
pub struct Scaled<R> {
    schur: Vec<Block<R>>,
    scale: Vec<R>,
    /// Exchanges begin with none.
    none: Vec<bool>,
    exchanges: Exchanges<R>,
}

impl<R: Real> Scaled<R> {
    /// Takes the S that a factor left for so many contact edges; `None` where it has no positive diagonal.
    pub fn new(mut schur: Vec<Block<R>>, contact: usize) -> Option<Self> {
        let (mut scale, none) = (vec![R::ZERO; padded(contact)], vec![false; padded(contact)]);
        let is_positive = normalise(&mut schur, &mut scale, contact);
        is_positive.then(|| Self { schur, scale, none, exchanges: exchanges(contact) })
    }

    /// The solver by the factor whose S this is.
    ///
    /// # Errors
    /// A factor of another number of contact edges.
    pub fn by<'a, I: Index>(
        &'a mut self,
        factor: Factor<'a, R, I>,
    ) -> Result<ByFactor<'a, R, I>, Error> {
        let (Self { schur, scale, none, exchanges }, counts) = (self, factor.counts());
        let start = InitialTableau { blocks: schur, exchanged: none };
        let factored = Factored { factor, schur, scale, start };
        let mut exact = Exact::new(factored, exchanges.memory(counts.contact)?)?;
        exact.restart()?;
        Ok(ByFactor { exact, places: vec![R::ZERO; counts.unknowns()] })
    }
}

/// A factor with its contact problem, ready for any number of loads.
#[derive(Debug)]
pub struct ByFactor<'a, R, I> {
    exact: Exact<'a, R, I>,
    /// Scratch.
    places: Vec<R>,
}

impl<R: Real, I: Index> ByFactor<'_, R, I> {
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
        let Some(solved) = self.exact.solve(&rows, system.law(), &mut self.places, u, low)? else {
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

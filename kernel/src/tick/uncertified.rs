//! A tick of which nobody wants a bound: sweeps, then the flux (15).

use super::running::FEWEST;
use super::{Deadline, Ended, Limits, Report, Running};
use crate::certificate::Verdict;
use crate::error::Error;
use crate::flux;
use crate::index::Index;
use crate::math::Math;
use crate::real::Real;

impl<R: Real, I: Index, const WIDTH: usize> Running<'_, '_, R, I, WIDTH> {
    /// Sweeps until the sweeps or the time are used up or, where `limits.share` is more than 0, until the
    /// residual is down to rounding; without a bound neither that share nor `limits.error` can be told. τ
    /// becomes ∫σ_h·n by (15), the mean of both sides of an edge; s stays as it is. The square root of `M`
    /// serves the search for ω.
    ///
    /// # Errors
    /// Never for a tick that has begun.
    pub fn advance_uncertified<M: Math<R>, F: FnMut() -> u32>(
        &mut self,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        let last = self.sweeps.saturating_add(limits.sweeps);
        let mut next_look = self.sweeps.saturating_add(FEWEST);
        let ended = loop {
            if self.sweeps >= last {
                break Ended::OutOfSweeps;
            }
            if !deadline.allows_a_sweep() {
                break Ended::OutOfTime;
            }
            if limits.share > R::ZERO && self.sweeps >= next_look {
                // A look costs a sweep: a fifth of the time at most goes there.
                next_look = self.sweeps.saturating_add((self.sweeps / 4).max(FEWEST));
                let residual = self.measure()?.0.largest;
                if !residual.finite() {
                    break Ended::NotFinite;
                }
                if self.is_rounding(residual) {
                    break Ended::Settled;
                }
            }
            self.sweep::<M>()?;
        };
        self.recover()?;
        self.report(ended, Verdict::NotAsked)
    }

    /// τ of the present iterate.
    pub(super) fn recover(&mut self) -> Result<(), Error> {
        let (ground, memory) = (&self.tick.ground, &mut self.tick.memory);
        let loads = self.data.given.loads;
        flux::recover(&ground.edges, ground.stiffness, loads, memory.u, &[], memory.tau).map(|_| ())
    }
}

//! A tick of which nobody wants a bound: sweeps, then the flux (15).

use super::method::{Method, Sweeping};
use super::running::FEWEST;
use super::{Deadline, Ended, Limits, Report, Running};
use signorini_bound::certificate::Verdict;
use signorini_kernel::{Error, Index, Math, Real, flux};

/// Sweeps until the sweeps or the time are used up or, where `limits.share` is more than 0, until the
/// residual is down to rounding; without a bound neither that share nor `limits.error` can be told. τ
/// becomes ∫σ_h·n by (15), the mean of both sides of an edge; s stays as it is. The square root of `M`
/// serves the search for ω.
#[derive(Debug, Clone, Copy)]
pub struct UncertifiedSweeps<M>(pub M);

impl<R: Real, I: Index, M: Math<R>> Method<R, I> for UncertifiedSweeps<M> {
    const CERTIFIES: bool = false;

    // Inlined: see `Running::advance`.
    #[inline(always)]
    fn advance<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        running: &mut Running<'_, '_, '_, R, I, WIDTH>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        let last = running.sweeps.saturating_add(limits.sweeps);
        let mut next_look = running.sweeps.saturating_add(FEWEST);
        let ended = loop {
            if let Some(cut) = running.cut(last, deadline) {
                break cut;
            }
            if limits.share > R::ZERO && running.sweeps >= next_look {
                // A look costs a sweep: a fifth of the time at most goes there.
                next_look = running.sweeps.saturating_add((running.sweeps / 4).max(FEWEST));
                let residual = running.measure()?.0.largest;
                if !residual.finite() {
                    break Ended::NotFinite;
                }
                if running.is_rounding(residual) {
                    break Ended::Settled;
                }
            }
            running.sweep::<M>()?;
        };
        running.recover()?;
        running.report(ended, Verdict::NotAsked)
    }
}

impl<R: Real, I: Index, M: Math<R>> Sweeping<R, I> for UncertifiedSweeps<M> {
    fn conclude<const WIDTH: usize>(
        &self,
        running: &mut Running<'_, '_, '_, R, I, WIDTH>,
        _: Limits<R>,
    ) -> Result<Report<R>, Error> {
        running.recover()?;
        running.report(Ended::Exact, Verdict::NotAsked)
    }
}

impl<R: Real, I: Index, const WIDTH: usize> Running<'_, '_, '_, R, I, WIDTH> {
    /// τ of the present iterate.
    fn recover(&mut self) -> Result<(), Error> {
        let (discretization, memory) = (&self.tick.discretization, &mut self.tick.memory);
        let (loads, edges) = (self.data.given.loads, &discretization.edges);
        let (k, u, tau) = (discretization.stiffness, &*memory.u, &mut *memory.tau);
        let recovered = match self.data.step.get() {
            Some(step) => flux::recover_in_step(edges, k, (loads, step.step.storage), u, &[], tau),
            None => flux::recover(edges, k, loads, u, &[], tau),
        };
        recovered.map(|_| ())
    }
}

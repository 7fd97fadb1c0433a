//! Sweeps with certificates between them: a tick that ends where its bound says that more sweeps buy nothing.

use super::method::{Method, Sweeping};
use super::running::FEWEST;
use super::{Deadline, Ended, Limits, Report, Running, Tick};
use signorini_bound::certificate::{Certificate, Verdict, certify};
use signorini_kernel::{Error, Index, Math, Real};

/// Sweeps until one of the limits or the deadline ends it, and certifies what it then has. The square root of `M`
/// serves the search for ω.
#[derive(Debug, Clone, Copy)]
pub struct CertifiedSweeps<M>(pub M);

impl<R: Real, I: Index, M: Math<R>> Method<R, I> for CertifiedSweeps<M> {
    // Inlined: see `Running::advance`.
    #[inline(always)]
    fn advance<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        running: &mut Running<'_, '_, '_, R, I, WIDTH>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        running.plan(&limits);
        let last = running.sweeps.saturating_add(limits.sweeps);
        loop {
            let cut = running.cut(last, deadline);
            let known = running.verdict.is_some();
            if cut.is_some() || known || running.is_due(deadline) {
                let verdict = running.certified()?;
                if let Some(ended) = judge(&verdict, &limits).or(cut) {
                    return running.report(ended, verdict);
                }
                if verdict == Verdict::NotFinite && !running.measure()?.0.largest.finite() {
                    return running.report(Ended::NotFinite, verdict);
                }
                if limits.share > R::ZERO && running.is_at_the_floor(&verdict)? {
                    return running.report(Ended::Settled, verdict);
                }
                running.schedule(&verdict, &limits);
                if !deadline.allows_a_sweep() {
                    return running.report(Ended::OutOfTime, verdict);
                }
            }
            running.sweep::<M>()?;
        }
    }
}

impl<R: Real, I: Index, M: Math<R>> Sweeping<R, I> for CertifiedSweeps<M> {
    fn conclude<const WIDTH: usize>(
        &self,
        running: &mut Running<'_, '_, '_, R, I, WIDTH>,
        limits: Limits<R>,
    ) -> Result<Report<R>, Error> {
        let verdict = running.certified()?;
        let is_accurate = judge(&verdict, &limits) == Some(Ended::Accurate);
        running.report(if is_accurate { Ended::Accurate } else { Ended::Exact }, verdict)
    }
}

impl<R: Real, I: Index, const WIDTH: usize> Running<'_, '_, '_, R, I, WIDTH> {
    /// When the first certificate within these limits is due.
    fn plan(&mut self, limits: &Limits<R>) {
        self.next_certificate = match limits.error > R::ZERO || limits.share > R::ZERO {
            // Nothing that a certificate could say would end it.
            false => u32::MAX,
            true if self.next_certificate == u32::MAX => self.sweeps.saturating_add(FEWEST),
            true => self.next_certificate,
        };
    }

    /// Whether to certify now, if it need not be: not more often than leaves half of the time to the
    /// sweeps, and not where it would leave time for nothing else.
    fn is_due<F: FnMut() -> u32>(&self, deadline: &mut Deadline<F>) -> bool {
        let since = self.sweeps - self.earlier.map_or(0, |(at, _)| at);
        self.sweeps >= self.next_certificate
            && since >= deadline.sweeps_a_certificate()
            && deadline.allows_to_look()
    }

    fn certified(&mut self) -> Result<Verdict<R>, Error> {
        if let Some(verdict) = self.verdict {
            return Ok(verdict);
        }
        let verdict = match self.data.step.get() {
            Some(step) => self.tick.of_step(&self.data, step)?,
            None => {
                let Tick { discretization, memory, .. } = &mut *self.tick;
                let (iterate, buffers) = memory.certified(self.data.law);
                certify(discretization, &self.data.given, iterate, buffers)?
            }
        };
        self.verdict = Some(verdict);
        Ok(verdict)
    }

    /// Whether rounding keeps the algebraic part from falling: it hardly fell since the last certificate, is
    /// not far above what rounding hides, and the residual is down to a few ε of u; without a bound the
    /// last alone tells.
    fn is_at_the_floor(&mut self, verdict: &Verdict<R>) -> Result<bool, Error> {
        if let Verdict::Certified(now) = verdict {
            let noticeably = R::ONE - R::QUARTER * R::HALF;
            let falls = self.earlier.is_none_or(|(_, before)| now.algebraic < before * noticeably);
            // Slow, smooth parts of the error can hide in a residual that is all rounding. The factor is what
            // thin cells make of rounding: 250 where they are 10⁴ times as long as high.
            let hidden = now.algebraic <= R::from_count(1024) * now.rounding;
            if falls || !hidden {
                return Ok(false);
            }
        }
        let residual = self.measure()?.0.largest;
        Ok(self.is_rounding(residual))
    }

    /// When the algebraic part, falling on as it did, should be small enough.
    fn schedule(&mut self, verdict: &Verdict<R>, limits: &Limits<R>) {
        let wait = match (verdict, self.earlier) {
            (Verdict::Certified(now), Some((at, before))) if now.algebraic < before => {
                let since = self.sweeps - at;
                since.saturating_mul(quarters(now, before, limits)) / 4
            }
            _ => self.sweeps,
        };
        if let Verdict::Certified(now) = verdict {
            self.earlier = Some((self.sweeps, now.algebraic));
        }
        let wait = wait.clamp(FEWEST, self.sweeps.saturating_mul(2).max(FEWEST));
        self.next_certificate = self.sweeps.saturating_add(wait);
    }
}

fn judge<R: Real>(verdict: &Verdict<R>, limits: &Limits<R>) -> Option<Ended> {
    match verdict {
        Verdict::Certified(now) if now.total <= limits.error => Some(Ended::Accurate),
        Verdict::Certified(now) if limits.are_settled(now) => Some(Ended::Settled),
        // Without a bound there may still be a solution.
        _ => None,
    }
}

/// How many times a quarter of the sweeps that brought the algebraic part from `before` down to what it is
/// will bring it down to its share, if it falls on at that rate; 32 at most.
fn quarters<R: Real>(now: &Certificate<R>, before: R, limits: &Limits<R>) -> u32 {
    let factor = (now.algebraic / before).rounded_sqrt().rounded_sqrt();
    let (mut rest, target) = (now.algebraic, limits.share * now.total);
    let enough = |_: &u32| {
        rest *= factor;
        rest <= target
    };
    (1..32).find(enough).unwrap_or(32)
}

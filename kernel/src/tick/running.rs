//! A tick in progress.

use super::{Data, Deadline, Ended, Limits, Report, Tick, contact_state};
use crate::certificate::{Buffers, Certificate, Verdict, certify};
use crate::contact;
use crate::equilibrium::Iterate;
use crate::error::Error;
use crate::index::Index;
use crate::math::{Libm, Math};
use crate::psor;
use crate::real::Real;
use crate::relaxation::Search;

/// Sweeps before the first certificate of a tick, and at least between two.
pub(super) const FEWEST: u32 = 4;

/// A tick with its data: [`Running::advance`] it as often as there is time.
#[derive(Debug)]
pub struct Running<'t, 'a, R: Real, I, const WIDTH: usize> {
    pub(super) tick: &'t mut Tick<'a, R, I, WIDTH>,
    pub(super) data: Data<'t, R, I>,
    /// That of the data in the unit of u.
    pub(super) size: R,
    /// ω as it was: what overflows teaches nothing.
    search: Search<R>,
    pub(super) sweeps: u32,
    /// Sweeps at the last measurement of the defect.
    measured: u32,
    next_certificate: u32,
    /// Sweeps and algebraic part at the last certificate.
    earlier: Option<(u32, R)>,
    /// The verdict on the present iterate, where it is known.
    pub(super) verdict: Option<Verdict<R>>,
}

impl<'t, 'a, R: Real, I: Index, const WIDTH: usize> Running<'t, 'a, R, I, WIDTH> {
    pub(super) fn new(tick: &'t mut Tick<'a, R, I, WIDTH>, data: Data<'t, R, I>, size: R) -> Self {
        Self {
            search: tick.search,
            tick,
            data,
            size,
            sweeps: 0,
            measured: 0,
            next_certificate: FEWEST,
            earlier: None,
            verdict: None,
        }
    }

    /// Sweeps until one of the limits or the deadline ends it, and certifies what it then has.
    ///
    /// # Errors
    /// Never for a tick that has begun.
    pub fn advance<F: FnMut() -> u32>(
        &mut self,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        self.advance_with::<Libm, F>(limits, deadline)
    }

    /// The same with the square root of `M` in the search for ω.
    ///
    /// # Errors
    /// As for [`Running::advance`].
    pub fn advance_with<M: Math<R>, F: FnMut() -> u32>(
        &mut self,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        self.next_certificate = match limits.error > R::ZERO || limits.share > R::ZERO {
            // Nothing that a certificate could say would end it.
            false => u32::MAX,
            true if self.next_certificate == u32::MAX => self.sweeps.saturating_add(FEWEST),
            true => self.next_certificate,
        };
        let last = self.sweeps.saturating_add(limits.sweeps);
        loop {
            let cut = if self.sweeps >= last {
                Some(Ended::OutOfSweeps)
            } else if deadline.allows_a_sweep() {
                None
            } else {
                Some(Ended::OutOfTime)
            };
            let known = self.verdict.is_some();
            if cut.is_some() || known || self.is_due(deadline) {
                let verdict = self.certified()?;
                if let Some(ended) = judge(&verdict, &limits).or(cut) {
                    return self.report(ended, verdict);
                }
                if verdict == Verdict::NotFinite && !self.measure()?.0.largest.finite() {
                    return self.report(Ended::NotFinite, verdict);
                }
                if limits.share > R::ZERO && self.is_at_the_floor(&verdict)? {
                    return self.report(Ended::Settled, verdict);
                }
                self.schedule(&verdict, &limits);
                if !deadline.allows_a_sweep() {
                    return self.report(Ended::OutOfTime, verdict);
                }
            }
            self.sweep::<M>()?;
        }
    }

    /// Whether to certify now, if it need not be: not more often than leaves half of the time to the
    /// sweeps, and not where it would leave time for nothing else.
    fn is_due<F: FnMut() -> u32>(&self, deadline: &mut Deadline<F>) -> bool {
        let since = self.sweeps - self.earlier.map_or(0, |(at, _)| at);
        self.sweeps >= self.next_certificate
            && since >= deadline.sweeps_a_certificate()
            && deadline.allows_to_look()
    }

    /// A sweep, and a look at ω where it is time for one.
    pub(super) fn sweep<M: Math<R>>(&mut self) -> Result<(), Error> {
        let memory = &mut self.tick.memory;
        psor::sweep(&memory.rows, self.data.lower, memory.u)?;
        self.sweeps += 1;
        self.verdict = None;
        if self.tick.search.is_over() || self.sweeps - self.measured < self.tick.search.block() {
            return Ok(());
        }
        let (defect, active) = self.measure()?;
        let before = self.tick.search.omega;
        // At the rounding limit the residual falls no faster whatever ω is: nothing to learn, and an ω led
        // astray would stay for the ticks to come.
        if defect.largest > self.rounding() {
            self.tick.search.look::<M>(defect.sum, active, self.sweeps - self.measured);
        }
        self.measured = self.sweeps;
        if self.tick.search.omega == before { Ok(()) } else { self.relax_anew() }
    }

    pub(super) fn measure(&mut self) -> Result<(psor::Defect<R>, u32), Error> {
        let (memory, lower) = (&self.tick.memory, self.data.lower);
        let defect = psor::defect(&memory.rows, lower, memory.u)?;
        let counts = self.tick.ground.edges.counts();
        let (active, _) = contact_state(counts, lower, memory.u, memory.active);
        Ok((defect, active))
    }

    /// Another ω asks for other rows.
    fn relax_anew(&mut self) -> Result<(), Error> {
        let Tick { ground, memory, search, .. } = &mut *self.tick;
        let boundary = &self.data.given.boundary;
        memory.rows.gather(&ground.edges, ground.stiffness, boundary, memory.load, search.omega)
    }

    pub(super) fn certified(&mut self) -> Result<Verdict<R>, Error> {
        if let Some(verdict) = self.verdict {
            return Ok(verdict);
        }
        let Tick { ground, memory, .. } = &mut *self.tick;
        let buffers = Buffers {
            vertices: memory.vertices,
            bubbles: memory.bubbles,
            tau: memory.tau,
            indicators: &mut [],
        };
        let iterate = Iterate { u: memory.u, lower: self.data.lower };
        let verdict = certify(ground, &self.data.given, iterate, buffers)?;
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

    /// Whether the residual may be all rounding.
    pub(super) fn is_rounding(&self, residual: R) -> bool {
        // An ω close to 2 keeps rounding errors alive for 1/(2 − ω) sweeps: they add up.
        residual * (R::TWO - self.tick.search.omega) <= self.rounding()
    }

    /// What rounding alone can make of the residual: a row's terms are at most a few times the largest u.
    fn rounding(&self) -> R {
        let u = self.tick.memory.u.iter();
        let size = u.fold(R::ZERO, |most, u| most.or_larger(u.magnitude()));
        R::from_count(16) * R::EPSILON * size
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

    pub(super) fn report(&mut self, ended: Ended, verdict: Verdict<R>) -> Result<Report<R>, Error> {
        let residual = self.measure()?.0.largest;
        let counts = self.tick.ground.edges.counts();
        let Tick { memory, search, report, .. } = &mut *self.tick;
        let lower = self.data.lower;
        let (active, changes) = contact_state(counts, lower, memory.u, memory.active);
        let force = contact::force(counts, &self.data.given.boundary, lower, memory.u, memory.tau);
        // u may be finite where its fluxes are not, and the law of contact may hide one.
        let fluxes = memory.tau.iter().skip(counts.free).take(counts.contact);
        let known = residual.finite() && force.finite() && fluxes.into_iter().all(|x| x.finite());
        let ended = if known { ended } else { Ended::NotFinite };
        if ended == Ended::NotFinite {
            *search = self.search;
        } else {
            for (at, was) in memory.active.iter_mut().enumerate() {
                *was = contact::is_active(counts, lower, memory.u, at);
            }
        }
        let (omega, verdict) = (search.omega, verdict.as_parts());
        let sweeps = self.sweeps;
        let found = Report { ended, sweeps, residual, active, changes, force, verdict, omega };
        *report = Some(found);
        Ok(found)
    }
}

pub(super) fn judge<R: Real>(verdict: &Verdict<R>, limits: &Limits<R>) -> Option<Ended> {
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

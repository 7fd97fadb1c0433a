//! A tick that is a step in time, and what the bound of the evolution takes from it.
//!
//! Cells hand on most of what they lack of balance, or keep it: the lesser total counts. τ stays that of cells which keep it: where
//! the tick has converged these are the fluxes of the step itself, which outputs are about.

use super::{Data, Memory, Tick};
use signorini_bound::certificate::{
    Buffers, Certificate, Kept, Motion, Residual, Step, StepTerms, Verdict, certify_step,
};
use signorini_bound::equilibrium::Iterate;
use signorini_kernel::law::Law;
use signorini_kernel::{Error, Index, Real};

/// A step (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct InStep<'a, R> {
    /// What cells store, and where the step begins.
    pub step: Step<'a, R>,
    /// What K_ii has beyond the element matrices, one per unknown: masses, and ∫h of a transfer law.
    pub diagonal: &'a [R],
}

/// A verdict, and what is left of the step's equation.
type Judged<R> = (Verdict<R>, Residual<R>);

/// Less where there is a bound, and a smaller one.
fn total<R: Real>(of: &Judged<R>) -> R {
    of.0.certificate().map_or(R::INFINITY, |of| of.total)
}

/// What is handed on stays in τ however long sweeps go on: they remove what fluxes lack without it.
fn with_algebraic<R: Real>((verdict, residual): Judged<R>, kept: &Judged<R>) -> Judged<R> {
    let verdict = match (verdict, kept.0.certificate()) {
        (Verdict::Certified(of), Some(kept)) => {
            let algebraic = kept.algebraic.or_smaller(of.total);
            Verdict::Certified(Certificate { algebraic, ..of })
        }
        (verdict, _) => verdict,
    };
    (verdict, residual)
}

impl<R: Real, I, const WIDTH: usize> Memory<'_, R, I, WIDTH> {
    /// The iterate, and the memory of its certificate.
    #[inline(always)]
    pub(super) fn certified<'m>(&'m mut self, law: Law<'m, R>) -> (Iterate<'m, R>, Buffers<'m, R>) {
        let Self { vertices, bubbles, tau, u, .. } = self;
        (Iterate { u, law }, Buffers { vertices, bubbles, tau, indicators: &mut [] })
    }
}

impl<R: Real, I: Index, const WIDTH: usize> Tick<'_, R, I, WIDTH> {
    /// The lesser bound of the present iterate.
    pub(super) fn of_step(&mut self, data: &Data<R, I>) -> Result<Judged<R>, Error> {
        self.lesser(data, |_, _| Ok(()))
    }

    /// The terms of the present iterate in the bound of the evolution, for each way to balance the cells; nothing for one without a
    /// bound. `openings` are those that the step began with, over `length`.
    pub(crate) fn terms(
        &mut self,
        data: &Data<R, I>,
        (openings, length): (&[[R; 2]], R),
    ) -> Result<[Option<StepTerms<R>>; 2], Error> {
        let (mut terms, mut at) = ([None; 2], 0);
        self.lesser(data, |tick, (verdict, residual)| {
            let place = terms.get_mut(at);
            at += 1;
            let (Some(certificate), Some(step), Some(place)) =
                (verdict.certificate(), data.step.get(), place)
            else {
                return Ok(());
            };
            let motion = tick.motion([step.step.vertices, step.step.bubbles]);
            let distance = motion.distances(&tick.discretization, &data.given)?;
            let contact = motion.contacts(&tick.discretization, &data.given, data.law, openings)?;
            let left = (residual, data.given.oscillation + certificate.rounding);
            *place = Some(StepTerms::new(length, left, distance, contact));
            Ok(())
        })?;
        Ok(terms)
    }

    /// Fills in the openings at the end of the step.
    pub(crate) fn open(&self, data: &Data<R, I>, openings: &mut [[R; 2]]) -> Result<(), Error> {
        let end = [&*self.memory.vertices, &*self.memory.bubbles];
        self.motion(end).openings(&self.discretization, &data.given, data.law, openings)
    }

    fn motion<'m>(&'m self, begin: [&'m [R]; 2]) -> Motion<'m, R> {
        let end = [&*self.memory.vertices, &*self.memory.bubbles];
        Motion { begin, end, tau: self.memory.tau }
    }

    /// Certifies both ways, lets `take` have each, and leaves s and τ of the second.
    fn lesser(
        &mut self,
        data: &Data<R, I>,
        mut take: impl FnMut(&Self, &Judged<R>) -> Result<(), Error>,
    ) -> Result<Judged<R>, Error> {
        let handed = self.judged(data, Kept::Part)?;
        take(self, &handed)?;
        let kept = self.judged(data, Kept::All)?;
        take(self, &kept)?;
        Ok(if total(&handed) < total(&kept) { with_algebraic(handed, &kept) } else { kept })
    }

    #[inline(never)]
    fn judged(&mut self, data: &Data<R, I>, kept: Kept) -> Result<Judged<R>, Error> {
        let Some(step) = data.step.get() else {
            return Err(Error::Length {
                of: signorini_kernel::error::Array::Storage,
                found: 0,
                expected: 1,
            });
        };
        let (iterate, buffers) = self.memory.certified(data.law);
        let given = (&data.given, &step.step);
        certify_step(&self.discretization, given, iterate, kept, buffers)
    }
}

//! A tick that is a step in time.
//!
//! Cells hand on most of what they lack of balance, or those that store something keep it: the lesser total counts. τ is always that of the
//! way in which they keep it: where the tick has converged these are the fluxes of the step itself, which outputs are about.

use core::cell::Cell;
use core::fmt;

use super::{Data, Memory, Tick};
use signorini_bound::certificate::{
    Buffers, Handed, Judged, Step, Verdict, WAYS, certify_step, openings,
};
use signorini_bound::equilibrium::Iterate;
use signorini_kernel::evolution::StepTerms;
use signorini_kernel::law::Law;
use signorini_kernel::{Error, Index, Real};

/// A step (borrowed).
pub struct InStep<'a, R> {
    /// What cells store, and where the step begins.
    pub step: Step<'a, R>,
    /// What K_ii has beyond the element matrices, one per unknown: masses, and ∫h of a transfer law.
    pub diagonal: &'a [R],
    /// Memory of τ where cells hand on what they lack, one entry an edge; empty where none may.
    pub handed: Cell<&'a mut [R]>,
    /// The terms of the last certified iterate in the bound of the evolution, for each way to balance the cells.
    pub terms: Cell<[Option<StepTerms<R>>; WAYS]>,
}

impl<R: fmt::Debug> fmt::Debug for InStep<'_, R> {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.debug_struct("InStep").field("step", &self.step).finish_non_exhaustive()
    }
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
    #[inline(never)]
    pub(super) fn of_step(
        &mut self,
        data: &Data<R, I>,
        of: &InStep<R>,
    ) -> Result<Verdict<R>, Error> {
        let (iterate, buffers) = self.memory.certified(data.law);
        let tau = of.handed.take();
        let handed = Handed { tau: &mut *tau, indicators: &mut [] };
        let given = (&data.given, &of.step);
        let judged = certify_step(&self.discretization, given, iterate, (buffers, handed));
        of.handed.set(tau);
        let judged = judged?;
        of.terms.set(judged.map(|way| way.terms));
        let total = |way: &Judged<R>| way.verdict.certificate().map_or(R::INFINITY, |of| of.total);
        let [kept, handed] = judged;
        Ok(if total(&handed) < total(&kept) { handed.verdict } else { kept.verdict })
    }

    /// Fills in the openings at the end of the step.
    pub(crate) fn open(&self, data: &Data<R, I>, of_edges: &mut [[R; 2]]) -> Result<(), Error> {
        let end = [&*self.memory.vertices, &*self.memory.bubbles];
        openings(&self.discretization, &data.given, data.law, end, of_edges)
    }
}

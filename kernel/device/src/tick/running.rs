//! A tick in progress, and what it says in the end.

use super::{Data, Deadline, Ended, Tick, contact_state};
use signorini_bound::certificate::Verdict;
use signorini_kernel::relaxation::Search;
use signorini_kernel::{Error, Index, Math, Real, contact, psor, report};

/// An answer's report with the figures of its sweeps, which are counted since the tick began.
pub type Report<R> = report::Report<R, Figures<R>>;

/// What sweeps on a mesh leave to say.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Figures<R> {
    /// max |r_i|/K_ii over the unknowns, on contact edges |min(u_i − ψ_i, −r_i/K_ii)|.
    pub residual: R,
    /// Contact edges that became active or ceased to be since the report before.
    pub changes: u32,
    /// ∫_C (τ·n − q) ≥ 0, τ within the law of contact at any stop ([`signorini_kernel::contact`]).
    pub force: R,
    /// The relaxation factor.
    pub omega: R,
}

/// Sweeps before the first certificate of a tick, and at least between two.
pub(super) const FEWEST: u32 = 4;

/// A tick with its data: [`Running::advance`] it as often as there is time.
#[derive(Debug)]
pub struct Running<'t, 'd, 'a, R: Real, I, const WIDTH: usize> {
    pub(super) tick: &'t mut Tick<'a, R, I, WIDTH>,
    pub(super) data: Data<'d, R, I>,
    /// That of the data in the unit of u.
    pub(super) size: R,
    /// ω as it was: what overflows teaches nothing.
    search: Search<R>,
    pub(super) sweeps: u32,
    /// Sweeps at the last measurement of the defect.
    measured: u32,
    pub(super) next_certificate: u32,
    /// Sweeps and algebraic part at the last certificate.
    pub(super) earlier: Option<(u32, R)>,
    /// The verdict on the present iterate, where it is known.
    pub(super) verdict: Option<Verdict<R>>,
}

impl<'t, 'd, 'a, R: Real, I: Index, const WIDTH: usize> Running<'t, 'd, 'a, R, I, WIDTH> {
    pub(super) fn new(tick: &'t mut Tick<'a, R, I, WIDTH>, data: Data<'d, R, I>, size: R) -> Self {
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

    /// What stops sweeps, however good they are: their number has come to `last`, or there is no time for another.
    pub(super) fn cut<F: FnMut() -> u32>(
        &self,
        last: u32,
        deadline: &mut Deadline<F>,
    ) -> Option<Ended> {
        if self.sweeps >= last {
            Some(Ended::OutOfSweeps)
        } else if deadline.allows_a_sweep() {
            None
        } else {
            Some(Ended::OutOfTime)
        }
    }

    /// A sweep, and a look at ω where it is time for one.
    pub(super) fn sweep<M: Math<R>>(&mut self) -> Result<(), Error> {
        let memory = &mut self.tick.memory;
        psor::sweep(&memory.rows, self.data.law, memory.u)?;
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
        // Another ω asks for other rows.
        match self.tick.search.omega == before {
            true => Ok(()),
            false => self.tick.lay_out_rows(&self.data),
        }
    }

    pub(super) fn measure(&mut self) -> Result<(psor::Defect<R>, u32), Error> {
        let (memory, law) = (&self.tick.memory, self.data.law);
        let defect = psor::defect(&memory.rows, law, memory.u)?;
        let counts = self.tick.discretization.edges.counts();
        let (active, _) = contact_state(counts, law, memory.u, memory.active);
        Ok((defect, active))
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

    pub(super) fn report(&mut self, ended: Ended, verdict: Verdict<R>) -> Result<Report<R>, Error> {
        let residual = self.measure()?.0.largest;
        let counts = self.tick.discretization.edges.counts();
        let Tick { memory, search, report, .. } = &mut *self.tick;
        let law = self.data.law;
        let (active, changes) = contact_state(counts, law, memory.u, memory.active);
        let force = contact::force(counts, &self.data.given.boundary, law, memory.u, memory.tau);
        // u may be finite where its fluxes are not, and the law of contact may hide one.
        let fluxes = memory.tau.iter().skip(counts.free).take(counts.contact);
        let known = residual.finite() && force.finite() && fluxes.into_iter().all(|x| x.finite());
        let ended = if known { ended } else { Ended::NotFinite };
        if ended == Ended::NotFinite {
            *search = self.search;
        } else {
            for (at, was) in memory.active.iter_mut().enumerate() {
                *was = contact::is_active(counts, law, memory.u, at);
            }
        }
        let (omega, verdict) = (search.omega, verdict.as_parts());
        let sweeps = self.sweeps;
        let figures = Figures { residual, changes, force, omega };
        let found = Report { ended, exchanges: 0, sweeps, active, verdict, figures };
        *report = Some(found);
        Ok(found)
    }
}

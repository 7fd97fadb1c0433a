//! A condensed model that steps in time.
//!
//! The inputs of its model go on with what the last tick has left: p⁻ without the constant, x⁻, and r states y⁻, in which the cells
//! remember what inputs and openings do not tell. After the tick the states follow by
//! ```text
//!   y = ω∘y⁻ − C_x (x − x⁻) − C_p (p − p⁻)        load += C_xᵀ y⁻
//! ```
//! so that rows of C_x are the columns that states have in the load. With a bound d⁻ is handed on too, by which s was corrected at contact
//! vertices: it has columns in the form of the bound alone. That form is the one of [`crate::certificate`], whose inputs are all terms: all that
//! has been handed on is exact by definition, and the bound is that of the step which begins there.
//!
//! ```text
//!   begin ─► terms: p │ p⁻ x⁻ y⁻ d⁻ B ─► Condensed::tick ─► x ─► outputs ─► advance ─┐
//!                          ▲             a refused tick leaves them, bit for bit    │
//!                          └────────────────────────────────────────────────────────┘
//! ```

pub mod evolution;
mod storage;

pub use storage::{ArrayStepStorage, StepMemory, StepStorage};

use super::Condensed;
use super::method::Method;
use super::outputs::dot;
use crate::dense::blocks::padded;
use crate::dense::sizes;
use evolution::{Evolution, Past};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::evolution::Carried;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Report;

/// A condensed model with what its ticks hand on (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Stepped<'a, R> {
    /// The model of one step: its inputs are those of the scene, then p⁻, x⁻ and y⁻, and in its certificate d⁻.
    pub model: Condensed<'a, R>,
    /// ω, one for each state.
    pub fading: &'a [R],
    /// C_p, state after state: a number for each input without the constant.
    pub of_inputs: &'a [R],
    /// p⁻, x⁻ and y⁻, with a certificate d⁻, and with a bound of the evolution what that carries, at the start.
    pub begin: &'a [R],
    /// The largest sum of sizes in a row of C_x, and in one of C_p.
    pub reach: [R; 2],
    /// The bound of the evolution; absent where there is none, or nobody asks for it.
    pub evolution: Option<Evolution<'a, R>>,
}

impl<R: Real> Stepped<'_, R> {
    /// Answers for the inputs p, p_0 = 1 among them. [`Stepped::advance`] takes the answer over.
    ///
    /// # Errors
    /// As for [`Condensed::tick`]; a state that might overflow.
    #[inline(always)]
    pub fn tick<M: Method<R>, F: FnMut() -> u32>(
        &self,
        inputs: &[R],
        method: &mut M,
        deadline: &mut Deadline<F>,
        memory: &mut StepMemory<R>,
    ) -> Result<Report<R>, Error> {
        let StepMemory { shared, terms } = memory;
        same_length(Array::Load, terms.len(), inputs.len() + self.begin.len())?;
        terms.iter_mut().zip(inputs).for_each(|(term, &input)| *term = input);
        self.model.prepare(self.seen(terms), shared)?;
        self.check_states(self.judged(terms), shared.load)?;
        self.model.solve(self.judged(terms), method, deadline, shared)
    }

    /// `Ok` where no state can overflow in this step.
    fn check_states(&self, terms: &[R], load: &[R]) -> Result<(), Error> {
        let size = terms.iter().fold(R::ZERO, |most, term| most.or_larger(term.magnitude()));
        let openings = if load.is_empty() { R::ZERO } else { sizes::room(sizes::of_load(load)?) };
        let [of_contact, of_inputs] = self.reach;
        let most = size + of_contact * (openings + size) + of_inputs * (size + size);
        if most.finite() { Ok(()) } else { Err(Error::NotFinite { of: Array::Load, at: 0 }) }
    }

    /// The next tick begins where the one with this report has ended.
    pub fn advance(&self, memory: &mut StepMemory<R>, report: &Report<R>) {
        let contact = self.contact_terms(memory);
        let StepMemory { shared, terms } = memory;
        let Some([p, past, carried]) = self.parts(terms) else { return };
        let x = &*shared.iterate.x;
        let found = shared.combination.len().saturating_sub(self.corrections());
        let found = shared.combination.get(found..).unwrap_or_default();
        let Some([given, openings, _, corrections]) = self.split(p.len(), past) else { return };
        // What changes stands in the place of what was, until bound and states have followed it.
        for (was, now) in [(given, &*p), (openings, x), (corrections, found)] {
            was.iter_mut().zip(now).for_each(|(was, &now)| *was = now - *was);
        }
        if let (Some(of), [bound, before]) = (&self.evolution, carried) {
            let last = Carried { bound: *bound, before: *before };
            let judged = (&self.model, report.certificate());
            let next = of.advance(last, judged, contact, past, shared.sum);
            (*bound, *before) = (next.bound, next.before);
        }
        let Some([given, openings, states, corrections]) = self.split(p.len(), past) else {
            return;
        };
        let rows = self.of_inputs.chunks_exact(given.len().max(1));
        let rows = rows.map(Some).chain(core::iter::repeat(None));
        for (((y, &fading), column), row) in
            states.iter_mut().zip(self.fading).zip(self.of_contact()).zip(rows)
        {
            *y = fading * *y - dot(column, openings) - row.map_or(R::ZERO, |row| dot(row, given));
        }
        for (was, now) in [(given, &*p), (openings, x), (corrections, found)] {
            was.iter_mut().zip(now).for_each(|(was, &now)| *was = now);
        }
    }

    /// 2ct of the last tick's τ, at the beginning of its step and at the end; nothing where s is on a side that there is not, and
    /// where nobody asks.
    fn contact_terms(&self, memory: &StepMemory<R>) -> [Option<R>; 2] {
        let (Some(of), Some(form)) = (&self.evolution, &self.model.certificate) else {
            return [None; 2];
        };
        let StepMemory { shared, terms } = memory;
        let answer = &self.model.candidate(self.judged(terms), shared);
        let uncertainty = form.uncertainty(answer);
        let end = form.contact(answer, shared.combination, uncertainty);
        let end = end.ok().flatten().map(|[term, _]| term);
        let judged = (answer, uncertainty);
        let begin = self.begun(terms).and_then(|past| of.contact_before(form, judged, &past));
        [begin, end]
    }

    /// How many corrections there are: one for each contact vertex of the certificate.
    fn corrections(&self) -> usize {
        self.model.certificate.as_ref().map_or(0, |form| form.vertices.len())
    }

    /// How many numbers the bound of the evolution carries: B, and the part of its weights before the start.
    fn carried(&self) -> usize {
        if self.evolution.is_some() { 2 } else { 0 }
    }

    /// The terms that loads and outputs have: all but the corrections, and what the bound of the evolution carries.
    pub fn seen<'t>(&self, terms: &'t [R]) -> &'t [R] {
        let beyond = self.corrections() + self.carried();
        terms.get(..terms.len().saturating_sub(beyond)).unwrap_or_default()
    }

    /// The terms that the certificate has.
    fn judged<'t>(&self, terms: &'t [R]) -> &'t [R] {
        terms.get(..terms.len().saturating_sub(self.carried())).unwrap_or_default()
    }

    /// The bound of the evolution after the tick with these terms, or at the start; nothing where it is infinite.
    pub fn window(&self, terms: Option<&[R]>) -> Option<[R; 2]> {
        let (of, terms) = (self.evolution.as_ref()?, terms.unwrap_or(self.begin));
        let (_, carried) = terms.split_at_checked(terms.len().checked_sub(self.carried())?)?;
        let &[bound, before] = carried else { return None };
        let energy = of.rates.energy(Carried { bound, before }) * self.model.unit();
        energy.finite().then_some([energy.or_larger(R::TINY), of.rates.seconds])
    }

    /// p without the constant, all that the last tick has left, and what is carried; nothing where there are too few terms.
    fn parts<'t>(&self, terms: &'t mut [R]) -> Option<[&'t mut [R]; 3]> {
        let inputs = terms.len().checked_sub(self.begin.len())?;
        let (p, past) = terms.split_at_mut_checked(inputs)?;
        let (past, carried) = past.split_at_mut_checked(past.len().checked_sub(self.carried())?)?;
        Some([p.get_mut(1..)?, past, carried])
    }

    /// p⁻, x⁻, y⁻ and d⁻.
    fn split<'t>(&self, inputs: usize, past: &'t mut [R]) -> Option<[&'t mut [R]; 4]> {
        let (given, past) = past.split_at_mut_checked(inputs)?;
        let (openings, past) = past.split_at_mut_checked(self.model.contact)?;
        let (states, corrections) = past.split_at_mut_checked(self.fading.len())?;
        Some([given, openings, states, corrections])
    }

    /// What a step with these terms begins from.
    fn begun<'t>(&self, terms: &'t [R]) -> Option<Past<'t, R>> {
        let inputs = terms.len().checked_sub(self.begin.len())?;
        let past = self.judged(terms).get(inputs..)?;
        let (given, past) = past.split_at_checked(inputs.checked_sub(1)?)?;
        let (openings, past) = past.split_at_checked(self.model.contact)?;
        let (_, corrections) = past.split_at_checked(self.fading.len())?;
        Some(Past { inputs: given, openings, corrections })
    }

    /// C_x by rows; without contact they are empty.
    fn of_contact(&self) -> impl Iterator<Item = &[R]> {
        let (length, count) = (padded(self.model.contact), self.fading.len());
        let first = self.model.load.len().saturating_sub(count * length);
        let rows = self.model.load.get(first..).unwrap_or_default();
        (0..count).map(move |at| rows.get(at * length..(at + 1) * length).unwrap_or_default())
    }
}

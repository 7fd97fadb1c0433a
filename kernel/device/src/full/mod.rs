//! The full model of a baked scene: its mesh solved on the target, tick after tick, by its inputs.
//!
//! ```text
//!   inputs p ─► patterns: loads, gaps, boundary data, h of p ─► tick ─► functionals: outputs
//! ```
//! Everything that the host can compute beforehand is a `static` ([`Full`]): numbering, element matrices,
//! packed cells in the order of the walk, the patterns of the inputs, the weights of the outputs. Nothing of it
//! is checked on the target; the host has checked it, and wrong numbers make wrong answers and nothing worse.
//! What changes lives in memory of the caller ([`Memory`], owned by a [`Storage`]), of exactly the size that the scene
//! needs ([`Lengths`]): data that no input changes are read from the statics, and their memory is empty.

pub mod controller;
mod curved;
mod data;
mod functional;
mod lengths;
mod pattern;
mod ranges;
mod state;
mod storage;
mod storing;
mod transfer;
mod units;

pub use curved::{CurvedPart, CurvedSum, Product};
pub use data::{Along, Base};
pub use functional::Functional;
pub use lengths::{Lengths, Numbers};
pub use pattern::{
    AmbientShare, Contribution, DataMemory, EdgeTrace, Pattern, Points, TransferPattern,
};
pub use storage::{ArrayStorage, Storage};
pub use storing::{Begin, HandedOn, Past, Storing};
pub use units::Units;

pub use crate::state::{State, checksum};

use crate::tick::{self, Data, Deadline, Ended, IfStoring, Limits, Method, Progress, Report, Tick};
use functional::TickState;
use signorini_bound::certificate::{Discretization, Verdict};
use signorini_bound::conforming::VertexData;
use signorini_kernel::error::{Array, Error, all_finite, same_length};
use signorini_kernel::index::{Index, read};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::{Real, features};
use storing::copy;

/// A baked scene (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Full<'a, R, I> {
    /// Mesh, A and ways out.
    pub discretization: Discretization<'a, R, I>,
    /// Loads and boundary data where all inputs are 0.
    pub base: Base<'a, R, I>,
    /// What each input adds for each unit of its value.
    pub patterns: &'a [Pattern<'a, R, I>],
    /// What f, g and q leave out: of the base, then of each input.
    pub oscillation: &'a [R],
    /// What each output is.
    pub outputs: &'a [Functional<'a, R, I>],
    /// Whether the data allow for a bound: u_D is continuous, and no transfer coefficient vanishes along a part of an edge.
    pub has_bound: bool,
    /// Where C meets D: the places of ψ and u_D there, counted over the ends of all edges of their blocks.
    pub corners: &'a [[I; 2]],
    /// Where u starts off the contact and Dirichlet edges.
    pub start: R,
    /// How ω is chosen.
    pub relaxation: Relaxation<R>,
    /// Where ticks are steps in time.
    pub storing: IfStoring<'a, Storing<'a, R>>,
}

/// Memory of a baked scene (borrowed).
#[derive(Debug)]
pub struct Memory<'a, R, I, const WIDTH: usize> {
    /// That of the tick.
    pub tick: tick::Memory<'a, R, I, WIDTH>,
    /// Loads and boundary data that inputs change.
    pub data: DataMemory<'a, R, I>,
    /// Where a step in time begins.
    pub past: Past<'a, R>,
    /// What else of the last step there is.
    pub handed_on: HandedOn<'a, R>,
    /// What the last tick left.
    pub progress: &'a mut Progress<R>,
}

impl<R: Real, I: Index> Full<'_, R, I> {
    /// Answers for these inputs, one value a pattern, by `method`: fills in `outputs` and says how wrong they can be.
    ///
    /// Where there is no bound an output that is the bound is infinite, and the report's verdict says why:
    /// [`Verdict::NotAsked`] for methods without one, [`Verdict::Unavailable`] for data that never allow for one,
    /// [`Verdict::BelowGap`] where u_D lies below ψ where they meet. A method without one does not use
    /// the memory of s, and of the discretization only edges and element matrices; the rest of either may be empty.
    /// Limits, outputs and report are in the scene's units: what 1 stands for in the model, or nothing where that is 1.
    ///
    /// # Errors
    /// Inputs that are not finite, or so large that data or answers may overflow ([`Tick::begin`]), or that leave a contact
    /// edge no flux; arrays of the wrong length, a factor of another mesh. The last answer stays then, bit for bit, and
    /// `outputs` are as they were.
    // Inlined, as all on the way to it from a module's tick: whatever the compiler decides by itself depends on how many checks come
    // before, and what stays apart loses its knowledge of the statics.
    #[inline(always)]
    pub fn tick<M: Method<R, I>, const WIDTH: usize, F: FnMut() -> u32>(
        &self,
        inputs: &[R],
        mut method: M,
        (units, limits): (Option<Units<R>>, Limits<R>),
        deadline: &mut Deadline<F>,
        memory: Memory<R, I, WIDTH>,
        outputs: &mut [R],
    ) -> Result<Report<R>, Error> {
        if !memory.progress.has_begun() {
            method.restart()?;
        }
        same_length(Array::Inputs, inputs.len(), self.patterns.len())?;
        same_length(Array::Outputs, outputs.len(), self.outputs.len())?;
        all_finite(Array::Inputs, inputs)?;
        let Memory { tick: of_tick, data: mut of_data, mut past, mut handed_on, progress } = memory;
        let moved = of_data.evaluate(&self.base, self.patterns, inputs)?;
        let oscillation = self.oscillation(inputs, moved);
        let (edges, forms) = (&self.discretization.edges, self.base.transfer.forms(inputs));
        let forms = if features::PIECES { forms.as_slice() } else { &[] };
        if let Some(storing) = self.storing.get() {
            if !progress.has_begun() {
                past.begin(&storing.begin);
                handed_on.begin(&storing.begin);
            }
            past.weigh(storing, of_data.robin);
        }
        let step = self.storing.get().map(|storing| past.step(storing, handed_on.openings));
        let given = of_data.view(&self.base, edges, forms, oscillation)?;
        let data = Data { step: step.as_ref().map_or(IfStoring::NOTHING, IfStoring::of), ..given };
        let known = match progress.has_begun() {
            true => *progress,
            false => Progress::new(self.relaxation)?,
        };
        let mut tick = Tick::resume(self.discretization, of_tick, known)?;
        let size = tick.admit(&data)?;
        if !progress.has_begun() || self.is_cold() {
            self.start(&data, tick.memory());
        }
        let refused = self.refused(&data.given.ends);
        let limits = units.map_or(limits, |units| units.limits(limits));
        // Where there is no bound nothing is small enough.
        let error = if refused.is_some() { R::ZERO } else { limits.error };
        let limits = Limits { error, ..limits };
        // All of it in one function: in parts it lost the compiler's knowledge of the statics, and cost 3 % more.
        let report = tick.enter(data, size).advance(method, limits, deadline)?;
        *progress = tick.progress();
        let verdict = match (report.verdict, refused) {
            (verdict @ Verdict::NotAsked, _) | (verdict, None) => verdict,
            (_, Some(refused)) => refused,
        };
        let report = Report { verdict, ..report };
        let answer = TickState { tick: &tick, data: &given, report: &report };
        for (output, functional) in outputs.iter_mut().zip(self.outputs) {
            *output = functional.of(&answer);
        }
        let has_bound = report.verdict.certificate().is_some();
        let report = units.map_or(report, |units| units.answer(self.outputs, outputs, report));
        // Without a bound its output is infinite, and nothing else is.
        let mut values = outputs.iter().zip(self.outputs);
        let is_known = values.all(|(value, of)| value.finite() || *of == Functional::Bound);
        let report = if is_known { report } else { Report { ended: Ended::NotFinite, ..report } };
        if let Some(storing) = self.storing.get() {
            if report.ended == Ended::NotFinite {
                // Nothing has advanced.
                copy(past.u, tick.memory().u);
                return Ok(report);
            }
            if M::CERTIFIES {
                let terms = step.as_ref().filter(|_| has_bound).map(|step| step.terms.get());
                handed_on.advance(storing, &terms.unwrap_or_default(), &tick, &given)?;
            }
            past.advance(tick.memory());
        }
        Ok(report)
    }

    /// Why the data allow for no bound.
    fn refused(&self, ends: &VertexData<R>) -> Option<Verdict<R>> {
        match self.has_bound {
            false => Some(Verdict::Unavailable),
            true if !self.meet(ends) => Some(Verdict::BelowGap),
            true => None,
        }
    }

    /// Whether u_D ≥ ψ where C meets D, up to rounding.
    fn meet(&self, ends: &VertexData<R>) -> bool {
        if !features::CONTACT || self.corners.is_empty() {
            return true;
        }
        let (gap, given) = (ends.gap.as_flattened(), ends.given.as_flattened());
        let slack = ends.slack();
        let below = |&[at, place]: &[I; 2]| read(gap, at.at()) - read(given, place.at());
        self.corners.iter().all(|corner| below(corner) <= slack)
    }

    /// osc(p) ≤ osc₀ + Σ|p_j| osc_j, and what it costs that ends of fluxes have `moved`.
    fn oscillation(&self, inputs: &[R], moved: R) -> R {
        let (first, rest) = match self.oscillation.split_first() {
            Some((&first, rest)) => (first, rest),
            None => return R::ZERO,
        };
        let all = rest.iter().zip(inputs);
        let all = all.fold(first, |sum, (&of_one, p)| sum + of_one * p.magnitude());
        let has_moved = features::LIMITED && moved > R::ZERO;
        if has_moved { all + moved * self.base.settling } else { all }
    }

    /// Where sweeps begin: on the gap, and elsewhere at one value; a step that is not cold from the answer before, or from the start.
    fn start<const WIDTH: usize>(&self, data: &Data<R, I>, memory: &mut tick::Memory<R, I, WIDTH>) {
        match data.step.get() {
            Some(step) if !self.is_cold() => copy(step.step.storage.old(), memory.u),
            _ => {
                memory.u.fill(self.start);
                let on_contact = memory.u.iter_mut().skip(self.discretization.edges.counts().free);
                on_contact.zip(data.law.edges()).for_each(|(u, law)| *u = law.gap());
            }
        }
        memory.active.fill(false);
    }

    /// Whether the sweeps of every step begin anew.
    fn is_cold(&self) -> bool {
        self.storing.get().is_some_and(|storing| storing.is_cold)
    }
}

//! A condensed model that steps in time: what cells store is carried by the inputs, the openings and a few states.
//!
//! With D and C held, u is a static shape and what it deviates from that, u = Θp + Ψx + w. So the u that a step begins from is
//! ```text
//!   u_old = Θp⁻ + Ψx⁻ + Φμ^{−½}W y⁻        p⁻, x⁻ those of the last tick, y⁻ its r states
//! ```
//! and one step is the condensed model of K + M whose inputs have p⁻, x⁻ and y⁻ beside them: their loads are M times these shapes.
//! Static shapes are all there, so that a steady state is exact whatever r is, and so is what answers at once. After the tick
//! ```text
//!   y = ω∘y⁻ − C_x (x − x⁻) − C_p (p − p⁻),        C_x the loads of the states: load += C_xᵀ y⁻
//! ```
//! With as many states as modes this is the step of the full model.

mod bound;
mod choice;
mod evolution;
mod gramian;
mod memory;
mod modes;
mod motion;
mod proof;
mod rows;
mod settled;
mod shapes;

use std::cell::LazyCell;

use super::elimination::{columns, fields};
use super::evaluate::dot;
use super::{CondensedModel, Pieces, Recovery, Settled};
pub(super) use bound::StepShapes;
use choice::Trial;
pub use evolution::EvolutionForms;
use gramian::Subspace;
pub use memory::Memory;
use modes::Deviations;
use motion::Motion;
pub use settled::settled;
use shapes::Shapes;
use signorini_certify::TermData;
use signorini_problem::{Approach, Problem, State};
use signorini_scene::error::Result;
use signorini_solve::decay::decay_rate;
use signorini_solve::step_of;

/// A condensed model with what one of its ticks hands on to the next.
#[derive(Debug, Clone)]
pub struct SteppedModel {
    /// The model of one step. Its inputs are those of the scene, then p⁻ without the constant, x⁻ and y⁻, and with a bound
    /// the corrections d⁻, by default those at the start.
    pub model: CondensedModel,
    /// m, the number of its inputs that are those of the scene with the constant 1.
    pub inputs: usize,
    /// ω of every state: the part of it that is left after a step without changes.
    pub fading: Vec<f64>,
    /// C_p, m − 1 numbers a state.
    pub of_inputs: Vec<Vec<f64>>,
    /// How many states the full model has: its modes.
    pub modes: usize,
    /// How many corrections the bound hands on.
    pub corrections: usize,
    /// Forms of the bound of the evolution; nothing where there is none.
    pub evolution: Option<EvolutionForms>,
    /// Means of u on contact edges by a unit of each input without the constant, x being held: gaps, in the unit of x.
    pub gaps: Vec<Vec<f64>>,
    /// The memory of the full model: all of its modes.
    pub full: Memory,
    /// Contact edges that are no unknowns.
    pub settled: Settled,
}

impl SteppedModel {
    /// C_x, n numbers a state: the columns of loads that are those of the states.
    pub fn of_contact(&self) -> &[Vec<f64>] {
        let first = 2 * self.inputs - 1 + self.model.contact;
        &self.model.load[first..][..self.fading.len()]
    }

    /// The states as the memory that they are.
    pub fn memory(&self) -> Memory {
        let begin = &self.start()[self.inputs - 1 + self.model.contact..][..self.fading.len()];
        Memory::new(&self.fading, [self.of_contact(), &self.of_inputs], begin)
    }

    /// What the last tick has left, at the start: p⁻, x⁻ and y⁻.
    pub fn start(&self) -> &[f64] {
        &self.model.defaults[self.inputs..]
    }

    /// The terms of a step that begins at the start and leaves the inputs there.
    pub(super) fn at_start(&self) -> Vec<f64> {
        let given = &self.start()[..self.inputs - 1];
        [&self.model.defaults[..1], given, self.start()].concat()
    }

    /// `past` after the tick with inputs `p`, the constant 1 first, and the answer `x`.
    pub fn advance(&self, past: &mut [f64], p: &[f64], x: &[f64]) {
        let minus = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>();
        let terms: Vec<f64> = p.iter().chain(&*past).copied().collect();
        let corrections = self.model.corrections(&terms, x);
        let (given, rest) = past.split_at_mut(self.inputs - 1);
        let (openings, rest) = rest.split_at_mut(x.len());
        let (states, of_s) = rest.split_at_mut(self.fading.len());
        of_s.iter_mut().zip(corrections).for_each(|(to, d)| *to = d);
        let (of_p, of_x) = (minus(&p[1..], given), minus(x, openings));
        let rows = self.fading.iter().zip(self.of_contact()).zip(&self.of_inputs);
        for (y, ((fading, of_contact), of_inputs)) in states.iter_mut().zip(rows) {
            *y = fading * *y - dot(of_contact, &of_x) - dot(of_inputs, &of_p);
        }
        given.copy_from_slice(&p[1..]);
        openings.copy_from_slice(x);
    }
}

/// Condenses the steps of `problem`, the steady one, with at most `memory` states, or as many as its bound needs.
///
/// # Errors
/// What [`Approach::Stepped`] cannot treat; a scene that does not say how long a step is; no steady state, where the start is one.
pub fn stepped(problem: &Problem, memory: Option<usize>) -> Result<(SteppedModel, Recovery)> {
    with_settled(problem, memory, Settled::default())
}

/// The same without these edges among the unknowns.
fn with_settled(
    problem: &Problem,
    memory: Option<usize>,
    settled: Settled,
) -> Result<(SteppedModel, Recovery)> {
    Approach::Stepped.check(problem)?;
    let length = step_of(&problem.scene)?;
    let statics = Pieces::with(problem, settled)?;
    let shapes = Shapes::new(&statics)?;
    let in_step = &problem.stepping(length, State::zero(problem))?;
    let mut pieces = statics.in_step(in_step, length, &shapes.inputs[0])?;
    let openings = pieces.openings(in_step)?;
    let start = shapes.start(problem, length, &openings)?;
    let deviations = Deviations::new(in_step, &statics.settled.open)?;
    let motion = Motion::new(&shapes, &start, &openings, deviations);
    let gramian = LazyCell::new(|| motion.gramian());
    let dominant = |memory: usize| match memory < motion.deviations.count() {
        true => gramian.dominant(memory),
        false => Subspace::all(&motion.deviations),
    };
    let silent = TermData::silent(in_step)?;
    pieces.begin_from(&motion.columns, (&silent, length))?;
    let memory = match memory {
        Some(memory) => memory,
        None => {
            let without = pieces.without_form(&mut pieces.fields(Vec::new())?)?.0;
            let pace = [length, decay_rate(problem)?];
            Trial { model: &without, motion: &motion, pace }.least(dominant)
        }
    };
    let kept = dominant(memory);
    let states = kept.shapes(&motion.deviations, in_step)?;
    pieces.begin_from(&states, (&silent, length))?;
    let (corrections, ends) = bound::corrections(&pieces, &openings);
    pieces.patterns.resize(pieces.patterns.len() + corrections, silent);
    pieces.beyond = [&start.inputs[1..], &start.openings, &kept.inner(&motion.left)].concat();
    pieces.step = Some(motion.remembered(&kept, states, corrections));
    let fields = pieces.fields(Vec::new())?;
    let (model, mut recovery) = pieces.model(fields)?;
    let mut of = motion.model(model, &mut recovery, (kept, corrections));
    of.settled = statics.settled.clone();
    of.gaps = shapes.gaps(in_step, &of.model.opening);
    of.correct_start();
    let stated = problem.scene.time.as_ref().and_then(|time| time.initial.as_ref());
    let begun = (problem, length, stated);
    of.evolution = EvolutionForms::new(&of, (&pieces, &recovery), begun, ends)?;
    Ok((of, recovery))
}

impl SteppedModel {
    /// Corrects s at the start as after a tick.
    fn correct_start(&mut self) {
        let terms = self.at_start();
        let Self { model, inputs, corrections, .. } = self;
        let first = model.inputs - *corrections;
        let x = &model.defaults[2 * *inputs - 1..][..model.contact];
        let found = model.corrections(&terms, x);
        model.defaults.iter_mut().skip(first).zip(found).for_each(|(to, d)| *to = d);
    }

    /// The same model without a bound, and without what that hands on.
    #[must_use]
    pub fn without_bound(&self) -> Self {
        let mut of = Self { corrections: 0, evolution: None, ..self.clone() };
        let inputs = self.model.inputs - self.corrections;
        of.model.keep_inputs(inputs, "certificate = false leaves it out");
        of
    }
}

impl<'p> Pieces<'p> {
    /// Adds inputs: factors of these shapes in what a step of this length begins from.
    fn begin_from(
        &mut self,
        shapes: &[Vec<f64>],
        (silent, length): (&TermData, f64),
    ) -> Result<()> {
        for shape in shapes {
            let begin = State { u: shape.clone(), ..State::zero(self.problem) };
            let problem = silent.problem.stepping(length, begin)?;
            self.patterns.push(TermData { problem, ..silent.clone() });
        }
        Ok(())
    }

    /// These pieces in a step of `problem`, with the shape of the `constant` in what it begins from.
    fn in_step(&self, problem: &'p Problem, length: f64, constant: &[f64]) -> Result<Self> {
        let zero = State::zero(problem);
        let in_step = |(at, pattern): (usize, &TermData)| {
            // The constant's shape is there from the beginning.
            let begin =
                if at == 0 { State { u: constant.to_vec(), ..zero.clone() } } else { zero.clone() };
            Ok(TermData { problem: pattern.problem.stepping(length, begin)?, ..pattern.clone() })
        };
        let patterns = self.patterns.iter().enumerate().map(in_step).collect::<Result<_>>()?;
        Ok(Pieces {
            problem,
            parts: self.parts.clone(),
            patterns,
            spans: self.spans.clone(),
            edges: self.edges.clone(),
            settled: self.settled.clone(),
            held_by_contact: Vec::new(),
            alone: None,
            laws: None,
            beyond: Vec::new(),
            step: None,
        })
    }

    /// d_i for U = 1.
    fn openings(&self, problem: &Problem) -> Result<Vec<f64>> {
        let columns = columns(problem, &[], &self.edges, None);
        let mut fields = fields(problem, &columns, &self.settled.open)?;
        self.scaled(&mut fields)
    }
}

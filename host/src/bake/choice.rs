//! Which model: the smallest that represents the scene exactly and fits the device.
//!
//! ```text
//!   condensed, exact method │ condensed, sweeps alone │ both without the bound │ full
//!   ── each with its needs (bytes from its arrays, instructions from counted parts and a trial) ──►
//!   the first that fits what `[target]` declares
//! ```
//! Without the bound a model comes last of its kind, and only where no output asks for it.

use signorini_kernel::condensed::blocks::padded;

use super::budget::{Budget, Needs, Shortfall};
use super::condensed::{self, Work};
use super::costs::{Costs, Footprint};
use super::full;
use super::trial::{self, Trial};
use crate::condense::{Condensate, condense};
use crate::error::{InputError, Result};
use crate::problem::Problem;
use crate::scalar::Scalar;
use crate::scene::{Quantity, Scene};
use crate::solve::unfit;

/// Sweeps that follow where the exchanges of a tick do not suffice.
const FALLBACK: u32 = 20;
/// Fewest exchanges that a tick is allowed, whatever the estimate of its time.
const FEWEST: u32 = 4;
/// Most sweeps of a model without the exact method.
const MOST_SWEEPS: u32 = 1000;
/// Contact edges beyond which nothing is condensed: the work on this machine grows like n³.
const MOST_CONTACTS: usize = 2000;
/// Instructions an entry of a load or an output: two loads, a multiply-add, half of a loop.
const AN_ENTRY: f64 = 4.0;

/// A model that is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Contact edges, inputs and outputs alone.
    Condensed,
    /// The scene's mesh.
    Full,
}

/// A model, ready to be written.
#[derive(Debug)]
pub enum Model<R: Scalar> {
    /// See [`condensed`].
    Condensed(Box<condensed::Baked<R>>),
    /// See [`full`].
    Full(Box<full::Baked<R>>),
}

/// A model with what it takes.
#[derive(Debug)]
pub struct Candidate<R: Scalar> {
    /// In a few words.
    pub name: String,
    /// The model.
    pub model: Model<R>,
    /// What it takes.
    pub needs: Needs,
    /// What its warm ticks do.
    pub trial: Trial,
    /// What of the device it goes beyond.
    pub shortfalls: Vec<Shortfall>,
    /// An output that it cannot give: it is no choice then, but may be one without that output.
    pub lacks: Option<String>,
}

impl<R: Scalar> Candidate<R> {
    /// Whether the device has room and time for it.
    pub fn fits(&self) -> bool {
        self.shortfalls.is_empty()
    }

    fn may_be_chosen(&self) -> bool {
        self.fits() && self.lacks.is_none()
    }
}

/// All that was considered, and which it is.
#[derive(Debug)]
pub struct Choice<R: Scalar> {
    /// In the order in which they were considered.
    pub candidates: Vec<Candidate<R>>,
    /// Position of the one chosen.
    pub chosen: usize,
    /// What the device has.
    pub budget: Budget,
    /// Why a model was not considered.
    pub excluded: Vec<String>,
}

impl<R: Scalar> Choice<R> {
    /// Chooses for `scene`; with `compared`, the full model is worked out in any case.
    ///
    /// # Errors
    /// No model fits what the scene declares: by how much the smallest one does not. What keeps a model that
    /// was asked for from existing.
    pub fn new(
        scene: &Scene,
        problem: &Problem,
        forced: Option<Kind>,
        compared: bool,
    ) -> Result<Self> {
        let budget = Budget::of(scene);
        let (mut candidates, mut excluded) = (Vec::new(), Vec::new());
        let contact = problem.topology.counts.contact;
        let few = contact <= MOST_CONTACTS;
        if forced == Some(Kind::Condensed) || (forced.is_none() && few) {
            candidates = of_condensed(scene, &condense(scene, problem)?, &budget)?;
        } else if forced.is_none() {
            excluded.push(format!("condensed: {contact} contact edges, at most {MOST_CONTACTS}"));
        }
        let fits = candidates.iter().any(Candidate::may_be_chosen);
        if forced == Some(Kind::Full) || (forced.is_none() && (compared || !fits)) {
            match of_full(scene, problem, &budget) {
                Ok(candidate) => candidates.push(candidate),
                Err(error) if candidates.is_empty() => return Err(error),
                Err(error) => excluded.push(format!("full: {error}")),
            }
        }
        let chosen = candidates.iter().position(Candidate::may_be_chosen);
        match chosen {
            Some(chosen) => Ok(Self { candidates, chosen, budget, excluded }),
            None => Err(too_large(scene, &candidates).into()),
        }
    }

    /// The model chosen.
    pub fn candidate(&self) -> &Candidate<R> {
        &self.candidates[self.chosen]
    }
}

/// The variants of the condensed model: with the bound first, and of two the one that takes less time.
fn of_condensed<R: Scalar>(
    scene: &Scene,
    condensate: &Condensate,
    budget: &Budget,
) -> Result<Vec<Candidate<R>>> {
    let has_bound = condensate.certificate.is_ok();
    let variants = if has_bound { &[true, false][..] } else { &[true] };
    let mut all = Vec::new();
    for &certified in variants {
        let mut pair = Vec::new();
        for exact in [true, false] {
            let mut candidate = condensed_as(scene, condensate, budget, exact, certified)?;
            candidate.lacks = bound_of(scene).filter(|_| !certified);
            pair.push(candidate);
        }
        pair.sort_by(|a, b| time(&a.needs).total_cmp(&time(&b.needs)));
        all.extend(pair);
    }
    Ok(all)
}

/// The name of an output that is the error bound.
fn bound_of(scene: &Scene) -> Option<String> {
    let bound = scene.outputs.iter().find(|output| output.quantity == Quantity::Bound);
    bound.map(|output| output.name.value.clone())
}

fn time(needs: &Needs) -> f64 {
    needs.instructions.unwrap_or(f64::INFINITY)
}

fn condensed_as<R: Scalar>(
    scene: &Scene,
    condensate: &Condensate,
    budget: &Budget,
    exact: bool,
    certified: bool,
) -> Result<Candidate<R>> {
    let costs = Costs::measured();
    let fixed = fixed::<R>(&costs, condensate, exact, certified);
    let work = work::<R>(&costs, condensate.contact, exact, fixed.zip(budget.instructions()));
    let unfit = unfit::<R>(scene);
    let baked = condensed::Baked::<R>::new(condensate, work, certified).map_err(unfit)?;
    let trial = trial::of_condensed(&baked, &condensate.defaults[1..]);
    let step = |stage: &str| costs.of_dense::<R>(stage, condensate.contact);
    let pivots = f64::from(trial.pivots[0]);
    let sweeps = f64::from(trial.sweeps[0]);
    let instructions = fixed.zip(step("exchange")).zip(step("sweep"));
    let instructions =
        instructions.map(|((fixed, pivot), sweep)| fixed + pivots * pivot + sweeps * sweep);
    let sizes = condensed::sizes(&baked);
    let needs = Needs::with_code(", condensed", sizes, instructions);
    let solver = if exact { "exact method" } else { "sweeps alone" };
    let bound = if baked.without_bound().is_none() { "" } else { ", no error bound" };
    Ok(Candidate {
        name: format!("condensed, {solver}{bound}"),
        shortfalls: budget.shortfalls(&needs),
        model: Model::Condensed(Box::new(baked)),
        needs,
        trial,
        lacks: None,
    })
}

/// Instructions of a tick in which no edge changes sides.
fn fixed<R: Scalar>(
    costs: &Costs,
    condensate: &Condensate,
    exact: bool,
    certified: bool,
) -> Option<f64> {
    let Condensate { contact, inputs, outputs, .. } = condensate;
    let (n, m) = (padded(*contact) as f64, *inputs as f64);
    let entries = n * m + outputs.len() as f64 * (n + m);
    let solve = if exact { "exact, no edge changes" } else { "product, half of x zero" };
    let solve = costs.of_dense::<R>(solve, *contact)?;
    let bound = match certified && condensate.certificate.is_ok() {
        true => costs.of_dense::<R>("norm of the bound, half of x zero", *contact)?,
        false => 0.0,
    };
    Some(AN_ENTRY * entries + solve + bound)
}

/// What a tick may do: without a declared time as much as it takes, else what time is left for.
fn work<R: Scalar>(costs: &Costs, contact: usize, exact: bool, time: Option<(f64, f64)>) -> Work {
    let all = 2 * contact as u32;
    let pivots = exact.then_some(all.max(1));
    let unlimited = Work { pivots, sweeps: if exact { FALLBACK } else { MOST_SWEEPS } };
    let steps = costs.of_dense::<R>("exchange", contact).zip(costs.of_dense::<R>("sweep", contact));
    let (Some((fixed, budget)), Some((pivot, sweep))) = (time, steps) else { return unlimited };
    if contact == 0 {
        return unlimited;
    }
    let times = |instructions: f64| (instructions / sweep).floor().clamp(1.0, 1e6) as u32;
    if !exact {
        return Work { pivots: None, sweeps: times(budget - fixed).min(MOST_SWEEPS) };
    }
    let sweeps = times(0.25 * (budget - fixed)).min(FALLBACK);
    let left = budget - fixed - f64::from(sweeps) * sweep;
    let affordable = (left / pivot).floor().clamp(0.0, f64::from(all)) as u32;
    Work { pivots: Some(affordable.max(FEWEST)), sweeps }
}

fn of_full<R: Scalar>(scene: &Scene, problem: &Problem, budget: &Budget) -> Result<Candidate<R>> {
    let baked = full::Baked::<R>::new(scene, problem)?;
    let sizes = full::sizes(&baked);
    let memory = Needs::with_code(", on ", sizes, None);
    let defaults: Vec<f64> = scene.inputs.iter().map(|input| input.default).collect();
    // A model that has no room is not tried.
    let trial = match budget.shortfalls(&memory).is_empty() {
        true => trial::of_full(&baked, &defaults),
        false => Trial::default(),
    };
    let cells = if baked.has_quads() { "quads" } else { "triangles" };
    let instructions = full_tick::<R>(&Costs::measured(), cells, problem, trial.sweeps[0]);
    let needs = Needs { instructions: instructions.filter(|_| trial.sweeps[0] > 0), ..memory };
    Ok(Candidate {
        name: "full".to_owned(),
        model: Model::Full(Box::new(baked)),
        lacks: None,
        shortfalls: budget.shortfalls(&needs),
        needs,
        trial,
    })
}

/// Load and rows, sweeps, a certificate.
fn full_tick<R: Scalar>(costs: &Costs, cells: &str, problem: &Problem, sweeps: u32) -> Option<f64> {
    let of = |stage: &str| costs.of_mesh::<R>(cells, stage);
    let (unknowns, number) = (problem.topology.counts.unknowns() as f64, problem.cells() as f64);
    let rows = of("rows from cells")? + f64::from(sweeps) * of("sweep")?;
    Some(unknowns * rows + number * (of("load")? + of("certificate")?))
}

/// That nothing fits: the candidate that misses by least, and what would fit.
fn too_large<R: Scalar>(scene: &Scene, candidates: &[Candidate<R>]) -> InputError {
    let factor = |candidate: &Candidate<R>| {
        let factors = candidate.shortfalls.iter().map(|short| short.needed / short.declared);
        factors.fold(1.0, f64::max)
    };
    let complete = candidates.iter().filter(|candidate| candidate.lacks.is_none());
    let least = complete.min_by(|a, b| factor(a).total_cmp(&factor(b)));
    let Some(candidate) = least else { return InputError::new("no model").file(&scene.path) };
    let message: Vec<String> = candidate.shortfalls.iter().map(Shortfall::to_string).collect();
    let message =
        format!("{}: the smallest model ({}) does not fit", message.join("; "), candidate.name);
    let without = candidates.iter().find(|candidate| candidate.fits());
    let hint = match without.and_then(|candidate| candidate.lacks.as_ref()) {
        Some(output) => format!(
            "without output.{output} it would fit; or {}",
            nearest(candidate, factor(candidate))
        ),
        None => nearest(candidate, factor(candidate)),
    };
    InputError::new(message).file(&scene.path).hint(hint)
}

/// The nearest mesh that would fit, from how needs grow.
fn nearest<R: Scalar>(candidate: &Candidate<R>, factor: f64) -> String {
    match &candidate.model {
        // Bytes and instructions of dense blocks grow like n².
        Model::Condensed(baked) => {
            let footprint = Footprint::measured(", condensed");
            let growing = |short: &Shortfall| {
                let fixed = match short.key {
                    "target.ram" => footprint.stack,
                    "target.flash" => footprint.code,
                    _ => 0,
                } as f64;
                (short.needed - fixed) / (short.declared - fixed)
            };
            let factors = candidate.shortfalls.iter().map(growing);
            let factor = factors.fold(1.0, |most: f64, factor| match factor > 0.0 {
                true => most.max(factor),
                // The code alone is too large.
                false => f64::INFINITY,
            });
            let fitting = (baked.contact as f64 / factor.sqrt()).floor();
            if fitting < 1.0 {
                return "the code of the model alone is larger than that".to_owned();
            }
            format!(
                "about {fitting} contact edges would fit instead of {}: coarsen the mesh along the contact \
                 boundary {:.1} times, or let a part of it be no contact; the mesh inside costs nothing",
                baked.contact,
                factor.sqrt()
            )
        }
        // Bytes grow like the number of unknowns, instructions like its power 1.5.
        Model::Full(_) => format!(
            "a mesh with about {:.1} times fewer unknowns would fit; the condensed model (--condensed) \
             needs no mesh on the target",
            factor
        ),
    }
}

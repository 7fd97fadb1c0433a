//! The full model, swept and by a factor, each with what it takes.

use super::candidates::time;
use super::{Candidate, Model};
use crate::Bakes;
use crate::budget::{Budget, Needs};
use crate::costs::Costs;
use crate::full;
use crate::trial::{self, Trial};
use signorini_certify::NoBound;
use signorini_problem::Problem;
use signorini_problem::inputs::InputSpace;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::units::Units;
use signorini_solve::{Scaled, Start};

/// The solver that the setting asks for, in `units`; where it leaves that open both, the quicker first: one that comes
/// to its end before one that does not. `excluded` gets the reason why there is no factor.
pub(super) fn of_full<R: Bakes>(
    problem: &Problem,
    units: Units,
    budget: &Budget,
    excluded: &mut Vec<String>,
) -> Result<Vec<Candidate<R>>> {
    let setting = problem.scene.setting.unwrap_or_default();
    // Where a material stores something, the module answers for the first step from the start.
    let start = Start::of(problem, problem.scene.time.as_ref().map_or(0.0, |time| time.step))?;
    let stepping = start.as_ref().map(|start| start.stepping(problem)).transpose()?;
    let problem = &Scaled::new(stepping.as_ref().unwrap_or(problem), units)?;
    let baked = full::Baked::<R>::of_scaled(problem)?;
    let baked = baked.evolving(problem, start.and_then(|start| start.evolution).as_ref())?;
    if let Some(why) = baked.no_bound().filter(|_| stepping.is_some() && baked.is_certified()) {
        let error = InputError::new(format!("there is no error bound: {why}"));
        let hint = "certificate = false in [setting] leaves the bound out";
        return Err(error.file(&problem.own.scene.path).hint(hint).into());
    }
    // Sweeps and shares are for who sweeps.
    let is_open = setting.solver.is_none() && setting.sweeps.is_none() && setting.share.is_none();
    let factored = is_open.then(|| baked.clone().with_factor(problem.problem()));
    let mut all = vec![candidate(problem.own, budget, baked)];
    match factored {
        Some(Ok(factored)) => all.push(candidate(problem.own, budget, factored)),
        Some(Err(error)) => excluded.push(format!("full, by a factor: {error}")),
        None => {}
    }
    let place = |candidate: &Candidate<R>| (!candidate.trial.settled, time(&candidate.needs));
    all.sort_by(|a, b| place(a).0.cmp(&place(b).0).then(place(a).1.total_cmp(&place(b).1)));
    Ok(all)
}

/// A full model, tried where there is room for it.
fn candidate<R: Bakes>(problem: &Problem, budget: &Budget, baked: full::Baked<R>) -> Candidate<R> {
    let sizes = full::sizes(&baked);
    let memory = Needs::with_code(baked.code(), sizes, [None; 2]);
    let spaces = InputSpace::of(&problem.scene);
    // A model that has no room is not tried.
    let trial = match budget.shortfalls(&memory).is_empty() {
        true => trial::of_full(&baked, &spaces),
        false => Trial::default(),
    };
    let tick = TickCost { costs: Costs::measured(), problem, baked: &baked, trial };
    let needs = Needs { ticks: [0, 1].map(|of| tick.count(of)), ..memory };
    let solver = if baked.entries().is_some() { ", by a factor" } else { "" };
    let bound = if baked.is_certified() { "" } else { ", no error bound" };
    Candidate {
        name: format!("full{solver}{bound}"),
        too_long: None,
        staying: None,
        lacks_bound: false,
        // Where the bound is left out, nobody asks for it.
        unbounded: baked.no_bound().filter(|_| baked.is_certified()).map(NoBound::to_string),
        model: Model::Full(Box::new(baked)),
        shortfalls: budget.shortfalls(&needs),
        needs,
        trial,
    }
}

/// Instructions of the certificate of a step in time, over those of a steady one. Each look takes two of them, one for each way to
/// balance cells, and so does the bound of the evolution, with as much for its distances.
const IN_STEP: f64 = 3.2;
const OF_EVOLUTION: f64 = 4.0;

/// Ticks of a trial: the median one has number 0, the longest 1.
struct TickCost<'a, R: Bakes> {
    costs: Costs,
    problem: &'a Problem,
    baked: &'a full::Baked<R>,
    trial: Trial,
}

impl<R: Bakes> TickCost<'_, R> {
    /// Instructions: load and rows, the solve with its looks at residual and bound, and what comes last; nothing where
    /// there was no tick.
    fn count(&self, of: usize) -> Option<f64> {
        let Trial { sweeps, rounds, looks, .. } = self.trial;
        let (sweeps, rounds) = (sweeps[of], rounds[of]);
        if sweeps + rounds == 0 {
            return None;
        }
        let [certificates, measurements] = looks.map(|look| f64::from(look[of]));
        let last = match self.baked.is_certified() {
            true if self.problem.loads.step.is_some() => {
                (2.0 * certificates + OF_EVOLUTION) * IN_STEP * self.of_certificate()?
            }
            true => certificates * self.of_certificate()?,
            false => self.of_cells("flux by edges")?,
        };
        let swept = match sweeps {
            0 => 0.0,
            _ => {
                f64::from(sweeps) * self.of_unknowns("sweep", self.width())?
                    + measurements * self.of_unknowns("residual", self.width())?
            }
        };
        let solve = swept + if rounds > 0 { self.exact(of)? } else { 0.0 };
        let rows = self.of_unknowns("rows from cells", self.quads())?;
        Some(rows + solve + self.of_cells("load")? + last)
    }

    /// Defects and substitutions, exchanges, and products with tableau and S.
    fn exact(&self, of: usize) -> Option<f64> {
        let (pivots, rounds) = (self.trial.pivots[of], self.trial.rounds[of]);
        let entries = self.baked.entries()? as f64;
        let round = self.of_cells("defect")?
            + self.of_unknowns("substitution, columns", self.width())?
            + entries * self.costs.of_mesh::<R>("triangles", "substitution, entries")?;
        let contact = self.problem.topology.counts.contact;
        let dense = |stage: &str| self.costs.of_dense::<R>(stage, contact);
        let first = dense("exact, no edge changes")? + dense("sweep")?;
        let exchanges = f64::from(pivots) * dense("exchange")?;
        Some(f64::from(rounds) * (round + dense("answer")?) + first + exchanges)
    }

    /// A stage on all cells, each kind at its own price.
    fn of_cells(&self, stage: &str) -> Option<f64> {
        let mesh = &self.problem.mesh;
        let kinds = [("triangles", mesh.triangles.len()), ("quads", mesh.quads.len())];
        let cost =
            |(kind, number)| self.costs.of_mesh::<R>(kind, stage).map(|each| each * number as f64);
        kinds.into_iter().filter(|(_, number)| *number > 0).map(cost).sum()
    }

    /// A certificate: cells in which A in reference coordinates varies take 64 points each.
    fn of_certificate(&self) -> Option<f64> {
        let [triangles, quads] = self.baked.varying();
        let varying = [("triangles", triangles), ("quads", quads)].into_iter();
        let more = varying.filter(|(_, number)| *number > 0).map(|(kind, number)| {
            let of = |stage| self.costs.of_mesh::<R>(kind, stage);
            Some((of("certificate, A varies")? - of("certificate")?) * number as f64)
        });
        Some(self.of_cells("certificate")? + more.sum::<Option<f64>>()?)
    }

    /// A stage on all unknowns, of which `quads` is the part that costs what it does on quads.
    fn of_unknowns(&self, stage: &str, quads: f64) -> Option<f64> {
        let [triangle, quad] = ["triangles", "quads"].map(|of| self.costs.of_mesh::<R>(of, stage));
        let each = (1.0 - quads) * triangle? + quads * quad?;
        Some(each * self.problem.topology.counts.unknowns() as f64)
    }

    /// Rows have room for the neighbours in quads as soon as there is one.
    fn width(&self) -> f64 {
        if self.baked.has_quads() { 1.0 } else { 0.0 }
    }

    /// The part of the sides of cells that are a quad's.
    fn quads(&self) -> f64 {
        let mesh = &self.problem.mesh;
        let (triangles, quads) = (3.0 * mesh.triangles.len() as f64, 4.0 * mesh.quads.len() as f64);
        quads / (triangles + quads).max(1.0)
    }
}

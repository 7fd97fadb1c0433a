//! The full model, swept and by a factor, each with what it takes.

use super::candidates::{bound_of, time};
use super::{Candidate, Model};
use crate::bake::budget::{Budget, Needs};
use crate::bake::costs::Costs;
use crate::bake::full;
use crate::bake::trial::{self, Trial};
use crate::error::Result;
use crate::problem::Problem;
use crate::scalar::Scalar;
use crate::scene::Scene;

/// The solver that the setting asks for; where it leaves that open both, the quicker first: one that comes to its end
/// before one that does not. `excluded` gets the reason why there is no factor.
pub(super) fn of_full<R: Scalar>(
    scene: &Scene,
    problem: &Problem,
    budget: &Budget,
    excluded: &mut Vec<String>,
) -> Result<Vec<Candidate<R>>> {
    let setting = scene.setting.unwrap_or_default();
    let baked = full::Baked::<R>::new(scene, problem)?;
    // Sweeps and shares are for who sweeps.
    let is_open = setting.solver.is_none() && setting.sweeps.is_none() && setting.share.is_none();
    let factored = is_open.then(|| baked.clone().with_factor(scene, problem));
    let mut all = vec![candidate(scene, problem, budget, baked)];
    match factored {
        Some(Ok(factored)) => all.push(candidate(scene, problem, budget, factored)),
        Some(Err(error)) => excluded.push(format!("full, by a factor: {error}")),
        None => {}
    }
    let place = |candidate: &Candidate<R>| (!candidate.trial.settled, time(&candidate.needs));
    all.sort_by(|a, b| place(a).0.cmp(&place(b).0).then(place(a).1.total_cmp(&place(b).1)));
    Ok(all)
}

/// A full model, tried where there is room for it.
fn candidate<R: Scalar>(
    scene: &Scene,
    problem: &Problem,
    budget: &Budget,
    baked: full::Baked<R>,
) -> Candidate<R> {
    let sizes = full::sizes(&baked);
    let memory = Needs::with_code(", on ", sizes, None);
    let defaults: Vec<f64> = scene.inputs.iter().map(|input| input.default).collect();
    // A model that has no room is not tried.
    let trial = match budget.shortfalls(&memory).is_empty() {
        true => trial::of_full(&baked, &defaults),
        false => Trial::default(),
    };
    let instructions = Tick { costs: Costs::measured(), problem, baked: &baked, trial }.count();
    let needs = Needs { instructions, ..memory };
    let solver = if baked.entries().is_some() { ", by a factor" } else { "" };
    let bound = if baked.is_certified() { "" } else { ", no error bound" };
    Candidate {
        name: format!("full{solver}{bound}"),
        lacks: None,
        infinite: bound_of(scene).filter(|_| !baked.has_bound()),
        model: Model::Full(Box::new(baked)),
        shortfalls: budget.shortfalls(&needs),
        needs,
        trial,
    }
}

/// The median tick of a trial.
struct Tick<'a, R: Scalar> {
    costs: Costs,
    problem: &'a Problem,
    baked: &'a full::Baked<R>,
    trial: Trial,
}

impl<R: Scalar> Tick<'_, R> {
    /// Instructions: load and rows, the solve, and what comes last; nothing where there was no tick.
    fn count(&self) -> Option<f64> {
        let Trial { sweeps: [sweeps, _], rounds: [rounds, _], .. } = self.trial;
        if sweeps + rounds == 0 {
            return None;
        }
        let last = if self.baked.is_certified() { "certificate" } else { "flux by edges" };
        let solve = self.unknowns() * f64::from(sweeps) * self.of("sweep")?
            + if rounds > 0 { self.exact()? } else { 0.0 };
        let rows = self.unknowns() * self.of("rows from cells")?;
        Some(rows + solve + self.cells() * (self.of("load")? + self.of(last)?))
    }

    /// Defects and substitutions, exchanges, and products with tableau and S.
    fn exact(&self) -> Option<f64> {
        let Trial { pivots: [pivots, _], rounds: [rounds, _], .. } = self.trial;
        let entries = self.baked.entries()? as f64;
        let round = self.cells() * self.of("defect")?
            + self.unknowns() * self.of("substitution, columns")?
            + entries * self.of("substitution, entries")?;
        let contact = self.problem.topology.counts.contact;
        let dense = |stage: &str| self.costs.of_dense::<R>(stage, contact);
        let first = dense("exact, no edge changes")? + dense("sweep")?;
        let exchanges = f64::from(pivots) * dense("exchange")?;
        Some(f64::from(rounds) * (round + dense("answer")?) + first + exchanges)
    }

    fn of(&self, stage: &str) -> Option<f64> {
        let cells = if self.baked.has_quads() { "quads" } else { "triangles" };
        self.costs.of_mesh::<R>(cells, stage)
    }

    fn unknowns(&self) -> f64 {
        self.problem.topology.counts.unknowns() as f64
    }

    fn cells(&self) -> f64 {
        self.problem.cells() as f64
    }
}

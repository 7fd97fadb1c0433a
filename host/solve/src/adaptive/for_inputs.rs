//! One mesh for all inputs of a controller: refined until the error bound is small enough for every input that is tried.
//!
//! ```text
//!   the defaults, all corners of the ranges ─► bounds ─► all ≤ goal? ─► 1000 inputs drawn from the ranges ─► all ≤ goal ─► this mesh
//!                                                │ no                       │ the worst that are not join the first
//!                                                ▼                          ▼
//!                                 a cell's indicator is the largest of all that are above the goal ─► refined
//! ```
//! The bound of every solve is guaranteed. That inputs between those tried have one as small is not: `bake` proves a largest bound
//! over the whole box where it can.

#[cfg(test)]
mod tests;

use std::time::Instant;

use super::marking::History;
use super::{Allowed, MeshOfScene, Promise, Promised, Refining};
use super::{Level, MOST_UNKNOWNS, Stop, indicators, marking};
use crate::{Options, SolverKind};
use signorini_problem::Problem;
use signorini_problem::inputs::{InputSpace, corners, drawn};
use signorini_problem::progress::stage;
use signorini_problem::threads::on_two_threads;
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::mesh::adaptive::{Carried, Hierarchy};
use signorini_scene::mesh::{Mesh, adapted};
use signorini_scene::scene::Scene;

/// The part of the goal down to which the bound is brought: a controller's own bound is up to some per cent above that of the mesh,
/// by rounding, by sweeps that it leaves, and by what a condensed model leaves out.
const MARGIN: f64 = 0.95;
/// Inputs that are tried beside the defaults and the corners of their ranges; so many times as many are drawn, since corners are
/// among them.
const DRAWN: usize = 1000;
const DRAWN_IN_ALL: usize = 4 * DRAWN;
/// Of inputs that are drawn and above the goal, how many join those that every level is solved for.
const JOINING: usize = 4;
/// Inputs that are drawn and tried before the worst of them may end the trial of a mesh.
const BATCH: usize = 50;

/// The mesh of the scene's file as its setting asks for: brought to cells of one kind, and refined so many times, or until its
/// error bound is small enough for the inputs' defaults and ranges, at time 0.
///
/// # Errors
/// A file that is no mesh; a refinement too fine; an error that no mesh reaches, with the inputs and the reason.
pub fn mesh_of_scene(scene: &Scene) -> Result<MeshOfScene> {
    of_adapted(scene, adapted::of_scene(scene)?)
}

/// Mesh for a scene that starts from another mesh than that of the scene's file.
///
/// # Errors
/// As for [`mesh_of_scene`].
pub fn mesh_for_scene(scene: &Scene, mesh: Mesh) -> Result<MeshOfScene> {
    let setting = scene.setting.unwrap_or_default();
    of_adapted(scene, adapted::adapted(mesh, setting.cells, setting.refine)?)
}

fn of_adapted(scene: &Scene, mesh: Mesh) -> Result<MeshOfScene> {
    match scene.setting.and_then(|setting| setting.error) {
        None => Ok(MeshOfScene { mesh, promise: None }),
        Some(goal) => {
            let (refining, most_unknowns) = (Refining::Marked, MOST_UNKNOWNS);
            let promised = Promised { goal, refining, most_unknowns };
            let (mesh, promise) = promised_mesh(scene, mesh, promised)?;
            Ok(MeshOfScene { mesh, promise: Some(promise) })
        }
    }
}

/// Refines `mesh` until the bound meets the goal for all inputs tried; that mesh, and what holds on it.
///
/// # Errors
/// As for [`mesh_of_scene`].
pub fn promised_mesh(scene: &Scene, mesh: Mesh, promised: Promised) -> Result<(Mesh, Promise)> {
    let goal = promised.goal;
    let mut hierarchy = Hierarchy::new(mesh)?;
    let mut trial = Trial::new(scene, promised);
    let mut history = History::default();
    let mut carried = None;
    loop {
        let problem = Problem::new(scene, hierarchy.mesh().clone())?;
        let unknowns = problem.topology.counts.unknowns();
        trial.check_size(unknowns)?;
        let largest = trial.solve(&problem, carried.as_ref())?;
        if largest <= MARGIN {
            let promise = Promise { goal, largest, unknowns, allowed: trial.allowed };
            return Ok((hierarchy.mesh().clone(), promise));
        }
        history.push(unknowns, largest);
        let marked = trial.marked(&history)?;
        carried = Some(hierarchy.refine(&marked).map_err(|why| trial.finest(&why.to_string()))?);
    }
}

/// Inputs on one mesh after another.
struct Trial<'a> {
    scene: &'a Scene,
    promised: Promised,
    options: Options,
    /// Inputs drawn from the ranges, corners apart.
    inputs: Vec<Vec<f64>>,
    /// Inputs that every mesh is solved for: the defaults, the corners, and the worst of the others so far.
    followed: Vec<Followed>,
    /// Bounds of all inputs on the last mesh.
    allowed: Vec<Allowed>,
}

/// Values of the inputs, and the solution with them on the last mesh.
struct Followed {
    values: Vec<f64>,
    level: Option<Level>,
}

impl<'a> Trial<'a> {
    fn new(scene: &'a Scene, promised: Promised) -> Self {
        let spaces = InputSpace::of(scene);
        let defaults = spaces.iter().map(|space| space.default).collect();
        let first: Vec<_> = std::iter::once(defaults).chain(corners(&spaces)).collect();
        let drawn = drawn(&spaces, if spaces.is_empty() { 0 } else { DRAWN_IN_ALL });
        let inputs = drawn.filter(|values| !first.contains(values)).take(DRAWN).collect();
        let followed = first.into_iter().map(|values| Followed { values, level: None }).collect();
        // A controller has the average.
        let options = Options { solver: SolverKind::Factor, averages: true, ..Options::default() };
        Self { scene, promised, options, inputs, followed, allowed: Vec::new() }
    }

    /// Solves for the inputs that are followed, each from its last solution. Where all of them meet the goal, the others are tried,
    /// and the worst that do not are followed from now on. The largest bound over what it is to be.
    fn solve(&mut self, problem: &Problem, carried: Option<&Carried>) -> Result<f64> {
        stage(&format!("{} unknowns", problem.topology.counts.unknowns()));
        let followed = |of: &Followed| {
            let start = |problem: &Problem| match (&of.level, carried) {
                (Some(level), Some(carried)) => level.carried(problem, carried),
                _ => Vec::new(),
            };
            self.level(problem, &of.values, start)
        };
        let levels = on_two_threads(&self.followed, followed, || ())?;
        for (of, level) in self.followed.iter_mut().zip(levels) {
            of.level = Some(level);
        }
        let largest = self.followed.iter().try_fold(0.0, |most, of| self.larger(most, of))?;
        if largest > MARGIN { Ok(largest) } else { self.try_others(problem, largest) }
    }

    /// The largest bound over what it is to be, once inputs are tried that are not followed yet.
    fn try_others(&mut self, problem: &Problem, mut largest: f64) -> Result<f64> {
        let start = self.followed[0].level.as_ref().map_or(&[][..], |level| &level.solution.u);
        let mut above = Vec::new();
        self.allowed = self.followed.iter().filter_map(|of| self.allowed_for(of)).collect();
        for batch in self.inputs.chunks(BATCH) {
            let tried = |values: &Vec<f64>| {
                let level = self.level(problem, values, |_| start.to_vec())?;
                Ok(Followed { values: values.clone(), level: Some(level) })
            };
            for of in on_two_threads(batch, tried, || ())? {
                let ratio = self.larger(0.0, &of)?;
                largest = largest.max(ratio);
                self.allowed.extend(self.allowed_for(&of));
                above.extend((ratio > MARGIN).then_some((ratio, of)));
            }
            if !above.is_empty() {
                break;
            }
        }
        above.sort_by(|a, b| b.0.total_cmp(&a.0));
        self.followed.extend(above.into_iter().take(JOINING).map(|(_, of)| of));
        Ok(largest)
    }

    fn allowed_for(&self, of: &Followed) -> Option<Allowed> {
        // Of nothing but rounding no part is promised.
        let level = of.level.as_ref().filter(|level| !level.is_constant(self.promised.goal))?;
        let bound = self.promised.goal.most(level.energy_norm);
        Some(Allowed { inputs: of.values.clone(), bound })
    }

    fn level(
        &self,
        problem: &Problem,
        values: &[f64],
        start: impl Fn(&Problem) -> Vec<f64>,
    ) -> Result<Level> {
        let clock = Instant::now();
        let problem = problem.with_inputs(values)?;
        let start = start(&problem);
        Level::solved(0, problem, clock, &self.options, &start)
    }

    /// The bound over what it is to be, or `most` where that is more.
    fn larger(&self, most: f64, of: &Followed) -> Result<f64> {
        let Some(level) = &of.level else { return Ok(most) };
        match level.ratio(self.promised.goal) {
            _ if !level.solution.converged() => Err(self.failed(level, &Stop::Unsolved)),
            Some(ratio) => Ok(most.max(ratio)),
            None => Err(self.failed(level, &Stop::NoBound)),
        }
    }

    /// The cells to refine, by the largest indicator of all inputs that are above the goal; all where the bound falls slowly.
    fn marked(&self, history: &History) -> Result<Vec<bool>> {
        let above: Vec<&Level> = self.levels().filter(|level| self.is_above(level)).collect();
        if let (true, Some(worst)) = (history.is_stalled(), self.worst()) {
            return Err(self.failed(worst, &Stop::stalled(worst)?));
        }
        let mut largest = vec![0.0_f64; above.first().map_or(0, |level| level.problem.cells())];
        if history.is_slow() || self.promised.refining == Refining::Everywhere {
            return Ok(vec![true; largest.len()]);
        }
        for level in above {
            let unit = (MARGIN * self.promised.goal.most(level.energy_norm)).powi(2);
            let squares = indicators::squares(&level.problem, &level.solution)?;
            for (most, square) in largest.iter_mut().zip(squares) {
                *most = most.max(square / unit);
            }
        }
        Ok(marking::marked(&largest, 1.0))
    }

    fn levels(&self) -> impl Iterator<Item = &Level> {
        self.followed.iter().filter_map(|of| of.level.as_ref())
    }

    fn is_above(&self, level: &Level) -> bool {
        level.ratio(self.promised.goal).is_some_and(|ratio| ratio > MARGIN)
    }

    fn worst(&self) -> Option<&Level> {
        let ratio = |level: &Level| level.ratio(self.promised.goal).unwrap_or(f64::INFINITY);
        self.levels().max_by(|a, b| ratio(a).total_cmp(&ratio(b)))
    }

    /// Refuses a mesh with too many unknowns.
    fn check_size(&self, unknowns: usize) -> Result<()> {
        let most = self.promised.most_unknowns;
        match self.worst() {
            Some(worst) if unknowns > most => {
                Err(self.failed(worst, &Stop::TooLarge { unknowns, most }))
            }
            _ => Ok(()),
        }
    }

    fn finest(&self, why: &str) -> Error {
        let stop = Stop::Finest(why.to_owned());
        self.worst().map_or_else(|| InputError::new(why).into(), |worst| self.failed(worst, &stop))
    }

    /// That no mesh was found, for the inputs of this level.
    fn failed(&self, level: &Level, stop: &Stop) -> Error {
        let why = stop.why(&level.solution).unwrap_or_default();
        let inputs = level.problem.scene.inputs.iter();
        let with: Vec<String> =
            inputs.map(|input| format!("{} = {}", input.name.value, input.default)).collect();
        let with = if with.is_empty() { String::new() } else { format!(", {}", with.join(", ")) };
        let message = format!("setting.error = {:?}{with}: {why}", self.promised.goal.to_string());
        let hint = "allow a larger error, or declare narrower ranges";
        InputError::new(message).file(self.scene.file()).hint(hint).into()
    }
}

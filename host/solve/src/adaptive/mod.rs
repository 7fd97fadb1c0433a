//! Adaptive meshes: solve, bound, mark, refine, until the guaranteed error bound is small enough.
//!
//! ```text
//!   mesh ─► solve from the start ─► bound ≤ goal? ─► indicators ─► marked cells ─► finer mesh, start carried over ─► …
//! ```
//! The bound decides, not an estimate. Where it falls slowly, all cells are refined in the next round; where it stalls nevertheless,
//! [`Stop::Stalled`] says which of its terms does, and where.

mod dominant;
mod for_inputs;
pub mod indicators;
mod marking;
mod stop;
#[cfg(test)]
mod tests;

pub use dominant::{Dominant, Term};
pub use for_inputs::{mesh_for_scene, mesh_of_scene, promised_mesh};
pub use stop::{Allowed, MeshOfScene, Promise, Promised, Refining, Stop};

use std::time::Instant;

use crate::carried::Old;
use crate::cost::Size;
use crate::energy_norm;
use crate::{Options, Ran, ScalarKind, Solution, SolverKind, solve_from};
use marking::History;
use signorini_problem::Problem;
use signorini_problem::progress::stage;
use signorini_scene::error::Result;
use signorini_scene::goal::Goal;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::adaptive::{Carried, Hierarchy};
use signorini_scene::scene::Scene;

/// Request for a refined mesh.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// Goal of the bound.
    pub goal: Goal,
    /// No refined mesh with more unknowns is solved on.
    pub most_unknowns: usize,
    /// How each level is solved.
    pub options: Options,
}

impl Wanted {
    /// How a level is solved. Sweeps are ahead on small meshes of the easiest scenes alone, and by milliseconds. Here there are
    /// many small meshes with cells of many sizes, for which sweeps are slow: a factor is as good as any there, and often faster.
    fn options_on(&self, problem: &Problem) -> Options {
        let is_double = self.options.scalar == ScalarKind::F64;
        let is_small = Size::of(problem).quickest(is_double) == Ran::Sweeps;
        let solver = match self.options.solver {
            SolverKind::Auto if is_small => SolverKind::Factor,
            asked => asked,
        };
        Options { solver, ..self.options }
    }
}

/// A mesh and the solution on it.
#[derive(Debug)]
pub struct Level {
    /// How many came before it.
    pub number: usize,
    /// The scene on its mesh.
    pub problem: Problem,
    /// With its bound.
    pub solution: Solution,
    /// (‖A^½∇s‖² + ∫_R h (s − u_ext)²)^½; none where there is no bound.
    pub energy_norm: Option<f64>,
    /// From the mesh to the bound and this norm.
    pub seconds: f64,
}

/// Unknowns of a refined mesh at most, unless more are allowed.
pub const MOST_UNKNOWNS: usize = 1_000_000;

/// Solves `scene` on `mesh` and on refinements of it until the goal is reached; `look` sees every level, and ends it by `false`.
/// The last level, with its mesh, and why it is the last.
///
/// # Errors
/// As for [`crate::solve`] on any of the meshes; what `look` fails with.
pub fn refined_until(
    scene: &Scene,
    mesh: Mesh,
    wanted: &Wanted,
    mut look: impl FnMut(&Level) -> Result<bool>,
) -> Result<(Level, Stop)> {
    let mut hierarchy = Hierarchy::new(mesh)?;
    let (mut start, mut number, mut history) = (Vec::new(), 0, History::default());
    let pose = |hierarchy: &Hierarchy| Problem::new(scene, hierarchy.mesh().clone());
    let mut clock = Instant::now();
    let mut problem = pose(&hierarchy)?;
    loop {
        stage(&format!("level {number}, {} unknowns", problem.topology.counts.unknowns()));
        let options = wanted.options_on(&problem);
        let level = Level::solved(number, problem, clock, &options, &start)?;
        let goes_on = look(&level)?;
        let bound = level.solution.bound.map_or(f64::NAN, |bound| bound.total);
        history.push(level.unknowns(), bound);
        if let Some(stop) = level.ended(wanted.goal, goes_on, &history)? {
            return Ok((level, stop));
        }
        stage("marking and refining cells");
        let squares = indicators::squares(&level.problem, &level.solution)?;
        let marked = match history.is_slow() {
            true => vec![true; squares.len()],
            false => marking::marked(&squares, wanted.goal.most(level.energy_norm)),
        };
        let carried = match hierarchy.refine(&marked) {
            Ok(carried) => carried,
            Err(why) => return Ok((level, Stop::Finest(why.to_string()))),
        };
        clock = Instant::now();
        problem = pose(&hierarchy)?;
        let unknowns = problem.topology.counts.unknowns();
        let most = wanted.most_unknowns;
        if unknowns > most {
            return Ok((level, Stop::TooLarge { unknowns, most }));
        }
        start = level.carried(&problem, &carried);
        number += 1;
    }
}

impl Level {
    /// Solves `problem`, in work since `clock` was started, from a start or from nothing.
    fn solved(
        number: usize,
        problem: Problem,
        clock: Instant,
        options: &Options,
        start: &[f64],
    ) -> Result<Self> {
        let solution = solve_from(&problem, options, start)?;
        let energy_norm = energy_norm::of_solution(&problem, &solution)?;
        let seconds = clock.elapsed().as_secs_f64();
        Ok(Self { number, problem, solution, energy_norm, seconds })
    }

    /// u to begin with on every unknown edge of `problem`, whose mesh lies in this one as `carried` says.
    fn carried(&self, problem: &Problem, carried: &Carried) -> Vec<f64> {
        let Self { problem: old, solution, .. } = self;
        let triangles = carried.triangle_sides.len();
        let holder = |cell: usize, side: usize| match cell.checked_sub(triangles) {
            None => carried.triangle_sides[cell][side] as usize,
            Some(quad) => carried.quad_sides[quad][side] as usize,
        };
        let gap = |at: usize| solution.gap(old, at);
        Old { problem: old, u: &solution.u, gap: &gap }.carried(problem, holder)
    }

    /// The bound over what it is to be at most, 0 where that is a part of nothing but rounding; none where there is no bound.
    fn ratio(&self, goal: Goal) -> Option<f64> {
        let bound = self.solution.bound?;
        Some(if self.is_constant(goal) { 0.0 } else { goal.ratio(bound.total, self.energy_norm) })
    }

    /// Whether the goal is a part of an energy norm that is rounding.
    fn is_constant(&self, goal: Goal) -> bool {
        matches!(goal, Goal::Part(_)) && self.solution.is_constant(self.energy_norm)
    }

    /// Unknown edges of its mesh.
    pub fn unknowns(&self) -> usize {
        self.problem.topology.counts.unknowns()
    }

    /// Why no level follows it, apart from meshes.
    fn ended(&self, goal: Goal, goes_on: bool, history: &History) -> Result<Option<Stop>> {
        Ok(match self.ratio(goal) {
            _ if !self.solution.converged() => Some(Stop::Unsolved),
            None => Some(Stop::NoBound),
            Some(_) if self.is_constant(goal) => Some(Stop::Constant),
            Some(..=1.0) => Some(Stop::Reached),
            Some(_) if !goes_on => Some(Stop::Interrupted),
            Some(_) if history.is_stalled() => Some(Stop::stalled(self)?),
            Some(_) => None,
        })
    }
}

//! Adaptive meshes: solve, bound, mark, refine, until the guaranteed error bound is small enough.
//!
//! ```text
//!   mesh ─► solve from the start ─► bound ≤ goal? ─► indicators ─► marked cells ─► finer mesh, start carried over ─► …
//! ```
//! The bound decides, not an estimate. Where it stalls, [`Stop::Stalled`] says which of its terms does, and where.

mod carry;
mod goal;
mod indicators;
mod marking;
mod stall;
#[cfg(test)]
mod tests;

pub use goal::Goal;
pub use stall::{Stall, Term};

use std::time::Instant;

use crate::energy_norm;
use crate::problem::Problem;
use crate::progress::stage;
use crate::solve::{Options, Solution, solve_from};
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::adaptive::Hierarchy;
use signorini_scene::scene::Scene;
use stall::History;

/// What is asked for.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// What the bound is to be below.
    pub goal: Goal,
    /// No refined mesh with more unknowns is solved on.
    pub most_unknowns: usize,
    /// How each level is solved.
    pub options: Options,
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
    /// ‖A^½∇s‖ with the part of transfer laws; none where there is no bound.
    pub energy_norm: Option<f64>,
    /// From the mesh to the bound and this norm.
    pub seconds: f64,
}

/// Why the last level is the last.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// The bound is below the goal.
    Reached,
    /// The next mesh has so many unknowns, more than are allowed.
    TooLarge(usize),
    /// There is no finer mesh: it would have too many cells, or ones so small that rounding hides their shape.
    Finest(String),
    /// The bound no longer falls.
    Stalled(Stall),
    /// There is no bound to go by.
    NoBound,
    /// The solver stopped before its tolerance.
    Unsolved,
    /// Whoever looks at each level asked for it.
    Interrupted,
}

/// Solves `scene` on `mesh` and on refinements of it until the goal is reached; `look` sees every level, and ends it by `false`.
/// The last level, with its mesh, and why it is the last.
///
/// # Errors
/// As for [`crate::solve::solve`] on any of the meshes; what `look` fails with.
pub fn refined_until(
    scene: &Scene,
    mesh: Mesh,
    wanted: &Wanted,
    mut look: impl FnMut(&Level) -> Result<bool>,
) -> Result<(Level, Stop)> {
    let mut hierarchy = Hierarchy::new(mesh)?;
    let (mut start, mut number, mut history) = (Vec::new(), 0, History::default());
    let mut posed = Posed::new(scene, &hierarchy)?;
    loop {
        let level = posed.solved(number, wanted, &start)?;
        let goes_on = look(&level)?;
        if let Some(stop) = level.ended(wanted, goes_on, &mut history)? {
            return Ok((level, stop));
        }
        stage("marking and refining cells");
        let squares = indicators::squares(&level.problem, &level.solution)?;
        let marked = marking::marked(&squares, wanted.goal.of(&level));
        let carried = match hierarchy.refine(&marked) {
            Ok(carried) => carried,
            Err(why) => return Ok((level, Stop::Finest(why.to_string()))),
        };
        posed = Posed::new(scene, &hierarchy)?;
        let unknowns = posed.problem.topology.counts.unknowns();
        if unknowns > wanted.most_unknowns {
            return Ok((level, Stop::TooLarge(unknowns)));
        }
        start = carry::start(&level, &posed.problem, &carried);
        number += 1;
    }
}

impl Level {
    /// Why no level follows it, apart from meshes.
    fn ended(&self, wanted: &Wanted, goes_on: bool, history: &mut History) -> Result<Option<Stop>> {
        Ok(match &self.solution.bound {
            _ if !self.solution.converged() => Some(Stop::Unsolved),
            None => Some(Stop::NoBound),
            Some(bound) if wanted.goal.is_met(bound.total, self.energy_norm) => Some(Stop::Reached),
            Some(_) if !goes_on => Some(Stop::Interrupted),
            Some(_) => history.stalled(self)?.map(Stop::Stalled),
        })
    }
}

/// The scene on a mesh, before it is solved.
struct Posed {
    problem: Problem,
    clock: Instant,
}

impl Posed {
    fn new(scene: &Scene, hierarchy: &Hierarchy) -> Result<Self> {
        let clock = Instant::now();
        Ok(Self { problem: Problem::new(scene, hierarchy.mesh().clone())?, clock })
    }

    fn solved(self, number: usize, wanted: &Wanted, start: &[f64]) -> Result<Level> {
        let Self { problem, clock } = self;
        stage(&format!("level {number}, {} unknowns", problem.topology.counts.unknowns()));
        let solution = solve_from(&problem, &wanted.options, start)?;
        let energy_norm = energy_norm::of_solution(&problem, &solution)?;
        let seconds = clock.elapsed().as_secs_f64();
        Ok(Level { number, problem, solution, energy_norm, seconds })
    }
}

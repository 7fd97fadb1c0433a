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
use signorini_scene::mesh::refine::MOST_CELLS;
use signorini_scene::scene::Scene;
use stall::History;

/// What is asked for.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// What the bound is to be below.
    pub goal: Goal,
    /// No mesh with more unknowns is solved on.
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
    /// From the mesh to the bound.
    pub seconds: f64,
}

/// Why the last level is the last.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// The bound is below the goal.
    Reached,
    /// The next mesh would have more unknowns than are allowed, or more cells than any may.
    TooLarge,
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
/// The last level, why it is the last, and its mesh.
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
    let mut problem = Problem::new(scene, hierarchy.mesh().clone())?;
    loop {
        let level = Level::solved(number, problem, wanted, &start)?;
        let goes_on = look(&level)?;
        let stop = match &level.solution.bound {
            _ if !level.solution.converged() => Some(Stop::Unsolved),
            None => Some(Stop::NoBound),
            Some(bound) if wanted.goal.is_met(bound.total, level.energy_norm) => {
                Some(Stop::Reached)
            }
            Some(_) if !goes_on => Some(Stop::Interrupted),
            Some(_) => history.stalled(&level)?.map(Stop::Stalled),
        };
        if let Some(stop) = stop {
            return Ok((level, stop));
        }
        stage("marking and refining cells");
        let squares = indicators::squares(&level.problem, &level.solution)?;
        let marked = marking::marked(&squares, wanted.goal.of(&level));
        if hierarchy.mesh().cells() + 3 * marked.iter().filter(|&&is| is).count() > MOST_CELLS {
            return Ok((level, Stop::TooLarge));
        }
        let carried = hierarchy.refine(&marked)?;
        problem = Problem::new(scene, hierarchy.mesh().clone())?;
        if problem.topology.counts.unknowns() > wanted.most_unknowns {
            return Ok((level, Stop::TooLarge));
        }
        start = carry::start(&level, &problem, &carried);
        number += 1;
    }
}

impl Level {
    fn solved(number: usize, problem: Problem, wanted: &Wanted, start: &[f64]) -> Result<Self> {
        let clock = Instant::now();
        stage(&format!("level {number}, {} unknowns", problem.topology.counts.unknowns()));
        let solution = solve_from(&problem, &wanted.options, start)?;
        let energy_norm = energy_norm::of_solution(&problem, &solution)?;
        let seconds = clock.elapsed().as_secs_f64();
        Ok(Self { number, problem, solution, energy_norm, seconds })
    }
}

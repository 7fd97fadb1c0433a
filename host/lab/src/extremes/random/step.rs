//! The judge of one step in time: the same step on finer meshes, from the same s_old.

use signorini_certify::admissible::{Admissible, Following};
use signorini_certify::cell::Cell;
use signorini_certify::curved::followed;
use signorini_problem::quadrature::gauss;
use signorini_problem::search::{LocatedPoint, Search};
use signorini_problem::{Problem, State};
use signorini_scene::mesh::adapted::adapted;
use signorini_scene::{Error, Result};
use signorini_solve::{Options, Solution, SolverKind, solve};

use super::nested::{Nesting, apart};
use crate::mesh_solution::MeshSolution;

/// How the bound of an answer stands against a finer one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged {
    pub bound: f64,
    /// The distance of the two answers in the norm of the bound.
    pub apart: f64,
    /// The bound of the finer answer.
    pub finer: f64,
}

impl Judged {
    /// The part of the bound that the finer answer proves to be error: over 1 where the bound is broken.
    pub fn error_over_bound(&self) -> f64 {
        (self.apart - self.finer) / self.bound
    }

    pub fn bound_over_error(&self) -> f64 {
        self.bound / self.apart
    }
}

/// Judges the answer of the step `problem` by that on a mesh refined `levels` times; nothing where one of them has no bound.
pub fn judge(problem: &Problem, answer: &Solution, levels: u32) -> Result<Option<Judged>> {
    let Some(bound) = answer.bound else { return Ok(None) };
    let (finer, truth) = finer_answer(problem, levels)?;
    let Some(of_truth) = truth.bound else { return Ok(None) };
    let nesting = Nesting { levels, cut: None };
    let (own, its) = (MeshSolution::of(problem, answer)?, MeshSolution::of(&finer, &truth)?);
    let apart = apart(&own, &its, &nesting, &gauss(4))?;
    Ok(Some(Judged { bound: bound.total, apart: apart.combined, finer: of_truth.total }))
}

/// The step of `problem` on a mesh refined `levels` times, and its answer.
fn finer_answer(problem: &Problem, levels: u32) -> Result<(Problem, Solution)> {
    let finer = finer(problem, levels)?;
    let options = Options { solver: SolverKind::Factor, averages: true, ..Options::default() };
    let truth = solve(&finer, &options)?;
    Ok((finer, truth))
}

/// The step of `problem` on a finer mesh: from its s_old, which every finer mesh holds exactly.
fn finer(problem: &Problem, levels: u32) -> Result<Problem> {
    let Some(step) = &problem.loads.step else {
        return Err(Error::Check("no step in time".to_owned()));
    };
    let mesh = adapted((*problem.mesh).clone(), None, levels)?;
    let mut finer = Problem::new(&problem.scene, mesh)?;
    finer.set_time(problem.time)?;
    let State { vertices, bubbles, .. } = &step.begin;
    let tau = vec![0.0; problem.ends.len()];
    let following = Following::default();
    let old = Admissible { vertices, bubbles, tau: &tau, following: &following };
    let (search, deviations) = (Search::new(problem), followed(problem, &old)?);
    let at = |point: [f64; 2]| {
        let Some(LocatedPoint { cell, reference }) = search.find(point) else {
            return Err(Error::Check(format!("{point:?} is in no cell")));
        };
        let local = Cell::of(problem, cell as usize).local(reference);
        Ok(old.on_cell(problem, cell as usize, &deviations).at(&local)?.value)
    };
    let vertices = finer.mesh.vertices.iter().map(|&vertex| at(vertex));
    let vertices: Vec<f64> = vertices.collect::<Result<_>>()?;
    let chord = |edge: usize| {
        let [a, b] = finer.ends[edge].map(|vertex| vertices[vertex as usize]);
        0.5 * (a + b)
    };
    // Along an edge s_old is quadratic.
    let bubble = |edge: usize| Ok(at(finer.along(edge, 0.5))? - chord(edge));
    let bubbles: Vec<f64> = (0..finer.ends.len()).map(bubble).collect::<Result<_>>()?;
    let means = bubbles.iter().enumerate().map(|(edge, bubble)| chord(edge) + bubble / 1.5);
    let means: Vec<f64> = means.collect();
    let begin = State { u: means, vertices, bubbles, ..State::zero(&finer) };
    finer.stepping(step.length, begin)
}

#[cfg(test)]
mod tests;

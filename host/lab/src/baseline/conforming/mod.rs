//! Conforming P1 on the same triangles: the method that most would take, with a third of the unknowns.
//!
//! One unknown a vertex that is not on D, u(v) ≥ ψ(v) at the vertices of C; quads are cut. The sweeps are the
//! kernel's own, on rows wide enough for the neighbours of a vertex. Its error of u is often the smaller one; it has no
//! conservative flux and so no certificate.

mod assembly;
mod errors;
mod mesh;
#[cfg(test)]
mod tests;
mod vertices;

use signorini_kernel::csr::Csr;
use signorini_kernel::law::Law;
use signorini_kernel::system::System;

use super::failed;
use super::load_case::LoadCase;
use super::psor::{Psor, TickLoads};
use super::quadratic::{Matrix, Quadratic, QuadraticLoads};
use super::timed_solver::Contest;
use crate::baseline::record::{Baseline, PointError};
use signorini_problem::{EdgeKind, Parts, Problem};
use signorini_scene::error::{InputError, Result};
use vertices::Vertices;

/// The discretisation over some ticks, with the answers of the first.
pub struct Conforming {
    /// The scene on its triangles.
    pub problem: Problem,
    /// u at every vertex of that mesh, in the first tick.
    pub values: Vec<f64>,
    /// ∫_C (σ·n − q) in the first tick, from the residuals at the vertices of C.
    pub force: f64,
    /// Length of the contact set in the first tick: half of each edge for each of its ends that touches.
    pub length: f64,
    /// K with the columns of D behind the others, the diagonal first in every row.
    matrix: Matrix,
    vertices: Vertices,
    ticks: Vec<TickLoads<f64>>,
    quadratic: Quadratic,
}

impl Conforming {
    /// The scene of `problem` as it stands on its triangles.
    ///
    /// # Errors
    /// Data that are not finite; a problem without a solution; a flux with a limit.
    pub fn new(problem: &Problem) -> Result<Self> {
        Self::over(problem, &[LoadCase::at(&problem.scene, problem.time)])
    }

    pub(super) fn over(problem: &Problem, moments: &[LoadCase]) -> Result<Self> {
        if problem.scene.limited().is_some() {
            return Err(InputError::new("fluxes with limits are left out").into());
        }
        let mut problem = Problem::new(&problem.scene, mesh::cut(&problem.mesh))?;
        problem.set_time(moments[0].time)?;
        let vertices = Vertices::of(&problem);
        let mut matrix = Matrix::new();
        for (at, row) in assembly::matrix(&problem, &vertices).iter().enumerate() {
            let own = row.get(&at).copied().unwrap_or(0.0);
            let others = row.iter().filter(|&(&column, _)| column != at);
            let others = others.map(|(&column, &value)| (column, value));
            matrix.push_row(std::iter::once((at, own)).chain(others));
        }
        let ticks: Result<Vec<_>> =
            moments.iter().map(|moment| assembly::data(&problem, &vertices, moment)).collect();
        let ticks = ticks?;
        let (reduced, loads) = reduce(&matrix, vertices.counts.unknowns(), &ticks);
        let data = loads.into_iter().zip(&ticks);
        let quadratic = |(load, given): (Vec<f64>, &TickLoads<f64>)| {
            QuadraticLoads::new(load, given.lower.clone(), Vec::new())
        };
        let data = data.map(quadratic).collect();
        let parts = Parts::examine(&problem)?;
        let floating = floating(&problem, &parts, &vertices)?;
        let (quadratic, _) = Quadratic::new(reduced, floating, data)?;
        let (values, force, length) = (Vec::new(), 0.0, 0.0);
        let mut conforming =
            Self { problem, values, force, length, matrix, vertices, ticks, quadratic };
        conforming.read_off();
        Ok(conforming)
    }

    /// Values, force and length of the first tick's answer.
    fn read_off(&mut self) {
        let (counts, given, u) = (self.vertices.counts, &self.ticks[0], &self.quadratic.answers[0]);
        let all: Vec<f64> = u.iter().chain(&given.dirichlet).copied().collect();
        self.values = self.vertices.number.iter().map(|&at| all[at]).collect();
        let residual = |at: usize| {
            self.matrix.row(at).map(|(column, value)| value * all[column]).sum::<f64>()
                - given.load[at]
        };
        self.force = (counts.free..counts.unknowns()).map(residual).sum();
        let touches = |vertex: u32| {
            let at = self.vertices.number[vertex as usize];
            let contact = at.checked_sub(counts.free).filter(|&at| at < counts.contact);
            contact.is_some_and(|contact| u[at] <= given.lower[contact])
        };
        let edges =
            (0..self.problem.ends.len()).filter(|&e| self.problem.kinds[e] == EdgeKind::Contact);
        let share = |edge: usize| {
            let ends = self.problem.ends[edge].iter().filter(|&&vertex| touches(vertex)).count();
            0.5 * ends as f64 * self.problem.lengths[edge]
        };
        self.length = edges.map(share).sum();
    }

    /// Unknowns: vertices not on D.
    pub fn unknowns(&self) -> usize {
        self.vertices.counts.unknowns()
    }

    /// Distance to the exact solution, where the scene has one.
    ///
    /// # Errors
    /// An exact solution that is not finite at a quadrature point.
    pub fn errors(&self) -> Result<Option<PointError>> {
        let Some(exact) = &self.problem.scene.exact else { return Ok(None) };
        errors::errors(self, exact, &self.values, self.force, self.length).map(Some)
    }

    /// Its sweeps against the others; `target` as for all.
    pub(super) fn compete(&self, target: f64) -> Result<Vec<Baseline>> {
        let widest = |rows: std::ops::Range<usize>| {
            rows.map(|row| self.matrix.row(row).count() - 1).max().unwrap_or(0)
        };
        let counts = self.vertices.counts;
        let (free, contact) = (widest(0..counts.free), widest(counts.free..counts.unknowns()));
        let mut baselines = match free.max(2 * contact) {
            0..=8 => self.sweep::<8>(target),
            9..=12 => self.sweep::<12>(target),
            13..=16 => self.sweep::<16>(target),
            _ => self.sweep::<32>(target),
        }?;
        let error = self.errors()?;
        baselines.iter_mut().for_each(|baseline| baseline.error = error);
        Ok(baselines)
    }

    /// Rows of `WIDTH` entries; at the boundary half of them count.
    fn sweep<const WIDTH: usize>(&self, target: f64) -> Result<Vec<Baseline>> {
        let Matrix { row_ptr, col_idx, values } = &self.matrix;
        let counts = self.vertices.counts;
        let given = &self.ticks[0];
        let matrix = Csr::new(row_ptr, col_idx, values, counts.edges()).map_err(failed)?;
        let system =
            System::new(matrix, &given.load, Law::above(&given.lower), counts).map_err(failed)?;
        let contest = Contest { problem: "conforming P1", quadratic: &self.quadratic, target };
        let mut adaptive = Psor::<f64, WIDTH>::adaptive(system, &self.ticks);
        let mut baselines = contest.hold("PSOR", &mut adaptive)?;
        let mut tuned = Psor::<f64, WIDTH>::tuned(system, &self.ticks)?;
        baselines.extend(contest.hold("PSOR, tuned ω", &mut tuned)?);
        Ok(baselines)
    }
}

/// K without the columns of D, and the loads with them on the right-hand side.
fn reduce(matrix: &Matrix, unknowns: usize, ticks: &[TickLoads<f64>]) -> (Matrix, Vec<Vec<f64>>) {
    let mut reduced = Matrix::new();
    (0..unknowns).for_each(|i| reduced.push_row(matrix.row(i).filter(|&(j, _)| j < unknowns)));
    let load = |given: &TickLoads<f64>| {
        let of_row = |i: usize| {
            let given_columns = matrix.row(i).filter(|&(j, _)| j >= unknowns);
            let held = given_columns.map(|(j, value)| value * given.dirichlet[j - unknowns]);
            given.load[i] - held.sum::<f64>()
        };
        (0..unknowns).map(of_row).collect()
    };
    (reduced, ticks.iter().map(load).collect())
}

/// For each vertex of C whether contact alone holds its part.
fn floating(problem: &Problem, parts: &Parts, vertices: &Vertices) -> Result<Vec<bool>> {
    use signorini_kernel::mesh::components::Support;
    let edges = problem.topology.edges().map_err(failed)?;
    let counts = vertices.counts;
    let mut floating = vec![false; counts.contact];
    for (edge, ends) in problem.ends.iter().enumerate() {
        let held = parts.support(parts.of_edge(&edges, edge)) == Support::Held;
        for &vertex in ends {
            let at = vertices.number[vertex as usize];
            if (counts.free..counts.unknowns()).contains(&at) {
                floating[at - counts.free] = !held;
            }
        }
    }
    Ok(floating)
}

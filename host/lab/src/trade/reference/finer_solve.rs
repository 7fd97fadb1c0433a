//! The scene solved on a fine mesh, as values at quadrature points.
//!
//! The solve gives two gradients, ∇s of a continuous function and A⁻¹τ of an equilibrated flux, with
//! errors that are nearly orthogonal. Their mean has a certified error,
//! ```text
//!   p = (∇s + A⁻¹τ)/2,   ‖A^½(∇u − p)‖ ≤ combined/√2 ≤ total/√2,
//! ```
//! and [`recovery`] brings it nearer: ∇u ≈ G, σ ≈ AG, ‖A^½(∇u − G)‖ ≤ total/√2 + ‖A^½(p − G)‖.
//! Of u itself the mean of u_h and s is taken, nearer to it than u_h by a third or more.

use super::Facts;
use super::places::Places;
use super::recovery::{self, Inside, points};
use super::tables::Kept;
use crate::mesh_solution::{MeshSolution, solve_directly};
use crate::trade::digits::grouped;
use signorini_certify::admissible::Admissible;
use signorini_certify::conductivity::{Conductivity, apply, inverse, product};
use signorini_problem::quadrature::gauss;
use signorini_problem::{Problem, Sum};
use signorini_scene::scene::Field;
use signorini_scene::{Mesh, Result, Scene};
use signorini_solve::Solution;

const ON_EDGES: usize = 3;

/// The solution on a fine mesh.
#[derive(Debug)]
pub(super) struct Reference {
    pub(super) points: Vec<Inside>,
    pub(super) robin: Vec<OnRobin>,
    pub(super) places: Kept<Places>,
}

/// The solution at a point of the Robin boundary.
#[derive(Debug, Clone, Copy)]
pub(super) struct OnRobin {
    pub(super) x: [f64; 2],
    /// An element of length.
    pub(super) weight: f64,
    /// The coefficient h.
    pub(super) transfer: f64,
    pub(super) u: f64,
    /// σ·n
    pub(super) sigma: f64,
}

impl Reference {
    /// Solves `scene` on `mesh` by the direct solver.
    pub(super) fn new(scene: &Scene, mesh: Mesh) -> Result<(Self, Facts)> {
        let problem = Problem::new(scene, mesh)?;
        let solution = solve_directly(&problem)?;
        let (mut points, robin) = sampled(&problem, &solution)?;
        let change = recovery::smooth(&problem, &mut points);
        let own = match solution.bound {
            Some(bound) => {
                let error = bound.total * std::f64::consts::FRAC_1_SQRT_2 + change;
                format!("its own certified error is at most {error:.1e}")
            }
            None => "its own error has no certified bound".to_owned(),
        };
        let unknowns = grouped(problem.topology.counts.unknowns() as u64);
        let words = format!(
            "the faer reference on {unknowns} unknowns, two refinements finer than the finest mesh; {own}"
        );
        let square = |at: &Inside| at.weight * product(&at.conductivity, at.gradient, at.gradient);
        let energy = points.iter().map(square).sum::<f64>().sqrt();
        let Solution { contact_force: force, contact_length: length, .. } = solution;
        let facts = Facts { words, energy, force, length };
        Ok((Self { points, robin, places: Kept::new(usize::MAX) }, facts))
    }
}

/// Values at the points of all cells and of the Robin boundary.
fn sampled(problem: &Problem, solution: &Solution) -> Result<(Vec<Inside>, Vec<OnRobin>)> {
    let certified = solution.certified.admissible();
    // Without a bound nobody mended τ.
    let tau = if solution.bound.is_some() { certified.tau } else { &solution.flux };
    let answer = MeshSolution::new(problem, Admissible { tau, ..certified }, &solution.u)?;
    let mut inside = Vec::new();
    for at in 0..problem.cells() {
        add_cell(&answer, at, &mut inside)?;
    }
    let mut robin = Vec::new();
    for edge in 0..problem.kinds.len() {
        add_robin(&answer, edge, &mut robin)?;
    }
    Ok((inside, robin))
}

fn add_cell(answer: &MeshSolution, at: usize, inside: &mut Vec<Inside>) -> Result<()> {
    let (own, conductivity) = (answer.on_cell(at), Conductivity::of(answer.problem, at));
    for point in points(&own.cell) {
        let conductivity = conductivity.at(point.x);
        let s = own.s(point.reference)?;
        let other = apply(&inverse(&conductivity), own.tau.sample(&point).flux);
        let gradient = [0, 1].map(|k| 0.5 * (s.gradient[k] + other[k]));
        let u = 0.5 * (own.u.sample(&point).u + s.value);
        inside.push(Inside { x: point.x, weight: point.weight, u, gradient, conductivity });
    }
    Ok(())
}

/// σ·n = h(u_ext − u) there, with u = s.
fn add_robin(answer: &MeshSolution, edge: usize, robin: &mut Vec<OnRobin>) -> Result<()> {
    let problem = answer.problem;
    let Some(transfer) = Sum::transfer(problem, edge) else { return Ok(()) };
    let ambient = Sum::on_edge(problem, edge, Field::Ambient);
    let Some(ambient) = ambient else { return Ok(()) };
    let (length, [a, b]) = (problem.lengths[edge], problem.segment(edge));
    for [t, weight] in gauss(ON_EDGES) {
        let x = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
        let transfer = transfer.finite_at(x)?;
        let ambient = ambient.finite_at(x)?;
        let u = answer.s_on_edge(edge, t)?;
        let (weight, sigma) = (weight * length, transfer * (ambient - u));
        robin.push(OnRobin { x, weight, transfer, u, sigma });
    }
    Ok(())
}

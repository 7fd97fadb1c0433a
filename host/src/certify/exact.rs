//! The true distance of S and τ to an exact solution: what the bound must not fall below.
//!
//! With σ = A∇u, the means f̄, ḡ, q̄ that τ was made for, and R the Robin boundary,
//! ```text
//!   combined² = ‖A^½∇(u − S)‖² + ‖A^{−½}(σ − τ)‖² + ∫_R h(u − S)² + ∫_R ((σ − τ)·n)²/h
//!   identity² = combined² + 2∫_C [(σ·n − q)(S − ψ) + (τ·n − q̄)(u − ψ)]
//!             + 2∫(S − u)(f − f̄) + 2∫_N (S − u)(g − ḡ) + 2∫_C (S − u)(q − q̄)
//! ```
//! bound² = identity², whatever S and τ are, is a test of the bound from both sides. Nothing is
//! clipped: where S or τ are not admissible, single terms are negative.

use signorini_kernel::Tensor;
use signorini_kernel::geometry::scaled_normal;

use super::admissible::Admissible;
use super::cell::Cell;
use super::conductivity::{Conductivity, apply, dot, inverse, product};
use super::deviation::Deviations;
use crate::error::Result;
use crate::field::CellField;
use crate::norms::{POINTS, exact_at};
use crate::problem::{EdgeKind, Problem, Sum};
use crate::quadrature::{gauss, on_panels};
use crate::scene::{Condition, Exact, Field, Scene};

/// Panels on an edge, each with 8 points: the exact flux has kinks where contact ends.
const PANELS: u32 = 8;

/// Distances of S and τ to the exact solution, in the unit of ‖A^½∇u‖.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distance {
    /// What the bound is for: bound ≥ combined.
    pub combined: f64,
    /// What the bound is, up to quadrature: bound = identity.
    pub identity: f64,
}

/// Squares of both while they add up.
#[derive(Default)]
struct Squares {
    combined: f64,
    /// identity² − combined²
    rest: f64,
}

/// Integrates the distances at the time of the problem, with 16×16 points a cell and 64 an edge; the means are those of
/// `problem.loads`.
///
/// # Errors
/// An exact solution or data that are not finite at a quadrature point.
pub fn distance(
    scene: &Scene,
    exact: &Exact,
    problem: &Problem,
    admissible: &Admissible,
) -> Result<Distance> {
    let deviations = Deviations::at_time(scene, problem, problem.time)?;
    let study = Study { scene, exact, problem, admissible, deviations: &deviations };
    let mut squares = Squares::default();
    for at in 0..problem.mesh.triangles.len() + problem.mesh.quads.len() {
        study.add_cell(&mut squares, at)?;
    }
    for (edge, kind) in problem.kinds.iter().enumerate() {
        match kind {
            EdgeKind::Contact => study.add_contact(&mut squares, edge)?,
            EdgeKind::Neumann => study.add_neumann(&mut squares, edge)?,
            EdgeKind::Robin => study.add_robin(&mut squares, edge)?,
            EdgeKind::Interior | EdgeKind::Dirichlet => {}
        }
    }
    let Squares { combined, rest } = squares;
    Ok(Distance { combined: combined.sqrt(), identity: (combined + rest).max(0.0).sqrt() })
}

struct Study<'a> {
    scene: &'a Scene,
    exact: &'a Exact,
    problem: &'a Problem,
    admissible: &'a Admissible<'a>,
    deviations: &'a Deviations<'a>,
}

/// What is known at a point of a boundary edge.
struct EdgePoint {
    x: [f64; 2],
    /// An element of length.
    weight: f64,
    u: f64,
    s: f64,
    /// σ·n
    sigma: f64,
    /// τ·n
    tau: f64,
}

impl Study<'_> {
    fn add_cell(&self, squares: &mut Squares, at: usize) -> Result<()> {
        let (scene, problem) = (self.scene, self.problem);
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(scene, problem, at));
        let s = self.admissible.on_cell(problem, at, self.deviations);
        // Of this field only the flux is read, so that any numbers do for the means of u.
        let tau = CellField::new(problem, at, self.admissible.tau, self.admissible.tau);
        let (f, load) = (Sum::source(scene, self.problem.time), problem.loads.of_cell(at));
        for point in cell.points(&gauss(POINTS)) {
            let local = cell.local(point.reference);
            let (u, gradient) = exact_at(scene, self.exact, point.x, self.problem.time)?;
            let (a, s) = (conductivity.at(point.x), s.at(&local)?);
            let tau = tau.sample(&point).flux;
            squares.combined += point.weight * in_cell(&a, gradient, s.gradient, tau);
            let missing = f.at(point.x[0], point.x[1]) - cell.spread(load, local.determinant);
            squares.rest += 2.0 * point.weight * (s.value - u) * missing;
        }
        Ok(())
    }

    fn add_contact(&self, squares: &mut Squares, edge: usize) -> Result<()> {
        let (Some(q), Some(gap)) = (self.data(edge, Field::Flux), self.data(edge, Field::Gap))
        else {
            return Ok(());
        };
        let mean = q.mean(self.problem.segment(edge))?;
        for point in self.edge_points(edge)? {
            let [x, y] = point.x;
            let (q, psi) = (q.finite(q.at(x, y), point.x)?, gap.finite(gap.at(x, y), point.x)?);
            let contact =
                (point.sigma - q) * (point.s - psi) + (point.tau - mean) * (point.u - psi);
            let oscillation = (point.s - point.u) * (q - mean);
            squares.rest += 2.0 * point.weight * (contact + oscillation);
        }
        Ok(())
    }

    fn add_neumann(&self, squares: &mut Squares, edge: usize) -> Result<()> {
        let Some(g) = self.data(edge, Field::Flux).filter(|g| g.constant().is_none()) else {
            return Ok(());
        };
        let mean = g.mean(self.problem.segment(edge))?;
        for point in self.edge_points(edge)? {
            let missing = g.finite(g.at(point.x[0], point.x[1]), point.x)? - mean;
            squares.rest += 2.0 * point.weight * (point.s - point.u) * missing;
        }
        Ok(())
    }

    fn add_robin(&self, squares: &mut Squares, edge: usize) -> Result<()> {
        let problem = self.problem;
        let boundary = problem.binding.boundary(problem.ends[edge]);
        let boundary = boundary.map(|boundary| &self.scene.boundaries[boundary].condition);
        let Some(Condition::Robin { coefficient, .. }) = boundary else { return Ok(()) };
        let coefficient = Sum::alone(self.scene, coefficient, self.problem.time);
        for point in self.edge_points(edge)? {
            let h = coefficient.finite(coefficient.at(point.x[0], point.x[1]), point.x)?;
            let square = on_robin(h, point.u - point.s, point.sigma - point.tau);
            squares.combined += point.weight * square;
        }
        Ok(())
    }

    fn data(&self, edge: usize, field: Field) -> Option<Sum<'_>> {
        Sum::on_edge(self.scene, self.problem, edge, field, self.problem.time)
    }

    fn edge_points(&self, edge: usize) -> Result<Vec<EdgePoint>> {
        let (problem, length) = (self.problem, self.problem.lengths[edge]);
        let [a, b] = problem.segment(edge);
        let normal: [f64; 2] = scaled_normal(a, b).into();
        let (at, _) = problem.topology.first_side(edge);
        let conductivity = Conductivity::of(self.scene, problem, at);
        let deviation = self.deviations.on(edge);
        let point = |[t, weight]: [f64; 2]| {
            let x = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
            let (u, gradient) = exact_at(self.scene, self.exact, x, self.problem.time)?;
            Ok(EdgePoint {
                x,
                weight: weight * length,
                u,
                s: self.admissible.on_edge(problem, edge, deviation, t)?,
                sigma: dot(apply(&conductivity.at(x), gradient), normal) / length,
                tau: self.admissible.tau[edge] / length,
            })
        };
        on_panels(PANELS, &gauss(8)).into_iter().map(point).collect()
    }
}

/// |A^½(∇u − ∇S)|² + |A^{−½}(A∇u − τ)|² at a point.
pub(crate) fn in_cell(a: &Tensor<f64>, u: [f64; 2], s: [f64; 2], tau: [f64; 2]) -> f64 {
    let (error, flux_error) = (minus(u, s), minus(apply(a, u), tau));
    product(a, error, error) + product(&inverse(a), flux_error, flux_error)
}

/// h(u − S)² + ((σ − τ)·n)²/h at a point of the Robin boundary.
pub(crate) fn on_robin(h: f64, error: f64, flux_error: f64) -> f64 {
    let square = h * error * error;
    if h > 0.0 { square + flux_error * flux_error / h } else { square }
}

pub(crate) fn minus(v: [f64; 2], w: [f64; 2]) -> [f64; 2] {
    [v[0] - w[0], v[1] - w[1]]
}

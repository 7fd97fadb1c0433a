//! How far two answers are from each other, one on a mesh and one on its uniform refinement, which may be cut along lines.
//!
//! A child's reference coordinates are an affine function of its parent's, on quads too: what both functions are
//! is known at any point of the finer mesh, without a search. In a cut cell they follow from the point.

use crate::mesh_solution::{MeshSolution, OnCell};
use signorini_certify::cell::Cell;
use signorini_certify::conductivity::{Conductivity, inverse, product};
use signorini_certify::weighed::{minus, on_robin};
use signorini_problem::quadrature::{Point, gauss};
use signorini_problem::{Problem, Sum};
use signorini_scene::{Error, Result};

/// The distance of two answers.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Apart {
    /// (‖A^½∇(s′ − s)‖² + ‖A^{−½}(τ′ − τ)‖² + ∫_R h(s′ − s)² + ∫_R ((τ′ − τ)·n)²/h)^½, and in a step of time ∫k(s′ − s)² under
    /// the root
    pub combined: f64,
    /// ‖A^½∇(s′ − s)‖
    pub of_s: f64,
    /// (‖A^½∇(s′ − s)‖² + ∫_R h(s′ − s)²)^½
    pub with_robin: f64,
    /// ‖A^½∇_h(s′ − u_h)‖
    pub of_u: f64,
    /// ‖A^½∇s′‖
    pub energy: f64,
}

/// How the finer mesh lies in the coarser one.
#[derive(Debug, Clone, Default)]
pub struct Nesting {
    /// How often its cells were halved.
    pub levels: u32,
    /// The cell in which each cell of the finer mesh lies, where these were then cut.
    pub cut: Option<Vec<u32>>,
}

struct NestedPair<'a> {
    coarse: &'a MeshSolution<'a>,
    fine: &'a MeshSolution<'a>,
    nesting: &'a Nesting,
}

/// The distance between `coarse` and `fine` by `rule` in both directions of a cell of the finer mesh.
pub fn apart(
    coarse: &MeshSolution,
    fine: &MeshSolution,
    nesting: &Nesting,
    rule: &[[f64; 2]],
) -> Result<Apart> {
    let study = NestedPair { coarse, fine, nesting };
    let mut squares = Apart::default();
    let mut last = None;
    for at in 0..fine.problem.cells() {
        let parent = study.parent(at);
        let own = fine.on_cell(at);
        // Children of one cell follow each other.
        let of_parent = match last.take() {
            Some((known, of)) if known == parent => of,
            _ => coarse.on_cell(parent),
        };
        study.add_cell(at, &own, &of_parent, rule, &mut squares)?;
        last = Some((parent, of_parent));
    }
    for edge in 0..fine.problem.kinds.len() {
        let [of_s, of_tau] = study.robin(edge)?;
        squares.with_robin += of_s;
        squares.combined += of_s + of_tau;
    }
    squares.with_robin += squares.of_s;
    let Apart { combined, of_s, with_robin, of_u, energy } = squares;
    let [combined, of_s, with_robin, of_u, energy] =
        [combined, of_s, with_robin, of_u, energy].map(f64::sqrt);
    Ok(Apart { combined, of_s, with_robin, of_u, energy })
}

impl NestedPair<'_> {
    /// The cell of the coarser mesh in which cell `at` of the finer one lies.
    fn parent(&self, at: usize) -> usize {
        // Four times as many triangles are before four times as many quads.
        let halved = self.nesting.cut.as_ref().map_or(at, |cut| cut[at] as usize);
        halved >> (2 * self.nesting.levels)
    }

    /// Where a point of cell `at` lies in its parent.
    fn in_parent(
        &self,
        at: usize,
        own: &OnCell,
        parent: &OnCell,
        reference: [f64; 3],
    ) -> Result<[f64; 3]> {
        if self.nesting.cut.is_none() {
            return Ok(self.in_halved(at, reference));
        }
        let x = own.cell.local(reference).x;
        parent.tau.locate(x).ok_or_else(|| Error::Check(format!("{x:?} is not in its cell")))
    }

    fn in_halved(&self, at: usize, mut reference: [f64; 3]) -> [f64; 3] {
        let triangles = self.fine.problem.mesh.triangles.len();
        let (mut number, quad) = match at.checked_sub(triangles) {
            None => (at, false),
            Some(quad) => (quad, true),
        };
        for _ in 0..self.nesting.levels {
            reference = if quad {
                of_quarter(number % 4, reference)
            } else {
                of_child(number % 4, reference)
            };
            number /= 4;
        }
        reference
    }

    fn add_cell(
        &self,
        at: usize,
        own: &OnCell,
        parent: &OnCell,
        rule: &[[f64; 2]],
        squares: &mut Apart,
    ) -> Result<()> {
        let problem = self.fine.problem;
        let conductivity = Conductivity::of(problem, at);
        let step = problem.loads.step.as_ref();
        let area: f64 = own.cell.points(rule).iter().map(|point| point.weight).sum();
        let k = step.and_then(|step| step.contents().nth(at)).map_or(0.0, |of| of / area);
        for point in own.cell.points(rule) {
            let reference = self.in_parent(at, own, parent, point.reference)?;
            let there = Point { reference, ..point };
            let (of_own, of_parent) = (own.s(point.reference)?, parent.s(there.reference)?);
            let s = of_own.gradient;
            let (tau, other) = (own.tau.sample(&point).flux, parent.tau.sample(&there).flux);
            let a = conductivity.at(point.x);
            let broken = minus(s, parent.u.sample(&there).gradient);
            let (error, flux_error) = (minus(s, of_parent.gradient), minus(tau, other));
            let of_s = product(&a, error, error);
            let of_tau = product(&inverse(&a), flux_error, flux_error);
            let stored = of_own.value - of_parent.value;
            squares.combined += point.weight * (of_s + of_tau + k * stored * stored);
            squares.of_s += point.weight * of_s;
            squares.of_u += point.weight * product(&a, broken, broken);
            squares.energy += point.weight * product(&a, s, s);
        }
        Ok(())
    }

    /// ∫h(s′ − s)² and ∫((τ′ − τ)·n)²/h over an edge of R, 0 on others.
    fn robin(&self, edge: usize) -> Result<[f64; 2]> {
        let (fine, coarse) = (self.fine, self.coarse);
        let Some(h) = Sum::transfer(fine.problem, edge) else {
            return Ok([0.0; 2]);
        };
        let (at, side) = fine.problem.topology.first_side(edge);
        let parent = self.parent(at);
        let (own, of_parent) = (fine.on_cell(at), coarse.on_cell(parent));
        let middle = self.in_parent(at, &own, &of_parent, own.cell.side_point(side, 0.5, 0.0))?;
        let whole = edge_at(coarse.problem, parent, &of_parent.cell, middle);
        let density = |side: &MeshSolution, edge: usize| {
            side.admissible.tau[edge] / side.problem.lengths[edge]
        };
        let flux = density(fine, edge) - density(coarse, whole);
        let [a, b] = fine.problem.segment(edge);
        let mut sums = [0.0; 2];
        for [t, weight] in gauss(8) {
            let [x, y] = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
            let reference = own.cell.side_point(side, t, 0.0);
            let there = self.in_parent(at, &own, &of_parent, reference)?;
            let error = own.s(reference)?.value - of_parent.s(there)?.value;
            let h = h.finite_at([x, y])?;
            let weight = weight * fine.problem.lengths[edge];
            sums[0] += weight * on_robin(h, error, 0.0);
            sums[1] += weight * on_robin(h, 0.0, flux);
        }
        Ok(sums)
    }
}

/// The edge of a cell on which a point of its boundary lies.
fn edge_at(problem: &Problem, at: usize, cell: &Cell, [x, y, z]: [f64; 3]) -> usize {
    let away: &[f64] = match cell {
        Cell::Triangle(_) => &[z, x, y],
        Cell::Quad(_) => &[y, 1.0 - x, 1.0 - y, x],
    };
    let edges = problem.topology.edges_of(at).iter().zip(away);
    let nearest = edges.min_by(|(_, one), (_, other)| one.abs().total_cmp(&other.abs()));
    nearest.map_or(0, |(&edge, _)| edge as usize)
}

/// Barycentric coordinates in the parent of child `number`, in the order of [`signorini_scene::mesh::adaptive::refined`].
fn of_child(number: usize, [a, b, c]: [f64; 3]) -> [f64; 3] {
    let half = [0.5 * a, 0.5 * b, 0.5 * c];
    match number {
        0 => [a + half[1] + half[2], half[1], half[2]],
        1 => [half[0], half[0] + b + half[2], half[2]],
        2 => [half[0], half[1], half[0] + half[1] + c],
        // Its corners are the midpoints of bc, ca and ab.
        _ => [half[1] + half[2], half[0] + half[2], half[0] + half[1]],
    }
}

/// (x̂, ŷ) in the parent of quarter `number`.
fn of_quarter(number: usize, [x, y, _]: [f64; 3]) -> [f64; 3] {
    let [right, up] = [matches!(number, 1 | 2), matches!(number, 2 | 3)].map(f64::from);
    [0.5 * (x + right), 0.5 * (y + up), 0.0]
}

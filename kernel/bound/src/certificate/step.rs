//! The bound of a step in time.
//!
//! The step from w = s_old is k(u − w) − ∇·(A∇u) = f with k = c/dt. For admissible s and any τ that meets the boundary conditions let
//! R = f − k(s − w) + ∇·τ, with mean R̄ on each cell and R′ = R − R̄. Where c > 0, completing the square gives
//! ```text
//!   gap² + Σ‖R̄‖²/k + Σ‖R′‖²/k ≥ combined² + 2∫_C […],
//!   combined² = ‖A^½∇(u − s)‖² + ∫k(u − s)² + ‖A^{−½}(σ − τ)‖² + ∫_R […],
//! ```
//! with gap and the terms of C and R as in the steady problem ([`super`]). Any part of R′ may go to the oscillation instead, where each
//! cell pays (‖R′‖²/(k + π²α/h²))^½: the least total of some such parts is taken. What f varies by in a cell is the caller's oscillation,
//! as ever.
//!
//! A cell may keep what it lacks of balance: that is R̄. Or it hands it on along the forest, as in the steady problem, of which a
//! cell that stores nothing has to hand on all. [`Kept`] says which; the caller takes the lesser total of both.
//!
//! The bound is about this one step, whose start w is s of the step before, not about the evolution.

use super::change::{Change, minus, of_quad, of_triangle};
use super::parts::{CellTerms, Parts};
use super::stored::{Balance, Residual, StoredCell};
use super::walk::{share_of_quad, share_of_triangle};
use super::{
    Buffers, Continuous, Discretization, LoadCase, Verdict, admissible, boundary, quad, triangle,
};
use crate::cells::{Cell, Cells, Either, Quad, Triangle, pick};
use crate::equilibrium::{self, Iterate};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::flux::{on_quad, on_triangle};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::storage::Storage;

/// A step in time (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Step<'a, R> {
    /// What cells store by their sides, and the means that the step begins from.
    pub storage: Storage<'a, R>,
    /// One per cell, triangles first.
    pub cells: &'a [StoredCell<R>],
    /// s_old at the vertices.
    pub vertices: &'a [R],
    /// The bubbles of s_old, one per edge; may be empty where there are no quads.
    pub bubbles: &'a [R],
}

/// What becomes of the balance that a cell lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kept {
    /// The cell keeps all of it.
    All,
    /// It keeps its part ([`StoredCell::keep`]), and hands the rest on.
    Part,
}

/// Bounds the error of an iterate of `step`, and says what is left of its equation.
///
/// # Errors
/// Arrays of the wrong length.
pub fn certify_step<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    (given, step): (&LoadCase<R, I>, &Step<R>),
    iterate: Iterate<R>,
    kept: Kept,
    buffers: Buffers<R>,
) -> Result<(Verdict<R>, Residual<R>), Error> {
    certify_step_with(discretization, (given, step), iterate, kept, buffers, |_, _| ())
}

/// Bounds the error of a step with what `moved` makes of s, as [`certify_with`](super::certify_with) does.
///
/// # Errors
/// As for [`certify_step`].
pub fn certify_step_with<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    (given, step): (&LoadCase<R, I>, &Step<R>),
    iterate: Iterate<R>,
    kept: Kept,
    mut buffers: Buffers<R>,
    moved: impl FnOnce(&mut [R], &mut [R]),
) -> Result<(Verdict<R>, Residual<R>), Error> {
    let Discretization { edges, cells, .. } = discretization;
    same_length(Array::Storage, step.cells.len(), edges.cells())?;
    same_length(Array::Vertices, step.vertices.len(), buffers.vertices.len())?;
    admissible(discretization, given, iterate, &mut buffers, moved)?;
    let Buffers { vertices, bubbles, tau, indicators } = buffers;
    add_stored(cells, step.storage, iterate.u, tau);
    equilibrium::impose(edges, &given.boundary, iterate, tau);
    let s = Continuous { vertices, bubbles };
    let of_cells = OverCells { discretization, given, step, u: iterate.u, s, kept };
    let (mut parts, stored) = of_cells.sum(tau, indicators);
    if let Some(edge) = equilibrium::pulled(edges, &given.boundary, tau) {
        return Ok((Verdict::Pulled { edge }, stored));
    }
    boundary::add(discretization, given, iterate, s, tau, indicators, &mut parts);
    Ok((conclude(discretization, given.oscillation, parts, stored), stored))
}

/// The least total of those where no, some or all quarters of R′ are in the storage, and the rest in the oscillation.
fn conclude<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    oscillation: R,
    mut parts: Parts<R>,
    stored: Residual<R>,
) -> Verdict<R> {
    let (cells, missed) = (discretization.cells.len(), discretization.metric.missed);
    let stability = discretization.stability;
    // s is moved by rounding of its data, in the norm of the storage too.
    let moved = R::TWO * R::EPSILON;
    parts.perturbation += moved * moved * stored.size;
    parts.gap.add(stored.mean);
    let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
    // What rounding leaves of a cell's balance may leave along the forest, or stay.
    let staying = R::from_count(8) * R::EPSILON * root(stored.terms);
    let unbalanced = parts.unbalanced(cells, stability).or_smaller(staying);
    let shed = root(stored.shed);
    let with = |quarters: u32| {
        let inside = R::QUARTER * R::from_count(quarters);
        let mut parts = parts;
        parts.gap.add(inside * inside * stored.rest);
        let oscillation = oscillation + (R::ONE - inside) * shed;
        parts.conclude_with(cells, (stability, missed), oscillation, unbalanced)
    };
    let total = |of: &Verdict<R>| of.certificate().map_or(R::INFINITY, |of| of.total);
    let lesser = |a, b| if total(&b) < total(&a) { b } else { a };
    (1..=4).map(with).fold(with(0), lesser)
}

/// Adds to the means of fluxes on edges what the cells store by their sides.
fn add_stored<R: Real, I: Index>(cells: &Cells<R, I>, storage: Storage<R>, u: &[R], tau: &mut [R]) {
    let mut add = |edge: I, flux: R| {
        let sum = read(tau, edge.at()) + flux * read(cells.of_edges, edge.at());
        write(tau, edge.at(), sum);
    };
    for cell in cells.triangles {
        let stored = storage.in_triangle(cell.number.at(), &cell.edges, u);
        let flux = cell.turned(stored.map(|flux| flux * cell.softness));
        cell.edges.iter().zip(flux).for_each(|(&edge, flux)| add(edge, flux));
    }
    for cell in cells.quads {
        let number = cell.number.at().wrapping_sub(cells.triangles.len());
        let stored = storage.in_quad(number, &cell.edges, u);
        let flux = cell.turned(stored.map(|flux| flux * cell.softness));
        cell.edges.iter().zip(flux).for_each(|(&edge, flux)| add(edge, flux));
    }
}

struct OverCells<'a, R, I> {
    discretization: &'a Discretization<'a, R, I>,
    given: &'a LoadCase<'a, R, I>,
    step: &'a Step<'a, R>,
    u: &'a [R],
    s: Continuous<'a, R>,
    kept: Kept,
}

impl<R: Real, I: Index> OverCells<'_, R, I> {
    /// The walk over the cells from the leaves.
    fn sum(&self, tau: &mut [R], indicators: &mut [R]) -> (Parts<R>, Residual<R>) {
        let (mut parts, mut stored) = (Parts::default(), Residual::nothing());
        for cell in self.discretization.cells.from_leaves() {
            let (number, found) = match cell {
                Either::Triangle(cell) => (cell.number, self.of_triangle(cell, tau, &mut stored)),
                Either::Quad(cell) => (cell.number, self.of_quad(cell, tau, &mut stored)),
            };
            let Some((share, of_mean)) = found else { break };
            write(indicators, number.at(), share.gap + share.open + of_mean);
            parts.add(share);
        }
        (parts, stored)
    }

    /// A triangle's share, and its ‖R̄‖²/k.
    fn of_triangle(
        &self,
        cell: &Triangle<R, I>,
        tau: &mut [R],
        stored: &mut Residual<R>,
    ) -> Option<(CellTerms<R>, R)> {
        let (number, metric) = (cell.number.at(), self.discretization.metric);
        let source = read(self.given.loads.triangles, number);
        let [now, old] = [self.s.vertices, self.step.vertices];
        let now = pick(&cell.vertices, now)?;
        let change = of_triangle(now, pick(&cell.vertices, old)?);
        let (balance, out) = self.balanced(cell, source, &change, tau)?;
        let mut share = share_of_triangle(metric, cell, now, self.u, (balance.load, out))?;
        let own = on_triangle(&cell.k, &pick(&cell.edges, self.u)?, source);
        let kept = self.step.storage.in_triangle(number, &cell.edges, self.u);
        share.algebraic =
            triangle::energy(cell, metric.varying(number), minus(minus(out, own), kept));
        let of_mean = stored.add(self.stored_in(number), (&balance, &change), &out, &mut share);
        Some((share, of_mean))
    }

    /// A quad's share, and its ‖R̄‖²/k.
    fn of_quad(
        &self,
        cell: &Quad<R, I>,
        tau: &mut [R],
        stored: &mut Residual<R>,
    ) -> Option<(CellTerms<R>, R)> {
        let (number, metric) = (cell.number.at(), self.discretization.metric);
        let quad = number.wrapping_sub(self.discretization.cells.triangles.len());
        let source = read(self.given.loads.quads, quad);
        let in_mesh = |vertices: &[R], bubbles: &[R]| {
            let corners = cell.vertices_in_mesh(pick(&cell.vertices, vertices)?);
            Some([corners, cell.sides_in_mesh(pick(&cell.edges, bubbles)?)])
        };
        let [now, old] = [
            in_mesh(self.s.vertices, self.s.bubbles)?,
            in_mesh(self.step.vertices, self.step.bubbles)?,
        ];
        let change = of_quad(now, old, self.stored_in(number).tilt);
        let (balance, out) = self.balanced(cell, source, &change, tau)?;
        let by_sides = (balance.load, out);
        let s = self.s.in_quad(cell)?;
        let mut share = share_of_quad(metric, (cell, quad), s, self.u, by_sides)?;
        let own = on_quad(&cell.k, &pick(&cell.edges, self.u)?, source);
        let kept = self.step.storage.in_quad(quad, &cell.edges, self.u);
        share.algebraic = quad::energy(cell, metric.varying(number), minus(minus(out, own), kept));
        let of_mean = stored.add(self.stored_in(number), (&balance, &change), &out, &mut share);
        Some((share, of_mean))
    }

    fn stored_in(&self, cell: usize) -> StoredCell<R> {
        read(self.step.cells, cell)
    }

    /// Balances a cell as far as it does not keep what it lacks, and gives the fluxes out of it. A cell that keeps all changes no flux,
    /// so that its way out may end on an edge whose flux is given.
    fn balanced<const SIDES: usize, const ENTRIES: usize>(
        &self,
        cell: &Cell<R, I, SIDES, ENTRIES>,
        source: R,
        change: &Change<R>,
        tau: &mut [R],
    ) -> Option<(Balance<R>, [R; SIDES])> {
        let StoredCell { content, keep, .. } = self.stored_in(cell.number.at());
        let wanted = source - content * change.mean;
        let out = cell.outward(tau)?;
        let lacking = out.iter().fold(-wanted, |rest, &flux| rest - flux);
        if content > R::ZERO && self.kept == Kept::All {
            return Some((Balance { source, wanted, load: wanted + lacking }, out));
        }
        let load = if content > R::ZERO { wanted + keep * lacking } else { wanted };
        Some((Balance { source, wanted, load }, cell.settle(load, tau)?))
    }
}

//! The walk over the cells of a step in time: each is balanced in every way, and gives its share of the bounds of step and evolution.

use super::change::{Change, mean, minus, of_quad, of_triangle};
use super::moving::Moving;
use super::parts::{CellTerms, Distance, Parts};
use super::quad::Values;
use super::stored::{Balance, Inside, Means, Step, StoredCell};
use super::walk::{share_of_quad, share_of_triangle};
use super::{Continuous, Discretization, LoadCase, quad, triangle};
use crate::cells::{Cell, Either, Quad, Triangle, pick};
use crate::equilibrium::Iterate;
use signorini_kernel::flux::{on_quad, on_triangle};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::{Real, features};

/// The ways to balance cells: they keep what they lack, or they keep their part ([`StoredCell::keep`]) and hand on the rest.
pub const WAYS: usize = 2;

/// What the cells add up to by one way.
#[derive(Default)]
pub(super) struct Way<R> {
    pub parts: Parts<R>,
    pub means: Means<R>,
    /// ‖A^½∇s − A^{−½}τ‖² for s at the beginning and in the middle of the step.
    pub earlier: [Distance<R>; 2],
    /// That of the first way, for another one.
    pub algebraic: Option<R>,
}

/// τ and the indicators of one way.
pub(super) type Fields<'a, R> = (&'a mut [R], &'a mut [R]);

pub(super) struct OfStep<'a, R, I> {
    pub discretization: &'a Discretization<'a, R, I>,
    pub given: &'a LoadCase<'a, R, I>,
    pub step: &'a Step<'a, R>,
    pub iterate: Iterate<'a, R>,
    pub s: Continuous<'a, R>,
    /// The square of what storing the data has done.
    pub perturbation: R,
}

impl<R: Real, I: Index> OfStep<'_, R, I> {
    /// The walk over the cells from the leaves.
    pub fn walk(&self, fields: &mut [Fields<R>; WAYS]) -> ([Way<R>; WAYS], Inside<R>) {
        let cells = &self.discretization.cells;
        let mut sums = (Default::default(), Inside::default());
        if !features::QUADS || cells.quads.is_empty() {
            self.over_triangles(&mut sums, fields);
            return sums;
        }
        for cell in cells.from_leaves() {
            let found = match cell {
                Either::Triangle(cell) => self.of_triangle(cell, &mut sums, fields),
                Either::Quad(cell) => self.of_quad(cell, &mut sums, fields),
            };
            if found.is_none() {
                break;
            }
        }
        sums
    }

    #[inline(never)]
    fn over_triangles(&self, sums: &mut Sums<R>, fields: &mut [Fields<R>; WAYS]) {
        let cells = self.discretization.cells.triangles.iter();
        let _ = cells.map(|cell| self.of_triangle(cell, sums, fields)).find(Option::is_none);
    }

    #[inline(always)]
    fn of_triangle(
        &self,
        cell: &Triangle<R, I>,
        sums: &mut Sums<R>,
        fields: &mut [Fields<R>; WAYS],
    ) -> Option<()> {
        let (number, metric) = (cell.number.at(), self.discretization.metric);
        let source = read(self.given.loads.triangles, number);
        let [now, old] = [self.s.vertices, self.step.vertices];
        let (now, old) = (pick(&cell.vertices, now)?, pick(&cell.vertices, old)?);
        let means = pick(&cell.edges, self.iterate.u)?;
        let stored = read(self.step.cells, number);
        let change = of_triangle(now, old);
        let own = on_triangle(&cell.k, &means, source);
        let kept = self.step.storage.in_triangle(number, &cell.edges, means);
        let algebraic = |out: [R; 3]| {
            triangle::energy(cell, metric.varying(number), minus(minus(out, own), kept))
        };
        let moving = Moving::new(cell, [now, old], means);
        let share = |by: (R, [R; 3])| {
            if metric.varying(number).is_none() {
                return Some(moving.share(by));
            }
            let of = |s: [R; 3]| share_of_triangle(metric, cell, s, self.iterate.u, by);
            Some((of(now)?, [of(old)?.distance(), of(mean(old, now))?.distance()]))
        };
        self.add(cell, (&stored, &change, source), (share, algebraic), sums, fields)
    }

    fn of_quad(
        &self,
        cell: &Quad<R, I>,
        sums: &mut Sums<R>,
        fields: &mut [Fields<R>; WAYS],
    ) -> Option<()> {
        let (number, metric, u) = (cell.number.at(), self.discretization.metric, self.iterate.u);
        let quad = number.wrapping_sub(self.discretization.cells.triangles.len());
        let source = read(self.given.loads.quads, quad);
        let begin = Continuous { vertices: self.step.vertices, bubbles: self.step.bubbles };
        let (now, old) = (self.s.in_quad(cell)?, begin.in_quad(cell)?);
        let in_mesh =
            |s: &Values<R>| [cell.vertices_in_mesh(s.corners), cell.sides_in_mesh(s.bubbles)];
        let stored = read(self.step.cells, number);
        let change = of_quad(in_mesh(&now), in_mesh(&old), stored.tilt);
        let means = pick(&cell.edges, u)?;
        let own = on_quad(&cell.k, &means, source);
        let kept = self.step.storage.in_quad(quad, &cell.edges, means);
        let algebraic =
            |out: [R; 4]| quad::energy(cell, metric.varying(number), minus(minus(out, own), kept));
        let middle = Values {
            corners: mean(old.corners, now.corners),
            bubbles: mean(old.bubbles, now.bubbles),
        };
        let share = |by: (R, [R; 4])| {
            let of = |s: Values<R>| share_of_quad(metric, (cell, quad), s, u, by);
            Some((of(now)?, [of(old)?.distance(), of(middle)?.distance()]))
        };
        self.add(cell, (&stored, &change, source), (share, algebraic), sums, fields)
    }

    /// Adds a cell to all ways. `share` gives its terms for a load and outward fluxes, and its share of the distance for s at the beginning
    /// and in the middle of the step; `algebraic` what fluxes of the first way are off by.
    #[inline(always)]
    fn add<const SIDES: usize, const ENTRIES: usize>(
        &self,
        cell: &Cell<R, I, SIDES, ENTRIES>,
        (stored, change, source): (&StoredCell<R>, &Change<R>, R),
        (share, algebraic): (
            impl Fn((R, [R; SIDES])) -> Option<(CellTerms<R>, [[R; 2]; 2])>,
            impl Fn([R; SIDES]) -> R,
        ),
        (ways, inside): &mut Sums<R>,
        fields: &mut [Fields<R>; WAYS],
    ) -> Option<()> {
        let rest = inside.add(stored, change);
        for (at, (way, (tau, indicators))) in ways.iter_mut().zip(fields).enumerate() {
            if tau.is_empty() {
                continue;
            }
            let keep = if at == 0 { R::ONE } else { stored.keep };
            let (balance, out) = balanced(cell, (stored, change, source), keep, tau)?;
            let (mut terms, earlier) = share((balance.load, out))?;
            let of_mean = way.means.add((stored, change, rest), &balance, &out, &mut terms);
            way.earlier.iter_mut().zip(earlier).for_each(|(sum, of)| sum.add(of));
            if features::INDICATORS {
                write(indicators, cell.number.at(), terms.gap + terms.open + of_mean);
            }
            if at == 0 {
                terms.algebraic = algebraic(out);
                way.parts.add(terms);
            } else {
                way.parts.add_of_flux(&terms);
            }
        }
        Some(())
    }
}

/// What all cells add up to, by each way and whatever τ.
pub(super) type Sums<R> = ([Way<R>; WAYS], Inside<R>);

/// Balances a cell as far as it does not keep a part of what it lacks, and gives the fluxes out of it. One that keeps all changes no
/// flux, so that its way out may end on an edge whose flux is given; one that stores nothing keeps nothing.
#[inline(always)]
fn balanced<R: Real, I: Index, const SIDES: usize, const ENTRIES: usize>(
    cell: &Cell<R, I, SIDES, ENTRIES>,
    (stored, change, source): (&StoredCell<R>, &Change<R>, R),
    keep: R,
    tau: &mut [R],
) -> Option<(Balance<R>, [R; SIDES])> {
    let wanted = source - stored.content * change.mean;
    let out = cell.outward(tau)?;
    let lacking = out.iter().fold(-wanted, |rest, &flux| rest - flux);
    if stored.content > R::ZERO && keep == R::ONE {
        return Some((Balance { source, wanted, load: wanted + lacking }, out));
    }
    let load = if stored.content > R::ZERO { wanted + keep * lacking } else { wanted };
    Some((Balance { source, wanted, load }, cell.settle(load, tau)?))
}

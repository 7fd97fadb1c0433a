//! Terms of a step in time, in which s goes linearly from where the step before has left it, and τ stays.

use super::boundary::{self, ends};
use super::parts::Sum;
use super::quad::Values;
use super::walk::{share_of_quad, share_of_triangle};
use super::{CellTerms, Continuous, Discretization, LoadCase};
use crate::cells::{Either, pick};
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::read;
use signorini_kernel::law::Law;
use signorini_kernel::{Index, Real, features};

/// s at the vertices and its bubbles, one per edge, when a step begins and ends; τ by ∫_E τ·n along every edge's direction (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Motion<'a, R> {
    /// s at the beginning.
    pub begin: [&'a [R]; 2],
    /// s at the end.
    pub end: [&'a [R]; 2],
    /// τ
    pub tau: &'a [R],
}

/// Terms for s at the beginning, in the middle and at the end.
#[derive(Clone, Copy, Default)]
struct Three<R> {
    gap: [Sum<R>; 3],
    open: [R; 3],
}

impl<R: Real> Three<R> {
    fn add(&mut self, terms: [[R; 2]; 3]) {
        for ((gap, open), [term, more]) in self.gap.iter_mut().zip(&mut self.open).zip(terms) {
            gap.add(term);
            *open += more;
        }
    }

    fn add_shares(&mut self, shares: [Option<CellTerms<R>>; 3]) -> Option<()> {
        let [begin, middle, end] = shares;
        self.add([begin?, middle?, end?].map(|share| [share.gap, share.open]));
        Some(())
    }

    /// The squares, with what A has above what it is taken for.
    fn squares(&self, missed: R) -> [R; 3] {
        let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
        let mut squares = self.gap.map(|gap| gap.value());
        if features::VARYING || features::PIECES {
            for (square, &open) in squares.iter_mut().zip(&self.open) {
                let seen = (R::ONE + missed) * (root(*square) + root(open));
                *square = seen * seen;
            }
        }
        squares
    }
}

/// The mean of two numbers.
fn mean<R: Real, const N: usize>(mut a: [R; N], b: [R; N]) -> [R; N] {
    a.iter_mut().zip(b).for_each(|(a, b)| *a = R::HALF * *a + R::HALF * b);
    a
}

impl<'a, R: Real> Motion<'a, R> {
    /// ‖A^½∇s − A^{−½}τ‖² + ∫_R (τ·n + h(s − u_ext))²/h for s at the beginning, in the middle and at the end. Extensions of curved
    /// data are left out.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn distances<I: Index>(
        &self,
        discretization: &Discretization<R, I>,
        given: &LoadCase<R, I>,
    ) -> Result<[R; 3], Error> {
        let (cells, metric) = (discretization.cells, discretization.metric);
        let [begin, end] = self.continuous(discretization)?;
        let mut sums = Three::default();
        for cell in cells.from_leaves() {
            let added = match cell {
                Either::Triangle(cell) => cell.outward(self.tau).and_then(|out| {
                    let [now, old] = [end, begin].map(|s| pick(&cell.vertices, s.vertices));
                    let (now, old) = (now?, old?);
                    let by = (balanced(&out), out);
                    sums.add_shares([old, mean(old, now), now].map(|s| {
                        // What u_h has is not asked for.
                        share_of_triangle(metric, cell, s, self.tau, by)
                    }))
                }),
                Either::Quad(cell) => cell.outward(self.tau).and_then(|out| {
                    let number = cell.number.at().wrapping_sub(cells.triangles.len());
                    let (now, old) = (end.in_quad(cell)?, begin.in_quad(cell)?);
                    let middle = Values {
                        corners: mean(old.corners, now.corners),
                        bubbles: mean(old.bubbles, now.bubbles),
                    };
                    let by = (balanced(&out), out);
                    sums.add_shares(
                        [old, middle, now]
                            .map(|s| share_of_quad(metric, (cell, number), s, self.tau, by)),
                    )
                }),
            };
            if added.is_none() {
                break;
            }
        }
        let laws = if features::ROBIN { given.boundary.robin() } else { &[] };
        for (at, law) in laws.iter().enumerate() {
            let edge = law.edge.at();
            let of = |s: Continuous<R>| (ends(discretization, s, edge), [read(s.bubbles, edge)]);
            let (now, old) = (of(end), of(begin));
            let middle = (mean(old.0, now.0), mean(old.1, now.1));
            sums.add([old, middle, now].map(|(s, [bubble])| {
                let transfer = boundary::Transfer { flux: read(self.tau, edge), s, bubble };
                let [term, _, open] = boundary::of_transfer(given, (at, law), &transfer);
                [term, open]
            }));
        }
        Ok(sums.squares(metric.missed))
    }

    /// 2∫_C (τ·n − lo)(s − ψ)⁺ + (hi − τ·n)(ψ − s)⁺ at the beginning, where `openings` are those of s and the gap then, and at the end.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn contacts<I: Index>(
        &self,
        discretization: &Discretization<R, I>,
        given: &LoadCase<R, I>,
        law: Law<R>,
        openings: &[[R; 2]],
    ) -> Result<[R; 2], Error> {
        let [_, s] = self.continuous(discretization)?;
        same_length(Array::Contact, openings.len(), given.ends.gap.len())?;
        let free = discretization.edges.counts().free;
        let mut sums = [R::ZERO; 2];
        for (at, &before) in openings.iter().enumerate() {
            let (range, tau) = (given.boundary.contact_flux(at), read(self.tau, free + at));
            let now = boundary::opening(discretization, given, law, s, at);
            for (sum, opening) in sums.iter_mut().zip([before, now]) {
                *sum += boundary::charge(range, law, tau, opening).0;
            }
        }
        Ok(sums)
    }

    /// Fills in the means of (s − ψ)⁺ and (ψ − s)⁺ along each contact edge at the end; without limits that of s − ψ, and 0.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn openings<I: Index>(
        &self,
        discretization: &Discretization<R, I>,
        given: &LoadCase<R, I>,
        law: Law<R>,
        openings: &mut [[R; 2]],
    ) -> Result<(), Error> {
        let [_, s] = self.continuous(discretization)?;
        same_length(Array::Contact, openings.len(), given.ends.gap.len())?;
        for (at, opening) in openings.iter_mut().enumerate() {
            *opening = boundary::opening(discretization, given, law, s, at);
        }
        Ok(())
    }

    fn continuous<I: Index>(
        &self,
        of: &Discretization<R, I>,
    ) -> Result<[Continuous<'a, R>; 2], Error> {
        same_length(Array::Fluxes, self.tau.len(), of.edges.counts().edges())?;
        for [vertices, _] in [self.begin, self.end] {
            same_length(Array::Vertices, vertices.len(), of.mesh.vertices().len())?;
        }
        Ok([self.begin, self.end].map(|[vertices, bubbles]| Continuous { vertices, bubbles }))
    }
}

/// The load that these outward fluxes balance.
fn balanced<R: Real>(out: &[R]) -> R {
    out.iter().fold(R::ZERO, |sum, &flux| sum - flux)
}

//! A triangle with constant A whose s moves in a step: all that τ does not change is worked out once for every way to balance it.
//!
//! Let d be the fluxes of A∇s − τ through the sides at the end of the step, δ those by which A∇s has changed in it, and
//! Q(d) = ‖A^{−½}d‖² with its product B, as in [`super::triangle`]. Then
//! ```text
//!   at the end Q(d),     at the beginning Q(d − δ) = Q(d) − 2B(d, δ) + Q(δ),     in the middle Q(d) − B(d, δ) + Q(δ)/4
//! ```
//! s of the beginning and of the middle cost one product each way. The linear part of τ is orthogonal to δ.
//!
//! With the weights w of Q no term is larger than Σ|w| (d² + δ²), which may be far above Q where w have two signs, and none is rounded
//! more than 16 times. So
//! ```text
//!   32 ε Σ|w| (d² + δ²)
//! ```
//! is added to both squares.

use super::parts::CellTerms;
use super::triangle::{flows, form, of_means, spread, squares};
use crate::cells::Triangle;
use signorini_kernel::element::crouzeix_raviart::product;
use signorini_kernel::{Index, Real};

pub(super) struct Moving<'a, R, I> {
    cell: &'a Triangle<R, I>,
    /// Fluxes of A∇s at the end.
    end: [R; 3],
    /// B(d, δ) = Σ `product`_i d_i
    product: [R; 3],
    /// Q(δ) and Σδ²
    moved: [R; 2],
    /// Σ of the squares that `end` is a difference of.
    size: R,
    nonconforming: R,
    uncertainty_of_u: R,
}

impl<'a, R: Real, I: Index> Moving<'a, R, I> {
    /// Of s at the vertices at the end and at the beginning, and of the means u over the sides.
    #[inline(always)]
    pub fn new(cell: &'a Triangle<R, I>, [now, old]: [[R; 3]; 2], u: [R; 3]) -> Self {
        let (k, ends) = (&cell.k, [flows(&cell.k, now), flows(&cell.k, old)]);
        let [[t01, t12, t20], [o01, o12, o20]] = ends;
        let end = [t01 - t20, t12 - t01, t20 - t12];
        // Of the differences, which are as exact as the fluxes themselves.
        let [c01, c12, c20] = [t01 - o01, t12 - o12, t20 - o20];
        let delta = [c01 - c20, c12 - c01, c20 - c12];
        let weights = [k[1], k[2], k[0]].map(|entry| -(cell.compliance * entry));
        let own = product(k, &u);
        let jump = [end[0] - own[0], end[1] - own[1], end[2] - own[2]];
        let size = t01 * t01 + t12 * t12 + t20 * t20;
        let product = [weights[0] * delta[0], weights[1] * delta[1], weights[2] * delta[2]];
        Self {
            cell,
            end,
            product,
            moved: [dot(product, delta), dot(delta, delta)],
            size,
            nonconforming: cell.compliance * form(k, jump),
            uncertainty_of_u: cell.uncertainty * (size + of_means(k, u)),
        }
    }

    /// The terms for outward fluxes τ that balance `load`, without their algebraic part, and the squared distances at the beginning
    /// and in the middle.
    #[inline(always)]
    pub fn share(&self, (load, tau): (R, [R; 3])) -> (CellTerms<R>, [[R; 2]; 2]) {
        let (cell, third) = (self.cell, load * R::THIRD);
        let d = [
            self.end[0] - (tau[0] + third),
            self.end[1] - (tau[1] + third),
            self.end[2] - (tau[2] + third),
        ];
        let linear = spread(&cell.k, third);
        let gap = cell.compliance * (form(&cell.k, d) - linear);
        let (cross, [moved, squares_of_moved]) = (dot(self.product, d), self.moved);
        let rounded = R::from_count(32) * R::EPSILON * cell.uncertainty;
        let gap_up = gap + rounded * (dot(d, d) + squares_of_moved);
        let middle = gap_up - cross + R::QUARTER * moved;
        let begin = gap_up - (cross + cross) + moved;
        let terms = squares(tau, load);
        let share = CellTerms {
            gap,
            algebraic: R::ZERO,
            nonconforming: self.nonconforming,
            uncertainty: cell.uncertainty * (terms + self.size),
            uncertainty_of_u: self.uncertainty_of_u,
            terms,
            open: R::ZERO,
        };
        (share, [[begin, R::ZERO], [middle, R::ZERO]])
    }
}

#[inline(always)]
fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::change::mean;
    use crate::certificate::triangle::share;

    /// A triangle with A = 1: K_ij = e_i·e_j/|T| of the sides e.
    fn cell([p, q, r]: [[f64; 2]; 3]) -> Triangle<f64, u16> {
        let side = |from: [f64; 2], to: [f64; 2]| [to[0] - from[0], to[1] - from[1]];
        let [a, b, c] = [side(p, q), side(q, r), side(r, p)];
        let area = 0.5 * (a[0] * b[1] - a[1] * b[0]);
        let k = [(a, b), (b, c), (c, a)].map(|(a, b)| (a[0] * b[0] + a[1] * b[1]) / area);
        let size: f64 = k.iter().map(|entry| entry.abs()).sum();
        Triangle { k, compliance: 0.25, uncertainty: 0.25 * size, ..Triangle::EMPTY }
    }

    /// The squares at the beginning and in the middle are those of s there, and what rounding takes is on top, flat cells included.
    #[test]
    fn earlier_squares_are_those_of_earlier_s() {
        for height in [1.0, 0.1, 1e-3] {
            let cell = cell([[0.0, 0.0], [1.0, 0.0], [0.4, height]]);
            let (now, old, u) = ([0.3, -1.2, 0.7], [1.1, 0.2, -0.4], [0.1, -0.6, 0.8]);
            let by = (0.7, [0.2, -0.9, 1.4]);
            let (terms, earlier) = Moving::new(&cell, [now, old], u).share(by);
            let direct = |s| share(&cell, s, by.1, u, by.0);
            let middle = mean(old, now);
            let size = direct(now).uncertainty + direct(old).uncertainty;
            let near = |what, found: f64, wanted: f64| {
                let over = found - wanted;
                assert!(
                    (0.0..=1000.0 * f64::EPSILON * size).contains(&over),
                    "{what} {height}: {over:e}"
                );
            };
            let [[begin, _], [half, _]] = earlier;
            near("beginning", begin, direct(old).gap);
            near("middle", half, direct(middle).gap);
            assert_eq!(terms.gap, direct(now).gap);
            let uncertainty = direct(now).uncertainty;
            assert!((terms.uncertainty - uncertainty).abs() <= 4.0 * f64::EPSILON * uncertainty);
        }
    }
}

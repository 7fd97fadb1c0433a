//! The nonconforming elements: one on triangles, two on quads. Degrees of freedom are edge means.
//!
//! An element matrix K_T has zero row sums (the basis functions add up to 1), so its off-diagonal
//! entries are the whole of it, and every product with it can be written with differences,
//! (K_T u)_i = Σ_j K_ij (u_j − u_i): what flows through the sides of a cell then adds up to zero for
//! any u at all. Stored are the entries above the diagonal:
//! ```text
//!   triangle [01, 12, 20]              quad [01, 02, 03, 12, 13, 23]
//! ```
//! On a triangle, what couples side k to the next one stands at k, to the one before at k − 1.

pub mod crouzeix_raviart;
pub mod nonparametric;
pub mod rannacher_turek;

use nalgebra::Vector2;

use crate::index::read;
use crate::{Real, Tensor};
use rannacher_turek::MappedPoint;

/// Which functions u_h is made of on quads. On parallelograms they are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum QuadElement {
    /// [`rannacher_turek`]: the same functions on the unit square for all quads.
    #[default]
    Parametric,
    /// [`nonparametric`]: quadratic functions of the place, with all linear ones among them.
    Nonparametric,
}

impl QuadElement {
    /// K_T as [`rannacher_turek::stiffness`] and [`nonparametric::stiffness`] integrate it.
    #[inline(always)]
    pub fn stiffness<R: Real>(
        self,
        quad: [[R; 2]; 4],
        rule: &[[R; 2]],
        tensor: impl FnMut(usize, &MappedPoint<R>) -> Tensor<R>,
    ) -> [R; 6] {
        match self {
            Self::Parametric => rannacher_turek::stiffness(quad, rule, tensor),
            Self::Nonparametric => nonparametric::stiffness(quad, rule, tensor),
        }
    }

    /// φ₀ … φ₃ at reference coordinates (x̂, ŷ) of `quad`.
    pub fn basis<R: Real>(self, quad: [[R; 2]; 4], reference: [R; 2]) -> [R; 4] {
        match self {
            Self::Parametric => rannacher_turek::place(quad, reference).basis(),
            Self::Nonparametric => nonparametric::axes(quad).basis(reference),
        }
    }

    /// ∇u_h there, from the means of u_h over the sides.
    pub fn gradient<R: Real>(
        self,
        quad: [[R; 2]; 4],
        reference: [R; 2],
        means: [R; 4],
    ) -> Vector2<R> {
        match self {
            Self::Parametric => rannacher_turek::place(quad, reference).gradient(means),
            Self::Nonparametric => nonparametric::axes(quad).gradient(reference, means),
        }
    }
}

/// Σ_p weight_p (A_p g_i)·g_j for i < j, over the points of the square of `rule`: `at` takes the number
/// of a point, its place and its weight, and gives A_p, weight_p and g₀ … g₃.
#[inline(always)]
fn above_diagonal<R: Real>(
    rule: &[[R; 2]],
    mut at: impl FnMut(usize, [R; 2], R) -> (Tensor<R>, R, [Vector2<R>; 4]),
) -> [R; 6] {
    let mut k = [R::ZERO; 6];
    for (row, &[y, weight_y]) in rule.iter().enumerate() {
        for (column, &[x, weight_x]) in rule.iter().enumerate() {
            let point = row * rule.len() + column;
            let (a, weight, [g0, g1, g2, g3]) = at(point, [x, y], weight_x * weight_y);
            let (a0, a1, a2) = (a.apply(g0) * weight, a.apply(g1) * weight, a.apply(g2) * weight);
            let terms =
                [a0.dot(&g1), a0.dot(&g2), a0.dot(&g3), a1.dot(&g2), a1.dot(&g3), a2.dot(&g3)];
            for (entry, addend) in k.iter_mut().zip(terms) {
                *entry += addend;
            }
        }
    }
    k
}

/// Where entry (i, j), i ≠ j, of an element matrix with `sides` rows stands.
#[inline(always)]
pub fn entry(sides: usize, i: usize, j: usize) -> usize {
    let (low, high) = if i < j { (i, j) } else { (j, i) };
    match sides {
        3 if high - low == 1 => low,
        3 => 2,
        _ => low + high - usize::from(low == 0),
    }
}

/// The diagonal entry of row i: minus the sum of the others.
#[inline(always)]
fn diagonal<R: Real>(sides: usize, k: &[R], i: usize) -> R {
    let others = (0..sides).filter(|&j| j != i);
    others.fold(R::ZERO, |sum, j| sum - read(k, entry(sides, i, j)))
}

/// Copies the entries of one side's row counterclockwise; returns the diagonal one.
#[inline(always)]
pub(crate) fn copy_row<'v, R: Real + 'v>(
    k: &[R],
    sides: usize,
    side: usize,
    places: &mut impl Iterator<Item = &'v mut R>,
) -> R {
    for step in 1..sides {
        if let Some(place) = places.next() {
            *place = read(k, entry(sides, side, (side + step) % sides));
        }
    }
    diagonal(sides, k, side)
}

/// The two entries of a triangle's side in an array of all triangles' entries: towards the next side
/// and the one before. `None` where `half_edge` is beyond them.
#[inline(always)]
pub(crate) fn adjacent<R: Copy>(k: &[R], half_edge: usize) -> Option<[R; 2]> {
    let next = *k.get(half_edge)?;
    // Two reads, not one at a chosen position: one instruction less for each.
    let first = half_edge.is_multiple_of(3);
    let before = if first { *k.get(half_edge + 2)? } else { *k.get(half_edge - 1)? };
    Some([next, before])
}

//! A in a cell where it varies: on each piece of the cell a polynomial p below A, and what A has above p at most.
//!
//! ```text
//!   p ≤ A ≤ p + N,   N ≤ ν p,   (1 − η) p̄ ≤ p ≤ (1 + η) p̄        as forms, in the whole piece
//! ```
//! p has degree 2 in the reference coordinates of the piece, p̄ is its constant coefficient, N is constant. What that makes of a bound, for
//! any flux τ and gradient v:
//! ```text
//!   ‖A^{−½}(τ − Av)‖ ≤ ‖p^{−½}(τ − pv)‖ + ‖N′^½v‖,   N′ = min(1, ν) N
//!   ∫ over the piece  ≤ (1 + ηᵏ⁺¹)/(1 − ηᵏ⁺¹) Σ over n×n points
//! ```
//! Since p ≤ A, |A^{−½}·| ≤ |p^{−½}·|; and with X = A − p, XA⁻¹X is at most X and at most Xp⁻¹X ≤ νX. For the points: with
//! p = p̄^½(1 + E)p̄^½ the polynomial q = p̄^{−½}(1 − E + … ± Eᵏ)p̄^{−½} is p⁻¹ up to a factor 1 ± Eᵏ⁺¹, and a rule of n points that is exact
//! for polynomials as long as (τ − pv)·q(τ − pv) integrates that exactly. (On quads that are no parallelograms the map has a share in it,
//! which is that of a constant A.)

mod enclosed;
mod piece;
mod rows;
#[cfg(test)]
mod tests;

use signorini_kernel::Tensor;
use signorini_scene::expression::enclosure::Region;
use signorini_scene::scene::Material;

use crate::cell::Cell;
use crate::quadrature::refined::{Part, refined};
use crate::quadrature::{DATA_POINTS, Point, enclosed as by_cells, gauss};
use crate::tensors::{average, scaled};

use enclosed::parts;
use piece::{MISSED, ROUNDING};
pub use piece::{Piece, PiecePoint};
pub use rows::{Cut, Root, Rows};

/// Points in a direction where functions are smooth and no more.
const MANY_POINTS: usize = 12;

/// A on the pieces of a cell in which it varies.
#[derive(Debug, Clone)]
pub struct Pieces {
    /// One where the cell's own points resolve A.
    pub all: Vec<Piece>,
    /// What ‖N′^½v‖ is of ‖(A − Ā)v‖ in A^{−½}, about: the part that is not seen of what can be seen.
    pub left: f64,
    is_resolved: bool,
}

impl Pieces {
    /// A of `material` on a cell, cut no more than so often until so much is `left`.
    pub fn new(material: &Material, cell: Cell, (most, left): (usize, f64)) -> Self {
        let whole = by_cells::region(cell);
        let [flat, best] = Piece::both(material, whole);
        let variation = flat.share.clamp(ROUNDING, 1.0);
        let missed = |piece: &Piece| match piece.share.is_finite() {
            true => piece.share.min(1.0) * flat.relative(&piece.above),
            false => f64::INFINITY,
        };
        let of_whole = missed(&best);
        let is_enough = |size: f64, missed: f64| missed <= (left * variation).powi(2) * size;
        let is_seen = best.missed_by(cell, DATA_POINTS).is_some_and(|missed| missed <= MISSED);
        if most == 0 || is_enough(1.0, of_whole) {
            let is_resolved = is_seen && best.share.is_finite();
            return Self { left: of_whole.sqrt() / variation, all: vec![best], is_resolved };
        }
        let part = |region: &Region| {
            let piece = Piece::of(material, *region);
            [region.measure(), region.measure() * missed(&piece)]
        };
        let cut = |region: &Region| Some(parts(material, region));
        let parts = refined(cut, [(0, whole)], most, is_enough, |_, region| part(region));
        let all: f64 = parts.iter().map(|part| part.missed / whole.measure()).sum();
        let piece = |part: Part| Piece::of(material, part.region);
        let all_pieces = parts.into_iter().map(piece).collect();
        Self { left: all.sqrt() / variation, all: all_pieces, is_resolved: false }
    }

    /// A over a power of two.
    #[must_use]
    pub fn divided(&self, by: f64) -> Self {
        Self { all: self.all.iter().map(|piece| piece.divided(by)).collect(), ..*self }
    }

    /// Whether the points of the cell itself resolve A.
    pub fn is_resolved(&self) -> bool {
        self.is_resolved
    }

    /// A point near which A is not proved to be positive definite and bounded.
    pub fn unproved(&self) -> Option<[f64; 2]> {
        let open = self.all.iter().find(|piece| !piece.share.is_finite());
        open.map(Piece::centre)
    }

    /// ν, the most of all pieces.
    pub fn share(&self) -> f64 {
        self.all.iter().fold(0.0, |most, piece| most.max(piece.share))
    }

    /// Part of the root of an integral that the rule misses: κ, and ν where it has A in the place of p.
    pub fn slack(&self, cell: Cell) -> f64 {
        let power = match self.is_resolved() {
            true => self.all[0].missed_by(cell, DATA_POINTS).unwrap_or(f64::INFINITY),
            false => self.all.iter().map(|piece| piece.rule(cell).1).fold(0.0, f64::max),
        };
        let share = if self.is_resolved() { self.share() } else { 0.0 };
        share + ((1.0 + power) / (1.0 - power)).sqrt() - 1.0
    }

    /// A tensor below A all over the piece, for each.
    pub fn floors(&self) -> impl Iterator<Item = Tensor<f64>> + '_ {
        self.all.iter().map(Piece::floor)
    }

    /// The points of a rule on a cell whose own points resolve A, with A there. What points see of √∫ is known within √(1 + ν) and 2N′.
    pub fn resolved(&self, point: Point, a: Tensor<f64>) -> PiecePoint {
        let [piece, ..] = &self.all[..] else { return PiecePoint::known(point, a) };
        PiecePoint { point, below: a, above: scaled(&piece.above, 4.0), share: piece.share }
    }

    /// The mean of p + ½N, which is that of A where no piece leaves anything open.
    pub fn mean(&self, cell: Cell) -> Tensor<f64> {
        let points = self.points(cell);
        average(points.map(|of| (of.point.weight, of.middle())))
    }

    /// The largest eigenvalue of A relative to a tensor.
    pub fn most(&self, to: &Tensor<f64>) -> f64 {
        self.all.iter().map(|piece| piece.most(to)).fold(0.0, f64::max)
    }

    /// The points of every piece.
    pub fn points(&self, cell: Cell) -> impl Iterator<Item = PiecePoint> + '_ {
        self.all.iter().flat_map(move |piece| piece.points(cell, &gauss(piece.rule(cell).0)))
    }

    /// More points, for functions that are no polynomials in the cell.
    pub fn many_points(&self, cell: Cell) -> impl Iterator<Item = PiecePoint> + '_ {
        let rule = gauss(MANY_POINTS);
        self.all.iter().flat_map(move |piece| piece.points(cell, &rule))
    }
}

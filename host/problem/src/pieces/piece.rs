//! A on one piece of a cell, enclosed.

use signorini_kernel::Tensor;
use signorini_scene::expression::enclosure::{Region, Shape};
use signorini_scene::scene::Material;

use super::enclosed::Enclosed;
use crate::cell::Cell;
use crate::quadrature::{DATA_POINTS, Point, on_quad, on_triangle};
use crate::tensors::{self, modulus, scaled, size_in, sum};

/// The most of ξ, η, ξ², ξη and η² on a triangle.
const IN_TRIANGLE: [f64; 5] = [2.0 / 3.0, 2.0 / 3.0, 4.0 / 9.0, 2.0 / 9.0, 4.0 / 9.0];
/// A variation of A that rounding makes.
pub(super) const ROUNDING: f64 = 1e-10;
/// Of the root of an integral over a piece twice this may be missed.
pub(super) const MISSED: f64 = 4e-3;
/// The most that p may vary in a piece, as η.
const VARIES: f64 = 0.5;
/// Points in a direction, at most.
const MOST_POINTS: usize = 16;

/// A on a piece of a cell.
#[derive(Debug, Clone)]
pub struct Piece {
    region: Region,
    /// Of 1, ξ, η, ξ², ξη, η².
    below: [Tensor<f64>; 6],
    /// N
    pub above: Tensor<f64>,
    /// ν, infinite where A is not proved to be positive definite and bounded.
    pub share: f64,
    /// η
    pub varies: f64,
}

/// A point of a piece, as one of the cell, with p there and N′ and N of the piece.
#[derive(Debug, Clone, Copy)]
pub struct PiecePoint {
    /// Where it is in the cell.
    pub point: Point,
    /// p
    pub below: Tensor<f64>,
    /// N
    pub above: Tensor<f64>,
    /// min(1, ν)
    pub share: f64,
}

impl PiecePoint {
    /// A point at which A is `a`, and known to be.
    pub fn known(point: Point, a: Tensor<f64>) -> Self {
        Self { point, below: a, above: Tensor::default(), share: 0.0 }
    }

    /// |N′^½v|, at least |A^{−½}(A − p)v|.
    pub fn open(&self, [x, y]: [f64; 2]) -> f64 {
        let Tensor { xx, xy, yy } = self.above;
        (self.share * (xx * x * x + 2.0 * xy * x * y + yy * y * y)).max(0.0).sqrt()
    }

    /// p + ½N
    pub fn middle(&self) -> Tensor<f64> {
        sum(&self.below, &scaled(&self.above, 0.5))
    }
}

impl Piece {
    /// A with a constant p, and with the better p.
    pub(super) fn both(material: &Material, region: Region) -> [Self; 2] {
        let a = Enclosed::new(material, &region);
        let flat = Self::flat(material, &a, region);
        let curved = Self::curved(&a, region).filter(|curved| curved.share <= flat.share);
        let better = curved.unwrap_or_else(|| flat.clone());
        [flat, better]
    }

    /// A with the better p.
    pub(super) fn of(material: &Material, region: Region) -> Self {
        let [_, better] = Self::both(material, region);
        better
    }

    /// With p of degree 2, where that varies little.
    fn curved(a: &Enclosed, region: Region) -> Option<Self> {
        let mut below = [0, 1, 2, 3, 4, 5].map(|k| a.changes(|of| of.coefficients[k]));
        below[0] = a.values(|of| of.coefficients[0] + of.remainder.middle());
        let down = a.distance(|of| 0.5 * of.remainder.width(), &below[0]);
        let piece = Self::less(below, &down, region)?;
        let varies = piece.terms().map(|of| piece.size_of(&of)).sum::<f64>();
        let piece = Self { varies, share: piece.share / (1.0 - varies), ..piece };
        (varies <= VARIES).then_some(piece)
    }

    /// With a constant p; with A of the centre and an infinite ν where nothing is proved.
    fn flat(material: &Material, a: &Enclosed, region: Region) -> Self {
        let mut below = [Tensor::default(); 6];
        below[0] = a.values(|of| of.range().middle());
        let down = a.distance(|of| 0.5 * of.range().width(), &below[0]);
        let found = Self::less(below, &down, region).filter(|_| a.is_finite());
        found.unwrap_or_else(|| {
            below[0] = tensors::at(material, region.centre());
            let above = Tensor::default();
            Self { region, below, above, share: f64::INFINITY, varies: 0.0 }
        })
    }

    /// Lowers `below` by D; N = 2D.
    fn less(mut below: [Tensor<f64>; 6], down: &Tensor<f64>, region: Region) -> Option<Self> {
        below[0] = sum(&below[0], &scaled(down, -1.0));
        let is_below = below[0].is_positive_definite();
        let piece = Self { region, below, above: scaled(down, 2.0), share: 0.0, varies: 0.0 };
        let share = piece.size_of(&piece.above);
        (is_below && share.is_finite()).then_some(Self { share, ..piece })
    }

    /// The coefficients of p but the first, each as large as its monomial makes it.
    fn terms(&self) -> impl Iterator<Item = Tensor<f64>> + '_ {
        let most = match self.region.shape() {
            Shape::Triangle => IN_TRIANGLE,
            _ => [1.0; 5],
        };
        self.below[1..].iter().zip(most).map(|(of, most)| scaled(of, most))
    }

    /// The largest modulus of an eigenvalue of p̄^{−½} T p̄^{−½}.
    fn size_of(&self, of: &Tensor<f64>) -> f64 {
        size_in(&self.below[0], of)
    }

    /// That of N against the A of this piece at its largest, p̄ + N.
    pub(super) fn relative(&self, above: &Tensor<f64>) -> f64 {
        size_in(&sum(&self.below[0], &self.above), above)
    }

    /// η to the power of what a rule of so many points in a direction leaves in this cell; nothing where it is not exact for constants.
    pub(super) fn missed_by(&self, cell: Cell, points: usize) -> Option<f64> {
        let square = match (cell, self.varies > 0.0) {
            (Cell::Triangle(_), false) => 2,
            (Cell::Triangle(_), true) | (Cell::Quad(_), false) => 4,
            (Cell::Quad(_), true) => 8,
        };
        let lost = if self.region.shape() == Shape::Quad { 1 } else { 2 };
        let k = (2 * points).checked_sub(lost + square)? / 2;
        Some(self.varies.powi(k as i32 + 1))
    }

    /// Points in a direction that it takes in this cell, and what they leave.
    pub(super) fn rule(&self, cell: Cell) -> (usize, f64) {
        let missed = |points: usize| Some((points, self.missed_by(cell, points)?));
        // Where the map is no polynomial the points are those of a constant A, at least.
        let least = if cell.is_affine() { 2 } else { DATA_POINTS };
        let mut all = (least..=MOST_POINTS).filter_map(missed);
        all.find(|(_, missed)| *missed <= MISSED).unwrap_or((MOST_POINTS, f64::INFINITY))
    }

    /// The points of a rule, as those of the cell.
    pub(super) fn points(&self, cell: Cell, rule: &[[f64; 2]]) -> Vec<PiecePoint> {
        let share = self.share.min(1.0);
        let here = |own: Point| {
            let [first, second, third] = own.reference;
            let at = match self.region.shape() {
                Shape::Triangle => [second - 1.0 / 3.0, third - 1.0 / 3.0],
                _ => [2.0 * first - 1.0, 2.0 * second - 1.0],
            };
            let point = Point { reference: cell.reference(own.x), ..own };
            PiecePoint { point, below: self.at(at), above: self.above, share }
        };
        match *self.region.corners() {
            [a, b, c] => on_triangle([a, b, c], rule).map(here).collect(),
            [a, b, c, d] => on_quad([a, b, c, d], rule).map(here).collect(),
            _ => Vec::new(),
        }
    }

    /// A point of it, as coordinates in \[0, 1\]² tell, with p there.
    #[cfg(test)]
    pub(super) fn place(&self, [s, t]: [f64; 2]) -> ([f64; 2], Tensor<f64>) {
        let at = match self.region.shape() {
            Shape::Triangle => [s * (1.0 - t) - 1.0 / 3.0, t - 1.0 / 3.0],
            _ => [2.0 * s - 1.0, 2.0 * t - 1.0],
        };
        (self.region.place(at), self.at(at))
    }

    /// The largest eigenvalue of A relative to a tensor.
    pub(super) fn most(&self, to: &Tensor<f64>) -> f64 {
        let most = scaled(&self.below[0], 1.0 + self.varies);
        size_in(to, &sum(&most, &self.above))
    }

    /// A tensor below A all over it: p̄ less what its other terms take away, or less a part of itself.
    pub(super) fn floor(&self) -> Tensor<f64> {
        let less = |a: Tensor<f64>, of: Tensor<f64>| sum(&a, &scaled(&modulus(&of), -1.0));
        let floor = self.terms().fold(self.below[0], less);
        match floor.is_positive_definite() {
            true => floor,
            false => scaled(&self.below[0], 1.0 - self.varies),
        }
    }

    pub(super) fn centre(&self) -> [f64; 2] {
        self.region.centre()
    }

    pub(super) fn divided(&self, by: f64) -> Self {
        let divided = |of: &Tensor<f64>| scaled(of, 1.0 / by);
        let below = self.below.each_ref().map(divided);
        Self { below, above: divided(&self.above), ..self.clone() }
    }

    /// p at reference coordinates of the piece.
    fn at(&self, [x, y]: [f64; 2]) -> Tensor<f64> {
        let monomials = [1.0, x, y, x * x, x * y, y * y];
        let terms = self.below.iter().zip(monomials);
        terms.fold(Tensor::default(), |all, (of, factor)| sum(&all, &scaled(of, factor)))
    }
}

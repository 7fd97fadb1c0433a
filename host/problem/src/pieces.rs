//! A in a cell where it varies: on each piece of the cell a polynomial p below A, and what A has above p at most.
//!
//! ```text
//!   p ≤ A ≤ p + N,   N ≤ ν p,   (1 − η) p̄ ≤ p ≤ (1 + η) p̄        as forms, in the whole piece
//! ```
//! p has degree 2 in the reference coordinates of the piece, p̄ is its constant coefficient, N is constant. What that makes of a bound, for
//! any flux τ and gradient v:
//! ```text
//!   ‖A^{−½}(τ − Av)‖ ≤ ‖p^{−½}(τ − pv)‖ + ‖N′^½v‖,   N′ = min(1, ν) N
//!   ∫ over the piece  ≤ (1 + κ) Σ over 8×8 points,     κ ≈ 2 η⁴
//! ```
//! Since p ≤ A, |A^{−½}·| ≤ |p^{−½}·|; and with X = A − p, XA⁻¹X is at most X and at most Xp⁻¹X ≤ νX. For κ: with p = p̄^½(1 + E)p̄^½ the
//! polynomial q = p̄^{−½}(1 − E + E² − E³)p̄^{−½} is p⁻¹ up to the factor 1 − E⁴, and the rule integrates (τ − pv)·q(τ − pv) exactly: of degree 14 in
//! all on triangles; in each coordinate, 2·(2 + 2) + 2·3 ≤ 15 on parallelograms. (On other quads the map has a share in it, which is that of a
//! constant A.)

use signorini_kernel::{Real, Tensor};
use signorini_scene::expression::Expression;
use signorini_scene::expression::enclosure::{Form, Region, Shape};
use signorini_scene::scene::{Located, Material};

use crate::cell::Cell;
use crate::integrals::average;
use crate::quadrature::refined::{Part, refined};
use crate::quadrature::{DATA_POINTS, Point, enclosed, on_quad, on_triangle};

/// A variation of A that rounding makes.
const ROUNDING: f64 = 1e-10;
/// Of the root of an integral over a piece twice this may be missed.
const MISSED: f64 = 1e-3;
/// The most that p may vary in a piece, as η: κ is 2e−3 then.
const VARIES: f64 = 0.18;
/// Pieces are small enough where ‖N′^½v‖ is this part of what the variation of A makes of ‖A^½v‖.
const LEFT: f64 = 1e-3;

/// A on a piece of a cell.
#[derive(Debug, Clone)]
pub struct Piece {
    region: Region,
    /// Of 1, ξ, η, ξ², ξη, η².
    below: [Tensor<f64>; 6],
    /// N, which is diagonal.
    pub above: [f64; 2],
    /// ν, infinite where A is not proved to be positive definite and bounded.
    pub share: f64,
    /// η
    pub varies: f64,
}

/// A on the pieces of a cell in which it varies.
#[derive(Debug, Clone)]
pub struct Pieces {
    /// One where the cell's own points resolve A.
    pub all: Vec<Piece>,
    /// What ‖N′^½v‖ is of ‖(A − Ā)v‖ in A^{−½}, about: the part that is not seen of what can be seen.
    pub left: f64,
}

/// A point of a piece, as one of the cell, with p there and N′ and N of the piece.
#[derive(Debug, Clone, Copy)]
pub struct PiecePoint {
    /// Where it is in the cell.
    pub point: Point,
    /// p
    pub below: Tensor<f64>,
    /// N, which is diagonal.
    pub above: [f64; 2],
    /// min(1, ν)
    pub share: f64,
}

impl PiecePoint {
    /// A point at which A is `a`, and known to be.
    pub fn known(point: Point, a: Tensor<f64>) -> Self {
        Self { point, below: a, above: [0.0; 2], share: 0.0 }
    }

    /// |N′^½v|, at least |A^{−½}(A − p)v|.
    pub fn open(&self, [x, y]: [f64; 2]) -> f64 {
        let [xx, yy] = self.above;
        (self.share * (xx * x * x + yy * y * y)).sqrt()
    }

    /// p + ½N
    pub fn middle(&self) -> Tensor<f64> {
        sum(&self.below, &diagonal(self.above.map(|x| 0.5 * x)))
    }
}

impl Pieces {
    /// A of `material` on a cell, of no more than so many pieces.
    pub fn new(material: &Material, cell: Cell, most: usize) -> Self {
        let whole = enclosed::region(cell);
        let flat = Piece::flat(material, &forms(material, &whole), whole);
        let variation = flat.share.clamp(ROUNDING, 1.0);
        let part = |region: &Region| {
            let piece = Piece::of(material, *region);
            let missed = match piece.share.is_finite() {
                true => piece.share.min(1.0) * flat.relative(piece.above),
                false => f64::INFINITY,
            };
            [region.measure(), region.measure() * missed]
        };
        let [value, missed] = part(&whole);
        let is_enough = |size: f64, missed: f64| missed <= (LEFT * variation).powi(2) * size;
        let whole = Part { of: 0, region: whole, value, missed };
        let cut = |region: &Region| Some(parts(material, region));
        let parts = refined(cut, vec![whole], most, is_enough, |_, region| part(region));
        let missed: f64 = parts.iter().map(|part| part.missed / value).sum();
        let piece = |part: Part| Piece::of(material, part.region);
        let left = missed.sqrt() / variation;
        Self { all: parts.into_iter().map(piece).collect(), left }
    }

    /// Whether there is more to cut, with more pieces.
    pub fn is_open(&self) -> bool {
        self.left > LEFT || !self.left.is_finite()
    }

    /// Whether the points of the cell itself resolve A.
    pub fn is_resolved(&self) -> bool {
        self.all.len() == 1 && self.unproved().is_none()
    }

    /// A point near which A is not proved to be positive definite and bounded.
    pub fn unproved(&self) -> Option<[f64; 2]> {
        let open = self.all.iter().find(|piece| !piece.share.is_finite());
        open.map(|piece| piece.region.centre())
    }

    /// ν, the most of all pieces.
    pub fn share(&self) -> f64 {
        self.all.iter().fold(0.0, |most, piece| most.max(piece.share))
    }

    /// Part of the root of an integral that the rule misses: κ, and ν where it has A in the place of p.
    pub fn slack(&self, cell: Cell) -> f64 {
        let power = match self.is_resolved() {
            true => self.all[0].varies.powi(4),
            false => self.all.iter().map(|piece| piece.rule(cell).1).fold(0.0, f64::max),
        };
        let share = if self.is_resolved() { self.share() } else { 0.0 };
        share + ((1.0 + power) / (1.0 - power)).sqrt() - 1.0
    }

    /// A tensor below A all over the piece, for each.
    pub fn floors(&self) -> impl Iterator<Item = Tensor<f64>> + '_ {
        self.all.iter().map(|piece| scaled(&piece.below[0], 1.0 - piece.varies))
    }

    /// The points of a rule on a cell whose own points resolve A, with A there. What points see of √∫ is known within √(1 + ν) and 2N′.
    pub fn resolved(&self, point: Point, a: Tensor<f64>) -> PiecePoint {
        let [piece, ..] = &self.all[..] else { return PiecePoint::known(point, a) };
        PiecePoint { point, below: a, above: piece.above.map(|n| 4.0 * n), share: piece.share }
    }

    /// The mean of p + ½N, which is that of A where no piece leaves anything open.
    pub fn mean(&self, cell: Cell) -> Tensor<f64> {
        let points = self.points(cell);
        average(points.map(|of| (of.point.weight, of.middle())))
    }

    /// The largest eigenvalue of A relative to a tensor.
    pub fn most(&self, to: &Tensor<f64>) -> f64 {
        let above = |piece: &Piece| {
            let most = scaled(&piece.below[0], 1.0 + piece.varies);
            size_in(to, &sum(&most, &diagonal(piece.above)))
        };
        self.all.iter().map(above).fold(0.0, f64::max)
    }

    /// The 8×8 points of every piece.
    pub fn points(&self, cell: Cell) -> impl Iterator<Item = PiecePoint> + '_ {
        self.all.iter().flat_map(move |piece| piece.points(cell))
    }
}

impl Piece {
    fn of(material: &Material, region: Region) -> Self {
        let forms = forms(material, &region);
        let flat = Self::flat(material, &forms, region);
        match Self::curved(&forms, region) {
            Some(curved) if curved.share <= flat.share => curved,
            _ => flat,
        }
    }

    /// With p of degree 2, where that varies little.
    fn curved(forms: &[Form; 3], region: Region) -> Option<Self> {
        let mut below =
            [0, 1, 2, 3, 4, 5].map(|k| tensor(forms.each_ref().map(|of| of.coefficients[k])));
        let rest = forms.each_ref().map(|of| [of.remainder.middle(), 0.5 * of.remainder.width()]);
        below[0] = sum(&below[0], &tensor(rest.map(|of| of[0])));
        let piece = Self::less(below, rest.map(|of| of[1]), region)?;
        let varies = piece.below[1..].iter().map(|of| piece.size_of(of)).sum::<f64>();
        let piece = Self { varies, share: piece.share / (1.0 - varies), ..piece };
        (varies <= VARIES).then_some(piece)
    }

    /// With a constant p; with A of the centre and an infinite ν where nothing is proved.
    fn flat(material: &Material, forms: &[Form; 3], region: Region) -> Self {
        let ranges = forms.each_ref().map(Form::range);
        let mut below = [Tensor::default(); 6];
        below[0] = tensor(ranges.map(|of| of.middle()));
        let found = Self::less(below, ranges.map(|of| 0.5 * of.width()), region);
        let is_defined = forms.iter().all(Form::is_finite);
        found.filter(|_| is_defined).unwrap_or_else(|| {
            let [x, y] = region.centre();
            below[0] =
                tensor(material.conductivity.each_ref().map(|entry| entry.value.eval(x, y, 0.0)));
            let above = [0.0; 2];
            Self { region, below, above, share: f64::INFINITY, varies: 0.0 }
        })
    }

    /// Lowers `below` by D ≥ |A − below|, entries of which are within `off`; N = 2D.
    fn less(mut below: [Tensor<f64>; 6], off: [f64; 3], region: Region) -> Option<Self> {
        let Tensor { xx, yy, .. } = below[0];
        let rounding = 16.0 * f64::EPSILON;
        let [of_xx, of_xy, of_yy] = off;
        let ratio = (xx / yy).sqrt();
        // ±2ab ≤ sa² + b²/s. What is exact is not lowered.
        let down = match off == [0.0; 3] {
            true => [0.0; 2],
            false => [of_xx + of_xy * ratio + rounding * xx, of_yy + of_xy / ratio + rounding * yy],
        };
        below[0] = sum(&below[0], &diagonal(down.map(|x| -x)));
        let is_below = below[0].is_positive_definite();
        let above = down.map(|x| 2.0 * x);
        let piece = Self { region, below, above, share: 0.0, varies: 0.0 };
        let share = piece.size_of(&diagonal(above));
        (is_below && share.is_finite()).then_some(Self { share, ..piece })
    }

    /// The largest modulus of an eigenvalue of p̄^{−½} T p̄^{−½}.
    fn size_of(&self, of: &Tensor<f64>) -> f64 {
        size_in(&self.below[0], of)
    }

    /// That of N against the A of this piece at its largest, p̄ + N.
    fn relative(&self, above: [f64; 2]) -> f64 {
        size_in(&sum(&self.below[0], &diagonal(self.above)), &diagonal(above))
    }

    /// Points in a direction that it takes in this cell, and η to the power of what they leave.
    fn rule(&self, cell: Cell) -> (usize, f64) {
        let square = match (cell, self.varies > 0.0) {
            (Cell::Triangle(_), false) => 2,
            (Cell::Triangle(_), true) | (Cell::Quad(_), false) => 4,
            (Cell::Quad(_), true) => 8,
        };
        let lost = if self.region.shape() == Shape::Quad { 1 } else { 2 };
        let missed = |points: usize| {
            let k = (2 * points).checked_sub(lost + square)? / 2;
            Some((points, self.varies.powi(k as i32 + 1)))
        };
        let enough = (2..=DATA_POINTS).filter_map(missed).find(|(_, missed)| *missed <= MISSED);
        enough.unwrap_or((DATA_POINTS, self.varies.powi(4)))
    }

    fn points(&self, cell: Cell) -> Vec<PiecePoint> {
        let (points, _) = self.rule(cell);
        let rule = f64::GAUSS[points - 1];
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

    /// p at reference coordinates of the piece.
    fn at(&self, [x, y]: [f64; 2]) -> Tensor<f64> {
        let monomials = [1.0, x, y, x * x, x * y, y * y];
        let terms = self.below.iter().zip(monomials);
        terms.fold(Tensor::default(), |all, (of, factor)| sum(&all, &scaled(of, factor)))
    }
}

/// Parts of a region along a jump or a kink of A, or across the direction in which it varies most.
fn parts(material: &Material, region: &Region) -> Vec<Region> {
    let switch = material.conductivity.iter().find_map(|of| of.value.switch(region, 0.0));
    let along = switch.and_then(|zero| region.cut(&zero));
    let slope = |entry: &Located<Expression>, way: [f64; 2]| {
        entry.value.enclose_slope(region, 0.0, way)[1].range().size()
    };
    let entries = &material.conductivity[..if material.is_scalar { 1 } else { 3 }];
    let steepest = |way: [f64; 2]| entries.iter().map(|of| slope(of, way)).fold(0.0, f64::max);
    along.unwrap_or_else(|| region.parts_across(steepest))
}

fn forms(material: &Material, region: &Region) -> [Form; 3] {
    let [xx, xy, yy] = &material.conductivity;
    let form = |entry: &Located<Expression>| entry.value.enclose(region, 0.0);
    let first = form(xx);
    [first, form(xy), if material.is_scalar { first } else { form(yy) }]
}

fn diagonal([xx, yy]: [f64; 2]) -> Tensor<f64> {
    Tensor { xx, xy: 0.0, yy }
}

fn tensor([xx, xy, yy]: [f64; 3]) -> Tensor<f64> {
    Tensor { xx, xy, yy }
}

fn sum(a: &Tensor<f64>, b: &Tensor<f64>) -> Tensor<f64> {
    Tensor { xx: a.xx + b.xx, xy: a.xy + b.xy, yy: a.yy + b.yy }
}

fn scaled(a: &Tensor<f64>, by: f64) -> Tensor<f64> {
    Tensor { xx: by * a.xx, xy: by * a.xy, yy: by * a.yy }
}

/// The largest modulus of an eigenvalue of L⁻¹ T L⁻ᵀ, LLᵀ = `to`.
fn size_in(to: &Tensor<f64>, of: &Tensor<f64>) -> f64 {
    let first = to.xx.sqrt();
    let slope = to.xy / to.xx;
    let last = (to.yy - slope * to.xy).sqrt();
    let xx = of.xx / first / first;
    let xy = (of.xy - slope * of.xx) / first / last;
    let yy = (of.yy - 2.0 * slope * of.xy + slope * slope * of.xx) / last / last;
    let (half, apart) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    let size = half.abs() + apart;
    if size.is_nan() { f64::INFINITY } else { size }
}

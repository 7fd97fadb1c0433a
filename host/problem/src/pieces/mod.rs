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

mod rows;

use signorini_kernel::Tensor;
use signorini_scene::expression::Expression;
use signorini_scene::expression::enclosure::{Form, Region, Shape};
use signorini_scene::scene::{Located, Material};

use crate::cell::Cell;
use crate::integrals::average;
use crate::quadrature::refined::{Part, refined};
use crate::quadrature::{Point, enclosed, gauss, on_quad, on_triangle};

/// The most of ξ, η, ξ², ξη and η² on a triangle.
const IN_TRIANGLE: [f64; 5] = [2.0 / 3.0, 2.0 / 3.0, 4.0 / 9.0, 2.0 / 9.0, 4.0 / 9.0];
/// Part of a range that a form has to see in its coefficients.
const SEEN: f64 = 0.25;
/// A variation of A that rounding makes.
const ROUNDING: f64 = 1e-10;
/// Of the root of an integral over a piece twice this may be missed.
const MISSED: f64 = 4e-3;
/// The most that p may vary in a piece, as η, and in a cell whose own points resolve A.
const VARIES: [f64; 2] = [0.5, 0.18];
/// Points in a direction, at most.
const MOST_POINTS: usize = 16;
/// The most of ξ, η, ξ², ξη and η² on a triangle.
const IN_TRIANGLE: [f64; 5] = [2.0 / 3.0, 2.0 / 3.0, 4.0 / 9.0, 2.0 / 9.0, 4.0 / 9.0];
/// Part of a range that a form has to see in its coefficients.
const SEEN: f64 = 0.25;
/// A variation of A that rounding makes.
const ROUNDING: f64 = 1e-10;
/// Of the root of an integral over a piece twice this may be missed.
const MISSED: f64 = 4e-3;
/// The most that p may vary in a piece, as η, and in a cell whose own points resolve A.
const VARIES: [f64; 2] = [0.5, 0.18];
/// Points in a direction, at most.
const MOST_POINTS: usize = 16;
/// Pieces are small enough where ‖N′^½v‖ is this part of what the variation of A makes of ‖A^½v‖.
const LEFT: f64 = 1e-3;

pub use rows::{Cut, Root, Rows};

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
    /// A of `material` on a cell, cut no more than so often until so much is `left`.
    pub fn new(material: &Material, cell: Cell, (most, left): (usize, f64)) -> Self {
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
        let is_enough = |size: f64, missed: f64| missed <= (left * variation).powi(2) * size;
        let whole = Part { of: 0, region: whole, value, missed };
        let cut = |region: &Region| Some(parts(material, region));
        let parts = refined(cut, vec![whole], most, is_enough, |_, region| part(region));
        let missed: f64 = parts.iter().map(|part| part.missed / value).sum();
        let piece = |part: Part| Piece::of(material, part.region);
        let left = missed.sqrt() / variation;
        Self { all: parts.into_iter().map(piece).collect(), left }
    }

    /// A over a power of two.
    #[must_use]
    pub fn divided(&self, by: f64) -> Self {
        let divided = |piece: &Piece| Piece {
            below: piece.below.map(|of| scaled(&of, 1.0 / by)),
            above: piece.above.map(|of| of / by),
            ..*piece
        };
        Self { all: self.all.iter().map(divided).collect(), left: self.left }
    }

    /// Whether the points of the cell itself resolve A.
    pub fn is_resolved(&self) -> bool {
        matches!(&self.all[..], [of] if of.share.is_finite() && of.varies <= VARIES[1])
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
        let most = if region.shape() == Shape::Triangle { IN_TRIANGLE } else { [1.0; 5] };
        let terms = piece.below[1..].iter().zip(most);
        let varies = terms.map(|(of, most)| most * piece.size_of(of)).sum::<f64>();
        let piece = Self { varies, share: piece.share / (1.0 - varies), ..piece };
        (varies <= VARIES[0]).then_some(piece)
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
        let mut all = (2..=MOST_POINTS).filter_map(missed);
        all.find(|(_, missed)| *missed <= MISSED).unwrap_or((MOST_POINTS, f64::INFINITY))
    }

    fn points(&self, cell: Cell) -> Vec<PiecePoint> {
        let (points, _) = self.rule(cell);
        let (rule, share) = (gauss(points), self.share.min(1.0));
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
            [a, b, c] => on_triangle([a, b, c], &rule).map(here).collect(),
            [a, b, c, d] => on_quad([a, b, c, d], &rule).map(here).collect(),
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
    along.unwrap_or_else(|| region.parts_across(variations(material, region)))
}

/// How much A varies along the directions of a region: by its forms, where they say most of it, or by its slopes.
fn variations(material: &Material, region: &Region) -> [f64; 3] {
    let entries = &material.conductivity[..if material.is_scalar { 1 } else { 3 }];
    let most =
        |of: &dyn Fn(&Located<Expression>) -> f64| entries.iter().map(of).fold(0.0, f64::max);
    let by_form = |of: &Located<Expression>| {
        let form = of.value.enclose(region, 0.0);
        let [_, x, y, xx, xy, yy] = form.coefficients.map(f64::abs);
        let beside = (form.coefficients[1] - form.coefficients[2]).abs();
        ([x + xx, y + yy, beside + xx + xy + yy], form.range().width())
    };
    let told = entries.iter().map(by_form).reduce(|a, b| if a.1 >= b.1 { a } else { b });
    match told {
        Some((along, width)) if along.iter().sum::<f64>() > SEEN * width => along,
        _ => region
            .directions()
            .map(|way| most(&|of| of.value.enclose_slope(region, 0.0, way)[1].range().size())),
    }
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

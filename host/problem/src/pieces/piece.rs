//! A on one piece of a cell, enclosed.

use signorini_kernel::Tensor;
use signorini_scene::expression::Expression;
use signorini_scene::expression::enclosure::{Form, Region, Shape};
use signorini_scene::scene::{Located, Material};

use crate::cell::Cell;
use crate::quadrature::{Point, on_quad, on_triangle};

/// The most of ξ, η, ξ², ξη and η² on a triangle.
const IN_TRIANGLE: [f64; 5] = [2.0 / 3.0, 2.0 / 3.0, 4.0 / 9.0, 2.0 / 9.0, 4.0 / 9.0];
/// Part of a range that a form has to see in its coefficients.
const SEEN: f64 = 0.25;
/// A variation of A that rounding makes.
pub(super) const ROUNDING: f64 = 1e-10;
/// Of the root of an integral over a piece twice this may be missed.
const MISSED: f64 = 4e-3;
/// The most that p may vary in a piece, as η, and in a cell whose own points resolve A.
pub(super) const VARIES: [f64; 2] = [0.5, 0.18];
/// Points in a direction, at most.
const MOST_POINTS: usize = 16;

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

impl Piece {
    /// A with a constant p, and with the better p.
    pub(super) fn both(material: &Material, region: Region) -> [Self; 2] {
        let forms = forms(material, &region);
        let flat = Self::flat(material, &forms, region);
        let curved = Self::curved(&forms, region).filter(|curved| curved.share <= flat.share);
        let better = curved.unwrap_or_else(|| flat.clone());
        [flat, better]
    }

    /// A with the better p.
    pub(super) fn of(material: &Material, region: Region) -> Self {
        let [_, better] = Self::both(material, region);
        better
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
    pub(super) fn relative(&self, above: [f64; 2]) -> f64 {
        size_in(&sum(&self.below[0], &diagonal(self.above)), &diagonal(above))
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
        let mut all = (2..=MOST_POINTS).filter_map(missed);
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
        size_in(to, &sum(&most, &diagonal(self.above)))
    }

    /// A tensor below A all over it.
    pub(super) fn floor(&self) -> Tensor<f64> {
        scaled(&self.below[0], 1.0 - self.varies)
    }

    pub(super) fn centre(&self) -> [f64; 2] {
        self.region.centre()
    }

    pub(super) fn divided(&self, by: f64) -> Self {
        let (below, above) =
            (self.below.map(|of| scaled(&of, 1.0 / by)), self.above.map(|of| of / by));
        Self { below, above, ..self.clone() }
    }

    /// p at reference coordinates of the piece.
    fn at(&self, [x, y]: [f64; 2]) -> Tensor<f64> {
        let monomials = [1.0, x, y, x * x, x * y, y * y];
        let terms = self.below.iter().zip(monomials);
        terms.fold(Tensor::default(), |all, (of, factor)| sum(&all, &scaled(of, factor)))
    }
}

/// Parts of a region along a jump or a kink of A, or across the direction in which it varies most.
pub(super) fn parts(material: &Material, region: &Region) -> Vec<Region> {
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

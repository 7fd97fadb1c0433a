//! Regions: cells, edges and parts of them, as images of reference shapes.

use super::form::Form;
use super::function::ULP;
use super::interval::Interval;
use super::polynomial::{self, Shape};

/// A segment, a triangle or a convex quad: x = c + ξ x_ξ + η x_η + ξη x_ξη.
///
/// Parts halve these vectors, which is exact: lengths and areas of parts have the relative accuracy of those of the whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    shape: Shape,
    /// Corners: the last ones of segments and triangles are copies.
    corners: [[f64; 2]; 4],
    centre: [f64; 2],
    /// x_ξ, x_η, x_ξη
    along: [[f64; 2]; 3],
}

/// Gauss points on [−1, 1] and their weights, which sum to 1: exact to degree 5.
const GAUSS: [[f64; 2]; 3] = [
    [-0.774_596_669_241_483_4, 5.0 / 18.0],
    [0.0, 8.0 / 18.0],
    [0.774_596_669_241_483_4, 5.0 / 18.0],
];
/// Strang and Fix: (λ of the corner opposite of two equal ones, weight) exact to degree 4.
const STRANG: [[f64; 2]; 2] = [
    [0.108_103_018_168_070_23, 0.223_381_589_678_011_47],
    [0.816_847_572_980_458_5, 0.109_951_743_655_321_87],
];

impl Region {
    /// The segment from `a` to `b`; its ξ runs from −1 to 1.
    pub fn segment([a, b]: [[f64; 2]; 2]) -> Self {
        let along = [0, 1].map(|k| 0.5 * (b[k] - a[k]));
        Self {
            shape: Shape::Segment,
            corners: [a, b, b, b],
            centre: middle(a, b),
            along: [along, [0.0; 2], [0.0; 2]],
        }
    }

    /// The triangle of three corners.
    pub fn triangle([a, b, c]: [[f64; 2]; 3]) -> Self {
        let along = [from(a, b), from(a, c), [0.0; 2]];
        Self { shape: Shape::Triangle, corners: [a, b, c, c], centre: centroid([a, b, c]), along }
    }

    /// The convex quad of four corners in their order, bilinear.
    pub fn quad(corners @ [a, b, c, d]: [[f64; 2]; 4]) -> Self {
        let (ab, dc, ad, bc) = (from(a, b), from(d, c), from(a, d), from(b, c));
        let half = |p: [f64; 2], q: [f64; 2], way: f64| [0, 1].map(|k| 0.25 * (q[k] + way * p[k]));
        let along = [half(ab, dc, 1.0), half(ad, bc, 1.0), half(ab, dc, -1.0)];
        Self { shape: Shape::Quad, corners, centre: middle(middle(a, c), middle(b, d)), along }
    }

    /// What its reference coordinates run through.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// Its corners: 2, 3 or 4.
    pub fn corners(&self) -> &[[f64; 2]] {
        match self.shape {
            Shape::Segment => &self.corners[..2],
            Shape::Triangle => &self.corners[..3],
            Shape::Quad => &self.corners,
        }
    }

    /// The point at (ξ, η) = 0: the middle, or a triangle's centroid.
    pub fn centre(&self) -> [f64; 2] {
        self.centre
    }

    /// The point at reference coordinates.
    pub fn place(&self, [xi, eta]: [f64; 2]) -> [f64; 2] {
        let [u, v, w] = self.along;
        [0, 1].map(|k| self.centre[k] + (xi * u[k] + eta * v[k] + xi * eta * w[k]))
    }

    /// Length or area.
    pub fn measure(&self) -> f64 {
        self.weight([0.0; 2])
    }

    /// Length or area, if the map were everywhere as at these reference coordinates.
    fn weight(&self, [xi, eta]: [f64; 2]) -> f64 {
        let [u, v, w] = self.along;
        match self.shape {
            Shape::Segment => 2.0 * u[0].hypot(u[1]),
            Shape::Triangle => 0.5 * cross(u, v).abs(),
            Shape::Quad => {
                let [u, v] = [(u, eta), (v, xi)].map(|(u, t)| [0, 1].map(|k| u[k] + t * w[k]));
                4.0 * cross(u, v).abs()
            }
        }
    }

    /// Reference coordinates and weights whose sums are integrals over the region: exact for polynomials of degree 4, those of
    /// degree 2 squared.
    pub fn rule(&self) -> Vec<([f64; 2], f64)> {
        let weighed = |at: [f64; 2], share: f64| (at, share * self.weight(at));
        match self.shape {
            Shape::Segment => GAUSS.map(|[t, share]| weighed([t, 0.0], share)).to_vec(),
            Shape::Quad => GAUSS
                .iter()
                .flat_map(|[y, b]| GAUSS.map(|[x, a]| weighed([x, *y], a * b)))
                .collect(),
            Shape::Triangle => STRANG
                .iter()
                .flat_map(|&[most, share]| {
                    let [own, other] = [most - 1.0 / 3.0, 0.5 * (1.0 - most) - 1.0 / 3.0];
                    [[other, other], [own, other], [other, own]].map(|at| weighed(at, share))
                })
                .collect(),
        }
    }

    /// x and y as forms.
    pub(super) fn coordinates(&self) -> [Form; 2] {
        [0, 1].map(|k| {
            let [c, [u, v, w]] = [[self.centre[k]; 3], self.along.map(|along| along[k])];
            let range = Interval::hull(&self.corners.map(|corner| corner[k] + 0.0));
            if range.low == range.high {
                return Form::constant(self.shape, range.low);
            }
            let slack = 4.0 * ULP * range.size();
            let coefficients = [c[0], u, v, 0.0, w, 0.0];
            Form::new(self.shape, coefficients, Interval::around(slack), (range, true), true)
        })
    }

    /// All of ∫f over the region that `form` allows for, f.
    pub fn integral(&self, form: &Form) -> Interval {
        let rule = self.rule();
        let sum: f64 = rule
            .iter()
            .map(|(at, weight)| weight * polynomial::value(&form.coefficients, *at))
            .sum();
        let measure = Interval::point(self.measure()).widened(8.0 * ULP * self.measure());
        let slack = 16.0 * ULP * self.measure() * polynomial::size(&form.coefficients);
        (measure * form.range())
            .meet(Interval::point(sum).widened(slack) + measure * form.remainder)
    }

    /// All that the mean of f over the region may be, by `form`.
    pub fn mean(&self, form: &Form) -> Interval {
        let measure = self.measure();
        let integral = self.integral(form);
        let slack = 8.0 * ULP;
        let mean = Interval::new(integral.low / measure, integral.high / measure);
        form.range().meet(mean.widened(slack * mean.size()))
    }

    /// Halves of a segment; quarters of a triangle or a quad, or halves across its longer direction where it is thin.
    pub fn parts(&self) -> Vec<Self> {
        match self.shape {
            Shape::Segment => self.halves(0),
            Shape::Quad => {
                let [u, v] = [0, 1].map(|k| self.along[k][0].hypot(self.along[k][1]));
                match (u > THIN * v, v > THIN * u) {
                    (true, _) => self.halves(0),
                    (_, true) => self.halves(1),
                    _ => self.halves(0).iter().flat_map(|half| half.halves(1)).collect(),
                }
            }
            Shape::Triangle => self.parts_of_triangle(),
        }
    }

    /// Halves across the direction of ξ or η.
    fn halves(&self, axis: usize) -> Vec<Self> {
        let [a, b, c, d] = self.corners;
        let corners = |way: f64| match (self.shape, axis, way < 0.0) {
            (Shape::Segment, _, true) => [a, middle(a, b), middle(a, b), middle(a, b)],
            (Shape::Segment, _, false) => [middle(a, b), b, b, b],
            (_, 0, true) => [a, middle(a, b), middle(c, d), d],
            (_, 0, false) => [middle(a, b), b, c, middle(c, d)],
            (_, _, true) => [a, b, middle(b, c), middle(d, a)],
            (_, _, false) => [middle(d, a), middle(b, c), c, d],
        };
        let [own, across] = [self.along[axis], self.along[1 - axis]];
        let half = |way: f64| {
            let twist = self.along[2];
            let centre = [0, 1].map(|k| self.centre[k] + 0.5 * way * own[k]);
            let mut along = self.along.map(|along| along.map(|x| 0.5 * x));
            along[1 - axis] = [0, 1].map(|k| across[k] + 0.5 * way * twist[k]);
            Self { shape: self.shape, corners: corners(way), centre, along }
        };
        [-1.0, 1.0].map(half).to_vec()
    }

    /// Quarters, or halves at the middle of the longest side where its height is less than a quarter of it.
    fn parts_of_triangle(&self) -> Vec<Self> {
        let [a, b, c, _] = self.corners;
        let [u, v, _] = self.along;
        let w = [0, 1].map(|k| v[k] - u[k]);
        let squares = [u, w, v].map(|[x, y]| x * x + y * y);
        let longest = squares.iter().copied().fold(0.0, f64::max);
        if longest * 0.25 > cross(u, v).abs() {
            let back = |u: [f64; 2]| u.map(|x| -x);
            // The longest side from its first corner, and from there to the third.
            let turned = match squares {
                [ab, ..] if ab == longest => ([a, b, c], [u, v]),
                [_, bc, _] if bc == longest => ([b, c, a], [w, back(u)]),
                _ => ([c, a, b], [back(v), back(w)]),
            };
            return Self::halved(turned);
        }
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        let corners = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]];
        let parts = corners.iter().enumerate();
        let part = |(k, corners): (usize, &[[f64; 2]; 3])| {
            let scale = if k == 3 { -0.5 } else { 0.5 };
            Self::in_triangle(*corners, [u, v].map(|along| along.map(|x| scale * x)))
        };
        parts.map(part).collect()
    }

    fn halved(([a, b, c], [u, v]): ([[f64; 2]; 3], [[f64; 2]; 2])) -> Vec<Self> {
        let (middle, half) = (middle(a, b), u.map(|x| 0.5 * x));
        let other = [0, 1].map(|k| v[k] - half[k]);
        vec![
            Self::in_triangle([a, middle, c], [half, v]),
            Self::in_triangle([middle, b, c], [half, other]),
        ]
    }

    /// A part of a triangle, whose sides are known better than its corners.
    fn in_triangle([a, b, c]: [[f64; 2]; 3], [u, v]: [[f64; 2]; 2]) -> Self {
        let corners = [a, b, c, c];
        Self {
            shape: Shape::Triangle,
            corners,
            centre: centroid([a, b, c]),
            along: [u, v, [0.0; 2]],
        }
    }
}

/// A side so much longer than the other is halved alone.
const THIN: f64 = 2.0;

fn middle(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| 0.5 * (a[k] + b[k]))
}

fn centroid([a, b, c]: [[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0)
}

fn from(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| b[k] - a[k])
}

fn cross(u: [f64; 2], v: [f64; 2]) -> f64 {
    u[0] * v[1] - u[1] * v[0]
}

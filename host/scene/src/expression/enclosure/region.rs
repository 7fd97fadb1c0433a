//! Regions: cells, edges and parts of them, as images of reference shapes.

use super::continuation::Disc;
use super::form::Form;
use super::function::ULP;
use super::interval::Interval;
use super::polynomial::{self, Shape};

/// A segment, a triangle or a convex quad: x = c + ξ x_ξ + η x_η + ξη x_ξη.
///
/// Parts halve these vectors, which is exact: lengths and areas of parts have the relative accuracy of those of the whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    pub(super) shape: Shape,
    /// Corners: the last ones of segments and triangles are copies.
    pub(super) corners: [[f64; 2]; 4],
    pub(super) centre: [f64; 2],
    /// x_ξ, x_η, x_ξη
    pub(super) along: [[f64; 2]; 3],
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
        Self::in_triangle([a, b, c], [from(a, b), from(a, c)])
    }

    /// A triangle, or a part of one, whose sides are known better than its corners.
    pub(super) fn in_triangle([a, b, c]: [[f64; 2]; 3], [u, v]: [[f64; 2]; 2]) -> Self {
        let centre = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        Self { shape: Shape::Triangle, corners: [a, b, c, c], centre, along: [u, v, [0.0; 2]] }
    }

    /// The convex quad of four corners in their order, bilinear.
    pub fn quad(corners @ [a, b, c, d]: [[f64; 2]; 4]) -> Self {
        let (ab, dc, ad, bc) = (from(a, b), from(d, c), from(a, d), from(b, c));
        let half = |p: [f64; 2], q: [f64; 2], way: f64| [0, 1].map(|k| 0.25 * (q[k] + way * p[k]));
        let along = [half(ab, dc, 1.0), half(ad, bc, 1.0), half(ab, dc, -1.0)];
        Self { shape: Shape::Quad, corners, centre: middle(middle(a, c), middle(b, d)), along }
    }

    /// The shape that its reference coordinates run through.
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

    /// Whether it is so small that its coordinates hardly differ: nothing is gained by cutting it.
    pub fn is_tiny(&self) -> bool {
        let [u, v, _] = self.along;
        let extent = u.iter().chain(&v).fold(0.0_f64, |most, x| most.max(x.abs()));
        extent <= 4096.0 * ULP * self.centre[0].abs().max(self.centre[1].abs())
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

    /// Discs around x and y where one reference coordinate of the rule of Gauss points is complex, in the ellipse of ρ. A triangle
    /// is the quad whose last corners are one.
    pub(super) fn neighbourhood(&self, rho: f64) -> [Disc; 2] {
        let quad = match self.shape {
            Shape::Triangle => Self::quad(self.corners),
            Shape::Segment | Shape::Quad => *self,
        };
        [0, 1].map(|k| Disc::linear(quad.centre[k], quad.along.map(|of| of[k]), reach(rho)))
    }

    /// The most that a rule of n Gauss points in each direction misses of an integral over the region, of a function with this modulus in
    /// the ellipse of ρ (`continuation`).
    pub fn missed(&self, points: usize, rho: f64, modulus: f64) -> f64 {
        let reach = reach(rho);
        // The largest area element over that in the middle: 1 − ŷ over ½ on a triangle.
        let stretch = match self.shape {
            Shape::Segment => 0.5,
            Shape::Triangle => 1.0 + reach,
            Shape::Quad => 1.0 + self.bent(reach),
        };
        let rate = rho.powi(-2 * points as i32) / (1.0 - rho.powi(-2));
        64.0 / 15.0 * stretch * self.measure() * rate * modulus
    }

    /// The least modulus of the area element in the ellipse of ρ over that in the middle; not positive where it may vanish.
    pub fn least_density(&self, rho: f64) -> f64 {
        match self.shape {
            Shape::Quad => 1.0 - self.bent(reach(rho)),
            Shape::Segment | Shape::Triangle => 1.0,
        }
    }

    /// How far a quad's area element differs from that in the middle, as a part of it, so far from there.
    fn bent(&self, reach: f64) -> f64 {
        let [u, v, w] = self.along;
        reach * (cross(u, w).abs() + cross(w, v).abs()) / cross(u, v).abs()
    }

    /// The area element over that of the reference square, or of a part of it, as a form: what [`Region::measure`] is the mean of.
    pub fn density(&self) -> Form {
        let [u, v, w] = self.along;
        let measure = self.measure();
        if self.shape != Shape::Quad || w == [0.0; 2] {
            return Form::constant(self.shape, measure);
        }
        let way = cross(u, v).signum();
        let [xi, eta] = [cross(u, w), cross(w, v)].map(|slope| 4.0 * way * slope);
        let size = xi.abs() + eta.abs();
        let range = Interval::point(measure).widened(size * (1.0 + 4.0 * ULP));
        let coefficients = [measure, xi, eta, 0.0, 0.0, 0.0];
        Form::new(
            self.shape,
            coefficients,
            Interval::around(8.0 * ULP * measure),
            (range, true),
            true,
        )
    }

    /// Points and weights of a segment under a rule on \[0, 1\].
    pub fn along(&self, rule: &[[f64; 2]]) -> Vec<([f64; 2], f64)> {
        let length = self.measure();
        let point = |&[t, weight]: &[f64; 2]| (self.place([2.0 * t - 1.0, 0.0]), length * weight);
        rule.iter().map(point).collect()
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

    /// The integrals of f over the region that its `form` allows for.
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

    /// ∫p² over the region, and by how much ∫f² may differ from it: ‖p + r‖² lies within ‖r‖(2‖p‖ + ‖r‖) of ‖p‖².
    pub fn square(&self, form: &Form) -> [f64; 2] {
        let squares = self
            .rule()
            .into_iter()
            .map(|(at, weight)| weight * polynomial::value(&form.coefficients, at).powi(2));
        let square: f64 = squares.sum();
        let rest = form.remainder.size() * self.measure().sqrt();
        let slack = 64.0 * ULP;
        [square, rest * (2.0 * square.sqrt() + rest) * (1.0 + slack) + slack * square]
    }

    /// All that the mean of f over the region may be, by `form`.
    pub fn mean(&self, form: &Form) -> Interval {
        let measure = self.measure();
        let integral = self.integral(form);
        let slack = 8.0 * ULP;
        let mean = Interval::new(integral.low / measure, integral.high / measure);
        form.range().meet(mean.widened(slack * mean.size()))
    }
}

/// Semi-axis of the ellipse of ρ, which lies in the disc of that radius.
pub(super) fn reach(rho: f64) -> f64 {
    0.5 * (rho + 1.0 / rho)
}

pub(super) fn middle(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| 0.5 * (a[k] + b[k]))
}

pub(super) fn from(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| b[k] - a[k])
}

pub(super) fn cross(u: [f64; 2], v: [f64; 2]) -> f64 {
    u[0] * v[1] - u[1] * v[0]
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn norm(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

//! Exact solutions on (−1, 1) × (0, 1) with contact on y = 0.
//!
//! There n = (0, −1) and λ = σ·n = −(A∇u)_y. Most cases are real parts of analytic functions W of
//! z = x + iy, whose gradient is (Re W', −Im W').

use std::f64::consts::PI;
use std::sync::Arc;

use crate::field::{IDENTITY, Point, Scalar, Tensor, Vector, constant};

/// A solution of −∇·(A∇u) = f with u ≥ ψ, λ ≥ 0, λ (u − ψ) = 0 on y = 0.
#[derive(Clone)]
pub struct Exact {
    /// The name that the catalogue gives it.
    pub name: String,
    /// u.
    pub u: Scalar,
    /// ∇u.
    pub gradient: Vector,
    /// f.
    pub source: Scalar,
    /// A.
    pub tensor: Tensor,
    /// ψ, meant for points with y = 0.
    pub gap: Scalar,
    /// λ, meant for points with y = 0.
    pub multiplier: Scalar,
    /// ∫ λ over −1 < x < 1.
    pub force: f64,
}

impl Exact {
    /// With f = 0, A = I and ψ = 0.
    fn harmonic(
        name: &str,
        u: impl Fn(Point) -> f64 + Send + Sync + 'static,
        gradient: impl Fn(Point) -> [f64; 2] + Send + Sync + 'static,
        force: f64,
    ) -> Self {
        let gradient: Vector = Arc::new(gradient);
        let slope = gradient.clone();
        Self {
            name: name.into(),
            u: Arc::new(u),
            gradient,
            source: constant(0.0),
            tensor: Arc::new(|_| IDENTITY),
            gap: constant(0.0),
            multiplier: Arc::new(move |p| -slope(p)[1]),
            force,
        }
    }

    /// A: smooth, with a source; contact where x ≤ 0. u = x₊³ − y (−x)₊³.
    pub fn a() -> Self {
        let parts = |x: f64| (x.max(0.0), (-x).max(0.0));
        let u = move |[x, y]: Point| parts(x).0.powi(3) - y * parts(x).1.powi(3);
        let gradient = move |[x, y]: Point| {
            let (right, left) = parts(x);
            [3.0 * right * right + 3.0 * y * left * left, -left.powi(3)]
        };
        let source = move |[x, y]: Point| -6.0 * parts(x).0 + 6.0 * y * parts(x).1;
        Self { source: Arc::new(source), ..Self::harmonic("A", u, gradient, 0.25) }
    }

    /// B: the generic free boundary, u = r^{3/2} cos(3θ/2); contact where x ≤ 0.
    pub fn b() -> Self {
        let u = |p: Point| Complex::of(p).power(1.5).re;
        let gradient = |p: Point| Complex::of(p).power(0.5).times(1.5).gradient();
        Self::harmonic("B", u, gradient, 1.0)
    }

    /// B mirrored: u = −r^{3/2} sin(3θ/2); contact where x ≥ 0.
    pub fn b_mirrored() -> Self {
        let Self { u, gradient, force, .. } = Self::b();
        let slope = move |[x, y]: Point| {
            let [gx, gy] = gradient([-x, y]);
            [-gx, gy]
        };
        Self::harmonic("B mirrored", move |[x, y]| u([-x, y]), slope, force)
    }

    /// H(a): contact where |x| ≤ a. W = z s − a² log((z + s)/a), W' = 2s, s = √(z−a) √(z+a).
    pub fn h(a: f64) -> Self {
        let root = move |[x, y]: Point| {
            Complex::of([x - a, y]).power(0.5).multiply(Complex::of([x + a, y]).power(0.5))
        };
        let u = move |p: Point| {
            let (z, s) = (Complex::of(p), root(p));
            let modulus = (z.re + s.re).hypot(z.im + s.im);
            z.multiply(s).re - a * a * (modulus / a).ln()
        };
        let gradient = move |p| root(p).times(2.0).gradient();
        Self::harmonic(&format!("H({a})"), u, gradient, PI * a * a)
    }

    /// H_g(a): H(a) over the concave gap ψ = −x².
    pub fn h_gap(a: f64) -> Self {
        let saddle = |[x, y]: Point| y * y - x * x;
        let gradient = |[x, y]: Point| [-2.0 * x, 2.0 * y];
        let sum = Self::h(a).plus(Arc::new(saddle), Arc::new(gradient), constant(0.0));
        Self { name: format!("H_g({a})"), ..sum }
    }

    /// J(k): A = k where x < 0 and 1 where x > 0; contact where x ≤ 0.
    ///
    /// u = Re z^α on the right, −k^{−½} Im (−x + iy)^α on the left, α = 2 − (2/π) arctan √k.
    pub fn jump(k: f64) -> Self {
        let alpha = 2.0 - 2.0 / PI * k.sqrt().atan();
        let mirrored = |[x, y]: Point| Complex::of([-x, y]);
        let u = move |p: Point| match p[0] < 0.0 {
            true => -mirrored(p).power(alpha).im / k.sqrt(),
            false => Complex::of(p).power(alpha).re,
        };
        let gradient = move |p: Point| {
            if p[0] < 0.0 {
                let w = mirrored(p).power(alpha - 1.0).times(alpha / k.sqrt());
                [w.im, -w.re]
            } else {
                Complex::of(p).power(alpha - 1.0).times(alpha).gradient()
            }
        };
        let conductivity = move |[x, _]: Point| if x < 0.0 { k } else { 1.0 };
        Self {
            tensor: Arc::new(move |p| [conductivity(p), 0.0, conductivity(p)]),
            multiplier: Arc::new(move |p| -conductivity(p) * gradient(p)[1]),
            ..Self::harmonic(&format!("J({k:e})"), u, gradient, k.sqrt())
        }
    }

    /// u = c + a x + b y with b ≤ 0, in contact everywhere (ψ = u).
    pub fn patch_closed(c: f64, a: f64, b: f64) -> Self {
        let u = move |[x, y]: Point| c + a * x + b * y;
        Self { gap: Arc::new(u), ..Self::harmonic("closed patch", u, move |_| [a, b], -2.0 * b) }
    }

    /// u = c + a x, open everywhere (ψ = u − 1).
    pub fn patch_open(c: f64, a: f64) -> Self {
        let u = move |[x, _]: Point| c + a * x;
        let gap = Arc::new(move |p| u(p) - 1.0);
        Self { gap, ..Self::harmonic("open patch", u, move |_| [a, 0.0], 0.0) }
    }

    /// T(s, κ): the pull-back by (x, y) ↦ (x − s y, κ y), any anisotropy and obliqueness.
    ///
    /// With DF = [[1, s/κ], [0, 1/κ]], the inverse map's derivative, A becomes DF A DFᵀ / det DF
    /// and f becomes f / det DF. On y = 0 nothing changes.
    pub fn transformed(self, s: f64, kappa: f64) -> Self {
        let back = move |[x, y]: Point| [x - s * y, kappa * y];
        let Self { u, gradient, source, tensor, .. } = self;
        let slope = move |p: Point| {
            let [gx, gy] = gradient(back(p));
            [gx, kappa * gy - s * gx]
        };
        let oblique = move |p: Point| {
            let [xx, xy, yy] = tensor(back(p));
            let first_row = [kappa * xx + s * xy, kappa * xy + s * yy];
            [first_row[0] + s / kappa * first_row[1], first_row[1] / kappa, yy / kappa]
        };
        Self {
            name: format!("T({s}, {kappa}) of {}", self.name),
            u: Arc::new(move |p| u(back(p))),
            gradient: Arc::new(slope),
            source: Arc::new(move |p| kappa * source(back(p))),
            tensor: Arc::new(oblique),
            ..self
        }
    }

    /// +G, for A = I and any G with ∂G/∂y = 0 on y = 0: the solution u + G over the gap ψ + G.
    pub fn plus(self, g: Scalar, g_gradient: Vector, g_laplacian: Scalar) -> Self {
        let Self { u, gradient, source, gap, .. } = self;
        let lift = g.clone();
        let slope = move |p: Point| {
            let ([ux, uy], [gx, gy]) = (gradient(p), g_gradient(p));
            [ux + gx, uy + gy]
        };
        Self {
            name: format!("{} + G", self.name),
            u: Arc::new(move |p| u(p) + g(p)),
            gradient: Arc::new(slope),
            source: Arc::new(move |p| source(p) - g_laplacian(p)),
            gap: Arc::new(move |p| gap(p) + lift(p)),
            ..self
        }
    }
}

/// A complex number of the closed upper half plane or what is computed from one.
#[derive(Clone, Copy)]
struct Complex {
    re: f64,
    im: f64,
}

impl Complex {
    /// x + i|y|: at y = −0.0 the angle of a negative x would be −π, and λ would change its sign.
    fn of([x, y]: Point) -> Self {
        Self { re: x, im: y.abs() }
    }

    fn power(self, exponent: f64) -> Self {
        let modulus = self.re.hypot(self.im).powf(exponent);
        let angle = exponent * self.im.atan2(self.re);
        Self { re: modulus * angle.cos(), im: modulus * angle.sin() }
    }

    fn multiply(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    fn times(self, factor: f64) -> Self {
        Self { re: factor * self.re, im: factor * self.im }
    }

    /// The gradient of Re W, where `self` is W'.
    fn gradient(self) -> [f64; 2] {
        [self.re, -self.im]
    }
}

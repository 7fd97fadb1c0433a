//! Transfer laws in the bound: ∫r²/h with r = τ·n + h(s − u_ext).

use signorini_kernel::Real;

/// A transfer edge inside which H = ∫h lies between H⁻ and H⁺, N = H⁺ − H⁻; t runs from 0 to 1 along it:
/// ```text
///   ‖H^{−½}r‖ ≤ (τ²∫1/H⁻ + 2τ∫(s − u_ext) + ∫H⁻(s − u_ext)²)^½ + (∫N′(s − u_ext)²)^½,     N′ = min(1, N/H⁻) N
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TransferForm<R, I> {
    /// Which law.
    pub law: I,
    /// ∫1/H⁻
    pub compliance: R,
    /// ∫H⁻(s − u_ext)²
    pub below: Square<R>,
    /// ∫N′(s − u_ext)²
    pub above: Square<R>,
    /// ∫u_ext
    pub mean: R,
}

/// ∫W (s − u_ext)² for a weight W, by the values of s at both ends and its bubble.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Square<R> {
    /// ∫W φᵢφⱼ of φ = 1 − t, t, 4t(1 − t): 00, 01, 02, 11, 12, 22.
    pub square: [R; 6],
    /// ∫W u_ext φᵢ
    pub linear: [R; 3],
    /// ∫W u_ext²
    pub constant: R,
}

impl<R: Real> Square<R> {
    /// The integral, and the size of what it is summed from.
    fn of(&self, [a, b, bubble]: [R; 3]) -> [R; 2] {
        let [aa, ab, ac, bb, bc, cc] = self.square;
        let [of_a, of_b, of_c] = self.linear;
        let squares = aa * a * a + bb * b * b + cc * bubble * bubble;
        let products = ab * a * b + ac * a * bubble + bc * b * bubble;
        let linear = of_a * a + of_b * b + of_c * bubble;
        let value = squares + R::TWO * (products - linear) + self.constant;
        // Each product is less than the squares beside it.
        [value, R::from_count(4) * (squares + self.constant)]
    }
}

/// A transfer edge: r = ∫τ·n + H(s − u_ext) with H = ∫h along it.
pub(super) struct Transfer<R> {
    pub flux: R,
    pub s: [R; 2],
    pub bubble: R,
}

impl<R: Real> Transfer<R> {
    /// ∫ r²/H with H and u_ext constant, `ambient` = ∫h u_ext: Simpson's rule for the linear part of r,
    /// and what the bubble H·4t(1 − t)d adds.
    pub fn constant(&self, h: R, ambient: R) -> R {
        if !(h > R::ZERO) {
            // Nothing passes: a flux there has no finite bound.
            return if self.flux == R::ZERO { R::ZERO } else { R::ONE / R::ZERO };
        }
        let [a, b] = self.s.map(|s| self.flux + (h * s - ambient));
        let bubble = h * self.bubble;
        let linear = (a * a + a * b + b * b) * R::THIRD;
        let cross = R::TWO * R::THIRD * bubble * (a + b);
        let square = R::from_count(8) / R::from_count(15) * bubble * bubble;
        (linear + cross + square) / h
    }

    /// ∫ e²/H, e what rounding of the data and of r can do: r is a small difference of large terms where
    /// u is large against its changes.
    pub fn moved(&self, h: R, ambient: R) -> R {
        if !(h > R::ZERO) {
            return R::ZERO;
        }
        let [a, b] = self.s.map(R::magnitude);
        let s = a.or_larger(b) + self.bubble.magnitude();
        let terms = self.flux.magnitude() + h * s + ambient.magnitude();
        let e = R::TWO * R::EPSILON * terms;
        e * e / h
    }

    /// The term from H and u_ext at the 8 Gauss points.
    pub fn at_points(&self, points: &[[R; 2]; 8]) -> R {
        let [a, b] = self.s;
        let rule = R::GAUSS[7].iter().zip(points);
        rule.fold(R::ZERO, |sum, (&[t, weight], &[h, ambient])| {
            let arch = (R::TWO + R::TWO) * t * (R::ONE - t);
            let s = a * (R::ONE - t) + b * t + arch * self.bubble;
            let r = self.flux + h * (s - ambient);
            // Where nothing passes the law asks for τ·n = 0; a flux there has no finite bound.
            let term = if r == R::ZERO { R::ZERO } else { r * r / h };
            sum + weight * term
        })
    }

    /// The term of H⁻, the size of its terms, and what N′ adds to the root.
    #[inline(never)]
    pub fn by_form<I>(&self, form: &TransferForm<R, I>) -> [R; 3] {
        let ([a, b], bubble, tau) = (self.s, self.bubble, self.flux);
        let mean = R::HALF * (a + b) + R::TWO * R::THIRD * bubble - form.mean;
        let [energy, size] = form.below.of([a, b, bubble]);
        let [open, of_open] = form.above.of([a, b, bubble]);
        let of_flux = form.compliance * tau * tau;
        let terms = a.magnitude() + b.magnitude() + bubble.magnitude() + form.mean.magnitude();
        let terms = of_flux + R::TWO * tau.magnitude() * terms + size;
        let open = open.or_larger(R::ZERO) + R::from_count(8) * R::EPSILON * of_open;
        [of_flux + R::TWO * tau * mean + energy, terms, open]
    }
}

//! Transfer laws in the bound: ∫r²/h with r = τ·n + h(s − u_ext).

use signorini_kernel::Real;
use signorini_kernel::index::{Index, read};

/// Transfer edges inside which H = ∫h lies between H⁻ and H⁺ (borrowed), N = H⁺ − H⁻; t runs from 0 to 1 along each:
/// ```text
///   ‖H^{−½}r‖ ≤ ‖(H⁻)^{−½}τ + (H⁻)^½(s − u_ext)‖ + (∫N′(s − u_ext)²)^½,     N′ = min(1, N/H⁻) N
/// ```
/// With x = (τ, s at both ends, its bubble, −1, −p), p the inputs that change u_ext, both are norms of a triangular factor times x, the
/// second without τ: sums of squares, in which s − u_ext loses no digit to the squares of either.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TransferForms<'a, R, I> {
    /// Which laws.
    pub laws: &'a [I],
    /// The numbers of the inputs p.
    pub inputs: &'a [u16],
    /// The values of all inputs.
    pub values: &'a [R],
    /// Of each law both factors by rows, which begin on the diagonal: the square of the length of x.
    pub factors: &'a [R],
}

/// τ, s at both ends, its bubble, and −1.
const OWN: usize = 5;

impl<R: Real, I: Index> TransferForms<'_, R, I> {
    /// The factors of a law that points do not see.
    fn of(&self, law: usize) -> Option<&[R]> {
        let at = self.laws.iter().position(|own| own.at() == law)?;
        let width = OWN + self.inputs.len();
        self.factors.chunks_exact(width * width).nth(at)
    }

    /// What stands at a place of x, `own` first.
    fn entry(&self, own: &[R; OWN], at: usize) -> R {
        match own.get(at) {
            Some(&own) => own,
            None => {
                -self.inputs.get(at - OWN).map_or(R::ZERO, |of| read(self.values, *of as usize))
            }
        }
    }

    /// ‖Fx‖² for the factor F at the front of `factors`, of x from an entry on, and the size of what it is summed from; F is taken off.
    fn square(&self, factors: &mut &[R], own: &[R; OWN], from: usize) -> [R; 2] {
        let width = OWN + self.inputs.len();
        let (mut value, mut terms) = (R::ZERO, R::ZERO);
        for first in from..width {
            let Some((row, rest)) = factors.split_at_checked(width - first) else { break };
            *factors = rest;
            let (mut sum, mut size) = (R::ZERO, R::ZERO);
            for (&factor, at) in row.iter().zip(first..) {
                let term = factor * self.entry(own, at);
                sum += term;
                size += term.magnitude() + sum.magnitude();
            }
            value += sum * sum;
            terms += size * (R::TWO * sum.magnitude() + R::EPSILON * size);
        }
        [value, terms]
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

    /// The term of H⁻, the size of its terms, and what N′ adds to the root; nothing for a law that its points see.
    #[inline(never)]
    pub fn by_form<I: Index>(&self, forms: &TransferForms<R, I>, law: usize) -> Option<[R; 3]> {
        let [a, b] = self.s;
        let (own, mut factors) = ([self.flux, a, b, self.bubble, -R::ONE], forms.of(law)?);
        let [value, terms] = forms.square(&mut factors, &own, 0);
        let [open, of_open] = forms.square(&mut factors, &own, 1);
        Some([value, terms, open + R::from_count(8) * R::EPSILON * of_open])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (τ + 2a + 3b + 4d − 5 − 6p)² + (7p)² of H⁻, and (a − p)² of N′, for law 3 alone and p the second input.
    #[test]
    fn a_form_is_that_of_its_law_at_the_inputs() {
        let mut factors = [0.0; 36];
        factors[..6].copy_from_slice(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        (factors[20], factors[21], factors[25]) = (7.0, 1.0, 1.0);
        let forms = TransferForms {
            laws: &[3_u16],
            inputs: &[1],
            values: &[100.0, 0.5],
            factors: &factors,
        };
        let edge = Transfer { flux: 1.0, s: [2.0, 3.0], bubble: -1.0 };
        let [value, terms, open] = edge.by_form(&forms, 3).unwrap_or_default();
        // 1 + 4 + 9 − 4 − 5 − 3 = 2, and 2 − 0.5 = 1.5.
        assert_eq!(value, 4.0 + 12.25);
        assert!((64.0..1000.0).contains(&terms), "{terms}");
        assert!(open > 2.25 && open < 2.25 + 1e-13, "{open}");
        assert_eq!(edge.by_form(&forms, 0), None);
    }
}

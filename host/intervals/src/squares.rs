//! Squares and products of residuals and weights, and what they may be off where A lies between two tensors.

use signorini_problem::pieces::{Cut, Rows};
use signorini_problem::triangular::norm;

/// Squares and products.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Products {
    /// ⟨r, r⟩, or less
    pub residual: f64,
    /// ⟨ζ − A∇z, ζ − A∇z⟩, or more
    pub weights: f64,
    /// ⟨r, ζ + A∇z⟩
    pub both: f64,
    /// By how much that may be off where A is taken for p ≤ A.
    pub off: f64,
    /// ⟨A∇z, A∇z⟩ and ⟨ζ, ζ⟩
    pub sizes: [f64; 2],
    /// Σ‖R_z′‖²/k and Σ‖R_z′‖²/(k + π²α/h²) in a step of time.
    pub inside: [f64; 2],
}

impl Products {
    /// So many times these.
    pub fn times(self, by: f64) -> Self {
        let Self { residual, weights, both, off, sizes, inside } = self;
        let [residual, weights, both, off] = [residual, weights, both, off].map(|x| by * x);
        let [sizes, inside] = [sizes, inside].map(|all| all.map(|x| by * x));
        Self { residual, weights, both, off, sizes, inside }
    }

    /// These at a point where A is no more than p + N, with p in them, and N ≤ νp. r differs by (A − p)∇s then, and
    /// ```text
    ///   |A^{−½}(A − p)v| ≤ |N′^½v|,   p⁻¹/(1 + ν) ≤ A⁻¹ ≤ p⁻¹
    /// ```
    /// `open` are |N′^½∇s| and |N′^½∇z|, `beyond` is |N^½∇z|.
    pub fn beside(self, share: f64, [by_s, by_z]: [f64; 2], beyond: f64) -> Self {
        if share == 0.0 {
            return self;
        }
        let [of_z, of_zeta] = self.sizes.map(f64::sqrt);
        // What cancels may be rounded below 0.
        let [residual, weights] =
            [self.residual, self.weights].map(|square| square.max(0.0).sqrt());
        let sum = of_zeta + of_z;
        Self {
            residual: (residual / (1.0 + share).sqrt() - by_s).max(0.0).powi(2),
            weights: (weights + by_z).powi(2),
            off: share * residual * sum + by_s * sum + residual * by_z + by_s * by_z,
            sizes: [(of_z + beyond).powi(2), self.sizes[1]],
            ..self
        }
    }

    /// These where rules miss a part of the roots of squares.
    pub fn widened(self, missed: f64) -> Self {
        if missed == 0.0 {
            return self;
        }
        let (less, more) = ((1.0 - missed).max(0.0).powi(2), (1.0 + missed).powi(2));
        let [of_z, of_zeta] = self.sizes.map(f64::sqrt);
        let both = self.residual.max(0.0).sqrt() * (of_z + of_zeta);
        Self {
            residual: less * self.residual,
            weights: more * self.weights,
            off: more * self.off + (more - less) * both,
            sizes: self.sizes.map(|size| more * size),
            ..self
        }
    }

    /// The products on the pieces of a cell, from the coefficients of s and τ, z and ζ; see [`Products::beside`].
    pub fn on_pieces(cut: &Cut, [s, tau]: [Vec<f64>; 2], [z, zeta]: [Vec<f64>; 2]) -> Self {
        let minus = |v: &[f64]| v.iter().map(|x| -x).collect::<Vec<_>>();
        let none = |of: &[f64]| vec![0.0; of.len()];
        let residual = [s.clone(), tau].concat();
        let sum = [minus(&z), zeta.clone()].concat();
        let size = |rows: &Rows, c: &[f64]| norm(&product(rows, c));
        let seen = product(&cut.seen, &residual);
        let [by_s, by_z] = [&s, &z].map(|v| size(&cut.above[0], v));
        let lost = size(&cut.doubtful, &residual);
        let (r, y) = (norm(&seen), size(&cut.seen, &sum));
        let of_z = size(&cut.seen, &[z.clone(), none(&zeta)].concat());
        let of_zeta = size(&cut.seen, &[none(&z), zeta.clone()].concat());
        Self {
            residual: ((r * r - lost * lost).max(0.0).sqrt() - by_s).max(0.0).powi(2),
            weights: (size(&cut.seen, &[z.clone(), zeta].concat()) + by_z).powi(2),
            both: seen.iter().zip(product(&cut.seen, &sum)).map(|(a, b)| a * b).sum(),
            off: lost * size(&cut.doubtful, &sum) + by_s * y + r * by_z + by_s * by_z,
            sizes: [(of_z + size(&cut.above[1], &z)).powi(2), of_zeta * of_zeta],
            inside: [0.0; 2],
        }
    }

    /// The sums.
    pub fn and(self, other: Self) -> Self {
        Self {
            residual: self.residual + other.residual,
            weights: self.weights + other.weights,
            both: self.both + other.both,
            off: self.off + other.off,
            sizes: [0, 1].map(|at| self.sizes[at] + other.sizes[at]),
            inside: [0, 1].map(|at| self.inside[at] + other.inside[at]),
        }
    }
}

/// Rc
fn product(rows: &Rows, c: &[f64]) -> Vec<f64> {
    rows.iter().map(|row| row.iter().zip(c).map(|(a, b)| a * b).sum()).collect()
}

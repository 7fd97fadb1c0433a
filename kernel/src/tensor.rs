//! The coefficient A: a symmetric, positive definite 2×2 tensor.

use nalgebra::{Matrix2, Vector2};

use crate::real::Real;

/// A symmetric 2×2 tensor \[\[xx, xy\], \[xy, yy\]\]; its unit is that of flux per gradient of u.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tensor<R> {
    /// A₁₁
    pub xx: R,
    /// A₁₂ = A₂₁
    pub xy: R,
    /// A₂₂
    pub yy: R,
}

impl<R: Real> Tensor<R> {
    /// The isotropic tensor a·I.
    pub fn scalar(a: R) -> Self {
        Self { xx: a, xy: R::ZERO, yy: a }
    }

    /// Finite and positive definite: trace and determinant are positive.
    pub fn is_positive_definite(&self) -> bool {
        let scale = self.xx.or_larger(self.yy);
        // Scaled, so that the determinant of a tiny or huge tensor neither under- nor overflows.
        let (xx, xy, yy) = (self.xx / scale, self.xy / scale, self.yy / scale);
        scale > R::ZERO && scale.finite() && xx > R::ZERO && xx * yy > xy * xy
    }

    /// The tensor as a nalgebra matrix.
    pub fn matrix(&self) -> Matrix2<R> {
        Matrix2::new(self.xx, self.xy, self.xy, self.yy)
    }

    /// A v.
    pub fn apply(&self, v: Vector2<R>) -> Vector2<R> {
        self.matrix() * v
    }
}

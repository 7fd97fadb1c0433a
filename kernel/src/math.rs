//! The one transcendental function that the kernel needs, behind one small trait.
//!
//! Element matrices, assembly, sweeps and flux use `+ − × ÷` and comparisons alone. A square root
//! serves the length of an edge and the relaxation factor. [`Libm`] is correctly rounded;
//! `Micromath` is faster without a square-root unit but off by up to 6 %, and it exists for `f32`
//! only, so that no guarantee can come to rest on it unnoticed.

use crate::real::Real;

/// A choice of square root for the scalar `R`.
pub trait Math<R: Real> {
    /// √x; NaN for negative x.
    fn sqrt(x: R) -> R;
}

/// Accurate: correctly rounded, the same bits on every machine.
#[derive(Debug, Clone, Copy)]
pub struct Libm;

impl<R: Real> Math<R> for Libm {
    fn sqrt(x: R) -> R {
        x.rounded_sqrt()
    }
}

/// Fast: an exponent trick with a relative error of up to 6e−2.
#[cfg(feature = "micromath")]
#[derive(Debug, Clone, Copy)]
pub struct Micromath;

#[cfg(feature = "micromath")]
impl Math<f32> for Micromath {
    fn sqrt(x: f32) -> f32 {
        micromath::F32(x).sqrt().0
    }
}

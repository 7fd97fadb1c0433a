//! The two scalar types: exactly `f32` and `f64`.
//!
//! Constants are associated, never converted at run time, so that an `f32` image holds no `f64`
//! arithmetic. Comparisons are written out (`if a > b`), since `min` and `max` of the standard
//! library leave the result for `-0.0` and NaN to the platform. Arithmetic is that of nalgebra's traits where there are meshes, of
//! the language's elsewhere.

/// A scalar of the kernel: `f32` or `f64`, and nothing else.
pub trait Real: Field + Copy + Default + 'static {
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;
    /// 2
    const TWO: Self;
    /// 3
    const THREE: Self;
    /// 1/2
    const HALF: Self;
    /// 1/3
    const THIRD: Self;
    /// 1/4
    const QUARTER: Self;
    /// Distance from 1 to the next larger number.
    const EPSILON: Self;
    /// The smallest positive normal number.
    const TINY: Self;
    /// ∞
    const INFINITY: Self;
    /// −∞
    const NEG_INFINITY: Self;
    /// Gauss–Legendre rules on \[0, 1\] with 1 to 8 points: (point, weight).
    const GAUSS: [&'static [[Self; 2]]; 8];

    /// A count as a scalar (rounded above 2²⁴ in `f32`).
    fn from_count(count: u32) -> Self;

    /// √x, correctly rounded (libm).
    fn rounded_sqrt(self) -> Self;

    /// The bits of the number.
    fn as_bits(self) -> u64;

    /// Neither infinite nor NaN.
    fn finite(self) -> bool;

    /// |x|, and NaN for NaN.
    fn magnitude(self) -> Self;

    /// The larger of two numbers; `self` where they do not compare.
    fn or_larger(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// The smaller of two numbers; `self` where they do not compare.
    fn or_smaller(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}

macro_rules! real {
    ($scalar:ident, $gauss:ident, $sqrt:ident) => {
        impl Real for $scalar {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const TWO: Self = 2.0;
            const THREE: Self = 3.0;
            const HALF: Self = 0.5;
            const THIRD: Self = 1.0 / 3.0;
            const QUARTER: Self = 0.25;
            const EPSILON: Self = $scalar::EPSILON;
            const TINY: Self = $scalar::MIN_POSITIVE;
            const INFINITY: Self = $scalar::INFINITY;
            const NEG_INFINITY: Self = $scalar::NEG_INFINITY;
            const GAUSS: [&'static [[Self; 2]]; 8] = crate::quadrature::$gauss;

            fn from_count(count: u32) -> Self {
                count as Self
            }

            fn as_bits(self) -> u64 {
                u64::from(self.to_bits())
            }

            fn finite(self) -> bool {
                self.is_finite()
            }

            fn magnitude(self) -> Self {
                $scalar::abs(self)
            }

            fn rounded_sqrt(self) -> Self {
                libm::$sqrt(self)
            }
        }
    };
}

real!(f32, GAUSS_F32, sqrtf);
real!(f64, GAUSS_F64, sqrt);

/// A field with an order: `f32` or `f64`, and nothing else.
#[cfg(feature = "mesh")]
pub trait Field: nalgebra::RealField + sealed::Sealed {}

/// A field with an order: `f32` or `f64`, and nothing else.
#[cfg(not(feature = "mesh"))]
pub trait Field: language::Arithmetic + sealed::Sealed {}

impl Field for f32 {}
impl Field for f64 {}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

#[cfg(not(feature = "mesh"))]
mod language {
    use core::fmt::{Debug, Display};
    use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

    pub trait Arithmetic:
        Copy
        + PartialOrd
        + Debug
        + Display
        + Send
        + Sync
        + 'static
        + Neg<Output = Self>
        + Add<Output = Self>
        + Sub<Output = Self>
        + Mul<Output = Self>
        + Div<Output = Self>
        + AddAssign
        + SubAssign
        + MulAssign
        + DivAssign
    {
    }
    impl Arithmetic for f32 {}
    impl Arithmetic for f64 {}
}

//! Arithmetic of numbers: the traits of nalgebra where there are meshes, those of the language elsewhere.

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

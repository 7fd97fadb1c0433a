//! The bridge between the host's f64 and the kernel's scalar.

use signorini_kernel::{Libm, Math, Micromath, Real};

/// A kernel scalar that the host can convert.
pub trait Scalar: Real + Send + Sync {
    /// Its name on the command line.
    const NAME: &'static str;

    /// The fastest square root there is for it.
    type Fast: Math<Self> + Copy;

    /// Its value, as a [`signorini_device::tick::Method`] takes it.
    const FAST: Self::Fast;

    /// Rounds to the scalar; too large a number becomes infinite, which the kernel refuses.
    fn narrow(x: f64) -> Self;

    /// Exact.
    fn wide(self) -> f64;
}

impl Scalar for f64 {
    const NAME: &'static str = "f64";

    type Fast = Libm;

    const FAST: Libm = Libm;

    fn narrow(x: f64) -> Self {
        x
    }

    fn wide(self) -> f64 {
        self
    }
}

impl Scalar for f32 {
    const NAME: &'static str = "f32";

    type Fast = Micromath;

    const FAST: Micromath = Micromath;

    fn narrow(x: f64) -> Self {
        x as f32
    }

    fn wide(self) -> f64 {
        f64::from(self)
    }
}

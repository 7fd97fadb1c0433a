//! The bridge between the host's f64 and the kernel's scalar, and coordinates that suit a short one: the mesh in [−1, 1]²,
//! wherever and however large it is.

use signorini_kernel::{Libm, Math, Micromath, Real, Tensor};

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

/// Numbers in f64, exact.
pub fn widened<R: Scalar>(numbers: &[R]) -> Vec<f64> {
    numbers.iter().map(|x| x.wide()).collect()
}

/// A tensor in another scalar.
pub fn narrowed<R: Scalar>(a: &Tensor<f64>) -> Tensor<R> {
    Tensor { xx: R::narrow(a.xx), xy: R::narrow(a.xy), yy: R::narrow(a.yy) }
}

/// The square around the mesh that becomes [−1, 1]².
pub(super) struct UnitBox {
    middle: [f64; 2],
    /// Half a side: the length of the new unit.
    pub(super) half: f64,
}

impl UnitBox {
    pub(super) fn of(vertices: &[[f64; 2]]) -> Self {
        let extent = |k: usize| {
            let values = vertices.iter().map(|vertex| vertex[k]);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
        };
        let (x, y) = (extent(0), extent(1));
        Self {
            middle: [0.5 * x.0 + 0.5 * x.1, 0.5 * y.0 + 0.5 * y.1],
            half: (0.5 * x.1 - 0.5 * x.0).max(0.5 * y.1 - 0.5 * y.0),
        }
    }

    /// `vertices` in it.
    pub(super) fn narrowed<R: Scalar>(&self, vertices: &[[f64; 2]]) -> Vec<[R; 2]> {
        let moved =
            |vertex: &[f64; 2]| [0, 1].map(|k| R::narrow((vertex[k] - self.middle[k]) / self.half));
        vertices.iter().map(moved).collect()
    }
}

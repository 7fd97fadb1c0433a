//! Numbers for many points at once: each step of a program is decoded once for all of them, and sums and products go through
//! vector units.

use std::array::from_fn;

use super::operation::{Binary, Unary};
use super::program::{Numbers, Program};

/// Points at once.
pub(super) const LANES: usize = 16;

/// Values of `N` places, side by side.
pub(super) struct Several<'a, N>(pub &'a N);

impl<N: Numbers> Numbers for Several<'_, N> {
    type Number = [N::Number; LANES];

    fn constant(&self, value: f64) -> Self::Number {
        [self.0.constant(value); LANES]
    }

    #[inline]
    fn unary(&self, operation: Unary, a: Self::Number) -> Self::Number {
        a.map(|a| self.0.unary(operation, a))
    }

    #[inline]
    fn binary(&self, operation: Binary, a: Self::Number, b: Self::Number) -> Self::Number {
        from_fn(|lane| self.0.binary(operation, a[lane], b[lane]))
    }
}

impl Program {
    /// The results at many points; a coordinate −0.0 is read as 0.0.
    pub(super) fn run_all(
        &self,
        numbers: &impl Numbers<Number = f64>,
        points: &[[f64; 2]],
        t: f64,
    ) -> Vec<f64> {
        let t = [numbers.constant(t); LANES];
        let mut values = Vec::with_capacity(points.len());
        for points in points.chunks(LANES) {
            // The last lanes may have no point of their own.
            let of = |lane: usize, k: usize| points[lane.min(points.len() - 1)][k] + 0.0;
            let [x, y] = [0, 1].map(|k| from_fn(|lane| numbers.constant(of(lane, k))));
            let found = self.run(&Several(numbers), [x, y, t]);
            values.extend(found.into_iter().take(points.len()));
        }
        values
    }
}

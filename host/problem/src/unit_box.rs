//! Coordinates that suit a short scalar: the mesh in [−1, 1]², wherever and however large it is.

use crate::scalar::Scalar;

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

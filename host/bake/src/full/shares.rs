//! What inputs add, place by place: nothing where that is 0.

use signorini_device::full::{Contribution, EdgeTrace};
use signorini_problem::scalar::Scalar;

/// The weights other than 0.
pub(super) fn shares<R: Scalar>(weights: &[f64]) -> Vec<Contribution<R, u32>> {
    let entries = weights.iter().zip(0..).filter(|(weight, _)| **weight != 0.0);
    entries.map(|(&weight, at)| Contribution { at, weight: R::narrow(weight) }).collect()
}

/// Means and end values of edges where one is not 0.
pub(super) fn chords<R: Scalar>(means: &[f64], ends: &[[f64; 2]]) -> Vec<EdgeTrace<R, u32>> {
    let edges = means.iter().zip(ends).zip(0..);
    let acts = edges.filter(|((mean, ends), _)| **mean != 0.0 || **ends != [0.0; 2]);
    acts.map(|((&mean, ends), at)| EdgeTrace {
        at,
        mean: R::narrow(mean),
        ends: ends.map(R::narrow),
    })
    .collect()
}

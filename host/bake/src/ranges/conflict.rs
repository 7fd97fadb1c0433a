//! Inputs within their ranges for which a Dirichlet value lies below the gap beside it: the scene has no solution there.

use crate::choice::Origin;
use signorini_condense::Corner;

/// u_D this far below ψ, against the size of its terms, is rounding.
const ROUNDING: f64 = 1e-9;

/// A sentence with the largest depth; nothing where there is none, or an input has no range.
pub fn conflict(origin: &Origin) -> Option<String> {
    let whole = &origin.whole;
    let form = whole.certificate.as_ref().ok()?;
    let below = |corner: &Corner| {
        // With a limit the flux may be at it, and u below the gap.
        if whole.end_columns(corner.edge)[1][0].is_finite() {
            return None;
        }
        let terms = || corner.excess.iter().zip(&whole.ranges).filter(|(e, _)| **e != 0.0);
        let least: f64 = terms().map(|(e, [lo, hi])| (e * lo).min(e * hi)).sum();
        let size: f64 = terms().map(|(e, [lo, hi])| (e * lo).abs().max((e * hi).abs())).sum();
        let is_below = least.is_finite() && least < -ROUNDING * size;
        is_below.then(|| -least * whole.opening[corner.edge])
    };
    let deepest = form.corners.iter().filter_map(below).reduce(f64::max)?;
    Some(format!(
        "warning: for some inputs within their ranges a Dirichlet value lies below the gap beside it, by up to {deepest:.4e}: the \
         scene has no solution there, and a tick no error bound. Narrow the ranges."
    ))
}

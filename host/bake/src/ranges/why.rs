//! What ranges do not allow: why nothing is proved of the contact edges, and inputs for which a Dirichlet value lies
//! below the gap beside it, where the scene has no solution.

use crate::choice::Origin;
use signorini_condense::ranges::split::Split;
use signorini_condense::{Corner, ModalModel};
use signorini_scene::scene::Scene;

/// u_D this far below ψ, against the size of its terms, is rounding.
const ROUNDING: f64 = 1e-9;

/// A sentence that names the inputs or the reason; nothing where something is proved.
pub(super) fn nothing_proved(scene: &Scene, origin: &Origin) -> Option<String> {
    let without = scene.inputs.iter().filter(|input| input.range.is_none());
    let without: Vec<_> = without.map(|input| format!("{:?}", input.name.value)).collect();
    if !without.is_empty() {
        let (have, their) = if without.len() == 1 { ("has", "its") } else { ("have", "their") };
        let names = without.join(", ");
        return Some(format!(
            "Nothing is proved: {names} {have} no range. Declare `range = [lo, hi]` in {their} [input] table."
        ));
    }
    let whole = &origin.whole;
    if whole.contact == 0 || origin.sides.enclosure.is_some() {
        return None;
    }
    let reason = if !whole.held_by_contact.is_empty() {
        "contact alone holds a part of the domain, and its matrix is singular"
    } else if let Some(modes) = &origin.modes {
        let name = coefficient(scene, modes);
        return Some(format!(
            "Nothing is proved: the matrix follows {name:?}, and no enclosure was found for a piece of its range."
        ));
    } else if Split::new(&whole.matrix, whole.contact).is_none() {
        "the contact edges' matrix without its positive entries off the diagonal is no M-matrix"
    } else if whole.is_limited() && has_positive_entries(&whole.matrix, whole.contact) {
        "fluxes have limits, and the contact edges' matrix has positive entries off the diagonal"
    } else {
        "the matrix of the edges that are always open is not positive definite to working precision"
    };
    Some(format!("Nothing is proved: {reason}."))
}

/// The name of the input that changes the coefficient.
pub(super) fn coefficient<'s>(scene: &'s Scene, modes: &ModalModel) -> &'s str {
    // The first input is the constant 1.
    scene.inputs.get(modes.input - 1).map_or("", |input| &input.name.value)
}

/// Whether an entry off the diagonal pushes.
fn has_positive_entries(matrix: &[f64], n: usize) -> bool {
    matrix.iter().enumerate().any(|(at, &entry)| at / n != at % n && entry > 0.0)
}

/// A sentence with the largest depth of a Dirichlet value below the gap beside it, for inputs within their ranges;
/// nothing where there is none, or an input has no range.
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

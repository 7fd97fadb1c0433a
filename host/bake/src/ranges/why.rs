//! Why nothing is proved of the contact edges for the ranges of inputs.

use crate::choice::Origin;
use signorini_condense::ModalModel;
use signorini_condense::ranges::lasting::Unproved;
use signorini_condense::ranges::split::Split;
use signorini_scene::scene::Scene;

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
    let reason = if let Some(why) = origin.unproved {
        of_steps(why)
    } else if !whole.held_by_contact.is_empty() {
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

/// Why not of steps in time.
pub(super) fn of_steps(why: Unproved) -> &'static str {
    match why {
        Unproved::NoRange => "an input has no range",
        Unproved::Indefinite => {
            "the contact edges' matrix less all that earlier steps load by, and its positive entries off the diagonal, is no M-matrix; \
             a longer step may have one"
        }
        Unproved::IndefiniteWithLimits => {
            "fluxes have limits, and the contact edges' matrix pushes too much in some step; a longer step may do"
        }
        Unproved::Start => "time.initial is not within what steps would stay in",
        Unproved::Rounding => "what a step rounds may add up to more than anything else",
        Unproved::Overflow => "what bounds all steps overflows",
    }
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

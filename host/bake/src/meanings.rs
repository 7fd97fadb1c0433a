//! What inputs do and outputs are, in a sentence each: for modules in Rust and headers in C.

use super::text::code;
use signorini_scene::scene::{Field, Input, Output, Quantity};

/// The unit that the scene gives.
pub(super) fn said(unit: &Option<String>) -> String {
    unit.as_ref().map_or_else(String::new, |unit| format!(" In {}.", code(unit)))
}

/// The effect of an input, in a sentence.
pub(super) fn effect(input: &Input) -> String {
    let (field, unit) = match input.field.value {
        Field::Flux => ("flux", "that of a flux (A∇u)·n, n outward"),
        Field::Limit => ("limit", "that of a flux (A∇u)·n, n outward"),
        Field::Value => ("value", "that of u"),
        Field::Gap => ("gap", "that of u"),
        Field::Ambient => ("ambient", "that of u"),
        Field::Coefficient => ("coefficient", "that of a flux over that of u"),
        Field::Source => ("f", "that of the load f"),
    };
    let (pattern, of) = (code(&input.pattern.value.to_string()), code(&input.of.value));
    format!(
        "Times {pattern} (unit: {unit}) it is added to `{field}` of {of}; default {:?}.",
        input.default
    )
}

/// The meaning of an output, in a few words.
pub(super) fn meaning(output: &Output) -> String {
    let place = output.place("all contact", code);
    match output.quantity {
        Quantity::Flux => {
            format!("∫(A∇u)·n over {place}, n outward; unit of a flux times a length.")
        }
        Quantity::Force => {
            format!(
                "∫(σ·n − q) over {place}, σ = A∇u; never negative, wherever a tick ends; unit of a flux times a \
                 length."
            )
        }
        Quantity::Length => format!("Length of {place} where u = ψ; unit of the mesh."),
        Quantity::Saturated => {
            format!("Length of {place} where the flux is at its limit, u < ψ; unit of the mesh.")
        }
        Quantity::Mean | Quantity::MeanInside => format!("Mean of u over {place}."),
        Quantity::Content => {
            let place = output.place("the domain", code);
            format!("∫c u over {place}, c the capacity; unit of c times an area times u.")
        }
        Quantity::Probe { at: [x, y] } => format!("u at ({x}, {y})."),
        Quantity::Window => {
            "Bound on the energy norm of the error over time; infinite where there is none."
                .to_owned()
        }
        Quantity::Bound => {
            "Bound on the error in the energy norm; infinite where there is none.".to_owned()
        }
    }
}

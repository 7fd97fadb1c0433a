//! The statics of the condensed model as Rust text.

use std::fmt::{Debug, Write as _};

use signorini_contact::dense::blocks::Block;

use super::arrays::{Baked, Solver};
use super::bound::{Bound, Ends};
use super::modes::Modes;
use super::output::Output;
use crate::module_api::ModuleApi;
use crate::text::array;
use signorini_problem::scalar::Scalar;

/// A module of their own.
pub(super) fn data<R: Scalar>(face: &ModuleApi, baked: &Baked<R>) -> String {
    let mut text = String::new();
    let mut names = Vec::new();
    put(&mut text, "MATRIX", "S, the lower triangle of its blocks.", "[[Scalar; 8]; 8]", {
        (baked.matrix.len(), blocks(&baked.matrix))
    });
    let start = match baked.solver() {
        Solver::Exchanges(_) | Solver::TwoPhases if baked.modes.is_none() => {
            let doc = "The tableau of the scene's own inputs: where exchanges begin.";
            let value = (baked.start.blocks.len(), blocks(&baked.start.blocks));
            put(&mut text, "TABLEAU", doc, "[[Scalar; 8]; 8]", value);
            let value = (baked.start.exchanged.len(), array(&baked.start.exchanged, 4));
            put(&mut text, "OPEN", "The edges that are open in it.", "bool", value);
            "InitialTableau { blocks: &TABLEAU, exchanged: &OPEN }"
        }
        _ => "InitialTableau { blocks: &[], exchanged: &[] }",
    };
    let _ = write!(
        text,
        "\n    /// The scaled openings for the scene's own inputs.\n    static START: [Scalar; {}] \
         = {};\n",
        baked.start.x.len(),
        array(&baked.start.x, 4)
    );
    numbers(
        &mut text,
        "LOAD",
        "B by columns: what each input, the constant first, does.",
        &baked.load,
    );
    let limits = match baked.limits.is_empty() {
        true => "&[]",
        false => {
            let value = (baked.limits.len(), array(&baked.limits, 4));
            put(&mut text, "WITHIN", "Where openings are kept, scaled.", "[Scalar; 2]", value);
            "&WITHIN"
        }
    };
    let spans = match baked.spans.is_empty() {
        true => "SpanColumns::UNLIMITED",
        false => {
            let doc = "How far it is to the other end of each flux, by columns.";
            let spans = array(&baked.spans, 4);
            put(&mut text, "SPANS", doc, "Scalar", (baked.spans.len(), spans));
            "SpanColumns::new(&SPANS)"
        }
    };
    for (output, name) in baked.outputs.iter().zip(face.outputs()) {
        names.push(measure(&mut text, &name.to_ascii_uppercase(), output));
    }
    let certificate = match &baked.bound {
        Ok(bound) => certificate(&mut text, bound),
        Err(_) => "None".to_owned(),
    };
    let uses = match &baked.bound {
        Ok(bound) if bound.corners.is_empty() => {
            "certificate::{Form, Vertex}, factor::Factor, sides::Sides, "
        }
        Ok(_) => "certificate::{Corner, Form, Vertex}, factor::Factor, sides::Sides, ",
        Err(_) => "",
    };
    let [uses_modes, of, before, after] = match &baked.modes {
        Some(modes) => {
            ["modes::Modal, ", "Modal", "Modal {\n        model: ", &of_modes(&mut text, modes)]
                .map(str::to_owned)
        }
        None => ["", "Condensed", "", ""].map(str::to_owned),
    };
    let model = format!(
        "Condensed {{
        contact: super::CONTACT,
        matrix: &MATRIX,
        x: &START,
        start: {start},
        load: &LOAD,
        limits: {limits},
        spans: {spans},
        outputs: &[{}],
        certificate: {certificate},
        has_bound: {},
    }}",
        names.iter().map(|name| format!("\n            {name},")).collect::<String>()
            + "\n        ",
        baked.has_bound,
    );
    let model = if baked.modes.is_some() { model.replace("\n    ", "\n        ") } else { model };
    format!(
        "
/// The scene: what stays from tick to tick.
#[rustfmt::skip]
#[allow(clippy::all)]
mod data {{
    use signorini_device::contact::{{{uses}{uses_modes}outputs::Measure, spans::SpanColumns, Condensed}};
    use signorini_device::contact::dense::tableau::InitialTableau;

    use super::Scalar;
{text}
    /// All of it.
    pub static SYSTEM: {of}<'static, Scalar> = {before}{model}{after};
}}
"
    )
}

/// What follows the model of modes.
fn of_modes<R: Scalar>(text: &mut String, modes: &Modes<R>) -> String {
    numbers(text, "COMPLIANCE", "What one of each mode brings to itself.", &modes.compliance);
    numbers(text, "MODES_OF_INPUTS", "By modes: what the inputs bring to them.", &modes.of_inputs);
    let laws = match &modes.laws {
        None => "None",
        Some(laws) => {
            numbers(text, "LAWS", "F of the laws that change, by columns.", &laws.columns);
            numbers(text, "LAWS_NORMS", "The norms of its columns.", &laws.norms);
            "Some(Factor { columns: &LAWS, norms: &LAWS_NORMS })"
        }
    };
    format!(
        ",
        input: {},
        origin: {:?},
        per_unit: {:?},
        compliance: &COMPLIANCE,
        of_inputs: &MODES_OF_INPUTS,
        laws: {laws},
        is_monotone: {},
    }}",
        modes.input, modes.origin, modes.per_unit, modes.is_monotone
    )
}

fn put(text: &mut String, name: &str, doc: &str, of: &str, (length, value): (usize, String)) {
    let _ = write!(text, "\n    /// {doc}\n    static {name}: [{of}; {length}] = {value};\n");
}

fn numbers<T: Debug>(text: &mut String, name: &str, doc: &str, numbers: &[T]) {
    put(text, name, doc, "Scalar", (numbers.len(), array(numbers, 4)));
}

/// A line a row of each block.
fn blocks<R: Debug>(blocks: &[Block<R>]) -> String {
    let block = |block: &Block<R>| {
        let rows: String = block.iter().map(|row| format!("\n        {row:?},")).collect();
        format!("\n        [{}],", rows.trim_start().trim_end_matches(','))
    };
    format!("[{}\n    ]", blocks.iter().map(block).collect::<String>())
}

fn measure<R: Debug>(text: &mut String, name: &str, output: &Output<R>) -> String {
    match output {
        Output::Linear { of_inputs, of_contact } => {
            numbers(text, &format!("{name}_OF_INPUTS"), "By the inputs.", of_inputs);
            numbers(text, &format!("{name}_OF_CONTACT"), "By the openings.", of_contact);
            format!(
                "Measure::Linear {{ of_inputs: &{name}_OF_INPUTS, of_contact: &{name}_OF_CONTACT }}"
            )
        }
        Output::Flux { of_inputs, of_contact, of_reaction } => {
            let mut some = |of: &str, doc: &str, factors: &[R]| {
                if factors.is_empty() {
                    return "&[]".to_owned();
                }
                let name = format!("{name}_{of}");
                numbers(text, &name, doc, factors);
                format!("&{name}")
            };
            let of_inputs = some("OF_INPUTS", "By the inputs.", of_inputs);
            let of_contact = some("OF_CONTACT", "By the openings.", of_contact);
            let of_reaction = some("OF_REACTION", "By the reactions.", of_reaction);
            format!(
                "Measure::Flux {{ of_inputs: {of_inputs}, of_contact: {of_contact}, \
                 of_reaction: {of_reaction} }}"
            )
        }
        Output::Length { always, of_contact } => {
            numbers(text, &format!("{name}_OF_CONTACT"), "Lengths of the edges.", of_contact);
            format!("Measure::Length {{ always: {always:?}, of_contact: &{name}_OF_CONTACT }}")
        }
        Output::Saturated { always, of_contact } => {
            numbers(text, &format!("{name}_OF_CONTACT"), "Lengths of the edges.", of_contact);
            format!("Measure::Saturated {{ always: {always:?}, of_contact: &{name}_OF_CONTACT }}")
        }
        Output::Bound => "Measure::Bound".to_owned(),
    }
}

fn certificate<R: Debug>(text: &mut String, bound: &Bound<R>) -> String {
    numbers(text, "FACTOR", "F by columns: inputs, openings, corrections.", &bound.factor.columns);
    numbers(text, "NORMS", "The norms of its columns.", &bound.factor.norms);
    let jump = match &bound.jump {
        None => "None",
        Some(jump) => {
            numbers(text, "JUMP", "J by columns: what u_h is off from s.", &jump.columns);
            numbers(text, "JUMP_NORMS", "The norms of its columns.", &jump.norms);
            "Some(Factor { columns: &JUMP, norms: &JUMP_NORMS })"
        }
    };
    let vertices = &bound.vertices;
    put(text, "VERTICES", "Contact vertices.", "Vertex<Scalar>", {
        (vertices.len(), array(vertices, 4))
    });
    numbers(text, "OSCILLATION", "The oscillation of each input.", &bound.oscillation);
    numbers(text, "LARGEST_LOAD", "The largest entry of each load.", &bound.largest_load);
    let floating = match bound.floating.is_empty() {
        true => "&[]",
        false => {
            numbers(text, "FLOATING", "The flux of a unit on each contact edge.", &bound.floating);
            "&FLOATING"
        }
    };
    let sides = match &bound.sides {
        None => "Sides::UNLIMITED".to_owned(),
        Some(sides) => baked_sides(text, sides),
    };
    let corners = bound.corners.iter().enumerate().map(|(at, (edge, excess, energy))| {
        let name = format!("CORNER_{at}");
        numbers(text, &name, "u_D above the gap at an end of the contact.", excess);
        format!("Corner {{ edge: {edge}, excess: &{name}, energy: {energy:?} }}")
    });
    let corners: Vec<_> = corners.collect();
    format!(
        "Some(Form {{
            factor: Factor {{ columns: &FACTOR, norms: &NORMS }},
            jump: {jump},
            vertices: &VERTICES,
            corners: &[{}],
            sides: {sides},
            stability: {:?},
            floating: {floating},
            oscillation: &OSCILLATION,
            row_sum: {:?},
            largest_load: &LARGEST_LOAD,
            unit: {:?},
        }})",
        corners.join(", "),
        bound.stability,
        bound.row_sum,
        bound.unit
    )
}

/// Where s − ψ comes from at the ends of contact edges.
fn baked_sides<R: Debug>(text: &mut String, sides: &Ends<R>) -> String {
    let value = (sides.ends.len(), array(&sides.ends, 4));
    put(text, "ENDS", "Vertices and corners at the ends of contact edges.", "[u16; 2]", value);
    numbers(text, "SCALE", "From the unit of vertices to that of 1/r.", &sides.scale);
    numbers(text, "LARGEST_SPAN", "The largest span of each input.", &sides.largest);
    format!(
        "Sides::new(signorini_device::contact::sides::Baked {{
                ends: &ENDS,
                scale: &SCALE,
                excess: {:?},
                largest: &LARGEST_SPAN,
            }})",
        sides.excess
    )
}

//! The statics of the condensed model, written by the structs that borrow them.

use std::fmt::Write as _;

use signorini_contact::certificate::{Corner, Form, Vertex};
use signorini_contact::dense::blocks::Block;
use signorini_contact::factor::Factor;
use signorini_contact::modes::Modal;
use signorini_contact::outputs::Measure;
use signorini_contact::{Condensed, sides};

use super::arrays::{Baked, Solver};
use crate::statics::{Statics, lines, named};
use signorini_problem::scalar::Scalar;

/// Names that they may use, with their place in the kernel.
const NAMES: &[(&str, &str)] = &[
    ("Condensed", "contact::Condensed"),
    ("Corner", "contact::certificate::Corner"),
    ("Form", "contact::certificate::Form"),
    ("Vertex", "contact::certificate::Vertex"),
    ("Factor", "contact::factor::Factor"),
    ("Modal", "contact::modes::Modal"),
    ("Measure", "contact::outputs::Measure"),
    ("Baked", "contact::sides::Baked"),
    ("Sides", "contact::sides::Sides"),
    ("SpanColumns", "contact::spans::SpanColumns"),
    ("InitialTableau", "contact::dense::tableau::InitialTableau"),
];

/// A module of their own.
pub(super) fn data<'n, R: Scalar>(
    outputs: impl Iterator<Item = &'n str>,
    baked: &Baked<R>,
) -> String {
    written(outputs, baked).module(NAMES, "Scalar")
}

/// Everything in flash; `outputs` are their names.
pub(super) fn written<'n, R: Scalar>(
    outputs: impl Iterator<Item = &'n str>,
    baked: &Baked<R>,
) -> Statics {
    let mut to = Statics::default();
    baked.with_model(|model| {
        let system = condensed(model, outputs, baked, &mut to);
        let (of, system) = match &baked.modes {
            None => ("Condensed", system),
            Some(modes) => ("Modal", modal(&modes.view(model), &system, &mut to)),
        };
        let _ = write!(
            to.text,
            "
    /// The scene as the kernel takes it.
    pub static SYSTEM: {of}<'static, Scalar> = {system};
"
        );
    });
    to
}

#[rustfmt::skip] // A table; so below.
fn condensed<'n, R: Scalar>(of: &Condensed<R>, names: impl Iterator<Item = &'n str>, baked: &Baked<R>, to: &mut Statics) -> String {
    let matrix = to.array::<Block<R>>("MATRIX", "S, the lower triangle of its blocks.", "[[Scalar; 8]; 8]", of.matrix);
    let start = start(of, baked, to);
    let x = to.array::<R>("START", "The scaled openings for the scene's own inputs.", "Scalar", of.x);
    let load = to.array::<R>("LOAD", "B by columns: what each input, the constant first, does.", "Scalar", of.load);
    let limits = to.array::<[R; 2]>("WITHIN", "Where openings are kept, scaled.", "[Scalar; 2]", of.limits);
    let spans = to.array::<R>("SPANS", "How far it is to the other end of each flux, by columns.", "Scalar", &baked.spans);
    let spans = if baked.is_limited() { format!("SpanColumns::new({spans})") } else { "SpanColumns::UNLIMITED".to_owned() };
    let outputs = of.outputs.iter().zip(names).map(|(of, name)| measure(of, name, to));
    let outputs = lines(&outputs.collect::<Vec<_>>());
    let certificate = of.certificate.as_ref().map_or("None".to_owned(), |form| certificate(form, baked, to));
    let has_bound = of.has_bound;
    format!(
        "Condensed {{
        contact: super::CONTACT,
        matrix: {matrix},
        x: {x},
        start: {start},
        load: {load},
        limits: {limits},
        spans: {spans},
        outputs: {outputs},
        certificate: {certificate},
        has_bound: {has_bound},
    }}"
    )
}

/// The tableau in which exchanges begin; with modes they begin in S(t).
fn start<R: Scalar>(of: &Condensed<R>, baked: &Baked<R>, to: &mut Statics) -> String {
    let is_exact = matches!(baked.solver(), Solver::Exchanges(_) | Solver::TwoPhases);
    let (blocks, exchanged) = match is_exact && baked.modes.is_none() {
        true => (of.start.blocks, of.start.exchanged),
        false => (&[][..], &[][..]),
    };
    let doc = "The tableau of the scene's own inputs: where exchanges begin.";
    let blocks = to.array::<Block<R>>("TABLEAU", doc, "[[Scalar; 8]; 8]", blocks);
    let exchanged = to.array::<bool>("OPEN", "The edges that are open in it.", "bool", exchanged);
    format!("InitialTableau {{ blocks: {blocks}, exchanged: {exchanged} }}")
}

/// The model of modes around that where the coefficient is least.
#[rustfmt::skip]
fn modal<R: Scalar>(of: &Modal<R>, model: &str, to: &mut Statics) -> String {
    let Modal { input, origin, per_unit, compliance, of_inputs, laws, is_monotone, .. } = of;
    let compliance = to.array::<R>("COMPLIANCE", "What one of each mode brings to itself.", "Scalar", compliance);
    let of_inputs = to.array::<R>("MODES_OF_INPUTS", "By modes: what the inputs bring to them.", "Scalar", of_inputs);
    let laws = optional(laws.as_ref(), "LAWS", "F of the laws that change, by columns.", to);
    format!(
        "Modal {{
        model: {model},
        input: {input},
        origin: {origin:?},
        per_unit: {per_unit:?},
        compliance: {compliance},
        of_inputs: {of_inputs},
        laws: {laws},
        is_monotone: {is_monotone},
    }}"
    )
}

/// The array that an output is read off.
fn measure<R: Scalar>(of: &Measure<R>, output: &str, to: &mut Statics) -> String {
    let mut factors =
        |what: &str, doc: &str, all: &[R]| to.array::<R>(&named(output, what), doc, "Scalar", all);
    let by_inputs = "By the inputs.";
    let by_openings = "By the openings.";
    let lengths = "Lengths of the edges.";
    match *of {
        Measure::Linear { of_inputs, of_contact } => {
            let of_inputs = factors("OF_INPUTS", by_inputs, of_inputs);
            let of_contact = factors("OF_CONTACT", by_openings, of_contact);
            format!("Measure::Linear {{ of_inputs: {of_inputs}, of_contact: {of_contact} }}")
        }
        Measure::Flux { of_inputs, of_contact, of_reaction } => {
            let of_inputs = factors("OF_INPUTS", by_inputs, of_inputs);
            let of_contact = factors("OF_CONTACT", by_openings, of_contact);
            let of_reaction = factors("OF_REACTION", "By the reactions.", of_reaction);
            format!(
                "Measure::Flux {{ of_inputs: {of_inputs}, of_contact: {of_contact}, of_reaction: {of_reaction} }}"
            )
        }
        Measure::Length { always, of_contact } => {
            let of_contact = factors("OF_CONTACT", lengths, of_contact);
            format!("Measure::Length {{ always: {always:?}, of_contact: {of_contact} }}")
        }
        Measure::Saturated { always, of_contact } => {
            let of_contact = factors("OF_CONTACT", lengths, of_contact);
            format!("Measure::Saturated {{ always: {always:?}, of_contact: {of_contact} }}")
        }
        Measure::Bound => "Measure::Bound".to_owned(),
    }
}

#[rustfmt::skip]
fn certificate<R: Scalar>(of: &Form<R>, baked: &Baked<R>, to: &mut Statics) -> String {
    let Form { factor, jump, vertices, corners, stability, floating, oscillation, row_sum, largest_load, unit, .. } = of;
    let factor = self::factor(factor, "FACTOR", "F by columns: inputs, openings, corrections.", to);
    let jump = optional(jump.as_ref(), "JUMP", "J by columns: what u_h is off from s.", to);
    let vertices = to.array::<Vertex<R>>("VERTICES", "Contact vertices.", "Vertex<Scalar>", vertices);
    let oscillation = to.array::<R>("OSCILLATION", "The oscillation of each input.", "Scalar", oscillation);
    let largest_load = to.array::<R>("LARGEST_LOAD", "The largest entry of each load.", "Scalar", largest_load);
    let floating = to.array::<R>("FLOATING", "The flux of a unit on each contact edge.", "Scalar", floating);
    let sides = sides(baked, to);
    let corners = corners.iter().enumerate().map(|(at, corner)| self::corner(at, corner, to));
    let corners = lines(&corners.collect::<Vec<_>>());
    format!(
        "Some(Form {{
            factor: {factor},
            jump: {jump},
            vertices: {vertices},
            corners: {corners},
            sides: {sides},
            stability: {stability:?},
            floating: {floating},
            oscillation: {oscillation},
            row_sum: {row_sum:?},
            largest_load: {largest_load},
            unit: {unit:?},
        }})"
    )
}

fn corner<R: Scalar>(at: usize, of: &Corner<R>, to: &mut Statics) -> String {
    let Corner { edge, excess, energy } = of;
    let doc = "u_D above the gap at an end of the contact.";
    let excess = to.array::<R>(&format!("CORNER_{at}"), doc, "Scalar", excess);
    format!("Corner {{ edge: {edge}, excess: {excess}, energy: {energy:?} }}")
}

/// Where s − ψ comes from at the ends of contact edges.
#[rustfmt::skip]
fn sides<R: Scalar>(baked: &Baked<R>, to: &mut Statics) -> String {
    let Some(sides) = baked.sides() else { return "Sides::UNLIMITED".to_owned() };
    let sides::Baked { ends, scale, excess, largest } = sides;
    let ends = to.array::<[u16; 2]>("ENDS", "Vertices and corners at the ends of contact edges.", "[u16; 2]", ends);
    let scale = to.array::<R>("SCALE", "From the unit of vertices to that of 1/r.", "Scalar", scale);
    let largest = to.array::<R>("LARGEST_SPAN", "The largest span of each input.", "Scalar", largest);
    format!("Sides::new(Baked {{ ends: {ends}, scale: {scale}, excess: {excess:?}, largest: {largest} }})")
}

fn factor<R: Scalar>(of: &Factor<R>, name: &str, doc: &str, to: &mut Statics) -> String {
    let columns = to.array::<R>(name, doc, "Scalar", of.columns);
    let norms = format!("{name}_NORMS");
    let norms = to.array::<R>(&norms, "The norms of its columns.", "Scalar", of.norms);
    format!("Factor {{ columns: {columns}, norms: {norms} }}")
}

fn optional<R: Scalar>(of: Option<&Factor<R>>, name: &str, doc: &str, to: &mut Statics) -> String {
    of.map_or("None".to_owned(), |of| format!("Some({})", factor(of, name, doc, to)))
}

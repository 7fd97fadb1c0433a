//! The statics of the condensed model, written by the structs that borrow them.

use std::fmt::Write as _;

use signorini_contact::certificate::{Corner, Form, Vertex};
use signorini_contact::dense::blocks::Block;
use signorini_contact::factor::Factor;
use signorini_contact::modes::Modal;
use signorini_contact::outputs::Measure;
use signorini_contact::steps::Stepped;
use signorini_contact::steps::evolution::Evolution;
use signorini_contact::{Condensed, sides};

use super::arrays::{Baked, Solver};
use super::balance;
use crate::Bakes;
use crate::room::{self, Room};
use crate::statics::{Statics, lines, named, record, tall_record};
use signorini_problem::scalar::Scalar;

/// Items of the kernel that they may use.
pub(super) const NAMES: &str = "\
    contact::Condensed contact::balance::Balance contact::certificate::Corner contact::certificate::Form \
    contact::certificate::Vertex contact::factor::Factor contact::modes::Modal \
    contact::outputs::Measure contact::sides::Baked contact::sides::Sides \
    contact::spans::SpanColumns contact::steps::Stepped contact::steps::evolution::Evolution \
    kernel::evolution::Rates kernel::flux_range::Room contact::dense::tableau::InitialTableau";

/// Everything in flash; `outputs` are their names.
pub(super) fn written<'n, R: Bakes>(
    outputs: impl Iterator<Item = &'n str>,
    baked: &Baked<R>,
) -> Statics {
    let mut to = Statics::default();
    baked.with_model(|model| {
        let system = condensed(model, outputs, baked, &mut to);
        let (of, system) = match (&baked.modes, &baked.steps) {
            (None, None) => ("Condensed", system),
            (None, Some(steps)) => ("Stepped", stepped(&steps.view(model), system, &mut to)),
            (Some(modes), _) => ("Modal", modal(&modes.view(model), system, &mut to)),
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
fn condensed<'n, R: Bakes>(of: &Condensed<R>, names: impl Iterator<Item = &'n str>, baked: &Baked<R>, to: &mut Statics) -> String {
    let matrix = to.array::<Block<R>>("MATRIX", "S, the lower triangle of its blocks.", "[[Scalar; 8]; 8]", of.matrix);
    let start = start(of, baked, to);
    tall_record("Condensed", 4, [
        ("contact", "super::CONTACT".to_owned()),
        ("matrix", matrix),
        ("x", to.numbers("START", "The scaled openings for the scene's own inputs.", of.x)),
        ("start", start),
        ("load", to.numbers("LOAD", "B by columns: what each input, the constant first, does.", of.load)),
        ("limits", to.array::<[R; 2]>("WITHIN", "Where openings are kept, scaled.", "[Scalar; 2]", of.limits)),
        ("spans", match baked.is_limited() {
            true => {
                let columns = to.numbers("SPANS", "How far it is to the other end of each flux, by columns.", &baked.spans);
                let rooms: Vec<_> = baked.rooms.iter().map(Room::view).collect();
                let rooms = room::written(&rooms, to);
                format!("SpanColumns::new({columns}).within({rooms})")
            }
            false => "SpanColumns::UNLIMITED".to_owned(),
        }),
        ("parts", balance::written(of.parts, to)),
        ("outputs", lines(of.outputs.iter().zip(names).map(|(of, name)| measure(of, name, to)))),
        ("certificate", of.certificate.as_ref().map_or("None".to_owned(), |form| certificate(form, baked, to))),
        ("has_bound", of.has_bound.to_string()),
    ])
}

/// The tableau in which exchanges begin; with modes they begin in S(t).
fn start<R: Bakes>(of: &Condensed<R>, baked: &Baked<R>, to: &mut Statics) -> String {
    let is_exact = matches!(baked.solver(), Solver::Exchanges(_) | Solver::TwoPhases);
    let (blocks, exchanged) = match is_exact && baked.modes.is_none() {
        true => (of.start.blocks, of.start.exchanged),
        false => (&[][..], &[][..]),
    };
    let doc = "The tableau of the scene's own inputs: where exchanges begin.";
    let blocks = to.array::<Block<R>>("TABLEAU", doc, "[[Scalar; 8]; 8]", blocks);
    let exchanged = to.array::<bool>("OPEN", "The edges that are open in it.", "bool", exchanged);
    record("InitialTableau", [("blocks", blocks), ("exchanged", exchanged)])
}

/// The model of modes around that where the coefficient is least.
#[rustfmt::skip]
fn modal<R: Scalar>(of: &Modal<R>, model: String, to: &mut Statics) -> String {
    tall_record("Modal", 4, [
        ("model", model),
        ("input", of.input.to_string()),
        ("origin", format!("{:?}", of.origin)),
        ("per_unit", format!("{:?}", of.per_unit)),
        ("compliance", to.numbers("COMPLIANCE", "What one of each mode brings to itself.", of.compliance)),
        ("of_inputs", to.numbers("MODES_OF_INPUTS", "By modes: what the inputs bring to them.", of.of_inputs)),
        ("laws", optional(of.laws.as_ref(), "LAWS", "F of the laws that change, by columns.", to)),
        ("is_monotone", of.is_monotone.to_string()),
    ])
}

/// The model of one step with what it hands on.
#[rustfmt::skip]
fn stepped<R: Scalar>(of: &Stepped<R>, model: String, to: &mut Statics) -> String {
    tall_record("Stepped", 4, [
        ("model", model),
        ("fading", to.numbers("FADING", "What a step leaves of each state.", of.fading)),
        ("of_inputs", to.numbers("STATES_OF_INPUTS", "By states: what changes of the inputs take from them.", of.of_inputs)),
        ("begin", to.numbers("BEGIN", "What the first step begins from: inputs, scaled openings, states, corrections, and what the bound of the evolution carries.", of.begin)),
        ("reach", format!("{:?}", of.reach)),
        ("evolution", of.evolution.as_ref().map_or("None".to_owned(), |of| evolution(of, to))),
    ])
}

/// What the bound of the evolution takes beside.
#[rustfmt::skip]
fn evolution<R: Scalar>(of: &Evolution<R>, to: &mut Statics) -> String {
    let evolution = tall_record("Evolution", 8, [
        ("length", format!("{:?}", of.length)),
        ("rates", format!("{:?}", of.rates)),
        ("residual", factor(&of.residual, "RESIDUAL", "By what a step changes: what it leaves of its equation.", to)),
        ("motion", factor(&of.motion, "MOTION", "By what a step changes: the energy of that.", to)),
        ("ends", to.array::<[u16; 2]>("STEP_ENDS", "Vertices and corners at the ends of contact edges.", "[u16; 2]", of.ends)),
        ("scale", to.numbers("STEP_SCALE", "From the unit of vertices to that of 1/r.", of.scale)),
    ]);
    format!("Some({evolution})")
}

/// The arrays that an output is read off.
fn measure<R: Scalar>(of: &Measure<R>, output: &str, to: &mut Statics) -> String {
    let inputs = ("of_inputs", "By the inputs.");
    let openings = ("of_contact", "By the openings.");
    let lengths = ("of_contact", "Lengths of the edges.");
    let reactions = ("of_reaction", "By the reactions.");
    let (kind, always, arrays) = match *of {
        Measure::Linear { of_inputs, of_contact } => {
            ("Linear", None, vec![(inputs, of_inputs), (openings, of_contact)])
        }
        Measure::Flux { of_inputs, of_contact, of_reaction } => {
            let all = vec![(inputs, of_inputs), (openings, of_contact), (reactions, of_reaction)];
            ("Flux", None, all)
        }
        Measure::Length { always, of_contact } => {
            ("Length", Some(always), vec![(lengths, of_contact)])
        }
        Measure::Saturated { always, of_contact } => {
            ("Saturated", Some(always), vec![(lengths, of_contact)])
        }
        Measure::Bound => return "Measure::Bound".to_owned(),
    };
    let arrays = arrays.into_iter().map(|((field, doc), all)| {
        let name = named(output, &field.to_ascii_uppercase());
        format!("{field}: {}", to.numbers(&name, doc, all))
    });
    let always = always.map(|always| format!("always: {always:?}"));
    let fields: Vec<_> = always.into_iter().chain(arrays).collect();
    format!("Measure::{kind} {{ {} }}", fields.join(", "))
}

#[rustfmt::skip]
fn certificate<R: Bakes>(of: &Form<R>, baked: &Baked<R>, to: &mut Statics) -> String {
    let factor = factor(&of.factor, "FACTOR", "F by columns: inputs, openings, corrections.", to);
    let jump = optional(of.jump.as_ref(), "JUMP", "J by columns: what u_h is off from s.", to);
    let vertices = to.array::<Vertex<R>>("VERTICES", "Contact vertices.", "Vertex<Scalar>", of.vertices);
    let oscillation = to.numbers("OSCILLATION", "The oscillation of each input.", of.oscillation);
    let largest_load = to.numbers("LARGEST_LOAD", "The largest entry of each load.", of.largest_load);
    let floating = to.numbers("FLOATING", "The flux of a unit on each contact edge.", of.floating);
    let sides = sides(baked, to);
    let form = tall_record("Form", 8, [
        ("factor", factor),
        ("jump", jump),
        ("vertices", vertices),
        ("corners", lines(of.corners.iter().enumerate().map(|(at, of)| corner(at, of, to)))),
        ("sides", sides),
        ("stability", format!("{:?}", of.stability)),
        ("floating", floating),
        ("oscillation", oscillation),
        ("row_sum", format!("{:?}", of.row_sum)),
        ("largest_load", largest_load),
        ("unit", format!("{:?}", of.unit)),
    ]);
    format!("Some({form})")
}

fn corner<R: Scalar>(at: usize, of: &Corner<R>, to: &mut Statics) -> String {
    let Corner { edge, excess, energy } = of;
    let doc = "u_D above the gap at an end of the contact.";
    let excess = to.numbers(&format!("CORNER_{at}"), doc, excess);
    format!("Corner {{ edge: {edge}, excess: {excess}, energy: {energy:?} }}")
}

/// Where s − ψ comes from at the ends of contact edges.
#[rustfmt::skip]
fn sides<R: Bakes>(baked: &Baked<R>, to: &mut Statics) -> String {
    let Some(sides::Baked { ends, scale, excess, largest }) = baked.sides() else { return "Sides::UNLIMITED".to_owned() };
    let sides = record("Baked", [
        ("ends", to.array::<[u16; 2]>("ENDS", "Vertices and corners at the ends of contact edges.", "[u16; 2]", ends)),
        ("scale", to.numbers("SCALE", "From the unit of vertices to that of 1/r.", scale)),
        ("excess", format!("{excess:?}")),
        ("largest", to.numbers("LARGEST_SPAN", "The largest span of each input.", largest)),
    ]);
    format!("Sides::new({sides})")
}

fn factor<R: Scalar>(of: &Factor<R>, name: &str, doc: &str, to: &mut Statics) -> String {
    let columns = to.numbers(name, doc, of.columns);
    let norms = to.numbers(&format!("{name}_NORMS"), "The norms of its columns.", of.norms);
    record("Factor", [("columns", columns), ("norms", norms)])
}

fn optional<R: Scalar>(of: Option<&Factor<R>>, name: &str, doc: &str, to: &mut Statics) -> String {
    of.map_or("None".to_owned(), |of| format!("Some({})", factor(of, name, doc, to)))
}

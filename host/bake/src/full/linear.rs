//! The statics of inputs and outputs: what each adds, and what each is read off.

use signorini_device::full::{
    AmbientShare, Contribution, EdgeTrace, Functional, Pattern, Points, TransferPattern,
};
use signorini_kernel::Index;

use crate::module_api::ModuleApi;
use crate::statics::{Statics, lines, named, record};
use signorini_problem::scalar::Scalar;

/// The share that each input adds for each unit of its value.
pub(super) fn patterns<R: Scalar, I: Index>(
    all: &[Pattern<R, u32>],
    face: &ModuleApi,
    to: &mut Statics,
) -> String {
    lines(
        all.iter().zip(&face.inputs).map(|(of, input)| pattern::<R, I>(of, &input.identifier, to)),
    )
}

fn pattern<R: Scalar, I: Index>(of: &Pattern<R, u32>, input: &str, to: &mut Statics) -> String {
    let adds = format!("that a unit of `{input}` adds.");
    let mut shares = |what: &str, doc: &str, all: &[Contribution<R, u32>]| {
        contributions::<R, I>(&named(input, what), &format!("{doc} {adds}"), all, to)
    };
    match of {
        Pattern::Source { triangles, quads } => {
            let triangles = ("triangles", shares("TO_TRIANGLES", "∫f", triangles));
            record("Pattern::Source", [triangles, ("quads", shares("TO_QUADS", "∫f", quads))])
        }
        Pattern::Neumann(all) => format!("Pattern::Neumann({})", shares("PATTERN", "∫g", all)),
        Pattern::ContactFlux(all) => {
            format!("Pattern::ContactFlux({})", shares("PATTERN", "∫q", all))
        }
        Pattern::ContactRange { fluxes, spans } => {
            let fluxes = ("fluxes", shares("TO_FLUXES", "∫lo", fluxes));
            let spans = ("spans", shares("TO_SPANS", "∫(hi − lo)", spans));
            record("Pattern::ContactRange", [fluxes, spans])
        }
        Pattern::Gap(all) => format!("Pattern::Gap({})", traces::<R, I>(input, all, to)),
        Pattern::Value(all) => format!("Pattern::Value({})", traces::<R, I>(input, all, to)),
        Pattern::Ambient { integrals, points } => {
            let integrals = shares("PATTERN", "∫h u_ext", integrals);
            let (name, doc) = (named(input, "AT_POINTS"), format!("u_ext {adds}"));
            let points = to.array::<Points<R, I>>(&name, &doc, "Points<Scalar, Index>", points);
            format!("Pattern::Ambient {{ integrals: {integrals}, points: {points} }}")
        }
        Pattern::Coefficient(of) => {
            let pattern = transfer::<R, I>(of, input, to);
            format!("Pattern::Coefficient(&{pattern})")
        }
    }
}

fn transfer<R: Scalar, I: Index>(
    of: &TransferPattern<R, u32>,
    input: &str,
    to: &mut Statics,
) -> String {
    let adds = format!("that a unit of `{input}` adds");
    let name = named(input, "PATTERN");
    let integrals = contributions::<R, I>(&name, &format!("∫h {adds}."), of.integrals, to);
    let ambient = of.ambient.iter().map(|AmbientShare { input: at, integrals }| {
        let name = named(input, &format!("TIMES_AMBIENT_{at}"));
        let part = "0 is what the scene states, 1 its first input";
        let doc = format!("∫h u_ext {adds}, of part {at} of u_ext: {part}.");
        let integrals = contributions::<R, I>(&name, &doc, integrals, to);
        format!("AmbientShare {{ input: {at}, integrals: {integrals} }}")
    });
    let ambient = lines(ambient);
    let (name, doc) = (named(input, "AT_POINTS"), format!("∫h {adds}, at points."));
    let points = to.array::<Points<R, I>>(&name, &doc, "Points<Scalar, Index>", of.points);
    format!("TransferPattern {{ integrals: {integrals}, ambient: {ambient}, points: {points} }}")
}

fn contributions<R: Scalar, I: Index>(
    name: &str,
    doc: &str,
    all: &[Contribution<R, u32>],
    to: &mut Statics,
) -> String {
    to.array::<Contribution<R, I>>(name, doc, "Contribution<Scalar, Index>", all)
}

fn traces<R: Scalar, I: Index>(input: &str, all: &[EdgeTrace<R, u32>], to: &mut Statics) -> String {
    let doc = format!("Mean and end values that a unit of `{input}` adds.");
    let name = named(input, "PATTERN");
    to.array::<EdgeTrace<R, I>>(&name, &doc, "EdgeTrace<Scalar, Index>", all)
}

/// The value of each output.
pub(super) fn outputs<R: Scalar, I: Index>(
    all: &[Functional<R, u32>],
    face: &ModuleApi,
    to: &mut Statics,
) -> String {
    lines(
        all.iter()
            .zip(&face.outputs)
            .map(|(of, output)| functional::<R, I>(of, &output.identifier, to)),
    )
}

fn functional<R: Scalar, I: Index>(
    of: &Functional<R, u32>,
    output: &str,
    to: &mut Statics,
) -> String {
    let (kind, what) = match of {
        Functional::Flux(_) => ("Flux", "Edges whose fluxes add up to"),
        Functional::Force(_) => ("Force", "Contact edges whose forces add up to"),
        Functional::Length(_) => ("Length", "Contact edges whose lengths add up to"),
        Functional::Saturated(_) => {
            ("Saturated", "Contact edges whose lengths at the limit add up to")
        }
        Functional::Probe(_) => ("Probe", "Edges whose means make"),
        Functional::Bound => return "Functional::Bound".to_owned(),
    };
    let (name, doc) = (named(output, "EDGES"), format!("{what} `{output}`."));
    let edges = match of {
        Functional::Flux(edges) | Functional::Force(edges) => {
            to.array::<I>(&name, &doc, "Index", edges)
        }
        Functional::Length(shares) | Functional::Saturated(shares) | Functional::Probe(shares) => {
            contributions::<R, I>(&name, &doc, shares, to)
        }
        Functional::Bound => String::new(),
    };
    format!("Functional::{kind}({edges})")
}

//! Why the model is what it is: the candidates with their needs, and each feature of the general model with
//! what leaving it out saves.

use std::fmt::Write as _;

use super::Bakes;
use super::choice::{Candidate, Choice, Model};
use super::costs::{CYCLES, Costs};
use super::ranges;
use super::text::table;
use super::worst;
use signorini_problem::scalar::Scalar;
use signorini_problem::{EdgeKind, Problem, QuadCoefficient};
use signorini_scene::scene::Quantity;

pub(crate) fn in_words<R: Bakes>(problem: &Problem, choice: &Choice<R>) -> String {
    let mut text = candidates(choice);
    let chosen = choice.candidate();
    let _ = writeln!(text, "\n{}:", chosen.name);
    let condensed = matches!(chosen.model, Model::Condensed(_));
    let head = ["feature", "", "bytes", "instructions", "why"];
    let mut rows = vec![head.map(str::to_owned)];
    rows.extend(features::<R>(problem, condensed));
    if let Model::Condensed(baked) = &chosen.model {
        rows.extend(baked.features().map(|(name, kept, bytes, why)| {
            let state = if kept { "kept" } else { "dropped" };
            [name.to_owned(), state.to_owned(), bytes.to_string(), "-".to_owned(), why]
        }));
    }
    text += &table(&rows);
    text += "\nBytes and instructions: what the general model spends on it on this mesh, RAM and flash \
             together; instructions a tick, of quads' columns a sweep (Cortex-M4F, counted parts).\n";
    text + &following(choice) + &ranges::section(problem, choice) + &worst::section(choice)
}

/// What it costs that a transfer coefficient changes.
fn following<R: Bakes>(choice: &Choice<R>) -> String {
    let candidate = choice.candidate();
    let Some((staying, changing)) = candidate.staying.zip(candidate.needs.instructions()) else {
        return String::new();
    };
    format!(
        "\nThe matrix follows a transfer coefficient: the median warm tick takes {changing:.0} instructions where that changes, \
         {staying:.0} where it stays.\n"
    )
}

/// What is to be said of the model chosen: ticks that probably take longer than declared, a bound that there cannot be.
pub fn warnings<R: Bakes>(choice: &Choice<R>) -> Vec<String> {
    let unbounded = choice.unbounded().map(|why| {
        format!("warning: there is no error bound: {why}; certificate = false in [setting] silences this")
    });
    let of_time = worst::warning(choice).or_else(|| late(choice));
    of_time.into_iter().chain(unbounded).collect()
}

/// That the longest tick of the trial probably takes longer than declared.
fn late<R: Bakes>(choice: &Choice<R>) -> Option<String> {
    let (cycles, needed) =
        choice.budget.cycles.zip(choice.candidate().needs.most_instructions())?;
    let estimated = needed * CYCLES;
    (estimated > cycles).then(|| {
        format!(
            "warning: the longest warm tick tried, of {needed:.0} instructions, takes about {estimated:.0} cycles \
             ({CYCLES} an instruction, estimated); [target] has {cycles:.0}. Measure it on the part, or give \
             tick_within a deadline."
        )
    })
}

fn candidates<R: Scalar>(choice: &Choice<R>) -> String {
    let head =
        ["model", "RAM", "flash", "instructions", "exchanges", "sweeps", "substitutions", ""];
    let mut rows = vec![head.map(str::to_owned)];
    for (at, candidate) in choice.candidates.iter().enumerate() {
        let Candidate { name, needs, trial, shortfalls, lacks_bound, unbounded, .. } = candidate;
        let short: Vec<_> = shortfalls.iter().map(|short| short.key).collect();
        let verdict = if at == choice.chosen {
            "chosen".to_owned()
        } else if !short.is_empty() {
            format!("beyond {}", short.join(", "))
        } else if *lacks_bound {
            "only with certificate = false".to_owned()
        } else if unbounded.is_some() {
            "has no error bound".to_owned()
        } else {
            "would fit".to_owned()
        };
        rows.push([
            name.clone(),
            needs.ram.to_string(),
            needs.flash.to_string(),
            needs.instructions().map_or("-".to_owned(), |count| format!("{count:.0}")),
            trial.pivots[0].to_string(),
            trial.sweeps[0].to_string(),
            trial.rounds[0].to_string(),
            verdict,
        ]);
    }
    let budget = choice.budget;
    let limit = |limit: Option<u64>| limit.map_or("-".to_owned(), |limit| limit.to_string());
    rows.push([
        "[target]".to_owned(),
        limit(budget.ram),
        limit(budget.flash),
        budget.cycles.map_or("-".to_owned(), |cycles| format!("{cycles:.0} cycles")),
        String::new(),
        String::new(),
        String::new(),
        String::new(),
    ]);
    let excluded = choice.excluded.iter().map(|why| format!("not considered: {why}\n"));
    table(&rows) + &excluded.collect::<String>()
}

/// The features of the general model: any mesh, any data, everything computed and kept on the target. Each with whether
/// it is kept, bytes of RAM and flash for it on this mesh, instructions a tick (of quads a sweep) that go with them,
/// and what the scene has of it.
fn features<R: Scalar>(problem: &Problem, condensed: bool) -> Vec<[String; 5]> {
    let costs = Costs::measured();
    let scalar = size_of::<R>();
    let (mesh, counts) = (&problem.mesh, problem.topology.counts);
    let (triangles, quads, cells) = (mesh.triangles.len(), mesh.quads.len(), problem.cells());
    let (unknowns, edges) = (counts.unknowns(), counts.edges());
    let index = if edges < 1 << 14 { 2 } else { 4 };
    let shape = if quads > 0 { "quads" } else { "triangles" };
    let each = |stage: &str, number: usize| {
        costs.of_mesh::<R>(shape, stage).map(|count| count * number as f64)
    };
    let wider = costs.of_mesh::<R>("quads", "sweep").zip(costs.of_mesh::<R>("triangles", "sweep"));
    let of_kind = |kind| problem.kinds.iter().filter(|&&known| known == kind).count();
    let varying = varying(problem);
    let sources = problem.loads.triangles.len() + problem.loads.quads.len();
    let inputs = problem.scene.inputs.iter().filter(|input| input.of.value == "source").count();
    let sources = (sources + inputs).min(cells);
    let robin = of_kind(EdgeKind::Robin);
    let pushed = problem.loads.contact_flux.iter().filter(|&&q| q != 0.0).count();
    let gaps = problem.loads.gap.iter().filter(|&&gap| gap != 0.0).count();
    let limits = problem.loads.spans.iter().filter(|span| **span != f64::INFINITY).count();
    let (contact, neumann) = (counts.contact, problem.loads.neumann.len());
    let is_read = problem.scene.outputs.iter().any(|of| matches!(of.quantity, Quantity::Flux));
    let row = |name: &str, present: usize, why: String, bytes: usize, count: Option<f64>| {
        let is_kept = present > 0 && (!condensed || name == "contact");
        let state = if is_kept { "kept" } else { "dropped" };
        let moved = if present > 0 && !is_kept { "; eliminated on the host" } else { "" };
        let count = count.map_or("-".to_owned(), |count| format!("{count:.0}"));
        [name.to_owned(), state.to_owned(), bytes.to_string(), count, why + moved]
    };
    let some = |name, number: usize, what: &str, bytes, count| {
        let number_of = if number == 0 { "no".to_owned() } else { number.to_string() };
        row(name, number, format!("{number_of} {what}"), bytes, count)
    };
    let never = |name, why: &str, bytes, count| row(name, 0, why.to_owned(), bytes, count);
    let of_quads = match quads {
        0 => unknowns * (2 * scalar + 2 * index),
        _ => quads * (6 * scalar + 8 * index),
    };
    let wider = wider.map(|(quads, triangles)| (quads - triangles) * unknowns as f64);
    let points = match varying {
        0 => "closed forms are exact in every cell".to_owned(),
        _ => format!("A varies, or a quad is no parallelogram, in {varying} of {cells} cells"),
    };
    let of_points = if varying > 0 { varying } else { cells } * 192 * scalar;
    let matrices = each("element matrices", cells);
    let (of_neumann, of_robin) = (of_kind(EdgeKind::Neumann), robin.max(1));
    let limited = "contact edges whose flux has a limit";
    let fluxes = match is_read {
        true => "outputs read those of their own edges alone",
        false => "no output reads them",
    };
    let of_fluxes = (3 * triangles + 4 * quads) * scalar;
    vec![
        some("triangles", triangles, "triangles", triangles * (3 * scalar + 6 * index), None),
        some("quads", quads, "quads", of_quads, wider),
        never("tensors", "element matrices are baked", cells * 3 * scalar, matrices),
        row("quadrature points", varying, points, of_points, None),
        some("source f", sources, "cells with a source", cells * 2 * scalar, each("load", cells)),
        some("Neumann fluxes", neumann, "edges with a flux", of_neumann * (scalar + index), None),
        some("Robin", robin, "Robin edges", of_robin * (2 * scalar + index), None),
        some("contact", contact, "contact edges", contact * (scalar + 1), None),
        some("limits", limits, limited, contact * scalar, None),
        some("gaps", gaps, "edges with a gap", contact * 3 * scalar, None),
        some("offsets q", pushed, "edges with a flux q", contact * scalar, None),
        never("fluxes of all edges", fluxes, of_fluxes, each("flux by cells", cells)),
        never("indicators of cells", "no output reads them", cells * scalar, None),
    ]
}

/// Cells that need 64 points each in the error bound.
fn varying(problem: &Problem) -> usize {
    let points = |quad: &&QuadCoefficient| matches!(quad, QuadCoefficient::AtPoints(_));
    problem.coefficients.quads.iter().filter(points).count()
}

//! The firmware that a promised error takes: on the mesh refined where its bound asks for it, and on the mesh refined everywhere.
//!
//! ```text
//!   scene, error ─► smallest mesh of either kind whose bound is small enough for all inputs tried ─► model ─► bytes, instructions
//! ```
//! The model is the one that `bake` chooses where a device has room for anything: in f32, and in f64 where rounding in f32 would break
//! the promise.

use std::fmt::Write;

use super::digits::{grouped, or_dash};
use signorini_bake::Bakes;
use signorini_bake::choice::{Candidate, Wanted};
use signorini_draw::{Column, Table};
use signorini_problem::Problem;
use signorini_scene::mesh::adapted;
use signorini_scene::{Error, Goal, Result, Scene};
use signorini_solve::adaptive::{Promise, Promised, Refining, promised_mesh};

/// Unknowns beyond which no mesh is tried: each is solved a thousand times.
const MOST_UNKNOWNS: usize = 50_000;

/// The scenes of the record, and where it is, from the root of the checkout.
pub const STANDARD: [&str; 6] = [
    "meshes/scenes/levee.toml",
    "tests/firmware/scenes/dam.toml",
    "meshes/scenes/slab.toml",
    "meshes/scenes/strip.toml",
    "meshes/scenes/pit.toml",
    "meshes/scenes/antiicing.toml",
];
/// See [`STANDARD`].
pub const RECORD: &str = "host/benches/trade/promised.txt";
/// The name of a table in the folder of its scene.
pub const FILE: &str = "promised.txt";

/// The kinds of meshes.
const KINDS: [(&str, Refining); 2] =
    [("where needed", Refining::Marked), ("everywhere", Refining::Everywhere)];

/// The firmware of a promised error on a mesh of one kind, or why there is none.
struct Taken {
    goal: Goal,
    /// Which cells were refined, in words.
    refined: &'static str,
    found: std::result::Result<Firmware, String>,
}

/// A controller for the mesh.
struct Firmware {
    promise: Promise,
    /// Edges of the contact boundary.
    contact: usize,
    /// The model, in a few words.
    model: String,
    /// Bytes of RAM and of flash.
    bytes: [u64; 2],
    /// Of the longest tick of its trial.
    instructions: Option<f64>,
}

/// The table of the firmware that each of these errors takes, on both kinds of meshes; calls `done` after each.
pub fn table(scene: &Scene, goals: &[Goal], done: &mut dyn FnMut()) -> Result<String> {
    let mut scene = scene.clone().at_rest();
    // What the device has room for is no limit here, and the error is the one asked for.
    scene.target = None;
    if let Some(setting) = &mut scene.setting {
        setting.error = None;
    }
    let mut all = Vec::new();
    for &goal in goals {
        for (refined, refining) in KINDS {
            let found = match firmware(&scene, goal, refining) {
                Ok(firmware) => Ok(firmware),
                Err(Error::Input(error)) => Err(error.message().to_owned()),
                Err(error) => return Err(error),
            };
            all.push(Taken { goal, refined, found });
            done();
        }
    }
    Ok(text(&scene.title, &all))
}

fn firmware(scene: &Scene, goal: Goal, refining: Refining) -> Result<Firmware> {
    let promised = Promised { goal, refining, most_unknowns: MOST_UNKNOWNS };
    let (mesh, promise) = promised_mesh(scene, adapted::of_scene(scene)?, promised)?;
    let problem = Problem::new(scene, mesh)?;
    match baked::<f32>(&problem, &promise) {
        Err(Error::Input(_)) => baked::<f64>(&problem, &promise),
        found => found,
    }
}

fn baked<R: Bakes>(problem: &Problem, promise: &Promise) -> Result<Firmware> {
    let (choice, _) = R::keep(problem, Wanted::default(), promise)?;
    let Candidate { name, needs, .. } = &choice.candidates[choice.chosen];
    Ok(Firmware {
        promise: promise.clone(),
        contact: problem.topology.counts.contact,
        model: format!("{}, {name}", R::NAME),
        bytes: [needs.ram, needs.flash],
        instructions: needs.ticks[1],
    })
}

fn text(title: &str, all: &[Taken]) -> String {
    let of = |name: &str, cell: fn(&Firmware) -> String| {
        Column::number(name, move |taken: &&Taken| or_dash(taken.found.as_ref().ok(), cell))
    };
    let columns = [
        Column::number("error", |taken: &&Taken| taken.goal.to_string()),
        Column::words("refined", |taken: &&Taken| taken.refined.to_owned()),
        of("unknowns", |found| grouped(found.promise.unknowns as u64)),
        of("contact", |found| grouped(found.contact as u64)),
        of("bound/error", |found| format!("{:.2}", found.promise.largest)),
        of("RAM", |found| grouped(found.bytes[0])),
        of("flash", |found| grouped(found.bytes[1])),
        of("instructions", |found| or_dash(found.instructions, |count| grouped(count as u64))),
        Column::words("model", |taken: &&Taken| {
            or_dash(taken.found.as_ref().ok(), |found| found.model.clone())
        }),
    ];
    let mut text = format!("{title}\n{}", Table::new(&columns, all).text());
    for taken in all {
        if let Err(why) = &taken.found {
            let _ = writeln!(text, "{}, refined {}: {why}", taken.goal, taken.refined);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_what_it_takes_or_the_reason_stands_below() {
        let goal = Goal::Part(0.1);
        let promise = Promise { goal, largest: 0.874, unknowns: 3145, allowed: Vec::new() };
        let model = "f32, condensed, exact method".to_owned();
        let instructions = Some(30_328.0);
        let firmware =
            Firmware { promise, contact: 69, model, bytes: [2096, 33_400], instructions };
        let taken = [
            Taken { goal, refined: KINDS[0].0, found: Ok(firmware) },
            Taken { goal, refined: KINDS[1].0, found: Err("too large".to_owned()) },
        ];
        let expected = "\
A levee
 error  refined       unknowns  contact  bound/error    RAM   flash  instructions  model
   10%  where needed     3 145       69         0.87  2 096  33 400        30 328  f32, condensed, exact method
   10%  everywhere           –        –            –      –       –             –  –
10%, refined everywhere: too large
";
        assert_eq!(text("A levee", &taken), expected);
    }
}

//! What the declared ranges of the inputs make of a condensed model, as `--explain` prints it.
//!
//! ```text
//!   sides of the edges ─► counts, runs along the boundary          proved
//!   enclosure          ─► intervals of the outputs                 proved
//!   pieces of the box  ─► the largest error bound                 proved
//!   random inputs      ─► what outputs and error bound reach       seen
//! ```

mod counts;
#[cfg(test)]
mod in_time;
mod own;
mod reach;
mod runs;
#[cfg(test)]
mod tests;
mod why;

use std::fmt::Write as _;

use crate::Bakes;
use crate::choice::{Choice, Origin};
use crate::text::{short, table};
use reach::Reach;
use runs::along_boundary;
use signorini_condense::ranges::interval::Interval;
use signorini_condense::ranges::largest::LargestBound;
use signorini_condense::ranges::outputs::intervals;
use signorini_condense::ranges::sides::EdgeSide;
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_scene::scene::Scene;
use why::{coefficient, nothing_proved};

use counts::largest_bound;
pub use counts::{constants, declared, found};

/// The section on ranges; empty for a full model, whose ticks need none.
pub fn section<R: Bakes>(problem: &Problem, choice: &Choice<R>) -> String {
    let Some((baked, origin)) = choice.condensed() else { return String::new() };
    let when = problem.scene.step().filter(|_| origin.steps.is_some());
    let when = when.map_or(String::new(), |step| format!(" for all times, at a step of {step} s"));
    let mut text = format!("\nRanges of the inputs{when}: {}\n", summary(&problem.scene, origin));
    if let Some(why) = nothing_proved(&problem.scene, origin) {
        return text + &why + "\n";
    }
    if origin.whole.contact > 0 {
        text += &along_boundary(problem, origin);
    }
    if let Some(steps) = &origin.steps {
        return text + &own::answers::<R>(steps);
    }
    let reach = Reach::new(problem, baked, origin);
    text + &outputs(problem, origin, &reach) + &bound(&reach, largest_bound(baked, origin))
}

/// How many edges are on which side, in a sentence.
fn summary(scene: &Scene, origin: &Origin) -> String {
    let contact = origin.whole.contact;
    if contact == 0 {
        return "nothing is in contact.".to_owned();
    }
    let sides = [EdgeSide::Open, EdgeSide::Touching, EdgeSide::Saturated, EdgeSide::MayChange];
    let [open, touching, saturated, may_change] = sides.map(|side| origin.sides.count(side));
    // Scenes without limits say nothing of them.
    let at_limit = match origin.whole.is_limited() {
        true => format!("{saturated} are always at their limit, "),
        false => String::new(),
    };
    let kept = origin.model().contact;
    let beside = kept - may_change.min(kept);
    let of_edges = format!(
        "of {contact} contact edges {open} are always open, {touching} always touch, {at_limit}{may_change} may change sides."
    );
    if let Some(steps) = &origin.steps {
        let (own, all) = (steps.fading.len(), steps.modes);
        let keeps = match (kept == contact, origin.has_all_edges) {
            (true, true) => "--full-edges keeps all of them".to_owned(),
            (true, false) => "The model keeps all".to_owned(),
            (false, _) => format!(
                "The model keeps {kept}: those that may change, and {beside} that its error bound needs"
            ),
        };
        return format!(
            "{of_edges}\n{keeps}. That is of exact steps on the mesh with its {all} states, of which the model has {own}."
        );
    }
    if let Some(modes) = &origin.modes {
        let name = coefficient(scene, modes);
        return format!("{of_edges}\nThe model keeps all, since its matrix follows {name:?}.");
    }
    match (origin.has_all_edges, beside) {
        (true, _) => format!("{of_edges}\n--full-edges keeps all of them."),
        (false, 0) if kept == 0 => format!("{of_edges}\nThe model keeps none."),
        (false, 0) => format!("{of_edges}\nThe model keeps those that may change."),
        (false, _) => format!(
            "{of_edges}\nThe model keeps {kept}: those that may change, and {beside} that its error bound needs."
        ),
    }
}

/// Where each output lies, and what of it was reached.
fn outputs(problem: &Problem, origin: &Origin, reach: &Reach) -> String {
    let proved = match &origin.followed {
        Some(followed) => followed.outputs.clone(),
        // Loads were finite when the sides were found.
        None => intervals(&origin.whole, &origin.sides).ok().flatten().unwrap_or_default(),
    };
    let head = ["output", "least", "largest", "least seen", "largest seen", "width", ""];
    let mut rows = vec![head.map(str::to_owned)];
    for ((output, proved), seen) in wanted(&problem.scene).iter().zip(proved).zip(&reach.outputs) {
        let Some((proved, seen)) = proved.zip(*seen) else { continue };
        rows.push(row(&output.name.value, proved, seen));
    }
    let mut text = String::from("\n");
    if rows.len() > 1 {
        text += &table(&rows);
    }
    let _ = writeln!(
        text,
        "Least and largest are proved for the exact solution of this model, on its mesh, at all inputs within their ranges.\n\
         Those seen are of {} inputs drawn from them, all corners included where inputs are few.\n\
         The width is the proved one over that seen.",
        reach.inputs
    );
    if let Some((modes, followed)) = origin.modes.as_ref().zip(origin.followed.as_ref()) {
        let (name, pieces) = (coefficient(&problem.scene, modes), followed.pieces);
        let _ = writeln!(text, "The range of {name:?} was cut into {pieces} pieces for it.");
    }
    text
}

/// The largest error bound that was seen, and the one that none exceeds.
fn bound(reach: &Reach, proved: Option<LargestBound>) -> String {
    let Some(seen) = reach.bound else {
        return format!("No error bound was seen: {}.\n", reach.unbounded);
    };
    let said = format!(
        "The largest error bound seen in {} ticks with them is {}.",
        reach.inputs,
        short(seen)
    );
    let Some(LargestBound { proved, pieces, .. }) = proved else {
        return format!("{said} Other inputs may have a larger one: no limit near it is proved.\n");
    };
    // Not below it: five digits are off by half of the last.
    let limit = short(proved * (1.0 + 5e-5));
    let pieces = if pieces == 1 { "a single piece".to_owned() } else { format!("{pieces} pieces") };
    let rounding =
        if seen > proved { "\nWhat a tick rounds in its scalar comes on top." } else { "" };
    format!(
        "{said}\nNo exact solution of this model has one above {limit}: proved with {pieces} of the box.{rounding}\n"
    )
}

fn row(name: &str, proved: Interval, seen: Interval) -> [String; 7] {
    let Interval { lo, hi } = proved;
    // What is proved of a single number is off by its rounding.
    let is_wider = proved.width() > 1e-9 * lo.abs().max(hi.abs());
    // So is what is seen of it.
    let moves = seen.width() > 1e-9 * lo.abs().max(hi.abs());
    let width = match (is_wider, moves) {
        (false, _) => "1".to_owned(),
        (true, true) => format!("{:.3}", proved.width() / seen.width()),
        (true, false) => "-".to_owned(),
    };
    let [lo, hi, least, most] = [lo, hi, seen.lo, seen.hi].map(short);
    [name.to_owned(), lo, hi, least, most, width, String::new()]
}

//! What no tick exceeds: as constants of a module, and as `--explain` says it.

use std::fmt::Write as _;

use crate::Bakes;
use crate::choice::{Choice, Model};
use crate::condensed;
use crate::costs::CYCLES;
use signorini_image::chosen::WorstCase;
use signorini_problem::scalar::Scalar;

/// The worst case as constants of a module, whose ticks may be steps in time.
pub fn constants(worst: WorstCase, is_stepped: bool) -> String {
    let WorstCase { exchanges, instructions, proven } = worst;
    let whatever = match is_stepped {
        true => {
            "whatever its inputs are\n/// and whatever state it begins in, unless it is refused"
        }
        false => {
            "whatever its inputs are within `Inputs::RANGES` and\n/// whatever state it begins in"
        }
    };
    let mut text = format!(
        "
/// Whether every tick ends with the solution within the limits below, {whatever}: proved by the signs of the matrix.
pub const WORST_PROVEN: bool = {proven};
"
    );
    if let Some(most) = exchanges {
        let _ = write!(
            text,
            "/// Exchanges that no tick exceeds.\npub const WORST_EXCHANGES: u32 = {most};\n"
        );
    }
    if let Some(most) = instructions {
        let _ = write!(
            text,
            "/// Instructions of a Cortex-M4F that no tick exceeds: stages counted one by one, by `cargo xtask cost`.
pub const WORST_INSTRUCTIONS: u32 = {most};\n"
        );
    }
    text
}

/// The same in a paragraph, with the reason where nothing is proved.
pub fn section<R: Bakes>(choice: &Choice<R>) -> String {
    let candidate = choice.candidate();
    let Model::Condensed(baked) = &candidate.model else {
        return "\nNo worst case is proved: how many sweeps a mesh takes depends on its inputs. A deadline cuts ticks \
                off.\n"
            .to_owned();
    };
    let WorstCase { exchanges, instructions, proven } = baked.worst_case();
    if baked.worst_exchanges().is_none() {
        let why = match candidate.too_long {
            Some(count) => too_long(choice, count),
            None => unproved(baked).to_owned(),
        };
        return format!("\nNo worst case is proved: {why}. {}.\n", cut_off(baked));
    }
    let exchanges = exchanges.unwrap_or_default();
    let mut text = match (proven, &baked.steps) {
        (true, Some(_)) => {
            "\nWorst case, proved for every load and state that the scalar holds; ranges of inputs are not needed for it: "
        }
        (true, None) => "\nWorst case, proved for all inputs within their ranges and every state: ",
        (false, _) => "\nWorst case for every state, not proved of loads, since an input has no range: ",
    }
    .to_owned();
    let _ = match instructions {
        Some(count) => {
            let cycles = count as f64 * CYCLES;
            writeln!(
                text,
                "{exchanges} exchanges, {count} instructions of a Cortex-M4F.\n\
                 At {CYCLES} cycles each, for its flash makes loads wait, these are {cycles:.0} cycles{}.",
                declared(choice)
            )
        }
        None => writeln!(
            text,
            "{exchanges} exchanges. Instructions of {} depend on its operands, and are not bounded.",
            R::NAME
        ),
    };
    text
}

/// That a proved tick takes longer than `[target]` has, and what was done.
pub fn warning<R: Bakes>(choice: &Choice<R>) -> Option<String> {
    let candidate = choice.candidate();
    let (Model::Condensed(baked), Some(count)) = (&candidate.model, candidate.too_long) else {
        return None;
    };
    let then = match baked.worst_exchanges() {
        Some(_) => "No tick tried does; give tick_within a deadline".to_owned(),
        None => cut_off(baked),
    };
    Some(format!("warning: {}. {then}.", too_long(choice, count)))
}

fn too_long<R: Scalar>(choice: &Choice<R>, count: f64) -> String {
    let cycles = choice.budget.cycles.unwrap_or_default();
    format!(
        "the exact method may take {count:.0} instructions, {:.0} cycles at {CYCLES} each, and [target] has {cycles:.0}",
        count * CYCLES
    )
}

fn unproved<R: Scalar>(baked: &condensed::Baked<R>) -> &'static str {
    match baked.is_monotone {
        true => "sweeps end when they are near the solution, and nobody knows how soon",
        false => {
            "some entries of the matrix off its diagonal are positive, so that edges may go to and fro"
        }
    }
}

fn cut_off<R: Scalar>(baked: &condensed::Baked<R>) -> String {
    let sweeps = baked.work.sweeps;
    match baked.work.pivots {
        Some(most) => format!("A tick is cut off after {most} exchanges and {sweeps} sweeps"),
        None => format!("A tick is cut off after {sweeps} sweeps"),
    }
}

fn declared<R: Bakes>(choice: &Choice<R>) -> String {
    let Some(cycles) = choice.budget.cycles else { return String::new() };
    let then = match choice.candidate().too_long {
        Some(_) => ": no tick tried took longer, others may",
        None => "",
    };
    format!(", and [target] has {cycles:.0}{then}")
}

//! `signorini solve --max-error`: a scene on a mesh that is refined where the error bound says.

use std::path::Path;
use std::sync::atomic::Ordering;

use super::interruption::interruption;
use super::series::{Series, remove};
use signorini_files::atomic::write_atomically;
use signorini_files::digits::percent_above;
use signorini_files::fields::{Drawn, picture};
use signorini_problem::progress::{note, say, waiting};
use signorini_scene::error::{Error, Result};
use signorini_scene::goal::Goal;
use signorini_scene::mesh::{Mesh, gmsh::write};
use signorini_scene::scene::Scene;
use signorini_solve::Solution;
use signorini_solve::adaptive::{Level, Stop, Wanted, refined_until};

/// The table of levels.
const TABLE: &str = "levels.csv";

/// Solves level after level, says a line for each, and writes their files into `out`, where they are wanted: `levels.csv`,
/// `levels.pvd`, a VTU each, and the last mesh as `refined.msh`.
pub(super) fn refined(
    scene: &Scene,
    mesh: Mesh,
    wanted: &Wanted,
    out: Option<&Path>,
) -> Result<(Level, Stop)> {
    let interrupted = interruption()?;
    let goes_on = || Ok(!interrupted.load(Ordering::Relaxed));
    let refining = |look: &mut dyn FnMut(&Level) -> Result<bool>| {
        waiting("refining", || refined_until(scene, mesh, wanted, look))
    };
    let Some(out) = out else {
        return refining(&mut |level| {
            say(format_args!("{}", line(level)));
            goes_on()
        });
    };
    let mut table = csv::Writer::from_writer(Vec::new());
    let mut series = series(out);
    let failed = |error: csv::Error| Error::Check(format!("levels.csv: {error}"));
    table
        .write_record([
            "level",
            "unknowns",
            "sweeps",
            "error_bound",
            "relative",
            "contact_force",
            "seconds",
        ])
        .map_err(failed)?;
    let mut look = |level: &Level| {
        say(format_args!("{}", line(level)));
        table.write_record(record(level)).map_err(failed)?;
        let drawn = Drawn::of(&level.problem, &level.solution)?;
        series.add(level.number as f64, &picture(&level.problem, &drawn))?;
        goes_on()
    };
    let found = refining(&mut look)?;
    let text = table.into_inner().map_err(|error| Error::Check(error.to_string()))?;
    write_atomically(&out.join(TABLE), &text)?;
    write_atomically(&out.join("refined.msh"), write::text(&found.0.problem.mesh).as_bytes())?;
    series.close()?;
    Ok(found)
}

/// Removes the levels of an earlier run from the folder of one that has none. Its last mesh stays: scenes may name it.
pub(super) fn forget(out: &Path) -> Result<()> {
    let table = out.join(TABLE);
    if series(out).forget()? && table.exists() {
        remove(&table)?;
        note(&format_args!("{}: levels of an earlier --max-error are removed", out.display()));
    }
    Ok(())
}

fn series(out: &Path) -> Series {
    Series::new(out, "levels", 2)
}

/// What part of the solution an absolute goal is, for whoever means a part by it.
pub(super) fn absolute(goal: Goal, energy_norm: Option<f64>) -> Option<String> {
    let Goal::Energy(most) = goal else { return None };
    let norm = energy_norm.filter(|norm| *norm > 0.0)?;
    Some(format!(
        "  --max-error {most} is an error in the unit of the energy norm, {} % of this solution's; --max-error {most}% asks for a part",
        percent_above(most / norm)
    ))
}

/// Why the levels ended, with the option that ended them; nothing where that is the goal.
pub(super) fn why(stop: &Stop, solution: &Solution) -> Option<String> {
    let option = if matches!(stop, Stop::TooLarge { .. }) { " (--max-unknowns)" } else { "" };
    stop.why(solution).map(|why| why + option)
}

/// The exit status: 3 where the goal was not reached.
pub(super) fn status(stop: &Stop) -> u8 {
    if stop.is_success() { 0 } else { 3 }
}

fn line(level: &Level) -> String {
    let unknowns = level.unknowns();
    let bound = match (level.solution.bound, relative(level)) {
        (Some(bound), Some(part)) => {
            format!("error bound {:.3e}, {} %", bound.total, percent_above(part))
        }
        (Some(bound), None) => format!("error bound {:.3e}", bound.total),
        (None, _) => "no error bound".to_owned(),
    };
    format!("  level {:2}: {unknowns:8} unknowns, {bound}, {:.2} s", level.number, level.seconds)
}

fn relative(level: &Level) -> Option<f64> {
    level.solution.relative_bound(level.energy_norm)
}

fn record(level: &Level) -> [String; 7] {
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    let solution = &level.solution;
    [
        level.number.to_string(),
        level.unknowns().to_string(),
        solution.sweeps.to_string(),
        number(solution.bound.map(|bound| bound.total)),
        number(relative(level)),
        solution.contact_force.to_string(),
        level.seconds.to_string(),
    ]
}

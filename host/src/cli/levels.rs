//! `signorini solve --max-error`: a scene on a mesh that is refined where the error bound says.

use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use super::picture::picture;
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::mesh::{Mesh, gmsh::write};
use signorini_scene::scene::Scene;
use signorini_solve::adaptive::{Level, Stop, Wanted, refined_until};
use signorini_solve::output::atomic::write_atomically;
use signorini_solve::output::digits::percent_above;
use signorini_solve::output::pvd::{Frame, pvd};
use signorini_solve::progress::{say, waiting, warn};

/// Solves level after level, says a line for each, and writes their files into `out`: `levels.csv`, `levels.pvd`, a VTU each, and
/// the last mesh as `refined.msh`.
pub(super) fn refined(
    scene: &Scene,
    mesh: Mesh,
    wanted: &Wanted,
    out: &Path,
) -> Result<(Level, Stop)> {
    let interrupted = interruption()?;
    let (mut table, mut frames) = (csv::Writer::from_writer(Vec::new()), Vec::new());
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
    say(format_args!("{}", scene.title));
    let look = |level: &Level| {
        say(format_args!("{}", line(level)));
        table.write_record(record(level)).map_err(failed)?;
        let name = format!("levels/{:02}.vtu", level.number);
        let bytes = picture(&level.problem, &level.solution).into_bytes();
        write_atomically(&out.join(&name), &bytes)?;
        frames.push(Frame { time: level.number as f64, file: name });
        Ok(!interrupted.load(Ordering::Relaxed))
    };
    let found = waiting("refining", || refined_until(scene, mesh, wanted, look))?;
    let text = table.into_inner().map_err(|error| Error::Check(error.to_string()))?;
    write_atomically(&out.join("levels.csv"), &text)?;
    write_atomically(&out.join("levels.pvd"), pvd(&frames).as_bytes())?;
    write_atomically(&out.join("refined.msh"), write::text(&found.0.problem.mesh).as_bytes())?;
    say_why(&found.0, &found.1, wanted);
    Ok(found)
}

/// The exit status: 3 where the goal was not reached.
pub(super) fn status(stop: &Stop) -> u8 {
    if *stop == Stop::Reached { 0 } else { 3 }
}

fn line(level: &Level) -> String {
    let unknowns = level.problem.topology.counts.unknowns();
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
        level.problem.topology.counts.unknowns().to_string(),
        solution.sweeps.to_string(),
        number(solution.bound.map(|bound| bound.total)),
        number(relative(level)),
        solution.contact_force.to_string(),
        level.seconds.to_string(),
    ]
}

/// What ended it, where that is not the goal.
fn say_why(level: &Level, stop: &Stop, wanted: &Wanted) {
    let why = match stop {
        Stop::Reached => return,
        Stop::TooLarge => format!(
            "the bound is above what was asked for: a finer mesh would have more than {} unknowns. Give more by --max-unknowns",
            wanted.most_unknowns
        ),
        Stop::Stalled(stall) => format!(
            "the bound no longer falls: most of it is {}, near ({}, {})",
            stall.term.sentence(),
            stall.at[0],
            stall.at[1]
        ),
        Stop::NoBound => format!(
            "nothing says where to refine: {}",
            level.solution.no_bound.as_ref().map_or_else(String::new, ToString::to_string)
        ),
        Stop::Unsolved => "the solver stopped before its tolerance".to_owned(),
        Stop::Interrupted => format!("interrupted: these are the files of level {}", level.number),
    };
    warn(&[why]);
}

/// Becomes true with Ctrl-C, which ends the work after the level at hand; a second one ends the program.
fn interruption() -> Result<&'static AtomicBool> {
    static IS: AtomicBool = AtomicBool::new(false);
    static HANDLER: OnceLock<std::result::Result<(), String>> = OnceLock::new();
    let handler = || {
        let handle = || {
            if IS.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        };
        ctrlc::set_handler(handle).map_err(|error| error.to_string())
    };
    match HANDLER.get_or_init(handler) {
        Ok(()) => Ok(&IS),
        Err(error) => Err(InputError::new(format!("Ctrl-C cannot be handled: {error}")).into()),
    }
}

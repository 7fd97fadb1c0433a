//! The main job: every standard scene, checked, measured and shown.

mod bound;
mod case;
mod checks;
mod convergence;
mod cost;
mod cut_off;
mod outputs;
mod panel;
mod table;

use serde::Serialize;

use crate::checkout::{root, scenes};
use crate::extremes::record as extremes;
use crate::extremes::section::section as extremes_section;
use crate::record_file::indented;
use crate::trade::records::{self, RECORD};
use crate::trade::section::section;
use crate::trade::verdict::{KnobValue, knob_values};
use case::KnownScene;
use checks::Check;
use convergence::ConvergenceStudy;
use cut_off::CutOff;
use signorini_draw::{Report, html};
use signorini_files::atomic::write_atomically;
use signorini_problem::progress::{say, steps};
use signorini_scene::Result;

/// Error norms by what they weigh, with their symbols; these do not break at the end of a line.
const OF_GRADIENT: &str = "gradient error of u, unweighed: |u\u{a0}−\u{a0}u_h|₁";
const OF_ENERGY: &str =
    "gradient error of u, weighed by A (energy norm): ‖A^½∇(u\u{a0}−\u{a0}u_h)‖";
const OF_U: &str = "mean-square error of u (L²): ‖u\u{a0}−\u{a0}u_h‖";
const OF_FLUX: &str = "mean-square error of the flux (L²): ‖σ\u{a0}−\u{a0}σ_h‖";

/// Everything that `results.json` holds.
#[derive(Debug, Serialize)]
struct Results<'r> {
    cycles: &'static str,
    scenes: &'r [KnownScene],
    convergence: &'r [ConvergenceStudy],
    cut_off: &'r [CutOff],
    knobs: &'r [KnobValue],
    passed: bool,
}

/// Runs every scene under `meshes/`, prints the table, writes the report; exit status 0 only when every
/// check holds.
pub fn run() -> Result<u8> {
    let root = &root()?;
    let scenes = scenes(&root.join("meshes"))?;
    let trades = records::read(&root.join(RECORD))?;
    let pushed = extremes::Record::read(&root.join(extremes::RECORD))?.unwrap_or_default();
    let studies = convergence::planned(root);
    let stopped = cut_off::planned(&scenes)?;
    let bar = steps(scenes.len() + studies.len() + stopped.len());
    let (mut cases, mut panels) = (Vec::new(), Vec::new());
    for path in &scenes {
        bar.set_message(format!("{}", path.strip_prefix(root).unwrap_or(path).display()));
        let (problem, solution, case) = case::study(path)?;
        panels.push(panel::panel(&problem, &solution, &case));
        cases.push(case);
        bar.inc(1);
    }
    bar.set_message("convergence on refined grids");
    let studies = convergence::run(&studies, || bar.inc(1))?;
    bar.set_message("cut off");
    let stopped = cut_off::run(&stopped, || bar.inc(1))?;
    bar.finish_and_clear();

    say(table::scenes(&cases));
    say(table::convergence(&studies));
    let checks: Vec<&Check> = (cases.iter().flat_map(|case| &case.checks))
        .chain(studies.iter().flat_map(|study| &study.checks))
        .chain(stopped.iter().flat_map(|study| &study.checks))
        .collect();
    let failed: Vec<_> = checks.iter().filter(|check| !check.passed).collect();
    let folder = root.join("target/report");
    let results = Results {
        cycles: crate::cycles::METHOD,
        scenes: &cases,
        convergence: &studies,
        cut_off: &stopped,
        knobs: &knob_values(trades.host.iter().chain(&trades.m4f)),
        passed: failed.is_empty(),
    };
    let report = Report {
        title: "Signorini: standard scenes".to_owned(),
        generated_by: format!(
            "signorini {}; cycles: {}",
            env!("CARGO_PKG_VERSION"),
            crate::cycles::METHOD
        ),
        table: table::main_table(&cases),
        checks: table::checks(&checks),
        convergence: convergence::plots(&studies),
        cut_off: cut_off::table(&stopped),
        sweeps: cut_off::plots(&stopped),
        tradeoff: Some(section(&trades)),
        extremes: Some(extremes_section(&pushed)),
        scenes: panels,
    };
    write_atomically(&folder.join("results.json"), indented(&results).as_bytes())?;
    write_atomically(&folder.join("index.html"), html(&report).as_bytes())?;
    say(format_args!("report: {}", folder.join("index.html").display()));
    for check in &failed {
        eprintln!("failed: {}: {}: {}", check.subject, check.claim, check.found);
    }
    say(format_args!("{} of {} checks hold", checks.len() - failed.len(), checks.len()));
    Ok(u8::from(!failed.is_empty()))
}

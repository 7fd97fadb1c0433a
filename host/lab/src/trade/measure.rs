//! One setting measured: what a tick costs, and how far its answer is from the truth.

use super::record::{Point, PointError};
use super::reference::ReferenceSolution;

use crate::cycles::{counted, median_and_spread};
use crate::record_file::word;
use signorini_problem::Problem;
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_scene::setting::{Method, ModelKind, Omega, Precision, Start};
use signorini_scene::{Result, Setting};
use signorini_session::{Session, completed, with_session};
use signorini_solve::Solution;

/// Repeats of a cold solve; of those that take long, fewer.
const REPEATS: usize = 5;
/// Cycles beyond which a solve takes long.
const LONG: f64 = 1e9;
/// Warm ticks, as many as `cargo xtask firmware` plays after the first.
const TICKS: usize = 100;
/// Runs of all warm ticks.
const RUNS: usize = 3;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Timing {
    cycles: f64,
    spread: f64,
    sweeps: u32,
}

/// Measures `problem` as its setting says; level and cells are told by the setting.
pub fn measure(problem: &Problem, truth: &ReferenceSolution) -> Result<Point> {
    let mut setting = completed(&problem.scene);
    // Where nothing changes from tick to tick, and where no tick goes, every solve begins anew.
    if problem.scene.inputs.is_empty() || setting.scalar == Some(Precision::Mixed) {
        setting.start = Start::Cold;
    }
    let spaces = InputSpace::of(&problem.scene);
    let defaults: Vec<f64> = spaces.iter().map(|space| space.default).collect();
    let (timing, answer) = with_session(problem, |session| {
        let timing = match setting.start {
            Start::Cold => cold(session, &defaults)?,
            Start::Warm => warm(session, &spaces, &defaults)?,
        };
        Ok((timing, session.answer(problem)?))
    })?;
    let error = truth.errors(problem, &answer)?;
    Ok(point(problem, &setting, timing, &answer, error))
}

/// Ticks that each begin anew.
fn cold(session: &mut dyn Session, defaults: &[f64]) -> Result<Timing> {
    let mut costs = Vec::new();
    let mut sweeps = 0;
    while costs.len() < REPEATS {
        session.restart();
        let (cost, tick) = counted(|| session.tick(defaults));
        sweeps = tick?;
        costs.push(cost);
        if cost > LONG && costs.len() > 1 {
            break;
        }
    }
    let (cycles, spread) = median_and_spread(costs);
    Ok(Timing { cycles, spread, sweeps })
}

/// Ticks with inputs drawn from their ranges, and a last one at the defaults, whose answer is kept.
fn warm(session: &mut dyn Session, spaces: &[InputSpace], defaults: &[f64]) -> Result<Timing> {
    let mut medians = Vec::new();
    let mut sweeps = Vec::new();
    for _ in 0..RUNS {
        session.restart();
        session.tick(defaults)?;
        let mut costs = Vec::new();
        sweeps.clear();
        for inputs in drawn::<f64>(spaces, TICKS).skip(1) {
            let (cost, tick) = counted(|| session.tick(&inputs));
            sweeps.push(f64::from(tick?));
            costs.push(cost);
        }
        let is_long = costs.iter().sum::<f64>() > LONG;
        medians.push(median_and_spread(costs).0);
        if is_long {
            break;
        }
    }
    session.tick(defaults)?;
    let (cycles, spread) = median_and_spread(medians);
    Ok(Timing { cycles, spread, sweeps: median_and_spread(sweeps).0 as u32 })
}

fn point(
    problem: &Problem,
    setting: &Setting,
    timing: Timing,
    answer: &Solution,
    error: PointError,
) -> Point {
    let unknowns = problem.topology.counts.unknowns();
    let cells = match (problem.mesh.triangles.is_empty(), problem.mesh.quads.is_empty()) {
        (false, true) => "triangles",
        (true, false) => "quads",
        _ => "mixed",
    };
    let omega = match (setting.model, setting.omega) {
        (Some(ModelKind::Condensed), _) => "tuned",
        (_, Omega::Auto) => "auto",
        (_, Omega::Fixed(1.0)) => "unit",
        (_, Omega::Fixed(_)) => "tuned",
    };
    let stop = match (setting.model, setting.sweeps, setting.share) {
        (_, Some(sweeps), _) => format!("{sweeps} sweeps"),
        (Some(ModelKind::Condensed), None, _) if !answer.converged() => {
            "out of exchanges".to_owned()
        }
        (Some(ModelKind::Condensed), ..) if setting.solver == Some(Method::Sweeps) => {
            "sweeps to a tolerance".to_owned()
        }
        (Some(ModelKind::Condensed), None, _) => "exact".to_owned(),
        _ if setting.solver == Some(Method::Factor) => "factor".to_owned(),
        (_, None, share) => format!("share {}", share.unwrap_or(signorini_bake::full::SHARE)),
    };
    let contact = problem.topology.counts.contact;
    let mut point = Point {
        name: String::new(),
        scalar: word(&setting.scalar.unwrap_or(Precision::F64)),
        math: word(&setting.math),
        cells: cells.to_owned(),
        level: setting.refine,
        unknowns,
        stop,
        sweeps: timing.sweeps,
        start: word(&setting.start),
        omega: omega.to_owned(),
        model: word(&setting.model.unwrap_or(ModelKind::Full)),
        certificate: setting.certificate,
        error,
        bound: answer.bound.map(|bound| bound.total).filter(|bound| bound.is_finite()),
        bound_of_u: answer.bound.map(|bound| bound.of_u).filter(|bound| bound.is_finite()),
        cycles: timing.cycles,
        cycles_spread: timing.spread,
        cycles_per_unknown: timing.cycles / unknowns.max(1) as f64,
        instructions: None,
        ram_bytes: None,
        flash_bytes: None,
        pareto: false,
        setting: *setting,
    };
    point.name = name(&point, contact);
    point
}

/// All that tells it from the other points of its study; numbers are unknowns, n those of a condensed model.
fn name(point: &Point, contact: usize) -> String {
    let Point { model, cells, unknowns, scalar, stop, start, .. } = point;
    let mut words = vec![match model.as_str() {
        "condensed" => format!("condensed n = {contact} ({cells} {unknowns})"),
        _ => format!("{cells} {unknowns}"),
    }];
    words.extend(point.setting.error.map(|error| format!("refined to {error}")));
    words.push(scalar.clone());
    match (model.as_str(), stop.as_str()) {
        ("condensed", "exact" | "out of exchanges") => words.push(stop.clone()),
        _ => words.push(format!("{start}, {stop}")),
    }
    if point.omega != "auto" && model != "condensed" {
        words.push(format!("ω {}", point.omega));
    }
    if point.math != "libm" {
        words.push(point.math.clone());
    }
    if !point.certificate {
        words.push("no bound".to_owned());
    }
    words.join(", ")
}

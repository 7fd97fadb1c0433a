//! A scene on a mesh, answered in one of the ways that there are: an error, or numbers.

use signorini_bake::{Bakes, condensed, full};
use signorini_condense::condense;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{Error, Result};
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::Scene;
use signorini_session::tick::{Budget, TickRecord, play, schedule};
use signorini_solve::outputs::outputs;
use signorini_solve::{Options, ScalarKind, Solution, SolverKind, solve};

/// Sweeps of a solve: enough for some looks at the residual.
const SWEEPS: u32 = 40;

/// Solves, plays or bakes the scene, as `way` says; every error is one of input.
pub(super) fn answer(scene: &Scene, mesh: Mesh, way: u8) {
    let problem = match Problem::new(scene, mesh) {
        Ok(problem) => problem,
        Err(error) => return refused(&error),
    };
    let kernel = Options { max_sweeps: Some(SWEEPS), ..Options::default() };
    let solved = |options| {
        judge(solve(&problem, &options), |solution| judged(&problem, &solution));
    };
    match way % 6 {
        0 => solved(kernel),
        1 => solved(Options { scalar: ScalarKind::F32, ..kernel }),
        2 => solved(Options { solver: SolverKind::Direct, ..kernel }),
        3 => judge(played(&problem), |ticks| ticks.iter().for_each(sane)),
        4 => judge(baked_full::<f32>(&problem), |()| {}),
        _ => judge(baked_condensed::<f32>(&problem), |()| {}),
    }
}

/// Wrong input says so in a few words.
pub(super) fn refused(error: &Error) {
    assert_eq!(error.exit_status(), 2, "{error}");
    let message = error.to_string();
    assert!(!message.is_empty() && message.len() < 20_000, "{message}");
}

fn judge<T>(found: Result<T>, accepted: impl FnOnce(T)) {
    match found {
        Ok(found) => accepted(found),
        Err(error) => refused(&error),
    }
}

/// All that is written of a solution.
fn judged(problem: &Problem, solution: &Solution) {
    let numbers = solution.u.iter().chain(&solution.flux).chain(&solution.certified.vertices);
    let single = [solution.contact_force, solution.contact_length, solution.algebraic_residual];
    let said = || format!("{:?} {single:?} {:?}", solution.status, solution.bound);
    assert!(numbers.chain(&single).all(|x| x.is_finite()), "{}", said());
    assert!(solution.contact_force >= 0.0, "a pull: {}", said());
    let free = problem.topology.counts.free;
    for at in 0..problem.topology.counts.contact {
        let (u, gap) = (solution.u[free + at], solution.gap(problem, at));
        let span = problem.loads.flux_range(at).span().length();
        assert!(u >= gap || span != f64::INFINITY, "below the gap: {}", said());
        assert!(u <= gap || span != f64::NEG_INFINITY, "above the gap: {}", said());
    }
    if let Some(bound) = solution.bound {
        let parts = [bound.total, bound.duality_gap, bound.algebraic, bound.oscillation];
        assert!(parts.iter().all(|&part| part.is_finite() && part >= 0.0), "{}", said());
    }
    judge(outputs(problem, solution), |values| {
        assert!(values.values().flatten().all(|value| value.is_finite()));
    });
}

/// The first ticks of its schedule.
fn played(problem: &Problem) -> Result<Vec<TickRecord>> {
    let scene = &problem.scene;
    let moments = schedule::moments_after(scene, scene.time.is_none().then_some(2), None)?;
    let own = Budget { scalar: ScalarKind::F64, sweeps: SWEEPS / 2, ..Budget::of(scene) };
    let budget = Budget { intervals: false, shows_start: false, ..own };
    play(problem, None, &moments[..moments.len().min(3)], &budget, |_, _| Ok(()))
}

fn sane(tick: &TickRecord) {
    let numbers = [tick.contact_force, tick.contact_length, tick.combined].into_iter();
    let numbers = numbers.chain(tick.outputs.iter().copied());
    assert!(numbers.flatten().all(|x| x.is_finite()), "{tick:?}");
    assert!(tick.contact_force.is_none_or(|force| force >= 0.0), "{tick:?}");
    assert!(tick.bound.is_none_or(|bound| bound.total >= 0.0), "{tick:?}");
}

fn defaults<R: Bakes>(problem: &Problem) -> Vec<R> {
    problem.scene.inputs.iter().map(|input| R::narrow(input.default)).collect()
}

fn baked_full<R: Bakes>(problem: &Problem) -> Result<()> {
    let baked = full::Baked::<R>::new(problem)?;
    let inputs = defaults::<R>(problem);
    let limits = signorini_device::tick::Limits { sweeps: SWEEPS / 2, ..baked.limits() };
    if let Ok((values, report)) = full::Controller::new(&baked).tick_within(&inputs, limits) {
        let finite = report.ended != signorini_device::tick::Ended::NotFinite;
        assert!(!finite || values.iter().all(no_nan), "{values:?} {report:?}");
    }
    Ok(())
}

fn baked_condensed<R: Bakes>(problem: &Problem) -> Result<()> {
    let condensate = condense(problem)?;
    let work = condensed::Work { pivots: Some(40), sweeps: 10 };
    let baked = condensed::Baked::<R>::new(&condensate, work, true);
    let Ok(baked) = baked else { return Ok(()) };
    let inputs = defaults::<R>(problem);
    if let Ok((values, report)) = condensed::Controller::new(&baked).tick(&inputs) {
        assert!(values.iter().all(no_nan), "{values:?} {report:?}");
    }
    Ok(())
}

/// A bound may be infinite.
fn no_nan<R: Scalar>(x: &R) -> bool {
    !x.wide().is_nan()
}

//! The judge of a bound over time: the same data played on a mesh twice finer with a quarter of the step.
//!
//! ```text
//!   window² ≥ mean of G²,   G² = ‖A^½∇(u − s)‖² + ∫_R h(u − s)²,   weights e^{−2θλ(t_n − t)}
//! ```
//! with u replaced by the finer s, whose own window counts. A steady start stands for all time before it. The controllers that the scene
//! can have, full and condensed, are judged by the same finer play, and their last step alone.

use signorini_certify::CertifiedFields;
use signorini_condense::stepped;
use signorini_problem::quadrature::gauss;
use signorini_problem::{Problem, State};
use signorini_scene::error::{Error, Result};
use signorini_scene::mesh::adaptive::refined;
use signorini_session::tick::{Budget, ScheduledTick, TickRecord, play, replay};
use signorini_solve::{ScalarKind, Solution};

use super::nested::{Nesting, apart};

use super::step::{Judged, judge};
use super::trajectory::Trajectory;
use crate::mesh_solution::MeshSolution;

/// Steps of the finer play in a tick.
pub const PARTS: u32 = 4;

/// What a trajectory came to.
#[derive(Debug, Clone)]
pub struct JudgedTrajectory {
    /// λ dt
    pub rate: Option<f64>,
    /// By this machine's own ticks, by the full controller and by the condensed one; empty where there is none.
    pub plays: [JudgedPlay; 3],
    /// Why the last tick has no bound.
    pub no_bound: Option<String>,
}

/// Bounds of a play beside the finer one.
#[derive(Debug, Clone, Default)]
pub struct JudgedPlay {
    /// The bound over time at each tick; empty where there is none.
    pub windows: Vec<Judged>,
    /// The last step.
    pub step: Option<Judged>,
}

/// One play: the start and all steps.
struct Played {
    problem: Problem,
    answers: Vec<Solution>,
    records: Vec<TickRecord>,
}

pub fn judged(case: &Trajectory) -> Result<JudgedTrajectory> {
    let own = played(case, 1)?;
    let ticks = case.log.len();
    let last = &own.answers[ticks];
    let no_bound = last.no_bound.as_ref().map(ToString::to_string);
    let seconds = own.records[1].window.map(|[_, seconds]| seconds);
    let rate = seconds.map(|seconds| case.step * 0.5 / (0.1 * seconds));
    let finer = seconds.map(|_| played(case, PARTS)).transpose()?.zip(seconds);
    let judged = |of: Option<Played>| -> Result<JudgedPlay> {
        let Some(of) = of else { return Ok(JudgedPlay::default()) };
        // A finer mesh does not hold s_old where that follows curved data.
        let step = if case.is_affine { of.step(case, ticks)? } else { None };
        let windows = match &finer {
            Some((finer, seconds)) => of.windows(case, finer, *seconds)?,
            None => Vec::new(),
        };
        Ok(JudgedPlay { windows, step })
    };
    let (full, condensed) = (full(case, &own)?, condensed(case)?);
    let plays = [judged(Some(own))?, judged(full)?, judged(condensed)?];
    Ok(JudgedTrajectory { rate, plays, no_bound })
}

/// The problem of a trajectory, if its condensed model with a few states has a bound over time, and s at its start.
pub(super) fn posed(case: &Trajectory) -> Result<Option<(Problem, CertifiedFields)>> {
    let memory = 2 + case.log.len() % 7;
    let scene = case.scene(1, &format!("[setting]\nmemory = {memory}\n"))?;
    let problem = Problem::new(&scene, case.mesh.clone())?;
    // What a condensed model refuses is no matter of this judge.
    let Ok((of, recovery)) = stepped(&problem, Some(memory)) else { return Ok(None) };
    let start = of.evolution.as_ref().and_then(|_| of.s_at_start(&recovery, &problem));
    Ok(start.map(|start| (problem, start)))
}

/// The trajectory by its full controller, which begins where its `own` ticks do; nothing where there is none.
fn full(case: &Trajectory, own: &Played) -> Result<Option<Played>> {
    let sweeps = case.sweeps.map_or_else(String::new, |sweeps| format!("sweeps = {sweeps}\n"));
    let scene = case.scene(1, &format!("[setting]\nmodel = \"full\"\n{sweeps}"))?;
    let problem = Problem::new(&scene, case.mesh.clone())?;
    match replayed(case, problem, own.answers[0].certified.clone()) {
        // Nor is what a full one refuses.
        Err(Error::Input(_)) => Ok(None),
        played => played.map(Some),
    }
}

/// The trajectory by its condensed controller; nothing where there is none.
fn condensed(case: &Trajectory) -> Result<Option<Played>> {
    let Some((problem, start)) = posed(case)? else { return Ok(None) };
    replayed(case, problem, start).map(Some)
}

/// The trajectory by the controller that `bake` writes for `problem`, whose s is this at the start.
fn replayed(case: &Trajectory, problem: Problem, start: CertifiedFields) -> Result<Played> {
    let moments = schedule(case, 1, &problem);
    let mut answers = Vec::new();
    let (_, records) = replay(&problem, &moments, (Some(case.scalar), true), |_, solution| {
        answers.push(answered(solution)?);
        Ok(())
    })?;
    answers[0].certified = start;
    Ok(Played { problem, answers, records })
}

fn played(case: &Trajectory, parts: u32) -> Result<Played> {
    let scene = case.scene(parts, "")?;
    let mesh = if parts == 1 { case.mesh.clone() } else { refined(&case.mesh)? };
    let problem = Problem::new(&scene, mesh)?;
    let own = Budget::of(&scene);
    let budget = match parts {
        1 => Budget {
            scalar: case.scalar,
            sweeps: case.sweeps.unwrap_or(own.sweeps),
            intervals: false,
            ..own
        },
        _ => Budget { scalar: ScalarKind::F64, intervals: false, ..own },
    };
    let moments = schedule(case, parts, &problem);
    let mut answers = Vec::new();
    let records = play(&problem, None, &moments, &budget, |_, solution| {
        answers.push(answered(solution)?);
        Ok(())
    })?;
    Ok(Played { problem, answers, records })
}

/// All ticks of a trajectory, each in so many parts.
fn schedule(case: &Trajectory, parts: u32, problem: &Problem) -> Vec<ScheduledTick> {
    let moment = |(tick, part): (usize, u32)| ScheduledTick {
        time: (tick as f64 + f64::from(part) / f64::from(parts)) * case.step,
        inputs: case.inputs(tick, [part, parts], problem).into_iter().enumerate().collect(),
    };
    let places = (0..case.log.len()).flat_map(|tick| (1..=parts).map(move |part| (tick, part)));
    places.map(moment).collect()
}

fn answered(solution: Option<&Solution>) -> Result<Solution> {
    solution.cloned().ok_or_else(|| Error::Check("a tick was refused".to_owned()))
}

impl Played {
    /// The problem as tick `tick`, counted from 1, has it.
    fn at(&self, case: &Trajectory, tick: usize) -> Result<Problem> {
        let mut problem = self.problem.clone();
        let inputs: Vec<_> =
            case.inputs(tick - 1, [1, 1], &self.problem).into_iter().enumerate().collect();
        problem.set(&inputs, tick as f64 * case.step)?;
        Ok(problem)
    }

    fn step(&self, case: &Trajectory, tick: usize) -> Result<Option<Judged>> {
        let begin: State<f64> = self.answers[tick - 1].state();
        let problem = self.at(case, tick)?.stepping(case.step, begin)?;
        judge(&problem, &self.answers[tick], 1)
    }

    /// At every tick the bound over time, the root of the mean of G², and the finer bound in these weights.
    fn windows(&self, case: &Trajectory, finer: &Self, seconds: f64) -> Result<Vec<Judged>> {
        let was_steady = case.initial.is_none();
        let fading = |time: f64| (-time / seconds).exp();
        let part = case.step / f64::from(PARTS);
        let (mut integral, mut weights) = (0.0, 0.0);
        let mut judged = Vec::new();
        for tick in 0..case.log.len() {
            let posed = [self.at(case, tick + 1)?, finer.at(case, tick + 1)?];
            let square = |at: f64| self.square(finer, &posed, tick, at);
            let mut begin = square(0.0)?;
            if tick == 0 && was_steady {
                (integral, weights) = (seconds * begin, seconds);
            }
            for number in 0..PARTS {
                let at = f64::from(number);
                let [middle, end] = [square(at + 0.5)?, square(at + 1.0)?];
                let of = fading(part) * begin + 4.0 * fading(0.5 * part) * middle + end;
                integral = fading(part) * integral + part / 6.0 * of;
                weights = fading(part) * weights + seconds * (1.0 - fading(part));
                begin = end;
            }
            let window = |records: &[TickRecord], at: usize| records[at].window;
            let (Some([own, _]), Some([its, its_seconds])) = (
                window(&self.records, tick + 1),
                window(&finer.records, PARTS as usize * (tick + 1)),
            ) else {
                break;
            };
            // Weights of the finer one fade a little faster: by how much the older past counts less there.
            let elapsed = case.step * (tick + 1) as f64;
            let older = (elapsed / its_seconds - elapsed / seconds).max(0.0).exp();
            let apart = (integral / weights).sqrt();
            judged.push(Judged { bound: own, apart, finer: its * older.sqrt() });
        }
        Ok(judged)
    }

    /// G² between both, `at` in parts of tick `tick`, with the data of that tick.
    fn square(&self, finer: &Self, posed: &[Problem; 2], tick: usize, at: f64) -> Result<f64> {
        let own = between(&self.answers[tick..], at / f64::from(PARTS));
        let its = between(&finer.answers[PARTS as usize * tick..], at);
        let side =
            |problem, of| MeshSolution::new(problem, CertifiedFields::admissible(of), &of.tau);
        let rule = gauss(3);
        let nesting = Nesting { levels: 1, cut: None };
        let found = apart(&side(&posed[0], &own)?, &side(&posed[1], &its)?, &nesting, &rule)?;
        Ok(found.with_robin * found.with_robin)
    }
}

/// s between answers, linear in between.
fn between(answers: &[Solution], at: f64) -> CertifiedFields {
    let first = (at.floor() as usize).min(answers.len() - 1);
    let share = at - first as f64;
    let [from, to] = [first, (first + 1).min(answers.len() - 1)].map(|at| &answers[at].certified);
    let mix = |a: &[f64], b: &[f64]| -> Vec<f64> {
        a.iter().zip(b).map(|(a, b)| (1.0 - share) * a + share * b).collect()
    };
    CertifiedFields {
        vertices: mix(&from.vertices, &to.vertices),
        bubbles: mix(&from.bubbles, &to.bubbles),
        tau: from.tau.clone(),
        following: from.following.clone(),
        ..CertifiedFields::default()
    }
}

//! Ticks of the controller that `bake` writes for a scene, with the bits that firmware gets.
//!
//! Model, solver, scalar, setting, first state and what stays from tick to tick are the module's. What the module
//! does not say, the contact force and length of a scene with other outputs and the true error, is read off its
//! state. A tick that the module refuses leaves its state and the answer before, as on a device.

#[cfg(test)]
mod tests;

use super::{ScheduledTick, TickFields, TickRecord};
use crate::engine::{self, Engine, Module, TickSolution};
use signorini_certify::exact::distance;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_solve::ScalarKind;

/// Plays `moments` through the controller of `problem`, calling `done` after each; also the controller's name in
/// a few words. `asked` is a scalar instead of that of the scene's setting.
///
/// # Errors
/// Those of `bake`; inputs for which the scene's data are not admissible, with their time.
pub fn replay(
    problem: &Problem,
    moments: &[ScheduledTick],
    asked: Option<ScalarKind>,
    mut done: impl FnMut(&TickRecord, &TickFields) -> Result<()>,
) -> Result<(String, Vec<TickRecord>)> {
    engine::baked(problem, asked, |engine, module| {
        let mut problem = problem.clone();
        let ticks = moments.iter().map(|moment| {
            moment.set(&mut problem)?;
            let (tick, fields) = tick(&problem, engine, module)?;
            done(&tick, &fields)?;
            Ok(tick)
        });
        Ok((module.name.clone(), ticks.collect::<Result<_>>()?))
    })
}

fn tick(
    problem: &Problem,
    engine: &mut dyn Engine,
    module: &Module,
) -> Result<(TickRecord, TickFields)> {
    let inputs: Vec<f64> = problem.scene.inputs.iter().map(|input| input.default).collect();
    match engine.tick(&inputs) {
        Ok(_) => {
            let answer = engine.answer(problem)?;
            let tick = read_off(problem, &answer, module)?;
            let TickSolution { u, flux, certified, .. } = answer;
            Ok((tick, TickFields { u, flux, vertices: certified.vertices }))
        }
        Err(_) => Ok((refused(problem), TickFields::default())),
    }
}

/// A tick whose inputs or answer the controller's scalar cannot hold.
fn refused(problem: &Problem) -> TickRecord {
    TickRecord {
        time: problem.time,
        status: "not-finite",
        sweeps: 0,
        contact_force: None,
        contact_length: None,
        bound: None,
        combined: None,
        outputs: vec![None; problem.scene.outputs.len()],
        intervals: vec![Err("the tick was refused".to_owned()); problem.scene.outputs.len()],
    }
}

fn read_off(problem: &Problem, answer: &TickSolution, module: &Module) -> Result<TickRecord> {
    let finite = |value: f64| value.is_finite().then_some(value);
    let bound = answer.bound.filter(|bound| bound.total.is_finite());
    let combined = match (&problem.scene.exact, bound) {
        (Some(exact), Some(_)) => {
            Some(distance(exact, problem, &answer.certified.admissible())?.combined)
        }
        _ => None,
    };
    // Without declared outputs the module's are these two.
    let [force, length] = match (problem.scene.outputs.is_empty(), &answer.outputs[..]) {
        (true, &[force, length]) => [force, length],
        _ => [answer.force, answer.length(problem)],
    };
    let outputs = answer.outputs.iter().take(problem.scene.outputs.len());
    let plus_minus = module.plus_minus(bound.as_ref());
    let around = |(&value, by): (&f64, std::result::Result<f64, String>)| {
        by.map(|by| [value - by, value + by])
    };
    let intervals = outputs.clone().zip(plus_minus).map(around).collect();
    Ok(TickRecord {
        time: problem.time,
        status: answer.ended,
        sweeps: answer.sweeps,
        contact_force: finite(force),
        contact_length: finite(length),
        bound,
        combined: combined.and_then(finite),
        outputs: outputs.map(|&value| finite(value)).collect(),
        intervals,
    })
}

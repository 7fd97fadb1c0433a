//! `signorini.tick`.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::Scene;
use signorini_session::tick::{Budget, ScheduledTick, TickRecord, log, play, replay, schedule};

use crate::arrays::Filled;
use crate::error::raised;
use crate::posed::GivenScene;
use crate::work::work;

/// Which ticks, and what they may take.
#[derive(FromPyObject)]
pub struct Ticks {
    count: Option<u32>,
    log: Option<PathBuf>,
    /// Times, and values by the names of inputs.
    times: Option<Vec<f64>>,
    inputs: Vec<(String, Vec<f64>)>,
    baked: bool,
    budget_sweeps: Option<u32>,
    intervals: bool,
}

/// Plays a scene over time. A column for each quantity.
#[pyfunction]
pub fn tick<'py>(py: Python<'py>, scene: GivenScene, ticks: Ticks) -> PyResult<Bound<'py, PyDict>> {
    let is_file = scene.is_file();
    let found = work(py, move |_| {
        let posed = scene.read()?;
        let problem = posed.problem()?;
        let moments = ticks.moments(&posed.scene)?;
        let records = match ticks.baked {
            true => replay(&problem, &moments, (None, true), |_, _| Ok(()))?.1,
            false => {
                let own = Budget::of(&posed.scene);
                let sweeps = ticks.budget_sweeps.unwrap_or(own.sweeps);
                let budget = Budget { sweeps, intervals: ticks.intervals, ..own };
                play(&problem, None, &moments, &budget, |_, _| Ok(()))?
            }
        };
        let names = posed.scene.outputs.iter().map(|of| of.name.value.clone()).collect();
        Ok((records, names))
    })?;
    let (records, names) = found.map_err(|error: Error| raised(py, error, is_file))?;
    columns(py, &records, names)
}

impl Ticks {
    fn moments(&self, scene: &Scene) -> Result<Vec<ScheduledTick>> {
        if let Some(path) = &self.log {
            return log::read(path, scene);
        }
        let Some(times) = &self.times else { return schedule::moments(scene, self.count) };
        let mut moments: Vec<_> =
            times.iter().map(|&time| ScheduledTick { time, inputs: Vec::new() }).collect();
        for (name, values) in &self.inputs {
            let at = scene.input_number(name)?;
            for (moment, &value) in moments.iter_mut().zip(values) {
                scene.check_input(at, value).map_err(|error| error.at_time(moment.time))?;
                moment.inputs.push((at, value));
            }
        }
        Ok(moments)
    }
}

/// What does not exist is NaN in an array of numbers.
fn columns<'py>(
    py: Python<'py>,
    records: &[TickRecord],
    names: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let all = Filled::new(py);
    let number = |of: &dyn Fn(&TickRecord) -> Option<f64>| {
        records.iter().map(|tick| of(tick).unwrap_or(f64::NAN)).collect::<Vec<f64>>()
    };
    all.numbers("t", number(&|tick| Some(tick.time)))?;
    all.set("status", records.iter().map(|tick| tick.status.name()).collect::<Vec<_>>())?;
    all.numbers("sweeps", records.iter().map(|tick| tick.sweeps).collect::<Vec<u32>>())?;
    all.numbers("contact_force", number(&|tick| tick.contact_force))?;
    all.numbers("contact_length", number(&|tick| tick.contact_length))?;
    all.numbers("error_bound", number(&|tick| tick.bound.map(|bound| bound.total)))?;
    let (outputs, bounds) = (Filled::new(py), Filled::new(py));
    for (at, name) in names.iter().enumerate() {
        outputs.numbers(name, number(&|tick| tick.outputs.get(at).copied().flatten()))?;
        let ends = |of: &dyn Fn(&TickRecord) -> Option<[f64; 2]>| {
            records.iter().map(|tick| of(tick).unwrap_or([f64::NAN; 2])).collect::<Vec<_>>()
        };
        let over_time = |tick: &TickRecord| tick.over_time.get(at).copied().flatten();
        let is_over_time = records.iter().any(|tick| over_time(tick).is_some());
        let anew = |tick: &TickRecord| tick.intervals.get(at)?.as_ref().ok().copied();
        let own: &dyn Fn(&TickRecord) -> Option<[f64; 2]> =
            if is_over_time { &over_time } else { &anew };
        bounds.rows(name, ends(own))?;
    }
    all.set("outputs", outputs.0)?;
    all.set("output_bounds", bounds.0)?;
    Ok(all.0)
}

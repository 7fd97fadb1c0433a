//! `signorini.tick`.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::Scene;
use signorini_session::tick::refusals::refusals;
use signorini_session::tick::window_error::without_window_error;
use signorini_session::tick::{
    Begin, Budget, Played, Saved, ScheduledTick, TickRecord, log, play_on, replay, schedule,
};
use signorini_solve::warnings;

use crate::arrays::Filled;
use crate::error::raised;
use crate::posed::{GivenScene, PosedScene};
use crate::work::work;

/// Which ticks, and what they may take.
#[derive(FromPyObject)]
pub struct Ticks {
    count: Option<u32>,
    log: Option<PathBuf>,
    /// Times, and values by the names of inputs.
    times: Option<Vec<f64>>,
    inputs: Vec<(String, Vec<f64>)>,
    step: Option<f64>,
    baked: bool,
    budget_sweeps: Option<u32>,
    tolerance: Option<f64>,
    intervals: bool,
    /// The file of a state to go on from.
    begin: Option<PathBuf>,
}

/// What a play has come to: its ticks, the text of its state, and what is to be said of it.
struct Told {
    scene: Scene,
    ticks: Vec<TickRecord>,
    state: Option<String>,
    warnings: Vec<String>,
}

/// Plays a scene over time. A column for each quantity.
#[pyfunction]
pub fn tick<'py>(py: Python<'py>, scene: GivenScene, ticks: Ticks) -> PyResult<Bound<'py, PyDict>> {
    let is_file = scene.is_file();
    let found = work(py, move |_| ticks.play(scene.read()?))?;
    let Told { scene, ticks, state, warnings } =
        found.map_err(|error: Error| raised(py, error, is_file))?;
    let all = columns(py, &scene, &ticks)?;
    all.set("state", state)?;
    all.set("warnings", warnings)?;
    Ok(all.0)
}

impl Ticks {
    fn play(&self, mut posed: PosedScene) -> Result<Told> {
        self.step.iter().for_each(|&step| posed.scene.set_step(step));
        let own = Budget::of(&posed.scene);
        let saved = self.begin.as_deref().map(Saved::read).transpose()?;
        if let Some(saved) = &saved {
            saved.check_scene(&posed.scene, own.scalar)?;
            posed.go_on_from(&saved.last);
        }
        let moments = self.moments(&posed.scene, saved.as_ref().map(|saved| saved.last.time))?;
        let problem = posed.problem()?;
        let mut said = problem.warnings.clone();
        let shows_start = self.log.is_none() && self.times.is_none();
        let Played { ticks, saved } = if self.baked {
            let (_, ticks) = replay(&problem, &moments, (None, shows_start), |_, _| Ok(()))?;
            Played { ticks, saved: None }
        } else {
            let first = moments.first().map_or(0.0, |moment| moment.time);
            said.extend(warnings(&problem, first, own.scalar)?);
            let begin = saved.as_ref().map_or(Begin::Anew(None), Begin::From);
            let sweeps = self.budget_sweeps.unwrap_or(own.sweeps);
            let (tolerance, intervals) = (self.tolerance, self.intervals);
            let budget = Budget { sweeps, tolerance, intervals, shows_start, ..own };
            play_on(&problem, begin, &moments, &budget, |_, _| Ok(()))?
        };
        said.extend(refusals(&ticks));
        said.extend(without_window_error(&posed.scene));
        let state = saved.map(|saved| saved.text()).transpose()?;
        Ok(Told { scene: posed.scene, ticks, state, warnings: said })
    }

    fn moments(&self, scene: &Scene, last: Option<f64>) -> Result<Vec<ScheduledTick>> {
        if let Some(path) = &self.log {
            return log::read_after(path, scene, last);
        }
        let Some(times) = &self.times else {
            return schedule::moments_after(scene, self.count, last);
        };
        let mut moments: Vec<_> =
            times.iter().map(|&time| ScheduledTick { time, inputs: Vec::new() }).collect();
        for (name, values) in &self.inputs {
            let at = scene.input_number(name)?;
            for (moment, &value) in moments.iter_mut().zip(values) {
                scene.check_input(at, value).map_err(|error| error.at_time(moment.time))?;
                moment.inputs.push((at, value));
            }
        }
        schedule::check_steps(scene, last, &moments)?;
        Ok(moments)
    }
}

/// What does not exist is NaN in an array of numbers.
fn columns<'py>(py: Python<'py>, scene: &Scene, records: &[TickRecord]) -> PyResult<Filled<'py>> {
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
    let window = |at: usize| move |tick: &TickRecord| tick.window.map(|window| window[at]);
    all.numbers("window_energy", number(&window(0)))?;
    all.numbers("window_seconds", number(&window(1)))?;
    all.numbers("window_error", number(&|tick| tick.window_error))?;
    let (outputs, bounds) = (Filled::new(py), Filled::new(py));
    for (at, output) in scene.outputs.iter().enumerate() {
        let name = &output.name.value;
        outputs.numbers(name, number(&|tick| tick.outputs.get(at).copied().flatten()))?;
        let ends = |of: &dyn Fn(&TickRecord) -> Option<[f64; 2]>| {
            records.iter().map(|tick| of(tick).unwrap_or([f64::NAN; 2])).collect::<Vec<_>>()
        };
        let anew = ends(&|tick| tick.intervals.get(at)?.as_ref().ok().copied());
        if scene.stores() {
            bounds.rows(name, ends(&|tick| tick.over_time.get(at).copied().flatten()))?;
            bounds.rows(&format!("{name}_step"), anew)?;
        } else {
            bounds.rows(name, anew)?;
        }
    }
    all.set("outputs", outputs.0)?;
    all.set("output_bounds", bounds.0)?;
    Ok(all)
}

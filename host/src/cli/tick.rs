//! `signorini tick`: one scene over time, its files.

use std::path::PathBuf;
use std::sync::atomic::Ordering;

use clap::Args;

use super::interruption::interruption;
use super::picture::picture;
use super::scene_arguments::{SceneArguments, problem_of};
use super::series::Series;
use super::step_advice::step_advice;
use super::tick_report::{contradiction, report, without_interval, without_window};
use super::tick_setting::check_ticks;
use signorini_bake::setting;
use signorini_draw::chart_file;
use signorini_files::atomic::{writable_file, write_atomically};
use signorini_files::fields::{Drawn, picture as vtu};
use signorini_problem::Problem;
use signorini_problem::progress::{note, say, steps, warn};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::mesh;
use signorini_scene::scene::Scene;
use signorini_session::tick::columns::{bounds_csv, check_names, ticks_csv};
use signorini_session::tick::refusals::refusals;
use signorini_session::tick::window_error::without_window_error;
use signorini_session::tick::{
    Begin, Budget, Onward, Played, Saved, ScheduledTick, TickRecord, log, play_on, replay_on,
    schedule,
};
use signorini_solve::warnings;
use signorini_solve::{Ending, ScalarKind, Solution};

const EXAMPLES: &str = "\
Examples:
  signorini tick meshes/catalogue/moving-tri.toml
  signorini tick meshes/scenes/levee.toml --budget-sweeps 40 --scalar f32
  signorini tick meshes/scenes/levee.toml --log inputs.csv
  signorini tick meshes/scenes/levee.toml --log inputs.csv --baked
  signorini tick meshes/catalogue/moving-tri.toml --vtu     for ParaView: open ticks.pvd
  signorini tick my.toml --ticks 100 --save state.json      then 100 more, as if there had been 200:
  signorini tick my.toml --ticks 100 --from state.json

A log has the inputs of ticks, one tick a line; inputs without a column keep their values:
  t,rain,river
  0,0,0
  0.01,2,0.5

Plain ticks sweep the full model with its certificate. A device has the controller that `bake` wrote: --baked plays \
the same one, bit for bit, its model, solver, scalar and [setting] chosen as there.

Without --budget-sweeps the first tick on a large mesh starts from the answer of a factor.

Where a material has a capacity, each tick is a step of length time.step that begins from the one before, and the first \
row is the start: error_bound is about the one step then, not about the evolution.

--from goes on bit for bit: t and the inputs are those of the state until --input or a log says otherwise, and the files \
have the new ticks alone. The state is one of the scene, its mesh, --step, --scalar, and of --tolerance and --baked being given or not.

Ctrl-C ends the run after the tick at hand, with its files and --save; the exit status is 130. A second one ends it at once.

A tick that its budget cuts off is normal: its status says so, and the exit status is 0.";

/// Arguments of `tick`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    place: SceneArguments,
    /// Number of ticks from t = 0, or from the state, by the step of the scene or, without [time], by 1 [default: to the
    /// end of the scene]
    #[arg(long, value_name = "N", conflicts_with = "log", value_parser = clap::value_parser!(u32).range(1..=i64::from(schedule::MOST)))]
    ticks: Option<u32>,
    /// Another length of a tick than the scene's time.step, in seconds
    #[arg(long, value_name = "DT", value_parser = super::tick_setting::length_of_step, allow_negative_numbers = true)]
    step: Option<f64>,
    /// Most sweeps of one tick [default: 1 000 000]
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(1..))]
    budget_sweeps: Option<u32>,
    /// The certified error, in the energy norm, that is small enough [default: a tick goes on until more
    /// sweeps would not lower it much]
    #[arg(long, value_name = "E", value_parser = super::solve::tolerance, allow_negative_numbers = true)]
    error: Option<f64>,
    /// Bound on the scaled complementarity residual that ends a tick, as it ends a solve; the bound on the error is worked out once then
    #[arg(long, value_name = "T", value_parser = super::solve::tolerance, allow_negative_numbers = true, conflicts_with = "error")]
    tolerance: Option<f64>,
    /// A coarser mesh of the same domain, from whose solution the first tick starts
    #[arg(long, value_name = "FILE", conflicts_with = "from")]
    coarse: Option<PathBuf>,
    /// Scalar type of the kernel [default: the scene's setting.scalar, else f64; with --baked else f32]
    #[arg(long, value_enum)]
    scalar: Option<ScalarKind>,
    /// Times and inputs from a CSV file with the columns t and names of inputs
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// By the controller that `bake` writes for the scene, with its bits
    #[arg(long, conflicts_with_all = ["budget_sweeps", "error", "tolerance", "coarse"])]
    baked: bool,
    /// Write the state after the last tick
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Go on from a state that --save has written
    #[arg(long, value_name = "FILE")]
    from: Option<PathBuf>,
    /// No intervals of the outputs: else output_bounds.csv has NAME_least and NAME_most around the exact value of each force, flux
    /// and mean, NAME_cell_least and NAME_cell_most around the mean over a probe's cell; of steps in time NAME_step_least and NAME_step_most, about that step alone. Above 300 000 unknowns times ticks there are none without --baked, whose controller has numbers for them
    #[arg(long)]
    no_intervals: bool,
    /// Also ticks.pvd, a series for ParaView, and a VTU file each tick in the folder ticks
    #[arg(long)]
    vtu: bool,
}

/// Unknowns times ticks up to which intervals of outputs are worked out: some seconds.
const MOST_INTERVALS: usize = 300_000;

/// A play that is about to begin: all that the command line and its files say.
struct Task {
    problem: Problem,
    coarse: Option<Problem>,
    /// Where it goes on from.
    saved: Option<Saved>,
    moments: Vec<ScheduledTick>,
    budget: Budget,
    out: PathBuf,
}

/// What a play has left.
struct Ran {
    /// The model in a few words.
    model: String,
    played: Played,
    was_interrupted: bool,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let task = self.task()?;
        self.warn_before(&task)?;
        let ran = self.play(&task)?;
        let Ran { model, played: Played { ticks, saved }, was_interrupted } = &ran;
        self.write(&task, ticks)?;
        let is_saved = self.save_state(&task.problem.scene, saved.as_ref())?;
        report(&task.problem, model, ticks, &task.out);
        self.tell(&task, &ran)?;
        if *was_interrupted {
            let played = ticks.iter().filter(|tick| tick.status != Ending::Start).count();
            let all = task.moments.len();
            note(&format_args!("interrupted after {played} of {all} ticks; the files have these"));
            return Ok(130);
        }
        Ok(if ticks.iter().any(TickRecord::failed) || !is_saved { 3 } else { 0 })
    }

    fn task(&self) -> Result<Task> {
        let mut scene = self.place.scene()?;
        self.step.iter().for_each(|&step| scene.set_step(step));
        check_names(&scene)?;
        if !self.baked {
            check_ticks(&scene, self.scalar.is_some())?;
        }
        let (out, own) = (self.place.out()?, Budget::of(&scene));
        let scalar = match self.baked {
            true => setting::scalar(&scene, self.scalar)?,
            false => self.scalar.unwrap_or(own.scalar),
        };
        self.check_state(&scene)?;
        if let Some(place) = &self.save {
            super::check_beside(&scene, "--save", place)?;
            writable_file("--save", place)?;
        }
        let saved = self.from.as_deref().map(Saved::read).transpose()?;
        if let Some(saved) = &saved {
            saved.check_scene(&scene, scalar)?;
            saved.last.values().for_each(|(at, value)| scene.inputs[at].default = value);
            self.place.set_inputs(&mut scene)?;
        }
        let last = saved.as_ref().map(|saved| saved.last.time);
        let moments = match &self.log {
            Some(path) => log::read_after(path, &scene, last)?,
            None => schedule::moments_after(&scene, self.ticks, last)?,
        };
        let problem = problem_of(&scene)?;
        let coarse = self.coarse.as_ref().map(|mesh| Problem::new(&scene, mesh::read(mesh)?));
        let budget = Budget {
            scalar,
            tolerance: self.tolerance,
            sweeps: self.budget_sweeps.unwrap_or(own.sweeps),
            error: self.error.unwrap_or(own.error),
            intervals: !self.no_intervals && work(&problem, &moments) <= MOST_INTERVALS,
            shows_start: self.log.is_none(),
        };
        Ok(Task { problem, coarse: coarse.transpose()?, saved, moments, budget, out })
    }

    /// Refuses a state of a controller whose ticks are no steps in time.
    fn check_state(&self, scene: &Scene) -> Result<()> {
        let key = if self.save.is_some() { "--save" } else { "--from" };
        if !self.baked || scene.stores() || (self.save.is_none() && self.from.is_none()) {
            return Ok(());
        }
        let why = "no material has a capacity: what a controller then keeps is where its next sweeps begin, and has no file";
        let hint = "leave out --baked, or play the log as a whole";
        Err(InputError::new(format!("{key}: {why}")).file(scene.file()).hint(hint).into())
    }

    fn warn_before(&self, Task { problem, coarse, moments, budget, .. }: &Task) -> Result<()> {
        warn(&problem.warnings);
        coarse.iter().for_each(|coarse| warn(&coarse.warnings));
        if !self.baked {
            let first = moments.first().map_or(0.0, |moment| moment.time);
            warn(&warnings(problem, first, budget.scalar)?);
        }
        Ok(())
    }

    fn play(&self, task: &Task) -> Result<Ran> {
        let Task { problem, coarse, saved, moments, budget, out } = task;
        let interrupted = interruption()?;
        let bar = steps(moments.len());
        let mut series = self.vtu.then(|| Series::new(out, "ticks", 4));
        let done = |tick: &TickRecord, solution: Option<&Solution>| {
            bar.set_message(format!("t = {}", tick.time));
            bar.inc(1);
            // A tick that was refused has no fields.
            if let (Some(series), Some(solution)) = (&mut series, solution) {
                series.add(tick.time, &vtu(problem, &Drawn::plain(solution)))?;
            }
            Ok(if interrupted.load(Ordering::Relaxed) { Onward::Stop } else { Onward::GoOn })
        };
        let begin = saved.as_ref().map_or(Begin::Anew(coarse.as_ref()), Begin::From);
        let ran = match self.baked {
            true => {
                let asked = (self.scalar, budget.shows_start);
                replay_on(problem, saved.as_ref(), moments, asked, done)
            }
            false => play_on(problem, begin, moments, budget, done)
                .map(|played| ("full, swept".to_owned(), played)),
        };
        bar.finish_and_clear();
        let (model, played) = ran.map_err(|error| match &self.log {
            Some(path) => log::blamed(path, error),
            None => error,
        })?;
        series.map_or_else(|| Series::new(out, "ticks", 4).forget().map(drop), Series::close)?;
        Ok(Ran { model, played, was_interrupted: interrupted.load(Ordering::Relaxed) })
    }

    fn write(&self, Task { problem, out, .. }: &Task, ticks: &[TickRecord]) -> Result<()> {
        let (scene, failed) = (&problem.scene, |error: csv::Error| Error::Check(error.to_string()));
        let table = ticks_csv(scene, ticks).map_err(failed)?;
        let bounds = bounds_csv(scene, ticks).map_err(failed)?;
        let drawing = chart_file(&picture(scene, ticks, self.budget_sweeps));
        write_atomically(&out.join("ticks.csv"), &table)?;
        write_atomically(&out.join("output_bounds.csv"), &bounds)?;
        write_atomically(&out.join("ticks.svg"), drawing.as_bytes())
    }

    /// Says what the ticks leave to be known: steps, refusals, and what has no bound or interval.
    fn tell(&self, task: &Task, ran: &Ran) -> Result<()> {
        let Task { problem, saved, moments, .. } = task;
        let (scene, ticks) = (&problem.scene, &ran.played.ticks);
        if saved.is_none() && !ran.was_interrupted {
            step_advice(problem, moments)?.iter().for_each(|line| say(format_args!("  {line}")));
        }
        warn(&refusals(ticks));
        let work = work(problem, moments);
        if !self.no_intervals && !self.baked && work > MOST_INTERVALS {
            let most = MOST_INTERVALS / problem.topology.counts.unknowns();
            say(format_args!(
                "  no intervals of outputs: {work} unknowns times ticks are more than {MOST_INTERVALS}; up to {most} ticks have them"
            ));
        }
        let lost = if self.baked { without_window(scene, ticks) } else { None };
        let told = [lost, contradiction(ticks), without_window_error(scene)];
        warn(&told.into_iter().flatten().collect::<Vec<_>>());
        without_interval(scene, ticks).iter().for_each(|line| say(format_args!("  {line}")));
        Ok(())
    }

    /// Writes the state; whether that was possible where it is asked for.
    fn save_state(&self, scene: &Scene, saved: Option<&Saved>) -> Result<bool> {
        let Some(place) = &self.save else { return Ok(true) };
        let Some(saved) = saved else {
            warn(&[format!(
                "--save {}: not written, since the last tick left no numbers to go on from",
                place.display()
            )]);
            return Ok(false);
        };
        super::write_beside(scene, "--save", place, &saved.text()?)?;
        Ok(true)
    }
}

/// Unknowns times ticks.
fn work(problem: &Problem, moments: &[ScheduledTick]) -> usize {
    problem.topology.counts.unknowns() * moments.len()
}

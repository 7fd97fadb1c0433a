//! `signorini solve`: one scene, its files.

use std::path::{Path, PathBuf};

use clap::Args;

use super::answer::Told;
use super::levels;
use super::scene_arguments::{SceneArguments, problem_of};
use super::{check_beside, picture_file};
use signorini_files::atomic::write_atomically;
use signorini_intervals::Coverage;
use signorini_problem::Problem;
use signorini_problem::progress::{say, waiting, warn};
use signorini_scene::error::{InputError, Result};
use signorini_scene::goal::Goal;
use signorini_scene::mesh::adapted;
use signorini_scene::scene::Scene;
use signorini_scene::scene::term::at_rest_warning;
use signorini_scene::setting::Precision;
use signorini_session::request::SolveRequest;
use signorini_solve::adaptive::{MOST_UNKNOWNS, Wanted};
use signorini_solve::energy_norm;
use signorini_solve::{ScalarKind, SolverKind};

const EXAMPLES: &str = "\
Examples:
  signorini solve meshes/scenes/levee.toml
  signorini solve levee.toml --mesh finer.msh --solver direct --out /tmp/levee
  signorini solve levee.toml --draw levee.svg               with a picture: u, flux, what is in contact, outputs
  signorini solve levee.toml --scalar f32 --input rain=2e-8
  signorini solve levee.toml --no-intervals --no-files      the solution and its bound, without what takes longest
  signorini solve levee.toml --max-error 5%      refine where the error bound says, until it is below 5 %

The [setting] of a scene is followed unless --solver, --tolerance or --max-sweeps is given: then of it cells, refine, \
element and scalar hold, and a warning names the keys that give way. A fixed number of warm sweeps is solved as the tick \
of a controller that has run.

`auto` takes what is quickest at the size of the mesh, by a record: sweeps, a factor, the direct solver or multigrid; \
--max-sweeps asks for sweeps. What solved the scene is printed, and stands in summary.json as `solver_used`.";

/// A bound above this part of the solution leaves the question what to do about it.
const LARGE: f64 = 0.05;

/// Arguments of `solve`.
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", signorini_scene::expression::vocabulary()))]
pub struct Arguments {
    #[command(flatten)]
    place: SceneArguments,
    /// Scalar type of the kernel [default: that of the scene's setting, else f64]
    #[arg(long, value_enum)]
    scalar: Option<ScalarKind>,
    /// What suits the size; the kernel's projected SOR, with its factor where that does not end or more than 10 000 sweeps
    /// are expected; or the host's active set, on a sparse factorisation of its own (f64) or by multigrid, whose cost
    /// grows with the unknowns alone [default: auto]
    #[arg(long, value_enum)]
    solver: Option<SolverKind>,
    /// Bound on the scaled complementarity residual [default: 1e-13 in f64, the rounding limit in f32]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Most sweeps allowed [default: 1 000 000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    max_sweeps: Option<u32>,
    /// Refine the mesh where the error bound says, until the bound is at most this: 5% is a part of the solution's energy norm,
    /// and 5 alone is an error in the unit of that norm, whatever its size (`energy_norm` in summary.json). (`trade --max-error` is about the true error.) Writes refined.msh, levels.csv and levels.pvd too
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    max_error: Option<Goal>,
    /// Intervals of outputs on every mesh [default: on those of up to 2.5 million unknowns]. Beyond 200 000
    /// unknowns each takes up to three solutions of a linear problem
    #[arg(long)]
    intervals: bool,
    /// No intervals of outputs
    #[arg(long, conflicts_with = "intervals")]
    no_intervals: bool,
    /// Write a picture of the solution: u and the flux, the contact, the outputs
    #[arg(long, value_name = "FILE.svg")]
    draw: Option<PathBuf>,
    /// Of all files summary.json alone
    #[arg(long)]
    no_files: bool,
    /// With --max-error: most unknowns of a refined mesh [default: 1 000 000]
    #[arg(long, value_name = "N", requires = "max_error")]
    max_unknowns: Option<usize>,
}

pub(super) fn tolerance(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(tolerance) if tolerance.is_finite() && tolerance >= 0.0 => Ok(tolerance),
        _ => Err("expected a finite number ≥ 0, such as 1e-9".to_owned()),
    }
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let scene = self.place.scene()?;
        let out = self.place.out()?;
        if let Some(file) = &self.draw {
            check_beside(&scene, "--draw", file)?;
            picture_file(file)?;
        }
        self.check(&scene)?;
        let told = match self.max_error {
            None => self.on_its_mesh(&scene)?,
            Some(goal) => self.refined(&scene, goal, &out)?,
        };
        told.write(&out, !self.no_files)?;
        if self.max_error.is_none() && told.relative_bound() > Some(LARGE) {
            say("  for a smaller error: --max-error 5% refines the mesh where the bound is large");
        }
        if self.max_error.is_none() || self.no_files {
            levels::forget(&out)?;
        }
        say(format_args!("  written to {}", out.display()));
        if let Some(file) = &self.draw {
            write_atomically(file, told.picture()?.as_bytes())?;
            say(format_args!("  {} is written", file.display()));
        }
        // Sweeps that a setting asks for are what was to be done.
        let prescribed =
            self.asked().follows_setting() && scene.setting.is_some_and(|set| set.sweeps.is_some());
        Ok(match told.stop {
            Some(stop) => levels::status(&stop),
            None if told.converged() || (prescribed && !told.broke_down()) => 0,
            None => 3,
        })
    }

    fn on_its_mesh(&self, scene: &Scene) -> Result<Told> {
        let mut problem = problem_of(scene)?;
        problem.warnings.extend(at_rest_warning(scene));
        problem.warnings.extend(self.long_intervals(&problem));
        warn(&problem.warnings);
        let unknowns = problem.topology.counts.unknowns();
        let solution =
            waiting(&format!("solving {unknowns} unknowns"), || self.asked().solve(&problem))?;
        let energy_norm = energy_norm::of_solution(&problem, &solution)?;
        say(format_args!("{}", scene.title));
        let asked = self.solver.unwrap_or_default();
        Told::new(problem, solution, energy_norm, asked, self.intervals(), None)
    }

    fn refined(&self, scene: &Scene, goal: Goal, out: &Path) -> Result<Told> {
        say(format_args!("{}", scene.title));
        let options = self.asked().options(scene.setting.and_then(|setting| setting.scalar));
        let wanted =
            Wanted { goal, most_unknowns: self.max_unknowns.unwrap_or(MOST_UNKNOWNS), options };
        let out = (!self.no_files).then_some(out);
        let (level, stop) = levels::refined(scene, adapted::of_scene(scene)?, &wanted, out)?;
        levels::absolute(goal, level.energy_norm).iter().for_each(say);
        let mut problem = level.problem;
        problem.warnings.extend(at_rest_warning(scene));
        warn(&problem.warnings);
        Told::new(
            problem,
            level.solution,
            level.energy_norm,
            self.solver.unwrap_or_default(),
            self.intervals(),
            Some(stop),
        )
    }

    /// A warning of intervals that take longer than the solution.
    fn long_intervals(&self, problem: &Problem) -> Option<String> {
        let is_long =
            self.intervals && !Coverage::Usual.takes(problem) && !problem.scene.outputs.is_empty();
        is_long.then(|| {
            let unknowns = problem.topology.counts.unknowns();
            format!(
                "--intervals: on {unknowns} unknowns each output takes up to three solutions more"
            )
        })
    }

    /// Whether outputs get intervals.
    fn intervals(&self) -> Coverage {
        match (self.intervals, self.no_intervals) {
            (true, _) => Coverage::All,
            (_, true) => Coverage::None,
            _ => Coverage::Usual,
        }
    }

    /// How the scene is to be solved.
    fn asked(&self) -> SolveRequest {
        let Self { scalar, solver, tolerance, max_sweeps, .. } = *self;
        SolveRequest { scalar, solver, tolerance, max_sweeps, refined: self.max_error.is_some() }
    }

    /// Refuses what cannot be followed at the same time; warns of what the command line takes the place of.
    fn check(&self, scene: &Scene) -> Result<()> {
        let other = match self.solver {
            Some(SolverKind::Direct) => Some("the direct solver"),
            Some(SolverKind::Multigrid) => Some("multigrid"),
            _ => None,
        };
        if let (Some(other), Some(_)) = (other, self.max_sweeps) {
            let message = format!("--max-sweeps: {other} takes no sweeps");
            let hint = "leave it out, or use --solver kernel";
            return Err(InputError::new(message).hint(hint).into());
        }
        let Some(setting) = scene.setting.filter(|_| !self.asked().follows_setting()) else {
            return Ok(());
        };
        let foreign = match (self.scalar, setting.scalar) {
            (None, Some(Precision::Mixed)) => Some("f32+f64 is for the scene's own solver"),
            (None, Some(Precision::F32)) if self.solver == Some(SolverKind::Direct) => {
                Some("this solver works in f64")
            }
            _ => None,
        };
        if let Some(why) = foreign {
            let error = InputError::new(format!("setting.scalar: {why}")).file(scene.file());
            return Err(error.hint("give --scalar, or leave out --solver").into());
        }
        let mut keys = setting.of_method();
        if self.max_error.is_some() && setting.error.is_some() {
            keys.push("error");
        }
        if !keys.is_empty() {
            let keys: Vec<_> = keys.iter().map(|key| format!("setting.{key}")).collect();
            eprintln!("warning: the command line takes the place of {}", keys.join(", "));
        }
        Ok(())
    }
}

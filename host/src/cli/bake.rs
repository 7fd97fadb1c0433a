//! `signorini bake`: a scene as a module of firmware.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::scene_arguments::{promised_problem_of, scene_at};
use super::step_advice::step_advice;
use super::tick_setting::length_of_step;
use super::write_beside;
use super::{bake_c, carried};
use signorini_bake::Bakes;
use signorini_bake::choice::{Choice, Wanted};
use signorini_bake::emit::{Emitted, emit};
use signorini_bake::explain::warnings;
use signorini_bake::setting;
use signorini_files::atomic::writable_file;
use signorini_image::chosen::Chosen;
use signorini_image::library::{MACHINES, Machine};
use signorini_problem::Problem;
use signorini_problem::progress::{note, say, waiting, warn};
use signorini_scene::error::Result;
use signorini_scene::goal::Goal;
use signorini_scene::setting::ModelKind;
use signorini_session::tick::half::trial;
use signorini_solve::ScalarKind;
use signorini_solve::adaptive::Promise;

const EXAMPLES: &str = "\
Examples:
  signorini bake meshes/scenes/levee.toml -o levee.rs --explain
  signorini bake slab.toml -o slab.rs --full --scalar f64
  signorini bake meshes/scenes/levee.toml --c out/levee --board m4

The smallest model that represents the scene exactly and fits its [target] is chosen: \
condensed to contact edges, inputs and outputs, or full. --condensed and --full ask for one, \
and win over the scene's [setting]. A full model is solved by sweeps or by a factor in flash, \
a condensed one by exchanges to the exact solution, where they are proved to end, else by these \
or by sweeps to a tolerance: whichever takes fewer instructions for inputs drawn from their \
ranges. setting.solver asks for one of them: sweeps, factor, exact.

Where a material has a capacity, a tick is a step in time of length time.step, in both models.

With error = \"5%\" in [setting] the mesh is refined first, until the error bound is that small for \
the default inputs, all corners of their ranges and 1000 inputs drawn from them. An error without \
% may be proved for all inputs within their ranges; which it is, is said.

Where inputs declare range = [lo, hi], contact edges that never change sides within these ranges \
are proved to be so, and taken out of a condensed model; --full-edges keeps them. --explain lists \
them along the boundary, with the values that outputs can take. A tick refuses inputs outside.

Where the signs of the condensed matrix allow, the worst tick is proved: exchanges and \
instructions that none exceeds, whatever inputs and state. --explain, --json and constants of the \
module tell it. Where [target] has less time than that there is a warning.

What does not fit is an error: bytes of RAM and flash, and the cycles of the median tick \
tried, counted instructions times 1.4, more than tick times clock. Where the longest takes \
more at 2 cycles an instruction there is a warning, and for a full model that is asked for \
there is no more than that, since a deadline cuts it off. The error bound is never left out \
to make room, but by certificate = false in [setting].

--c builds the controller as a library for C, by cargo: m4 and m7 pass numbers in \
floating-point registers, m4-soft in the others; m33 is a Cortex-M33 with its unit for f32, host this machine. The header says what each \
function does; the example is a program with a timer, a watchdog and a state that outlives a reset:
  cmake -S out/levee/example -B out/levee/build
  cmake --build out/levee/build --target run

In the firmware:
  mod levee;
  static mut CONTROLLER: levee::Controller = levee::Controller::new();

  let controller = unsafe { &mut *&raw mut CONTROLLER }; // once: nothing else may refer to it
  let answer = controller.tick(levee::Inputs { rain: 2.0, river: 0.1 })?;
  let seepage = answer.outputs.seepage;";

/// Arguments of `bake`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
#[command(group = ArgGroup::new("what").required(true).multiple(true).args(["output", "c"]))]
pub struct Arguments {
    /// The scene file (TOML)
    scene: PathBuf,
    /// The Rust file to write
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The folder for the controller in C: NAME.h, libNAME.a, NAMEConfig.cmake and an example
    #[arg(long, value_name = "DIR")]
    c: Option<PathBuf>,
    /// What the library for C is built for [default: m4]; repeatable: each then has a folder of its name in DIR
    #[arg(long, value_name = "BOARD", requires = "c", value_parser = known_machines())]
    board: Vec<String>,
    /// The full model: the scene's mesh solved on the target
    #[arg(long, conflicts_with = "condensed")]
    full: bool,
    /// The condensed model: contact edges, inputs and outputs alone
    #[arg(long)]
    condensed: bool,
    /// Keep all contact edges of a condensed model, those that never change sides too
    #[arg(long)]
    full_edges: bool,
    /// Write what was chosen, for programs: model, scalar, features of the kernel, bytes, instructions, ranges, worst case
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Print which models were considered, what each feature left out saves, and what ranges of inputs prove
    #[arg(long)]
    explain: bool,
    /// Scalar type of the firmware [default: the scene's setting.scalar, else f32]
    #[arg(long, value_enum)]
    scalar: Option<ScalarKind>,
    /// Another length of a step in time than the scene's time.step, in seconds
    #[arg(long, value_name = "DT", value_parser = length_of_step, allow_negative_numbers = true)]
    step: Option<f64>,
    /// Another default of an input; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    input: Vec<String>,
}

/// The words that `--board` knows.
fn known_machines() -> [&'static str; MACHINES.len()] {
    MACHINES.map(|machine| machine.word)
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let mut scene = scene_at(&self.scene, &self.input)?;
        self.step.iter().for_each(|&step| scene.set_step(step));
        for (option, file) in [("-o", &self.output), ("--json", &self.json)] {
            file.as_deref().map_or(Ok(()), |file| writable_file(option, file))?;
        }
        let (problem, promise) = promised_problem_of(&scene)?;
        let promise = promise.as_ref();
        warn(&problem.warnings);
        // The module names where the kernel is, and a library is built from it.
        let sources = carried::sources();
        let emitted = match setting::scalar(&scene, self.scalar)? {
            ScalarKind::F32 => self.module::<f32>(&problem, promise)?,
            ScalarKind::F64 => self.module::<f64>(&problem, promise)?,
        };
        let Emitted { source, chosen } = &emitted;
        step_advice(&problem, &trial(&problem))?.iter().for_each(note);
        if let Some(promise) = promise {
            let proved = chosen.ranges.and_then(|ranges| ranges.largest_error_bound);
            note(&match scene.stores() {
                true => OF_STEPS.to_owned(),
                false => of_the_box(promise.goal, proved),
            });
        }
        if let Some(folder) = &self.c {
            sources?;
            self.machines().try_for_each(|on| match self.board.len() {
                0 | 1 => bake_c::write(&problem, &emitted, on, folder),
                _ => bake_c::write(&problem, &emitted, on, &folder.join(on.word)),
            })?;
        }
        if let Some(file) = &self.output {
            write_beside(&scene, "-o", file, source)?;
            let Chosen { model, scalar, ram_bytes: ram, flash_bytes: flash, .. } = chosen;
            let needs = format!("{ram} bytes of RAM and {flash} of flash");
            let file = file.display();
            note(&format_args!("{file} is written: a {model} model in {scalar}, about {needs}"));
        }
        if let Some(file) = &self.json {
            // Numbers, names and flags: nothing here can fail.
            let chosen = serde_json::to_string_pretty(chosen).unwrap_or_default();
            write_beside(&scene, "--json", file, &(chosen + "\n"))?;
            note(&format_args!("{} is written", file.display()));
        }
        Ok(0)
    }

    /// The machines that libraries for C are built for, each once.
    fn machines(&self) -> impl Iterator<Item = &'static Machine> {
        let is_asked = |machine: &&Machine| match &self.board[..] {
            [] => machine.word == "m4",
            words => words.iter().any(|word| word == machine.word),
        };
        MACHINES.iter().filter(is_asked)
    }

    /// The module; what there is to say of it is said.
    fn module<R: Bakes>(&self, problem: &Problem, promise: Option<&Promise>) -> Result<Emitted> {
        let kind = match (self.full, self.condensed) {
            (true, _) => Some(ModelKind::Full),
            (_, true) => Some(ModelKind::Condensed),
            _ => None,
        };
        let wanted =
            Wanted { model: kind, is_compared: self.explain, has_all_edges: self.full_edges };
        let unknowns = problem.topology.counts.unknowns();
        let (choice, ticked) = waiting(&format!("baking {unknowns} unknowns"), || match promise {
            Some(promise) => R::keep(problem, wanted, promise),
            None => Ok((Choice::<R>::new(problem, wanted)?, 0)),
        })?;
        if let Some(promise) = promise {
            let all = promise.allowed.len();
            if ticked < all && !problem.scene.stores() {
                note(&format!(
                    "the controller's own bound was tried with {ticked} of these {all} inputs"
                ));
            }
            if kind.is_none() && !choice.excluded.is_empty() {
                note(&choice.excluded.join("; "));
            }
        }
        if problem
            .scene
            .target
            .is_some_and(|target| target.tick.is_some() && target.clock.is_none())
        {
            eprintln!("warning: target.tick is no limit without target.clock");
        }
        for warning in warnings(&choice) {
            eprintln!("{warning}");
        }
        if self.explain {
            say(R::explain(problem, &choice));
        }
        Ok(emit(problem, &choice))
    }
}

/// A promised error where ticks are steps in time.
const OF_STEPS: &str =
    "setting.error has made the mesh for the steady state; nothing is promised of steps in time";

/// Whether a promised error holds for all inputs within their ranges, and not only for those tried.
fn of_the_box(goal: Goal, proved: Option<f64>) -> String {
    match (goal, proved) {
        (Goal::Energy(most), Some(proved)) if proved <= most => {
            format!(
                "setting.error is proved for all inputs within their ranges: no solution of the model has an error bound above \
                 {proved:.3e}, what a tick rounds apart"
            )
        }
        (Goal::Energy(_), Some(proved)) => format!(
            "setting.error holds for the inputs tried; for all within their ranges an error bound of {proved:.3e} is proved"
        ),
        (Goal::Energy(_), None) => {
            "setting.error holds for the inputs tried; nothing is proved of others".to_owned()
        }
        (Goal::Part(_), _) => "setting.error holds for the inputs tried: a part of each solution's energy norm is not proved for \
             others, as an error without % may be"
            .to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use signorini_bake::compiled::printed;
    use signorini_scene::mesh::adapted;

    /// What stands in the help below `In the firmware:`, without its margin.
    fn example() -> Vec<&'static str> {
        let (_, lines) = EXAMPLES.split_once("In the firmware:\n").expect("an example");
        lines.lines().map(|line| line.trim_start()).collect()
    }

    #[test]
    fn a_promise_says_for_which_inputs_it_holds() {
        let goal = Goal::Energy(0.01);
        assert!(of_the_box(goal, Some(0.01)).contains("is proved for all inputs within"));
        assert!(of_the_box(goal, Some(0.02)).contains("2.000e-2 is proved"));
        assert!(of_the_box(goal, None).contains("nothing is proved"));
        assert!(of_the_box(Goal::Part(0.05), Some(0.01)).contains("not proved"));
    }

    fn levee() -> String {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes/levee.toml");
        let scene = scene_at(&path, &[]).expect("a scene");
        let mesh = adapted::of_scene(&scene).expect("a mesh");
        let problem = Problem::new(&scene, mesh).expect("a problem");
        let choice = Choice::<f32>::new(&problem, Wanted::model(ModelKind::Condensed));
        emit(&problem, &choice.expect("a choice")).source
    }

    #[test]
    fn the_example_compiles_and_is_the_readme_s() {
        let lines = example();
        let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
        let readme = std::fs::read_to_string(readme).expect("the page");
        assert!(
            readme.contains(&format!("```rust,ignore\n{}\n```", lines.join("\n"))),
            "{lines:?}"
        );
        let (module, rest) = lines.split_first().expect("lines");
        assert_eq!(*module, "mod levee;");
        let program = format!(
            "mod levee {{\n{}}}\nfn run() -> Result<levee::Scalar, signorini_device::Error> {{\n{}\nOk(seepage)\n}}\n\
             fn main() {{ println!(\"{{}}\", run().is_ok_and(|seepage| seepage > 0.0)); }}\n",
            levee(),
            rest.join("\n")
        );
        assert_eq!(printed(&program), "true\n");
    }
}

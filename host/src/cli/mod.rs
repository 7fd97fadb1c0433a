//! The command line.

mod answer;
mod bake;
mod bake_c;
mod carried;
mod check;
mod example;
mod extremes;
mod interruption;
mod levels;
mod look;
mod new;
mod outlined;
mod picture;
mod scene_arguments;
mod series;
mod shell;
mod solve;
mod step_advice;
mod tick;
mod tick_report;
mod tick_setting;
mod trade;

use std::path::{Path, PathBuf};

use clap::{Parser, Subcommand};

use signorini_files::atomic::{writable_file, write_atomically};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::{Scene, schema};

const EXAMPLES: &str = "\
Examples:
  signorini                                         all standard scenes, table and report
  signorini new bar.msh                             a scene for a mesh: bar.toml, to be filled in
  signorini check bar.toml --draw bar.svg           what stands where, and what is wrong with it
  signorini solve meshes/scenes/levee.toml          one scene; files in out/levee
  signorini solve my.toml --scalar f32 --out /tmp/a what a microcontroller would compute
  signorini tick my.toml --budget-sweeps 40         the scene over time, warm-started
  signorini bake my.toml -o my.rs --explain         the scene as the firmware it needs, and why
  signorini trade my.toml --max-error 1%            what accuracy costs, and the setting to take
  signorini extremes                                contrast, scales, shapes: what holds how far

Exit status: 0 done; 1 a check failed or a file could not be written; 2 the input is wrong;
3 the solver stopped before its tolerance (its outputs are written and say so).";

/// Unilateral contact by a mixed finite volume method: scenes, checks, report.
///
/// Without a command it runs the kernel on every standard scene, checks each against an independent
/// reference and the exact solution where there is one, and writes target/report/index.html.
#[derive(Debug, Parser)]
#[command(name = "signorini", version, after_help = EXAMPLES)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Write a scene for a mesh: a table per group, with "?" where somebody has to decide
    New(new::Arguments),
    /// Tell what stands where in a scene and what is wrong with it, without solving it
    Check(check::Arguments),
    /// Solve one scene and write edges.csv, summary.json, solution.vtu and contact.vtu
    Solve(solve::Arguments),
    /// Solve a scene over time, each tick from the last one's answer; write ticks.csv and ticks.svg
    Tick(tick::Arguments),
    /// Write a scene as firmware: a module in Rust, or a library for C, with its data and a controller
    Bake(bake::Arguments),
    /// Measure speed against accuracy: many settings of a scene, and the one to take
    Trade(trade::Arguments),
    /// Push every scale until something gives: a map of what is correct, poor or refused
    Extremes(extremes::Arguments),
    /// Print the JSON Schema of scene files, for editors
    Schema,
    /// Print completions for a shell
    Completions(shell::Arguments),
    /// Print the manual page of signorini or of one command, for `man -l -`
    Man(shell::Page),
}

impl Cli {
    /// Runs the command; returns the exit status.
    ///
    /// # Errors
    /// Wrong input, files that cannot be written, failed checks.
    pub fn run(self) -> Result<u8> {
        match self.command {
            Some(Command::New(arguments)) => arguments.run(),
            Some(Command::Check(arguments)) => arguments.run(),
            Some(Command::Solve(arguments)) => arguments.run(),
            Some(Command::Tick(arguments)) => arguments.run(),
            Some(Command::Bake(arguments)) => arguments.run(),
            Some(Command::Trade(arguments)) => arguments.run(),
            Some(Command::Extremes(arguments)) => arguments.run(),
            Some(Command::Schema) => shell::printed(schema::text().as_bytes()),
            Some(Command::Completions(arguments)) => arguments.run(),
            Some(Command::Man(page)) => page.run(),
            None => signorini_lab::study::run(),
        }
    }
}

/// Writes the file that `option` names, unless it is one that the scene is made of.
fn write_beside(scene: &Scene, option: &str, output: &Path, text: &str) -> Result<()> {
    check_beside(scene, option, output)?;
    write_atomically(output, text.as_bytes())
}

/// Refuses a place where no picture can be written, or which names another format.
fn picture_file(file: &Path) -> Result<()> {
    if file.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("svg")) {
        let message = format!("--draw {}: expected a name that ends with .svg", file.display());
        return Err(InputError::new(message).hint("pictures are SVG; browsers open them").into());
    }
    writable_file("--draw", file)
}

/// Refuses a file to be written, named by `option`, that the scene is made of.
fn check_beside(scene: &Scene, option: &str, output: &Path) -> Result<()> {
    let own = [&scene.path, &scene.mesh.value].into_iter().chain(&scene.fragment);
    let is_own = |place: &PathBuf| {
        own.clone().any(|file| file.canonicalize().is_ok_and(|file| file == *place))
    };
    if output.canonicalize().as_ref().is_ok_and(is_own) {
        let message = format!("{option} {}: the scene is made of this file", output.display());
        return Err(InputError::new(message).hint("name another file to write").into());
    }
    Ok(())
}

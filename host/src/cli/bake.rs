//! `signorini bake`: a scene as a module of firmware.

use std::path::PathBuf;

use clap::Args;

use super::{scene_at, write_beside};
use crate::bake::choice::{Choice, Model};
use crate::bake::condensed;
use crate::bake::explain::{explanation, warning};
use crate::bake::face::Face;
use crate::bake::full;
use crate::bake::setting;
use crate::error::Result;
use crate::mesh::adapted;
use crate::problem::Problem;
use crate::progress::{say, waiting};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::setting::ModelKind;
use crate::solve::ScalarKind;

const EXAMPLES: &str = "\
Examples:
  signorini bake meshes/scenes/levee.toml -o levee.rs --explain
  signorini bake slab.toml -o slab.rs --full --scalar f64

The smallest model that represents the scene exactly and fits its [target] is chosen:
condensed to contact edges, inputs and outputs, or full. --condensed and --full ask for one,
and win over the scene's [setting]; what does not fit is an error. A full model is solved by
sweeps or by a factor in flash, whichever takes fewer instructions and ends; setting.solver
asks for one of them.

In the firmware:
  mod levee;
  static mut CONTROLLER: levee::Controller = levee::Controller::new();";

/// Arguments of `bake`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The scene file (TOML)
    scene: PathBuf,
    /// The Rust file to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The full model: the scene's mesh solved on the target
    #[arg(long, conflicts_with = "condensed")]
    full: bool,
    /// The condensed model: contact edges, inputs and outputs alone
    #[arg(long)]
    condensed: bool,
    /// Print which models were considered and what each feature left out saves
    #[arg(long)]
    explain: bool,
    /// Scalar type of the firmware [default: the scene's setting.scalar, else f32]
    #[arg(long, value_enum)]
    scalar: Option<ScalarKind>,
    /// Another default of an input; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    input: Vec<String>,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let scene = scene_at(&self.scene, &self.input)?;
        let problem = Problem::new(&scene, adapted::of_scene(&scene)?)?;
        let text = match setting::scalar(&scene, self.scalar)? {
            ScalarKind::F32 => self.source::<f32>(&scene, &problem)?,
            ScalarKind::F64 => self.source::<f64>(&scene, &problem)?,
        };
        write_beside(&scene, &self.output, &text)?;
        Ok(0)
    }
}

impl Arguments {
    /// The module; what there is to say of it is said.
    fn source<R: Scalar>(&self, scene: &Scene, problem: &Problem) -> Result<String> {
        let kind = match (self.full, self.condensed) {
            (true, _) => Some(ModelKind::Full),
            (_, true) => Some(ModelKind::Condensed),
            _ => None,
        };
        let unknowns = problem.topology.counts.unknowns();
        let choice = waiting(&format!("baking {unknowns} unknowns"), || {
            Choice::<R>::new(scene, problem, kind, self.explain)
        })?;
        if scene.target.is_some_and(|target| target.tick.is_some() && target.clock.is_none()) {
            eprintln!("warning: target.tick is no limit without target.clock");
        }
        if let Some(warning) = warning(&choice) {
            eprintln!("{warning}");
        }
        if self.explain {
            say(explanation(scene, problem, &choice));
        }
        Ok(match &choice.candidate().model {
            Model::Condensed(baked) => condensed::source(&Face::new(scene, problem), baked),
            Model::Full(baked) => full::source(baked),
        })
    }
}

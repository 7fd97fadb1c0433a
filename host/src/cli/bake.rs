//! `signorini bake`: a scene as a module of firmware.

use std::path::PathBuf;

use clap::Args;

use super::scene_at;
use crate::bake::condensed::{self, Work};
use crate::bake::face::Face;
use crate::bake::full;
use crate::condense::condense;
use crate::error::Result;
use crate::mesh::gmsh;
use crate::output::atomic::write_atomically;
use crate::problem::Problem;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::solve::{ScalarKind, unfit};

const EXAMPLES: &str = "\
Examples:
  signorini bake meshes/scenes/levee.toml -o levee.rs --full
  signorini bake slab.toml -o slab.rs --full --scalar f64

In the firmware: mod levee; then static mut CONTROLLER: levee::Controller = levee::Controller::new();";

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
    /// Scalar type of the firmware
    #[arg(long, value_enum, default_value = "f32")]
    scalar: ScalarKind,
    /// Another default of an input; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    input: Vec<String>,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let scene = scene_at(&self.scene, &self.input)?;
        let problem = Problem::new(&scene, gmsh::read(&scene.mesh.value)?)?;
        let text = match self.scalar {
            ScalarKind::F32 => self.text::<f32>(&scene, &problem)?,
            ScalarKind::F64 => self.text::<f64>(&scene, &problem)?,
        };
        write_atomically(&self.output, text.as_bytes())?;
        Ok(0)
    }
}

impl Arguments {
    fn text<R: Scalar>(&self, scene: &Scene, problem: &Problem) -> Result<String> {
        if self.full {
            return Ok(full::source(&full::Baked::<R>::new(scene, problem)?));
        }
        let condensate = condense(scene, problem)?;
        let work = Work { pivots: Some(condensate.contact as u32), sweeps: 20 };
        let baked =
            condensed::Baked::<R>::new(&condensate, work, true).map_err(unfit::<R>(scene))?;
        Ok(condensed::source(&Face::new(scene, problem)?, &baked))
    }
}

//! `signorini bake`: a scene as a module of firmware.

use std::path::PathBuf;

use clap::Args;

use crate::bake::full::{Baked, source};
use crate::error::Result;
use crate::mesh::gmsh;
use crate::output::atomic::write_atomically;
use crate::problem::Problem;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::solve::ScalarKind;

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
    #[arg(long)]
    full: bool,
    /// Scalar type of the firmware
    #[arg(long, value_enum, default_value = "f32")]
    scalar: ScalarKind,
    /// Another default of an input; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    input: Vec<String>,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let mut scene = Scene::read(&self.scene)?;
        for input in &self.input {
            scene.set_input(input)?;
        }
        let problem = Problem::new(&scene, gmsh::read(&scene.mesh.value)?)?;
        let text = match self.scalar {
            ScalarKind::F32 => full::<f32>(&scene, &problem)?,
            ScalarKind::F64 => full::<f64>(&scene, &problem)?,
        };
        write_atomically(&self.output, text.as_bytes())?;
        Ok(0)
    }
}

fn full<R: Scalar>(scene: &Scene, problem: &Problem) -> Result<String> {
    Ok(source(&Baked::<R>::new(scene, problem)?))
}

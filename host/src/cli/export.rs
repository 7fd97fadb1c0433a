//! `signorini export`: a scene as a `static` for firmware.

use std::path::PathBuf;

use clap::Args;

use super::honoured::Command;
use super::posed::problem_of;
use super::write_beside;
use signorini_bake::export::export;
use signorini_bake::setting;
use signorini_problem::progress::warn;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_scene::scene::term::at_rest_warning;
use signorini_solve::ScalarKind;

const EXAMPLES: &str = "\
Examples:
  signorini export meshes/scenes/levee.toml -o levee.rs
  signorini export slab.toml -o slab.rs --scalar f64

In the firmware: include!(\"levee.rs\"); then MODEL is a signorini_device::model::Model.";

/// Arguments of `export`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The scene file (TOML)
    scene: PathBuf,
    /// The Rust file to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Scalar type of the firmware [default: the scene's setting.scalar, else f32]
    #[arg(long, value_enum)]
    scalar: Option<ScalarKind>,
    /// Set an input of the scene; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    input: Vec<String>,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let mut scene = Scene::read(&self.scene)?;
        for input in &self.input {
            scene.set_input(input)?;
        }
        Command::Export.check(&scene, self.scalar.is_some())?;
        let mut problem = problem_of(&scene)?;
        problem.warnings.extend(at_rest_warning(&scene));
        warn(&problem.warnings);
        let text = match setting::scalar(&scene, self.scalar)? {
            ScalarKind::F32 => export::<f32>(&problem)?,
            ScalarKind::F64 => export::<f64>(&problem)?,
        };
        write_beside(&scene, "-o", &self.output, &text)?;
        Ok(0)
    }
}

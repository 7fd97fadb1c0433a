//! `signorini condense`: the dense contact problem of a scene for other solvers.

use std::path::PathBuf;

use clap::Args;

use super::honoured::Command;
use super::posed::problem_of;
use super::{scene_at, write_beside};
use signorini_bake::choice::reduced;
use signorini_bake::condensed::header;
use signorini_condense::condense;
use signorini_problem::progress::warn;
use signorini_scene::error::Result;

const EXAMPLES: &str = "\
Examples:
  signorini condense tests/firmware/peers/contact-32.toml -o problem.h
  signorini condense meshes/scenes/levee.toml --reduced -o problem.h";

/// Arguments of `condense`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The scene file (TOML)
    scene: PathBuf,
    /// The C header to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Without the contact edges that never change sides while inputs are within their ranges
    #[arg(long)]
    reduced: bool,
    /// Another default of an input; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    input: Vec<String>,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let scene = scene_at(&self.scene, &self.input)?;
        Command::Condense.check(&scene, false)?;
        let problem = problem_of(&scene)?;
        warn(&problem.warnings);
        let model = if self.reduced { reduced(&problem)? } else { condense(&problem)? };
        let text = header(&scene, &model);
        write_beside(&scene, "-o", &self.output, &text)?;
        Ok(0)
    }
}

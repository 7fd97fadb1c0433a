//! `signorini check`: what stands where in a scene, and what is wrong with it, without solving it.

use std::path::{Path, PathBuf};

use clap::Args;

use signorini_draw::plan_file;
use signorini_problem::progress::{say, warn};
use signorini_scene::Faults;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;

use super::look::Look;
use super::{outlined, picture_file, write_beside};

const EXAMPLES: &str = "\
Examples:
  signorini check bar.toml
  signorini check bar.toml --draw bar.svg     with a picture of groups and materials
  signorini check bar.toml --json             for programs: sizes, parts, inputs, outputs, faults

All that is wrong in the file and with its groups on the mesh is told; data are looked at once these are right.
Exit status: 0 the scene can be solved, or stepped from the start that it states; 2 something is wrong.";

/// Arguments of `check`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The scene file (TOML)
    scene: PathBuf,
    /// Write a picture of what stands where
    #[arg(long, value_name = "FILE.svg")]
    draw: Option<PathBuf>,
    /// Print JSON in the place of text
    #[arg(long)]
    json: bool,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        self.draw.as_deref().map_or(Ok(()), picture_file)?;
        let look = match Scene::draft(&self.scene) {
            Ok(draft) => Look::at(draft),
            Err(error) if self.json => {
                say(format_args!("{:#}", outlined::unreadable(error)));
                return Ok(2);
            }
            Err(error) => return Err(error),
        };
        if let Some(file) = &self.draw {
            self.draw(&look, file)?;
        }
        if self.json {
            say(format_args!("{:#}", outlined::json(&look)));
            return Ok(if look.faults.is_empty() { 0 } else { 2 });
        }
        say(outlined::text(&look));
        warn(&look.warnings);
        Faults::from(look.faults).into_result().map(|()| 0)
    }

    fn draw(&self, look: &Look, file: &Path) -> Result<()> {
        let Some((mesh, outline)) = &look.on_mesh else {
            warn(&[format!("{}: without a mesh nothing is drawn", file.display())]);
            return Ok(());
        };
        let plan = outlined::plan(&look.draft.scene, mesh, outline);
        let picture = plan_file(&plan).ok_or_else(|| {
            InputError::new("the vertices span no area to draw").file(&look.draft.scene.mesh.value)
        })?;
        write_beside(&look.draft.scene, "--draw", file, &picture)?;
        if !self.json {
            say(format_args!("{} is written", file.display()));
        }
        Ok(())
    }
}

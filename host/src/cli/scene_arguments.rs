//! Where a command finds its scene and leaves its files.

use std::path::{Path, PathBuf};

use clap::Args;

use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;

/// The scene with what the command line changes in it, and the folder of the files.
#[derive(Debug, Args)]
pub(super) struct SceneArguments {
    /// The scene file (TOML)
    scene: PathBuf,
    /// Another mesh than the scene names (Gmsh MSH 2.2 or 4.1)
    #[arg(long, value_name = "FILE")]
    mesh: Option<PathBuf>,
    /// Set an input of the scene; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    input: Vec<String>,
    /// Where the files go [default: out/SCENE]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl SceneArguments {
    /// Reads the scene and sets mesh and inputs.
    pub fn scene(&self) -> Result<Scene> {
        let mut scene = Scene::read(&self.scene)?;
        if let Some(mesh) = &self.mesh {
            scene.mesh.value.clone_from(mesh);
        }
        for input in &self.input {
            scene.set_input(input)?;
        }
        Ok(scene)
    }

    /// The folder of the files, which need not exist yet.
    pub fn out(&self) -> Result<PathBuf> {
        let default = || Path::new("out").join(self.scene.file_stem().unwrap_or_default());
        let out = self.out.clone().unwrap_or_else(default);
        writable("--out", &out)?;
        Ok(out)
    }
}

/// Refuses a folder for files that is a file, or would lie in one.
///
/// # Errors
/// Such a place.
pub(super) fn writable(option: &str, out: &Path) -> Result<()> {
    if out.ancestors().find(|path| path.exists()).is_some_and(|path| !path.is_dir()) {
        let message = format!("{option} {}: is a file, expected a directory", out.display());
        let hint = "name a directory, or one that does not exist yet";
        return Err(InputError::new(message).hint(hint).into());
    }
    Ok(())
}

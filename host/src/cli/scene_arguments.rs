//! Where a command finds its scene and leaves its files, and the problem that the scene poses.

use std::path::{Path, PathBuf};

use clap::Args;

use signorini_files::atomic::writable;
use signorini_problem::Problem;
use signorini_problem::progress::{note, waiting};
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_solve::adaptive::{MeshOfScene, Promise, mesh_of_scene};

/// The scene with what the command line changes in it, and the folder of the files.
#[derive(Debug, Args)]
pub(super) struct SceneArguments {
    /// The scene file (TOML)
    scene: PathBuf,
    /// Another mesh than the scene names (Gmsh MSH 2.0 to 2.2 or 4.1)
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
        let mut scene = scene_at(&self.scene, &self.input)?;
        if let Some(mesh) = &self.mesh {
            scene.mesh.value.clone_from(mesh);
        }
        Ok(scene)
    }

    /// Sets the inputs that the command line names.
    pub fn set_inputs(&self, scene: &mut Scene) -> Result<()> {
        self.input.iter().try_for_each(|input| scene.set_input(input))
    }

    /// The folder of the files, which need not exist yet.
    pub fn out(&self) -> Result<PathBuf> {
        let default = || Path::new("out").join(self.scene.file_stem().unwrap_or_default());
        let out = self.out.clone().unwrap_or_else(default);
        writable("--out", &out)?;
        Ok(out)
    }
}

/// The problem of a scene on the mesh that its setting asks for; what holds on a refined mesh is said.
pub(super) fn problem_of(scene: &Scene) -> Result<Problem> {
    Ok(promised_problem_of(scene)?.0)
}

/// The problem with what holds, where the setting has an error.
pub(super) fn promised_problem_of(scene: &Scene) -> Result<(Problem, Option<Promise>)> {
    let MeshOfScene { mesh, promise } = waiting("refining the mesh", || mesh_of_scene(scene))?;
    promise.iter().for_each(note);
    Ok((Problem::new(scene, mesh)?, promise))
}

/// The scene with the inputs of the command line.
pub(super) fn scene_at(path: &Path, inputs: &[String]) -> Result<Scene> {
    let mut scene = Scene::read(path)?;
    inputs.iter().try_for_each(|input| scene.set_input(input))?;
    Ok(scene)
}

//! Scenes as `signorini bake` writes them, and the images that hold them.
//!
//! Every module and every program is kept under a name of its own: scene, path, scalar, model and inputs. Commands that
//! run at the same time do not take each other's: of two that bake the same, the second waits until the first has done with
//! its [`Baked`], and programs, which cargo puts under one name whatever their scene, are built and taken away in turns.

use std::fs::File;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use crate::board::{Board, Build};
use crate::cargo::{cargo, root, run as run_cargo, target_dir};
use crate::export::take;
use crate::lock;
use crate::toolchain::output;

const PACKAGE: &str = "signorini-scene";

/// What the baked module says of the kernel's features that it needs.
const FEATURES: &str = "//! Kernel features:";

/// What to bake.
#[derive(Debug, Clone)]
pub struct Recipe {
    /// The scene's file.
    pub scene: PathBuf,
    /// `f32` or `f64`, where one is forced.
    pub scalar: Option<String>,
    /// `--full` or `--condensed`, where one is forced.
    pub model: Option<String>,
    /// `NAME=VALUE`, as they were given.
    pub inputs: Vec<String>,
}

/// Why there is no module, and the exit status for it.
#[derive(Debug)]
pub struct Failure {
    /// For a person.
    pub why: String,
    /// 2 where the scene is wrong: the bake has said how.
    pub status: u8,
}

impl From<String> for Failure {
    fn from(why: String) -> Self {
        Self { why, status: 1 }
    }
}

/// A module.
#[derive(Debug)]
pub struct Baked {
    name: String,
    module: PathBuf,
    /// Nobody else has module and programs of this name meanwhile.
    _turn: File,
    /// Features of the kernel that it needs.
    pub features: Vec<String>,
}

impl Recipe {
    /// A scene of the repository in f32.
    pub fn of(scene: &str, model: &str) -> Self {
        Self {
            scene: root().join(scene),
            scalar: Some("f32".to_owned()),
            model: Some(model.to_owned()),
            inputs: Vec::new(),
        }
    }

    /// The scene's name.
    pub fn scene_name(&self) -> String {
        self.scene.file_stem().unwrap_or_default().display().to_string()
    }

    fn name(&self) -> String {
        let scalar = self.scalar.iter().map(|scalar| format!("_{scalar}"));
        let inputs = self.inputs.iter().map(|input| format!("_{input}"));
        let asked: String = scalar.chain(self.model.clone()).chain(inputs).collect();
        let name = format!("{}-{:08x}{asked}", self.scene_name(), self.place());
        name.replace(['/', '\\'], "_")
    }

    /// A hash of the scene's path: scenes of the same name in different folders are kept apart.
    fn place(&self) -> u32 {
        let path = self.scene.canonicalize().unwrap_or_else(|_| self.scene.clone());
        let mut hash = DefaultHasher::new();
        path.hash(&mut hash);
        hash.finish() as u32
    }

    /// The program that bakes: the one that the environment names, else the checkout's.
    fn command(&self) -> Command {
        if let Some(program) = env::var_os("SIGNORINI") {
            return Command::new(program);
        }
        // The build that tests and exports use, optimised like a release.
        let mut command = cargo(&["run", "--locked", "--package", "signorini"]);
        if !std::io::stderr().is_terminal() {
            command.arg("--quiet");
        }
        command.arg("--manifest-path").arg(root().join("Cargo.toml")).arg("--");
        command
    }

    /// What `bake --explain` says of it.
    pub fn explained(&self) -> Result<String, String> {
        let file = folder()?.join(format!("{}.{}.explained.rs", self.name(), std::process::id()));
        let mut command = self.baking(&file);
        let said = output(command.arg("--explain"));
        let _ = fs::remove_file(&file);
        said
    }

    /// The command that writes the module to `file`.
    fn baking(&self, file: &Path) -> Command {
        let mut command = self.command();
        command.arg("bake").arg(&self.scene).arg("-o").arg(file).args(&self.model);
        if let Some(scalar) = &self.scalar {
            command.args(["--scalar", scalar]);
        }
        for input in &self.inputs {
            command.args(["--input", input]);
        }
        command
    }

    /// Writes the module; the command tells itself what is wrong with a scene.
    pub fn bake(&self) -> Result<Baked, Failure> {
        let folder = folder()?;
        let name = self.name();
        let turn = lock::hold(&folder.join(format!("{name}.lock")))?;
        let fresh = folder.join(format!("{name}.{}.rs", std::process::id()));
        let mut command = self.baking(&fresh);
        // Where this one was called: the scene's path is from there.
        command.current_dir(env::current_dir().map_err(|error| error.to_string())?);
        let status = command.status().map_err(|error| error.to_string())?;
        if !status.success() {
            let _ = fs::remove_file(&fresh);
            let why = format!("signorini bake: {status}");
            return Err(Failure { why, status: if status.code() == Some(2) { 2 } else { 1 } });
        }
        let module = folder.join(format!("{name}.rs"));
        take(&fresh, &module)?;
        let source = fs::read_to_string(&module);
        let source = source.map_err(|error| format!("{}: {error}", module.display()))?;
        Ok(Baked { name, module, _turn: turn, features: features(&source) })
    }
}

impl Baked {
    /// Builds the image of a board, with features of the scene's package beside its kernel's.
    pub fn image(&self, board: &Board, more: &[&str]) -> Result<PathBuf, String> {
        let features = self.of_kernel();
        let features: Vec<&str> =
            features.iter().map(String::as_str).chain(more.iter().copied()).collect();
        // This package reads one scene; the folder of the exported ones is for others.
        let build =
            Build { package: PACKAGE, bins: &["scene"], features: &features, scenes: &self.module };
        let (mut command, folder) = board.build(build)?;
        command.env("SIGNORINI_SCENE", &self.module);
        self.made(command, &folder.join("scene"), board.name)
    }

    /// Builds the program for the desk.
    pub fn desk(&self) -> Result<PathBuf, String> {
        let folder = target_dir("desk");
        let mut command = cargo(&["build", "--release", "--locked", "-p", PACKAGE]);
        command.args(["--bin", "scene_desk", "--target-dir"]).arg(&folder);
        let features = [self.of_kernel(), vec!["desk".to_owned()]].concat();
        command.arg("--features").arg(features.join(","));
        command.env("SIGNORINI_SCENE", &self.module).current_dir(root().join("tests/firmware"));
        self.made(command, &folder.join("release/scene_desk"), "desk")
    }

    fn of_kernel(&self) -> Vec<String> {
        self.features.iter().map(|feature| format!("signorini-kernel/{feature}")).collect()
    }

    /// What `command` puts at `program`: a copy that the next scene's does not replace.
    fn made(&self, command: Command, program: &Path, machine: &str) -> Result<PathBuf, String> {
        let _turn = lock::hold(&program.with_extension("lock"))?;
        run_cargo(command)?;
        let kept = folder()?.join(format!("{}.{machine}", self.name));
        let copied = fs::copy(program, &kept);
        copied.map(|_| kept).map_err(|error| format!("{}: {error}", program.display()))
    }
}

fn folder() -> Result<PathBuf, String> {
    let folder = target_dir("firmware").join("baked");
    let made = fs::create_dir_all(&folder);
    made.map(|()| folder.clone()).map_err(|error| format!("{}: {error}", folder.display()))
}

/// The kernel's features that a module names; none where it names none.
fn features(module: &str) -> Vec<String> {
    let line = module.lines().find_map(|line| line.strip_prefix(FEATURES));
    let names = line.unwrap_or_default().trim_end_matches('.').split(',').map(str::trim);
    names.filter(|name| !matches!(*name, "" | "none")).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_module_names_its_features() {
        let module =
            "//! Levee.\n//!\n//! Kernel features: contact, triangles.\n\npub type Scalar = f32;\n";
        assert_eq!(features(module), ["contact", "triangles"]);
        assert_eq!(features("//! Kernel features: none.\n"), [""; 0]);
        assert_eq!(features("//! Levee.\n"), [""; 0]);
    }

    #[test]
    fn every_recipe_has_a_name_of_its_own() {
        let recipe = Recipe::of("meshes/scenes/levee.toml", "--full");
        let name = recipe.name();
        assert!(name.starts_with("levee-") && name.ends_with("_f32--full"), "{name}");
        let wet = Recipe { inputs: vec!["rain=2".to_owned()], ..recipe.clone() };
        assert_eq!(wet.name(), format!("{name}_rain=2"));
        let free = Recipe { scalar: None, model: None, ..recipe.clone() };
        assert_eq!(Some(free.name()), name.strip_suffix("_f32--full").map(str::to_owned));
        // Called alike, elsewhere.
        let elsewhere = Recipe::of("somewhere/levee.toml", "--full");
        assert_ne!(elsewhere.name(), name);
        let detour = Recipe::of("meshes/../meshes/scenes/levee.toml", "--full");
        assert_eq!(detour.name(), name);
    }
}

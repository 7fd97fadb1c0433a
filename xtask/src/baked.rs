//! A scene to bake, and the module that `signorini bake` makes of it.

use std::env;
use std::fs;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use crate::program::signorini;
use clap::Args;
use signorini_image::cargo::root;
use signorini_image::chosen::Chosen;
use signorini_image::files;
use signorini_image::module::Module;
use signorini_image::once::Once;
use signorini_image::room::NoResult;

/// The modules of this run.
static BAKED: Once<Arc<Module>> = Once::new();

/// A scene to bake, and how.
#[derive(Debug, Clone, Args)]
pub struct Recipe {
    /// The scene's file
    #[arg(value_name = "SCENE.toml")]
    pub scene: PathBuf,
    /// The number format [the scene's setting.scalar, else f32]
    #[arg(long, value_parser = ["f32", "f64"])]
    pub scalar: Option<String>,
    /// Forces the full model, whatever the scene's setting says
    #[arg(long, conflicts_with = "condensed")]
    pub full: bool,
    /// Forces the condensed model, whatever the scene's setting says
    #[arg(long)]
    pub condensed: bool,
    /// The default of an input; repeatable
    #[arg(long = "input", value_name = "NAME=VALUE")]
    pub inputs: Vec<String>,
    /// Another length of a step in time than the scene's
    #[arg(long, value_name = "DT")]
    pub step: Option<String>,
    /// Keeps contact edges that never change sides
    #[arg(long)]
    pub full_edges: bool,
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

impl From<NoResult> for Failure {
    fn from(why: NoResult) -> Self {
        why.to_string().into()
    }
}

impl From<Failure> for String {
    fn from(failure: Failure) -> Self {
        failure.why
    }
}

impl Recipe {
    /// A scene of the repository in f32; the model is `--full` or `--condensed`.
    pub fn of(scene: &str, model: &str) -> Self {
        Self {
            scene: root().join(scene),
            scalar: Some("f32".to_owned()),
            full: model == "--full",
            condensed: model == "--condensed",
            inputs: Vec::new(),
            step: None,
            full_edges: false,
        }
    }

    /// The scene's name.
    pub fn scene_name(&self) -> String {
        self.scene.file_stem().unwrap_or_default().display().to_string()
    }

    /// The option of the model that is forced, if one is.
    pub fn model(&self) -> Option<&'static str> {
        let of_condensed = self.condensed.then_some("--condensed");
        if self.full { Some("--full") } else { of_condensed }
    }

    fn name(&self) -> String {
        let scalar = self.scalar.iter().map(|scalar| format!("_{scalar}"));
        let inputs = self.inputs.iter().map(|input| format!("_{input}"));
        let edges = self.full_edges.then(|| "--full-edges".to_owned());
        let edges = edges.into_iter().chain(self.step.iter().map(|step| format!("_dt{step}")));
        let model = self.model().map(str::to_owned);
        let asked: String = scalar.chain(model).chain(inputs).chain(edges).collect();
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

    /// The command that writes the module to `file`, and what was chosen to `facts`.
    fn baking(&self, file: &Path, facts: &Path) -> Result<Command, String> {
        let mut command = signorini(&["bake"])?;
        command.arg(&self.scene).args(self.model());
        if let Some(scalar) = &self.scalar {
            command.args(["--scalar", scalar]);
        }
        if self.full_edges {
            command.arg("--full-edges");
        }
        if let Some(step) = &self.step {
            command.args(["--step", step]);
        }
        for input in &self.inputs {
            command.args(["--input", input]);
        }
        command.arg("-o").arg(file).arg("--json").arg(facts);
        // Where this one was called: the scene's path is from there.
        command.current_dir(env::current_dir().map_err(|error| error.to_string())?);
        Ok(command)
    }

    /// The module, baked once a run; the command tells itself what is wrong with a scene.
    pub fn bake(&self) -> Result<Arc<Module>, Failure> {
        self.bake_for(&[], Path::new(""))
    }

    /// The module with its controllers for C, for machines by the words of `--board`; nothing is written where it is baked
    /// already.
    pub fn bake_for(&self, words: &[&str], folder: &Path) -> Result<Arc<Module>, Failure> {
        BAKED.get(&self.name(), || {
            let module = Module::new(&self.name(), |file| {
                let facts = file.with_extension("json");
                let mut command = self.baking(file, &facts)?;
                if !words.is_empty() {
                    command.arg("--c").arg(folder);
                }
                command.args(words.iter().flat_map(|word| ["--board", word]));
                let chosen = written(command, &facts);
                let _ = fs::remove_file(&facts);
                chosen
            })?;
            Ok(Arc::new(module))
        })
    }
}

/// The number of modules that this run has baked.
pub fn bakes() -> usize {
    BAKED.count()
}

/// Runs the command; the facts that it has written.
fn written(mut command: Command, facts: &Path) -> Result<Chosen, Failure> {
    let status = command.status().map_err(|error| error.to_string())?;
    if !status.success() {
        let why = format!("signorini bake: {status}");
        return Err(Failure { why, status: if status.code() == Some(2) { 2 } else { 1 } });
    }
    let wrong = |error| format!("{}: {error}", facts.display());
    Ok(serde_json::from_str(&files::text(facts)?).map_err(wrong)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_recipe_has_a_name_of_its_own() {
        let recipe = Recipe::of("meshes/scenes/levee.toml", "--full");
        let name = recipe.name();
        assert!(name.starts_with("levee-") && name.ends_with("_f32--full"), "{name}");
        let wet = Recipe { inputs: vec!["rain=2".to_owned()], ..recipe.clone() };
        assert_eq!(wet.name(), format!("{name}_rain=2"));
        let free = Recipe { scalar: None, full: false, ..recipe.clone() };
        assert_eq!(Some(free.name()), name.strip_suffix("_f32--full").map(str::to_owned));
        // Called alike, elsewhere.
        let elsewhere = Recipe::of("somewhere/levee.toml", "--full");
        assert_ne!(elsewhere.name(), name);
        let detour = Recipe::of("meshes/../meshes/scenes/levee.toml", "--full");
        assert_eq!(detour.name(), name);
    }
}

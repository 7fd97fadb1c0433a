//! A controller for C in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::baked::Recipe;
use signorini_image::cargo::target_dir;
use signorini_image::library::{MACHINES, Machine};

/// What this run has baked: several steps look at the same one.
static BAKED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Header, library, package of CMake, example.
#[derive(Debug, Clone)]
pub struct Package {
    /// What its functions begin with.
    pub name: String,
    /// What it is built for.
    pub machine: Machine,
    /// Where it is.
    pub folder: PathBuf,
}

impl Package {
    /// Bakes it, once.
    pub fn bake(recipe: &Recipe, machine: &Machine) -> Result<Self, String> {
        let name = recipe.scene_name().replace('-', "_");
        let [scalar, model] =
            [&recipe.scalar, &recipe.model].map(|of| of.as_deref().unwrap_or("-"));
        let kind = format!("{name}-{scalar}{model}");
        let folder = folder().join(machine.word).join(kind);
        let baked = || BAKED.lock().unwrap_or_else(PoisonError::into_inner);
        if !baked().contains(&folder) {
            // What is left of another run must not pass for a file of this one.
            let _ = fs::remove_dir_all(&folder);
            recipe.bake_c(machine.word, &folder)?;
            baked().push(folder.clone());
        }
        Ok(Self { name, machine: *machine, folder })
    }

    /// Its library.
    pub fn library(&self) -> PathBuf {
        self.folder.join(format!("lib{}.a", self.name))
    }

    /// What the scene-independent programs are told of it.
    pub fn defines(&self) -> Vec<String> {
        let name = &self.name;
        vec![
            format!("-DSCENE={name}"),
            format!("-DCONSTANTS={}", name.to_uppercase()),
            format!("-I{}", self.folder.display()),
            "-include".to_owned(),
            format!("{name}.h"),
        ]
    }
}

/// Of all that this verb makes.
pub fn folder() -> PathBuf {
    target_dir("firmware").join("c")
}

/// The machine of `--board`.
pub fn machine(word: &str) -> Result<&'static Machine, String> {
    MACHINES.iter().find(|machine| machine.word == word).ok_or(format!("no board `{word}`"))
}

/// Writes a file, and its folder where there is none.
pub fn write(file: &Path, bytes: &[u8]) -> Result<(), String> {
    let made = fs::create_dir_all(file.parent().unwrap_or(Path::new(".")));
    made.and_then(|()| fs::write(file, bytes))
        .map_err(|error| format!("{}: {error}", file.display()))
}

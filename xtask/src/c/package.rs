//! A controller for C in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};

use crate::baked::Recipe;
use signorini_image::cargo::target_dir;
use signorini_image::library::{MACHINES, Machine};

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
    /// Bakes it.
    pub fn bake(recipe: &Recipe, machine: &Machine) -> Result<Self, String> {
        let name = recipe.scene_name().replace('-', "_");
        let kind = format!("{name}-{}", recipe.scalar.as_deref().unwrap_or("f32"));
        let folder = folder().join(machine.word).join(kind);
        // What is left of another bake must not pass for one of this.
        let _ = fs::remove_dir_all(&folder);
        recipe.bake_c(machine.word, &folder)?;
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

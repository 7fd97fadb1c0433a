//! A controller for C in a folder of its own.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use crate::baked::{Failure, Recipe};
use signorini_image::cargo::target_dir;
use signorini_image::files;
use signorini_image::library::{MACHINES, Machine};
use signorini_image::module::Module;

/// Folders that this run has written.
static WRITTEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Header, library, package of CMake, example.
#[derive(Debug, Clone)]
pub struct Package {
    /// The beginning of its functions' names.
    pub name: String,
    /// The machine that it is built for.
    pub machine: Machine,
    /// Its place.
    pub folder: PathBuf,
}

/// Bakes a module with its libraries for these machines, by one command.
pub fn bake(recipe: &Recipe, words: &[&'static str]) -> Result<Arc<Module>, Failure> {
    let folder = folder_of(recipe);
    // What is left of another run must not pass for a file of this one.
    let _ = fs::remove_dir_all(&folder);
    // With more than one each has a folder of its own.
    let place = if let [word] = words { folder.join(word) } else { folder.clone() };
    let module = recipe.bake_for(words, &place)?;
    let written = words.iter().map(|word| folder.join(word));
    WRITTEN.lock().unwrap_or_else(PoisonError::into_inner).extend(written);
    Ok(module)
}

impl Package {
    /// The package that [`bake`] has written.
    pub fn of(recipe: &Recipe, machine: &Machine) -> Result<Self, String> {
        let folder = folder_of(recipe).join(machine.word);
        if !WRITTEN.lock().unwrap_or_else(PoisonError::into_inner).contains(&folder) {
            return Err(format!("{} was not baked for {}", recipe.scene_name(), machine.word));
        }
        Ok(Self { name: name_of(recipe), machine: *machine, folder })
    }

    /// Its library.
    pub fn library(&self) -> PathBuf {
        self.folder.join(format!("lib{}.a", self.name))
    }

    /// Definitions for the programs that know no scene.
    ///
    /// # Errors
    /// A header that cannot be read.
    pub fn defines(&self) -> Result<Vec<String>, String> {
        let name = &self.name;
        let header = files::text(&self.folder.join(format!("{name}.h")))?;
        let step = format!("#define {}_STEP ", name.to_uppercase());
        let in_time = header.contains(&step).then(|| "-DIN_TIME".to_owned());
        let mut defines = vec![
            format!("-DSCENE={name}"),
            format!("-DCONSTANTS={}", name.to_uppercase()),
            format!("-I{}", self.folder.display()),
            "-include".to_owned(),
            format!("{name}.h"),
        ];
        defines.extend(in_time);
        Ok(defines)
    }
}

fn name_of(recipe: &Recipe) -> String {
    recipe.scene_name().replace('-', "_")
}

fn folder_of(recipe: &Recipe) -> PathBuf {
    let [scalar, model] = [recipe.scalar.as_deref(), recipe.model()].map(|of| of.unwrap_or("-"));
    folder().join(format!("{}-{scalar}{model}", name_of(recipe)))
}

/// The folder of all that this verb makes.
pub fn folder() -> PathBuf {
    target_dir("firmware").join("c")
}

/// The machine of `--board`.
pub fn machine(word: &str) -> Result<&'static Machine, String> {
    MACHINES.iter().find(|machine| machine.word == word).ok_or(format!("no board `{word}`"))
}

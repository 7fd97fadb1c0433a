//! The checkout of the sources, for what works on it: standard scenes and their records, boards, OSQP.

use std::path::{Path, PathBuf};

use signorini_image::checkout::find;
use signorini_scene::{Error, InputError, Result, Scene};

/// The root of the checkout.
///
/// # Errors
/// There is none: where it was looked for, and what is missing there.
pub fn root() -> Result<&'static Path> {
    find().map_err(|why| {
        let hint =
            "run this command inside of one: it has the standard scenes and what images for boards are built from. \
             For a mesh of yours begin with `signorini new MESH`";
        InputError::new(why).hint(hint).into()
    })
}

/// The scene files below `folder` whose materials store nothing, in the order of their names: all studies are of steady states.
pub fn scenes(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).map_err(Error::io(&folder))? {
            let path = entry.map_err(Error::io(&folder))?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                // One that cannot be read is told of where it is.
                let stores = Scene::read(&path).is_ok_and(|scene| scene.stores());
                found.extend((!stores).then_some(path));
            }
        }
    }
    if found.is_empty() {
        let message = format!("{}: no scene found", folder.display());
        return Err(InputError::new(message).hint("run from a complete checkout").into());
    }
    found.sort();
    Ok(found)
}

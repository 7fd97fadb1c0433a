//! A setting as a file: what `solve`, `bake` and `cargo xtask firmware` take in place of the scene.

use std::path::Path;

use serde::Serialize;

use signorini_files::atomic::write_atomically;
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::Setting;

#[derive(Serialize)]
struct Fragment<'a> {
    extends: String,
    setting: &'a Setting,
}

/// Writes the fragment of `scene` with `setting` to `file`; `why` stands above it.
///
/// # Errors
/// A file that cannot be written.
pub fn write(file: &Path, scene: &Scene, setting: &Setting, why: &str) -> Result<()> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    let whole = |path: &Path| path.canonicalize().map_err(Error::io(path));
    let (scene, folder) = (whole(&scene.path)?, whole(folder)?);
    let way = pathdiff::diff_paths(&scene, &folder).unwrap_or(scene);
    let fragment = Fragment { extends: way.to_string_lossy().replace('\\', "/"), setting };
    let text = toml::to_string(&fragment).map_err(|error| Error::Check(error.to_string()))?;
    let comment: String = why.lines().map(|line| format!("# {line}\n")).collect();
    write_atomically(file, (comment + &text).as_bytes())
}

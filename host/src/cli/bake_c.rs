//! `signorini bake --c`: the files of a controller for C.

use std::fs;
use std::path::{Path, PathBuf};

use signorini_bake::c::{File, files, name_of};
use signorini_bake::emit::Emitted;
use signorini_files::atomic::{writable, write_atomically};
use signorini_image::checkout;
use signorini_image::library::Machine;
use signorini_problem::Problem;
use signorini_problem::progress::{note, waiting};
use signorini_scene::error::{Error, InputError, Result};

/// Builds them, then writes them all; an example that somebody has changed stays.
pub(super) fn write(
    problem: &Problem,
    emitted: &Emitted,
    on: &Machine,
    folder: &Path,
) -> Result<()> {
    let failed = |why: String| Error::Check(format!("no library for {}: {why}", on.word));
    checkout::find()
        .map_err(|why| failed(format!("it is built from the sources, and there is {why}")))?;
    writable("--c", folder)?;
    let name = name_of(problem);
    let built =
        waiting(&format!("building lib{name}.a for {}", on.word), || files(problem, emitted, on));
    let all = built.map_err(failed)?;
    // Before the first is written: header and library belong together.
    all.iter().try_for_each(|file| free(&folder.join(&file.path)))?;
    let mut kept = Vec::new();
    for File { path, bytes } in &all {
        let place = folder.join(path);
        match fs::read(&place) {
            Ok(own) if path.starts_with("example/") && own != *bytes => kept.push(place),
            _ => write_atomically(&place, bytes)?,
        }
    }
    told(&name, folder, &kept);
    Ok(())
}

/// Refuses a place where no file can be.
fn free(place: &Path) -> Result<()> {
    writable("--c", place.parent().unwrap_or(Path::new(".")))?;
    if place.is_dir() {
        let message = format!("--c: {} is a directory, expected a file", place.display());
        return Err(InputError::new(message).hint("remove it, or name another directory").into());
    }
    Ok(())
}

/// What is there now, and how to run it.
fn told(name: &str, folder: &Path, kept: &[PathBuf]) {
    let place = folder.display();
    note(&format!("{place}/{name}.h and lib{name}.a are written"));
    if !kept.is_empty() {
        let files: Vec<_> = kept.iter().map(|file| file.display().to_string()).collect();
        let files = files.join(", ");
        note(&format!("kept as they are, since they differ from what bake writes: {files}"));
        note(&format!("remove {place}/example for a new one"));
    }
    note(&"to run the example:");
    note(&format!("  cmake -S \"{place}/example\" -B \"{place}/build\""));
    note(&format!("  cmake --build \"{place}/build\" --target run"));
}

//! `signorini bake --c`: the files of a controller for C.

use std::path::Path;

use signorini_bake::c::{File, files, name_of};
use signorini_bake::emit::Emitted;
use signorini_image::checkout;
use signorini_image::library::Machine;
use signorini_scene::error::{Error, Result};
use signorini_solve::output::atomic::write_atomically;
use signorini_solve::problem::Problem;
use signorini_solve::progress::{note, waiting};

/// Builds them, then writes them all.
pub(super) fn write(
    problem: &Problem,
    emitted: &Emitted,
    on: &Machine,
    folder: &Path,
) -> Result<()> {
    let failed = |why: String| Error::Check(format!("no library for {}: {why}", on.word));
    checkout::find()
        .map_err(|why| failed(format!("it is built from the sources, and there is {why}")))?;
    let name = name_of(problem);
    let built =
        waiting(&format!("building lib{name}.a for {}", on.word), || files(problem, emitted, on));
    for File { path, bytes } in &built.map_err(failed)? {
        write_atomically(&folder.join(path), bytes)?;
    }
    let place = folder.display();
    note(&format!("{place}/{name}.h and lib{name}.a are written; to run the example:"));
    note(&format!("  cmake -S {place}/example -B {place}/build"));
    note(&format!("  cmake --build {place}/build --target run"));
    Ok(())
}

//! `signorini bake --c`: the files of a controller for C.

use std::fs;
use std::path::{Path, PathBuf};

use super::example::Written;
use signorini_bake::c::{File, files, name_of};
use signorini_bake::emit::Emitted;
use signorini_files::atomic::{writable, writable_file, write_atomically};
use signorini_image::library::Machine;
use signorini_image::tools::answer;
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
    answer(&["cargo"]).map_err(|why| {
        InputError::new(format!("--c builds a library by cargo: {why}"))
            .hint("install Rust's toolchain: https://rustup.rs")
    })?;
    writable("--c", folder)?;
    let name = name_of(problem);
    let built =
        waiting(&format!("building lib{name}.a for {}", on.word), || files(problem, emitted, on));
    let all = built.map_err(failed)?;
    let kept = put(&all, folder)?;
    told(&name, folder, &kept);
    Ok(())
}

/// Puts files into a folder; those of the example that stay, since somebody has changed them.
fn put(all: &[File], folder: &Path) -> Result<Vec<PathBuf>> {
    // Before the first is written: header and library belong together.
    all.iter().try_for_each(|file| free(&folder.join(&file.path)))?;
    let (mut kept, mut written) = (Vec::new(), Written::into(folder));
    for File { path, bytes } in all {
        let (place, is_example) = (folder.join(path), path.starts_with("example/"));
        match fs::read(&place) {
            Ok(own) if is_example && !written.may_be_replaced(path, &own, bytes) => {
                kept.push(place)
            }
            _ => {
                write_atomically(&place, bytes)?;
                if is_example {
                    written.note(path, bytes);
                }
            }
        }
    }
    written.keep(folder)?;
    Ok(kept)
}

/// Refuses a place where no file can be.
fn free(place: &Path) -> Result<()> {
    writable_file("--c", place)
}

/// What is there now, and how to run it.
fn told(name: &str, folder: &Path, kept: &[PathBuf]) {
    let place = folder.display();
    note(&format!("{place}/{name}.h and lib{name}.a are written"));
    if !kept.is_empty() {
        let files: Vec<_> = kept.iter().map(|file| file.display().to_string()).collect();
        let files = files.join(", ");
        note(&format!("kept as they are, since somebody has changed them: {files}"));
        note(&format!("remove {place}/example for a new one"));
    }
    note(&"to run the example:");
    note(&format!("  cmake -S \"{place}/example\" -B \"{place}/build\""));
    note(&format!("  cmake --build \"{place}/build\" --target run"));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn baked(input: &str) -> [File; 3] {
        [("plate.h", input), ("example/main.c", input), ("example/board.c", "the board")]
            .map(|(path, text)| File { path: path.to_owned(), bytes: text.as_bytes().to_vec() })
    }

    /// An input has another name: header and example follow, but for what somebody has made of the example.
    #[test]
    fn an_example_that_nobody_has_changed_is_written_anew() {
        let folder = tempfile::tempdir().expect("a folder");
        let (folder, text) = (folder.path(), |path: &str| {
            fs::read_to_string(folder.path().join(path)).expect("a file")
        });
        assert!(put(&baked("push"), folder).expect("files").is_empty());
        assert!(put(&baked("load"), folder).expect("files").is_empty());
        assert_eq!([text("plate.h"), text("example/main.c")], ["load"; 2]);
        fs::write(folder.join("example/main.c"), "load, and mine").expect("a file");
        for input in ["heat", "rain"] {
            assert_eq!(put(&baked(input), folder).expect("files"), [folder.join("example/main.c")]);
            assert_eq!(text("plate.h"), input);
        }
        assert_eq!(text("example/main.c"), "load, and mine");
        // An example of before there was a record, which may be anybody's.
        fs::remove_file(folder.join("example/.baked")).expect("the record");
        fs::write(folder.join("example/board.c"), "another board").expect("a file");
        assert_eq!(put(&baked("rain"), folder).expect("files").len(), 2);
    }
}

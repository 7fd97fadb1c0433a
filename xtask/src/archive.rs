//! `cargo xtask archive`: the program, its pages and the standard scenes as one file for machines of this kind, in `target/dist`.
//!
//! ```text
//!   signorini-VERSION-TRIPLE.tar.gz (Windows: .zip) ─► unpacked ─► it solves a scene out of there
//! ```

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::program;
use crate::steps::Steps;
use signorini_image::cargo::{root, target_dir};
use signorini_image::files;
use signorini_image::toolchain::{host, output};

/// Files and folders of the checkout that go with the program. Links of pages to its sources lead nowhere from there.
const BESIDE: [&str; 10] = [
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "LICENSE",
    "CITATION.cff",
    ".github/levee.png",
    "docs",
    "meshes",
];
/// A scene that is solved in less than a second.
const SCENE: &str = "meshes/scenes/levee.toml";

/// The verb.
pub fn run(steps: &mut Steps) {
    steps.compile("the program signorini", || program::path().map(drop));
    let name = format!("signorini-{}", env!("CARGO_PKG_VERSION"));
    steps.check("the archive", || {
        let archive = packed(&format!("{name}-{}", host()?))?;
        tried(&archive)?;
        println!("{}", archive.display());
        Ok(())
    });
}

/// The archive whose files are all in a folder `name`.
fn packed(name: &str) -> Result<PathBuf, String> {
    let dist = target_dir("dist");
    let folder = files::emptied(&dist.join(name))?;
    let program = program::path()?;
    copy(&program, &folder.join("signorini").with_extension(env::consts::EXE_EXTENSION))?;
    for part in BESIDE {
        for file in files::below(&root().join(part), &["__pycache__"])? {
            let place = file.strip_prefix(root()).map_err(|error| error.to_string())?;
            copy(&file, &folder.join(place))?;
        }
    }
    let archive = format!("{name}.{}", if cfg!(windows) { "zip" } else { "tar.gz" });
    output(tar().args(["-acf", &archive, name]).current_dir(&dist))?;
    remove(&folder)?;
    Ok(dist.join(archive))
}

/// `Ok` where the program solves a scene out of the archive.
fn tried(archive: &Path) -> Result<(), String> {
    let apart = files::emptied(&target_dir("dist").join("unpacked"))?;
    output(tar().arg("-xf").arg(archive).current_dir(&apart))?;
    let unpacked = files::within(&apart)?;
    let [folder] = &unpacked[..] else { return Err(format!("{} folders", unpacked.len())) };
    let program = folder.join("signorini").with_extension(env::consts::EXE_EXTENSION);
    output(Command::new(program).args(["solve", SCENE, "--no-files"]).current_dir(folder))?;
    files::text(&folder.join("out/levee/summary.json"))?;
    remove(&apart)
}

/// The system's tar. That of Windows writes zip; Git brings another one along, which does not.
fn tar() -> Command {
    match env::var_os("SystemRoot") {
        Some(windows) if cfg!(windows) => {
            Command::new(Path::new(&windows).join("System32/tar.exe"))
        }
        _ => Command::new("tar"),
    }
}

fn remove(folder: &Path) -> Result<(), String> {
    fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

fn copy(file: &Path, place: &Path) -> Result<(), String> {
    files::folder(place.parent().unwrap_or(Path::new(".")))?;
    fs::copy(file, place).map(drop).map_err(|error| format!("{}: {error}", file.display()))
}

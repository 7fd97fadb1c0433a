//! `signorini new`: a scene for a mesh that has none yet.

use std::path::{Path, PathBuf};

use clap::Args;

use pathdiff::diff_paths;
use signorini_files::atomic::{writable_file, write_atomically};
use signorini_problem::progress::{say, warn};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::mesh;
use signorini_scene::scene::{blank, schema};

use super::shell::printed;

const EXAMPLES: &str = "\
Examples:
  signorini new bar.msh             writes bar.toml beside it, with \"?\" where you decide
  signorini new bar.msh --out -     the same on standard output
  signorini check bar.toml          what is still to be filled in

Beside the scene it writes signorini.schema.json, where there is none: with it an editor completes keys.";

/// Arguments of `new`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The mesh (Gmsh MSH 2.0 to 2.2 or 4.1)
    mesh: PathBuf,
    /// The scene to write, - for standard output [default: the mesh's name with .toml]
    #[arg(long, value_name = "SCENE")]
    out: Option<PathBuf>,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let to_output = self.out.as_deref() == Some(Path::new("-"));
        let scene = self.out.clone().unwrap_or_else(|| self.mesh.with_extension("toml"));
        if !to_output && !self.mesh.is_dir() {
            check_free(&scene)?;
        }
        let mesh = mesh::read(&self.mesh)?;
        let title = self.mesh.file_stem().unwrap_or_default().to_string_lossy();
        let folder =
            if to_output { Path::new("") } else { scene.parent().unwrap_or(Path::new("")) };
        std::fs::create_dir_all(Path::new(".").join(folder)).map_err(Error::io(folder))?;
        let text = blank(&mesh, &title, &seen_from(folder, &self.mesh)?);
        if to_output {
            return printed(text.as_bytes());
        }
        write_atomically(&scene, text.as_bytes())?;
        say(format_args!("{} is written", scene.display()));
        write_schema(&folder.join(schema::FILE));
        let (place, picture) = (scene.display(), scene.with_extension("svg"));
        say("fill in each \"?\"; what is left, and where each group lies:");
        say(format_args!("  signorini check '{place}' --draw '{}'", picture.display()));
        Ok(0)
    }
}

/// Refuses a scene that is there already.
fn check_free(scene: &Path) -> Result<()> {
    writable_file("--out", scene)?;
    if scene.symlink_metadata().is_err() {
        return Ok(());
    }
    let error = InputError::new("is there already, and is left as it is").file(scene);
    Err(error.hint("name another file with --out, or print it with --out -").into())
}

/// The schema for editors, where there is none; where it cannot be written, that is a warning.
fn write_schema(file: &Path) {
    let text = schema::text();
    let left =
        |why: &str| warn(&[format!("{}: {why}; `signorini schema` prints it", file.display())]);
    match std::fs::read_to_string(file) {
        Ok(own) if own == text => {}
        Ok(_) => left("is of another version, and is left as it is"),
        Err(_) => match write_atomically(file, text.as_bytes()) {
            Ok(()) => {
                say(format_args!("{} is written: editors complete keys with it", file.display()))
            }
            Err(error) => left(&error.reason()),
        },
    }
}

/// The path of the mesh as a scene in `folder` has to name it; both folders are there, and links are followed.
fn seen_from(folder: &Path, mesh: &Path) -> Result<String> {
    let real = |path: &Path| Path::new(".").join(path).canonicalize().ok();
    let name = mesh.file_name().unwrap_or_default();
    let home = mesh.parent().and_then(real);
    let relative = match mesh.is_absolute() && !folder.is_absolute() {
        true => None,
        false => {
            home.zip(real(folder)).and_then(|(home, folder)| diff_paths(home.join(name), folder))
        }
    };
    let path = relative.unwrap_or_else(|| mesh.to_owned());
    let text = path.to_str().map(|path| path.replace('\\', "/"));
    text.ok_or_else(|| InputError::new("its name is no text in UTF-8").file(mesh).into())
}

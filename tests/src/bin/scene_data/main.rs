//! Data of scenes for tests of firmware: `cargo xtask boards` and `cargo xtask peers` call it.
//!
//! ```text
//!   scene_data model SCENE f32|f64 FILE             a `static` of the kernel's Model, for its stages one by one
//!   scene_data contact SCENE FILE [--reduced]       the dense contact problem as a C header, for other solvers
//! ```

mod contact;
mod model;

use std::path::Path;
use std::process::ExitCode;

use signorini_bake::choice::reduced;
use signorini_condense::condense;
use signorini_files::atomic::write_atomically;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_solve::adaptive::mesh_of_scene;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let written = match words[..] {
        ["model", scene, scalar, file] => write_model(scene, scalar, file),
        ["contact", scene, file] => write_contact(scene, file, false),
        ["contact", scene, file, "--reduced"] => write_contact(scene, file, true),
        _ => {
            eprintln!(
                "usage: scene_data model SCENE f32|f64 FILE, scene_data contact SCENE FILE [--reduced]"
            );
            return ExitCode::from(2);
        }
    };
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn problem_of(scene: &Scene) -> Result<Problem> {
    Problem::new(scene, mesh_of_scene(scene)?.mesh)
}

fn write_model(scene: &str, scalar: &str, file: &str) -> Result<()> {
    let problem = problem_of(&Scene::read(Path::new(scene))?)?;
    let text = match scalar {
        "f64" => model::source_of::<f64>(&problem)?,
        _ => model::source_of::<f32>(&problem)?,
    };
    write_atomically(Path::new(file), text.as_bytes())
}

fn write_contact(scene: &str, file: &str, is_reduced: bool) -> Result<()> {
    let scene = Scene::read(Path::new(scene))?;
    let problem = problem_of(&scene)?;
    let model = if is_reduced { reduced(&problem)? } else { condense(&problem)? };
    write_atomically(Path::new(file), contact::header(&scene, &model).as_bytes())
}

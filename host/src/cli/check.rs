//! `signorini check`: what stands where in a scene, and all that is wrong with it, without solving it.

use std::path::{Path, PathBuf};

use clap::Args;

use signorini_draw::plan_file;
use signorini_files::atomic::writable_file;
use signorini_problem::cell::Cell;
use signorini_problem::functional::Functional;
use signorini_problem::outline::Outline;
use signorini_problem::pointwise::{POINTS, exact_at_all};
use signorini_problem::progress::{say, warn};
use signorini_problem::quadrature::gauss;
use signorini_problem::{Parts, Problem, check_groups};
use signorini_scene::Faults;
use signorini_scene::error::{InputError, Result};
use signorini_scene::mesh::{Mesh, adapted};
use signorini_scene::scene::term::at_rest_warning;
use signorini_scene::scene::{Draft, Scene};
use signorini_scene::setting::{Precision, Setting};
use signorini_session::with_session;
use signorini_solve::units;

use super::{outlined, write_beside};

const EXAMPLES: &str = "\
Examples:
  signorini check bar.toml
  signorini check bar.toml --draw bar.svg     with a picture of groups and materials
  signorini check bar.toml --json             for programs: sizes, parts, inputs, outputs, faults

All that is wrong in the file and with its groups on the mesh is told; data are looked at once these are right.
Exit status: 0 the scene can be solved; 2 something is wrong.";

/// Arguments of `check`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The scene file (TOML)
    scene: PathBuf,
    /// Write a picture of what stands where
    #[arg(long, value_name = "FILE.svg")]
    draw: Option<PathBuf>,
    /// Print JSON in the place of text
    #[arg(long)]
    json: bool,
}

/// What a look at a scene finds.
pub(super) struct Look {
    pub draft: Draft,
    /// The mesh with what stands on it, where it could be read.
    pub on_mesh: Option<(Mesh, Outline)>,
    pub warnings: Vec<String>,
    pub faults: Vec<InputError>,
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        self.draw.as_ref().map_or(Ok(()), |file| writable_file("--draw", file))?;
        let look = match Scene::draft(&self.scene) {
            Ok(draft) => Look::at(draft),
            Err(error) if self.json => {
                say(format_args!("{:#}", outlined::unreadable(error)));
                return Ok(2);
            }
            Err(error) => return Err(error),
        };
        if let Some(file) = &self.draw {
            self.draw(&look, file)?;
        }
        if self.json {
            say(format_args!("{:#}", outlined::json(&look)));
            return Ok(if look.faults.is_empty() { 0 } else { 2 });
        }
        say(outlined::text(&look));
        warn(&look.warnings);
        let faults = Faults::default();
        look.faults.into_iter().for_each(|fault| faults.note(fault));
        faults.into_result().map(|()| 0)
    }

    fn draw(&self, look: &Look, file: &Path) -> Result<()> {
        let Some((mesh, outline)) = &look.on_mesh else {
            warn(&[format!("{}: without a mesh nothing is drawn", file.display())]);
            return Ok(());
        };
        let plan = outlined::plan(&look.draft.scene, mesh, outline);
        let picture = plan_file(&plan).ok_or_else(|| {
            InputError::new("the vertices span no area to draw").file(&look.draft.scene.mesh.value)
        })?;
        write_beside(&look.draft.scene, "--draw", file, &picture)?;
        if !self.json {
            say(format_args!("{} is written", file.display()));
        }
        Ok(())
    }
}

/// What a solution would ask of a sound problem: places of outputs, the exact solution, what the setting says.
fn posed(problem: &Problem, faults: &Faults) {
    for output in &problem.scene.outputs {
        faults.keep(Functional::of(problem, output));
    }
    if let Some(exact) = &problem.scene.exact {
        let cells = (0..problem.cells()).map(|at| Cell::of(problem, at));
        let rule = gauss(POINTS);
        let points = cells.flat_map(|cell| cell.points(&rule));
        faults.keep(exact_at_all(&problem.scene, exact, &points.collect::<Vec<_>>(), problem.time));
    }
    faults.keep(units::choose(problem));
    let is_followed = |setting: &Setting| {
        setting.scalar == Some(Precision::Mixed) || !setting.of_method().is_empty()
    };
    if problem.scene.setting.as_ref().is_some_and(is_followed) {
        faults.keep(with_session(problem, |_| Ok(())));
    }
}

impl Look {
    /// Looks at a scene: at its groups where its text has faults, else at all of its data.
    fn at(mut draft: Draft) -> Self {
        let faults = Faults::default();
        std::mem::take(&mut draft.faults).into_iter().for_each(|fault| faults.note(fault));
        let is_sound = faults.count() == 0;
        let has_mesh = !draft.open.iter().any(|key| key == "mesh");
        let mesh = has_mesh.then(|| faults.keep(adapted::of_scene(&draft.scene))).flatten();
        let mut warnings: Vec<String> = at_rest_warning(&draft.scene).into_iter().collect();
        let on_mesh = mesh.map(|mesh| {
            let mut outline = Outline::of_draft(&draft, &mesh);
            if !is_sound {
                faults.keep(check_groups(&draft.scene, &mesh));
            } else if let Some(problem) = faults.keep(Problem::new(&draft.scene, mesh.clone())) {
                warnings.extend(problem.warnings.iter().cloned());
                if let Some(parts) = faults.keep(Parts::examine(&problem)) {
                    outline = outline.with_parts(&problem, &parts);
                    posed(&problem, &faults);
                }
            }
            (mesh, outline)
        });
        let mut faults = faults.into_vec();
        faults.sort_by_key(|fault| fault.place().1.unwrap_or(usize::MAX));
        Self { draft, on_mesh, warnings, faults }
    }
}

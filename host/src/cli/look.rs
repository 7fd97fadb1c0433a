//! A look at a scene: what stands where, and what is wrong with it, without a solution.

use signorini_problem::cell::Cell;
use signorini_problem::functional::Functional;
use signorini_problem::outline::Outline;
use signorini_problem::pointwise::{POINTS, exact_at_all};
use signorini_problem::quadrature::gauss;
use signorini_problem::{Parts, Problem, check_groups};
use signorini_scene::Faults;
use signorini_scene::error::InputError;
use signorini_scene::mesh::{Mesh, adapted};
use signorini_scene::scene::term::at_rest_warning;
use signorini_scene::scene::{Draft, Scene};
use signorini_scene::setting::{Precision, Setting};
use signorini_session::tick::columns::check_names;
use signorini_session::with_session;
use signorini_solve::{check_stated, units};

/// What a look at a scene finds.
pub(super) struct Look {
    pub draft: Draft,
    /// The mesh with what stands on it, where it could be read.
    pub on_mesh: Option<(Mesh, Outline)>,
    pub warnings: Vec<String>,
    pub faults: Vec<InputError>,
}

impl Look {
    /// Looks at a scene: at its groups where its text has faults, else at all of its data.
    pub fn at(mut draft: Draft) -> Self {
        let faults = Faults::from(std::mem::take(&mut draft.faults));
        let is_sound = faults.count() == 0;
        let has_mesh = !draft.open.iter().any(|key| key == "mesh");
        let mesh = has_mesh.then(|| faults.keep(adapted::of_scene(&draft.scene))).flatten();
        let mut warnings: Vec<String> = at_rest_warning(&draft.scene).into_iter().collect();
        if let Err(error) = check_names(&draft.scene) {
            warnings.push(format!("`signorini tick` refuses an output's name: {}", error.reason()));
        }
        let on_mesh = mesh.map(|mesh| {
            let mut outline = Outline::of_draft(&draft, &mesh);
            if !is_sound {
                faults.keep(check_groups(&draft.scene, &mesh));
            } else if let Some(problem) = faults.keep(Problem::new(&draft.scene, mesh.clone())) {
                warnings.extend(problem.warnings.iter().cloned());
                match Parts::examine(&problem) {
                    Ok(parts) => outline = outline.with_parts(&problem, &parts),
                    // Steps in time need no steady state where a start is stated.
                    Err(error) if begins_from_stated(&problem.scene) => warnings.push(format!(
                        "at rest there is no answer, `signorini tick` steps from time.initial: {}",
                        error.reason()
                    )),
                    Err(error) => faults.add(error),
                }
                if faults.count() == 0 {
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

fn begins_from_stated(scene: &Scene) -> bool {
    scene.stores() && scene.time.as_ref().is_some_and(|time| time.initial.is_some())
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
    faults.keep(check_stated(problem));
    faults.keep(units::choose(problem));
    let is_followed = |setting: &Setting| {
        setting.scalar == Some(Precision::Mixed) || !setting.of_method().is_empty()
    };
    if problem.scene.setting.as_ref().is_some_and(is_followed) {
        faults.keep(with_session(problem, |_| Ok(())));
    }
}

//! Every standard scene stands on its mesh refined, paired and cut, and the errors are the catalogue's.

use signorini_tolerances::solve::CATALOGUE;

use super::{meshes, standard_scenes};
use crate::norms::of_solution;
use crate::{Options, solve};
use signorini_problem::Problem;
use signorini_scene::mesh::adapted::{adapted, of_scene};
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{CellKind, Setting};

#[test]
fn every_standard_scene_takes_every_setting_of_the_mesh() {
    let mut count = 0;
    for path in standard_scenes() {
        let mut scene = Scene::read(&path).expect("a scene");
        for (cells, refine) in
            [(None, 1), (Some(CellKind::Triangles), 0), (Some(CellKind::Quads), 0)]
        {
            scene.setting = Some(Setting { cells, refine, ..Setting::default() });
            let mesh = of_scene(&scene).expect("a mesh");
            match Problem::new(&scene, mesh) {
                Ok(problem) => assert_eq!(problem.warnings, [""; 0], "{}", path.display()),
                Err(error) => {
                    panic!("{}, {cells:?}, refined {refine} times: {error}", path.display())
                }
            }
        }
        count += 1;
    }
    assert!(count >= 20);
}

/// |u − u_h|₁, ‖u − u_h‖, ∫λ of H(0.55) for n = 16, as independent programs have them.
#[test]
fn the_refined_grid_has_the_errors_of_the_finer_one() {
    let scene = Scene::read(&meshes("catalogue").join("h-tri.toml")).expect("a scene");
    for (cells, expected) in [
        (CellKind::Triangles, [9.74473e-2, 1.97915e-3, 0.952483]),
        (CellKind::Quads, [2.41546e-2, 3.49377e-4, 0.950322]),
    ] {
        let mesh = adapted(grid(8, Cells::Mixed), Some(cells), 1).expect("a mesh");
        let problem = Problem::new(&scene, mesh).expect("a problem");
        let solution = solve(&problem, &Options::default()).expect("a solution");
        let errors = of_solution(&problem, &solution).expect("errors").expect("errors");
        let found = [errors.h1, errors.l2, solution.contact_force];
        for (found, expected) in found.into_iter().zip(expected) {
            CATALOGUE.check_relative(format_args!("{cells:?}"), found, expected);
        }
    }
}

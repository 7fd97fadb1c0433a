//! Scenes that call functions, a scene that calls none, and loads that a wrong function spoils.

use super::{FunctionCost, of_scene};
use crate::trade::tests::scene;
use signorini_problem::Problem;
use signorini_scene::{Result, Scene, mesh};

fn rows(scene: &Scene) -> Result<Vec<FunctionCost>> {
    of_scene(&Problem::new(scene, mesh::read(&scene.mesh.value)?)?)
}

fn row<'r>(rows: &'r [FunctionCost], function: &str, place: &str) -> &'r FunctionCost {
    let found = rows.iter().find(|row| row.function == function && row.used_in.contains(place));
    found.unwrap_or_else(|| panic!("no row for {function} in {place}: {rows:#?}"))
}

#[test]
fn a_load_with_many_functions_has_a_row_for_each() {
    let rows = rows(&scene("catalogue/h-tri")).unwrap();
    let single = row(&rows, "f32 with libm", "value").energy.unwrap();
    assert!((1e-9..1e-6).contains(&single), "{single:e}");
    for function in ["sin", "cos", "atan2", "ln", "powf"] {
        let FunctionCost { energy, calls, saved, .. } = row(&rows, function, "value");
        let energy = energy.unwrap();
        assert!((1e-5..0.1).contains(&energy), "{function}: {energy:e}");
        assert!(energy > 100.0 * single && *calls > 0 && *saved > 0.0, "{function}");
    }
    assert!(rows.iter().all(|row| row.function != "exp"), "{rows:#?}");
}

#[test]
fn a_sine_in_the_source_moves_the_answer_by_a_thousandth() {
    let rows = rows(&scene("scenes/benbelgacem")).unwrap();
    let sin = row(&rows, "sin", "source.f");
    assert!((1e-5..1e-2).contains(&sin.energy.unwrap()), "{sin:#?}");
    assert!((1e-6..1e-2).contains(&sin.force.unwrap()), "{sin:#?}");
    assert_eq!(sin.sweeps, None);
}

#[test]
fn loads_without_functions_leave_the_square_root_of_the_kernel() {
    let rows = rows(&scene("scenes/levee")).unwrap();
    assert!(rows.iter().all(|row| row.function == "sqrt"), "{rows:#?}");
    let search = row(&rows, "sqrt", "search for ω");
    assert!(search.energy.unwrap() < 1e-3, "{search:#?}");
    assert!(search.sweeps.is_some() && search.calls > 0);
    let length = row(&rows, "sqrt", "lengths of edges").length.unwrap();
    assert!((1e-4..6.1e-2).contains(&length), "{length:e}");
}

#[test]
fn a_function_that_puts_the_given_value_below_the_gap_is_reported() {
    let square = scene("catalogue/a-tri");
    let (given, gap) = ("max(x,0)^3 - (y)*max(-(x),0)^3", "gap = \"0\"");
    let text = square.text.replace(given, "1.4143").replace(gap, "gap = \"sqrt(2*x*x)\"");
    let (text, _exact) = text.split_once("[exact]").unwrap();
    let rows = rows(&Scene::parse(text, &square.path).unwrap()).unwrap();
    let root = row(&rows, "sqrt", "gap");
    assert_eq!((root.energy, root.force, root.length), (None, None, None));
    assert!(root.note.as_ref().unwrap().contains("lies below the gap"), "{root:#?}");
    assert!(row(&rows, "f32 with libm", "gap").energy.unwrap() < 1e-6);
}

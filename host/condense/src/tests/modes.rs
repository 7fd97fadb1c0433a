//! A model of modes at a coefficient is the model that a scene with this coefficient condenses to.

use signorini_tolerances::solve::{GUARANTEE, IDENTITY_OF_MODES, MODES, MODES_OUTPUTS};

use super::*;
use crate::modal;
use signorini_certify::exact::distance;
use signorini_problem::fixtures::{SMOOTH, distorted};
use signorini_scene::mesh::structured::{Cells, grid};

/// The fixture with an input of its coefficient beside what the scene states.
fn with_input(pattern: &str) -> String {
    let input = "[input.h]\nof = \"left\"\nfield = \"coefficient\"\n";
    format!("{ALL}{input}pattern = \"{pattern}\"\ndefault = 1.5\nrange = [-1.0, 1000.0]\n")
}

/// The scene that states the h of this value of the input.
fn stated(pattern: &str, value: f64) -> String {
    let sum = format!("coefficient = \"2+y + ({value})*({pattern})\"");
    changed(ALL, &[("coefficient = \"2+y\"", &sum)])
}

/// Compares with the largest number.
fn same(what: &str, allowed: Tolerance, found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let most = expected.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    let pairs = found.iter().zip(expected);
    let off = pairs.fold(0.0, |off: f64, (a, b)| off.max((a - b).abs()));
    allowed.check_over(what, off, most);
}

/// Loads and openings where U = 1.
fn physical(model: &CondensedModel) -> Vec<Vec<f64>> {
    let unit = model.energy_unit;
    let times = |numbers: &Vec<f64>, unit: f64| numbers.iter().map(|x| x * unit).collect();
    let loads = model.load.iter().map(|column| times(column, unit));
    loads.chain([times(&model.opening, 1.0 / unit)]).collect()
}

fn compare_modes(cells: Cells, pattern: &str) -> Result<()> {
    let mesh = || distorted(grid(5, cells));
    let (_, problem) = on_grid(&with_input(pattern), mesh())?;
    let (modes, _) = modal(&problem, 0.0)?;
    assert!(!modes.compliance.is_empty() && modes.compliance.iter().all(|nu| *nu > 0.0));
    for value in [1.5, -1.0, 0.0, 1.4, 30.0, 1000.0] {
        let found = modes.at(value);
        let (_, fresh) = on_grid(&stated(pattern, value), mesh())?;
        let expected = condense(&fresh)?;
        same(&format!("matrix at {value}"), MODES, &found.matrix, &expected.matrix);
        let (mut of_modes, of_fresh) = (physical(&found), physical(&expected));
        // The coefficient is no load of its own.
        let silent = of_modes.remove(modes.input);
        assert!(silent.iter().all(|&entry| entry == 0.0), "{silent:?}");
        for (at, (found, expected)) in of_modes.iter().zip(&of_fresh).enumerate() {
            same(&format!("load {at} at {value}"), MODES, found, expected);
        }
        outputs(&problem, &found, value)?;
    }
    Ok(())
}

/// Solved at other inputs too, against the direct solver on the mesh.
fn outputs(problem: &Problem, model: &CondensedModel, value: f64) -> Result<()> {
    for round in 0..3 {
        let mut p = moved(model, 0.3, 17 * round);
        p[model.inputs - 1] = value;
        let (_, solution, expected) = full_at(problem, &p)?;
        let x = model.solve(&p).expect("a solution");
        let scale = solution.largest_flux();
        check_outputs(MODES_OUTPUTS, model, [&p, &x], &expected, scale);
    }
    Ok(())
}

#[test]
fn a_coefficient_by_modes_is_the_one_that_a_scene_states() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        compare_modes(cells, "1 + y/2")?;
    }
    compare_modes(Cells::Mixed, "1")
}

/// u = SMOOTH's for every h: u_ext = u + σ·n/h, and σ·n is an input that is set to 1/h.
fn smooth() -> String {
    let text = SMOOTH.replace("coefficient = \"2+y\"", "coefficient = \"0\"");
    text.replace(" + (3*y - 6.5)/(2+y)\"", "\"")
        + "
input.h = { of = \"left\", field = \"coefficient\", pattern = \"1\", default = 1.0, range = [0.01, 100.0] }
input.push = { of = \"left\", field = \"ambient\", pattern = \"3*y - 6.5\", default = 1.0 }
"
}

/// The bound of the model whose s is the best one for this h.
fn best(cells: Cells, h: f64) -> Result<f64> {
    let text = SMOOTH
        .replace("coefficient = \"2+y\"", &format!("coefficient = \"{h}\""))
        .replace("/(2+y)\"", &format!("/{h}\""));
    let (_, problem) = on_grid(&text, grid(4, cells))?;
    let model = condense(&problem)?;
    let x = model.solve(&[1.0]).expect("a solution");
    Ok(model.bound(&[1.0], &x).expect("a bound"))
}

#[test]
fn the_bound_holds_for_every_coefficient() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let (_, problem) = on_grid(&smooth(), grid(4, cells))?;
        let (modes, recovery) = modal(&problem, 0.0)?;
        for h in [0.01, 0.1, 1.0, 10.0, 100.0] {
            let (p, now) = ([1.0, h, 1.0 / h], modes.at(h));
            let solution = now.solve(&p).expect("a solution");
            let openings = solution.iter().zip(&now.opening).map(|(x, d)| x * d);
            let exact: Vec<f64> = openings.zip(&modes.model.opening).map(|(v, d)| v / d).collect();
            // Bounds hold of any openings, and of others than the solution's they are larger.
            let moved: Vec<f64> = exact.iter().map(|x| x + 0.01).collect();
            let best = best(cells, h)?;
            for (x, most) in [(exact, 1.01 * best), (moved, f64::INFINITY)] {
                let bound = modes.bound(h, &p, &x).expect("a bound");
                let all = modes.amplitudes(h, &p, &x);
                let fields =
                    recovery.admissible(&modes.model, &problem, &all, &x).expect("s and τ");
                let now = problem.with_inputs(&p[1..])?;
                let exact = now.scene.exact.as_ref().expect("an exact solution");
                let found = distance(exact, &now, &fields.admissible())?;
                let error = found.combined;
                GUARANTEE.check_at_most(format_args!("{cells:?}, h = {h}"), error, bound);
                if most.is_finite() {
                    let norm = modes.norm(h, &all, &x).expect("a norm") * modes.model.energy_unit;
                    IDENTITY_OF_MODES.check_relative(
                        format_args!("{cells:?}, h = {h}"),
                        norm,
                        found.identity,
                    );
                }
                assert!(bound < most, "{cells:?}, h = {h}: {bound} for {error}, {best} at best");
            }
        }
    }
    Ok(())
}

#[test]
fn edges_without_a_pattern_are_no_part_of_the_modes() -> Result<()> {
    let pattern = "max(0, y - 0.5)";
    let (_, problem) = on_grid(&with_input(pattern), grid(6, Cells::Quads))?;
    assert_eq!(modal(&problem, 0.0)?.0.compliance.len(), 3);
    compare_modes(Cells::Triangles, pattern)
}

#[test]
fn what_modes_cannot_do_is_told() -> Result<()> {
    let wind = "field = \"ambient\", pattern = \"1 - y^2\"";
    let coefficient = "field = \"coefficient\", pattern = \"y\", range = [0, 1]";
    let second = changed(&with_input("1"), &[(wind, coefficient)]);
    for (text, expected) in [
        (ALL.to_owned(), "no input adds to a transfer coefficient"),
        (second, "input.h.field: a second coefficient"),
        (with_input("y - 0.5").replace("1000.0", "2.0"), "input.h.pattern: negative on an edge"),
    ] {
        let (_, problem) = on_grid(&text, grid(4, Cells::Mixed))?;
        let error = modal(&problem, 0.0).expect_err("no modes").to_string();
        assert!(error.contains(expected), "{error}");
    }
    Ok(())
}

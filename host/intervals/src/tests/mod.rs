//! Intervals of outputs hold what far finer meshes and exact solutions say.

mod cases;
mod steps;
mod weights;

use std::path::Path;

use super::*;
use signorini_certify::cell::Cell;
use signorini_problem::field::CellField;
use signorini_problem::fixtures::on_grid;
use signorini_problem::functional::Functional;
use signorini_problem::quadrature::gauss;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{self, adapted};
use signorini_scene::scene::{Output, Scene};
use signorini_solve::outputs::outputs;
use signorini_solve::{MOST_FACTORED, Options, SolverKind, solve};
use signorini_tolerances::solve::SHARED_SOLVER;
use signorini_tolerances::{is_whole, some};

fn options() -> Options {
    Options::by(SolverKind::Factor)
}

fn scene(name: &str) -> Result<Scene> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/scenes");
    Scene::read(&folder.join(name))
}

/// On the scene's mesh, refined so many times.
fn solved(scene: &Scene, times: u32) -> Result<(Problem, Solution)> {
    let mesh = adapted::adapted(mesh::read(&scene.mesh.value)?, None, times)?;
    let problem = Problem::new(scene, mesh)?;
    let solution = solve(&problem, &options())?;
    Ok((problem, solution))
}

/// The outputs on the mesh refined so many times; of a probe the mean over the cell of `coarse`.
fn refined(scene: &Scene, coarse: &Problem, times: u32) -> Result<BTreeMap<String, f64>> {
    let (problem, solution) = solved(scene, times)?;
    let values = outputs(&problem, &solution)?;
    let value = |output: &Output| {
        let name = output.name.value.clone();
        let value = match Functional::of(coarse, output)? {
            Functional::Probe(cell, _) => mean_over(&problem, &solution, coarse, cell),
            _ => values[&name].unwrap_or(f64::NAN),
        };
        Ok((name, value))
    };
    wanted(&scene.clone()).iter().map(value).collect()
}

/// The mean of u_h over the cells of a finer mesh within a coarse one.
fn mean_over(fine: &Problem, solution: &Solution, coarse: &Problem, cell: usize) -> f64 {
    let none = vec![0.0; coarse.ends.len()];
    let whole = CellField::new(coarse, cell, &none, &none);
    let [mut sum, mut area] = [0.0; 2];
    for at in 0..fine.cells() {
        let part = Cell::of(fine, at);
        if whole.locate(part.middle()).is_none() {
            continue;
        }
        let field = CellField::new(fine, at, &solution.u, &solution.flux);
        for point in part.points(&gauss(3)) {
            sum += point.weight * field.sample(&point).u;
            area += point.weight;
        }
    }
    sum / area
}

fn check(name: &str, found: &OutputBound, exact: f64) {
    let off = (exact - found.center).abs();
    assert!(off <= found.plus_minus, "{name}: {exact} is not in {found:?}");
}

/// The exact value is not known: that of a mesh refined twice, off by what the second refinement changed, or less.
#[test]
fn they_hold_the_values_of_finer_meshes() -> Result<()> {
    for (name, with_interval) in
        [("levee", 2), ("slab", 2), ("strip", 1), ("pit", 2), ("antiicing", 6), ("membrane", 1)]
    {
        let scene = scene(&format!("{name}.toml"))?;
        let (coarse, solution) = solved(&scene, 0)?;
        let found: BTreeMap<String, Found> = of_outputs(&coarse, &solution, Coverage::Usual);
        let once = refined(&scene, &coarse, 1)?;
        let twice = refined(&scene, &coarse, 2)?;
        let mut count = 0;
        for (output, found) in &found {
            match found {
                Ok(of) => {
                    let (value, off) = (twice[output], (twice[output] - once[output]).abs());
                    let apart = (value - of.center).abs() - off;
                    assert!(apart <= of.plus_minus, "{name}: {output}: {value} is not in {of:?}");
                    count += 1;
                }
                Err(why) => assert!(!why.is_empty()),
            }
        }
        assert_eq!(count, with_interval, "{name}: {found:?}");
    }
    Ok(())
}

/// Whoever solves the linear problems, the intervals are the same.
#[test]
fn multigrid_weighs_as_the_factor_does() -> Result<()> {
    for name in ["levee", "strip", "antiicing"] {
        let (problem, solution) = solved(&scene(&format!("{name}.toml"))?, 0)?;
        let Some((scaled, own)) = solution.in_its_units().or(Some((&problem, &solution))) else {
            continue;
        };
        let solver = Some(Box::new(SharedSolver::Multigrid));
        let by_multigrid = Lasting { solver, ..Lasting::default() };
        let found = of_next(scaled, &own.into(), &by_multigrid);
        let mut count = 0;
        for (output, expected) in of_answer(scaled, &own.into(), Coverage::Usual) {
            let Ok(expected) = expected else { continue };
            let found = found[&output].as_ref().expect("an interval");
            let size = expected.plus_minus;
            SHARED_SOLVER.check_over(&output, found.plus_minus - size, size);
            SHARED_SOLVER.check_over(&output, found.center - expected.center, size);
            count += 1;
        }
        assert!(count > 0, "{name}");
    }
    Ok(())
}

/// None where they are not asked for; on large meshes of a solution, and not of each tick.
#[test]
fn they_are_worked_out_where_they_are_asked_for() -> Result<()> {
    let (problem, solution) = solved(&scene("strip.toml")?, 0)?;
    assert!(of_outputs(&problem, &solution, Coverage::None).is_empty());
    let of = |asked| of_outputs(&problem, &solution, asked);
    let count = |asked| of(asked).values().filter(|of| of.is_ok()).count();
    assert_eq!(count(Coverage::All), count(Coverage::Usual));
    let large = on_grid(signorini_problem::fixtures::SMOOTH, grid(200, Cells::Triangles))?.1;
    assert!(large.topology.counts.unknowns() > MOST_FACTORED);
    assert!(Coverage::Usual.takes(&large) && !Coverage::Factored.takes(&large));
    Ok(())
}

/// Every force, flux and mean that a scene's boundaries have, and a probe in the middle.
const ALL_OUTPUTS: &str = r#"
[output.force]
kind = "force"
[output.skin]
kind = "mean"
of = "contact"
[output.out]
kind = "flux"
of = "dirichlet"
[output.middle]
kind = "probe"
at = [0.03, 0.51]
"#;

/// The scenes with an exact solution, on their meshes and refined ones.
fn known_scenes() -> Result<Vec<(String, Scene)>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes");
    let mut all = Vec::new();
    for part in ["catalogue", "limits"] {
        for entry in std::fs::read_dir(folder.join(part)).expect("a folder of scenes") {
            let path = entry.expect("a file").path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                let scene = Scene::read(&path)?;
                let scene = Scene::parse(&format!("{}{ALL_OUTPUTS}", scene.text), &path)?;
                all.push((path.file_stem().unwrap().to_string_lossy().into_owned(), scene));
            }
        }
    }
    all.sort_by(|one, other| one.0.cmp(&other.0));
    Ok(all)
}

/// Half-widths over true errors of the middles. An interval that holds because it is huge is of no use.
#[test]
fn they_hold_the_values_of_the_catalogue_and_are_not_huge() -> Result<()> {
    const MEDIAN: f64 = 20.0;
    // An error that is rounding has no ratio: linear u, and u that a symmetry makes exact.
    const ROUNDING: f64 = 1e-7;
    let mut ratios = Vec::new();
    for (name, scene) in some(4, known_scenes()?) {
        for times in [0, 1] {
            let (problem, solution) = solved(&scene, times)?;
            for (output, found) in of_outputs(&problem, &solution, Coverage::Usual) {
                let Ok(found) = found else { continue };
                let exact = found.exact.expect("an exact solution");
                check(&format!("{name}: {output}"), &found, exact);
                let off = (exact - found.center).abs();
                if off > ROUNDING * (1.0 + exact.abs()) {
                    ratios.push(found.plus_minus / off);
                }
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    let least = if is_whole() { 80 } else { 12 };
    assert!(ratios.len() > least && median <= MEDIAN, "{median}: {ratios:?}");
    Ok(())
}

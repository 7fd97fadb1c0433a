//! Intervals of outputs hold what far finer meshes and exact solutions say.

use std::path::Path;

use super::*;
use crate::certify::cell::Cell;
use crate::field::CellField;
use crate::fixtures::on_grid;
use crate::functional::Functional;
use crate::outputs::outputs;
use crate::quadrature::gauss;
use crate::solve::{Options, SolverKind, solve};
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{adapted, gmsh};
use signorini_scene::scene::{Output, Scene};
use signorini_tolerances::solve::OUTPUT_WEIGHTS;

fn options() -> Options {
    Options { solver: SolverKind::Factor, ..Options::default() }
}

fn scene(name: &str) -> Result<Scene> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/scenes");
    Scene::read(&folder.join(name))
}

/// On the scene's mesh, refined so many times.
fn solved(scene: &Scene, times: u32) -> Result<(Problem, Solution)> {
    let mesh = adapted::adapted(gmsh::read(&scene.mesh.value)?, None, times)?;
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
        let found: BTreeMap<String, Found> = of_outputs(&coarse, &solution);
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
    for (name, scene) in known_scenes()? {
        for times in [0, 1] {
            let (problem, solution) = solved(&scene, times)?;
            for (output, found) in of_outputs(&problem, &solution) {
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
    println!(
        "{} intervals, half-widths {median:.1} times the true errors in the median",
        ratios.len()
    );
    assert!(ratios.len() > 80 && median <= MEDIAN, "{median}: {ratios:?}");
    Ok(())
}

/// u = x² − y² on (−1, 1) × (0, 1), heat through the left side by a transfer law, through the right one by a given u.
const HARMONIC: &str = r#"
mesh = "grid"
[material.default]
conductivity = "1"
[source]
f = "0"
[boundary.dirichlet]
kind = "neumann"
flux = "-2"
[boundary.left]
kind = "robin"
coefficient = "2 + y"
ambient = "1 - y^2 + 2/(2 + y)"
[boundary.right]
kind = "dirichlet"
value = "1 - y^2"
[boundary.contact]
kind = "neumann"
flux = "0"
[output.top]
kind = "mean"
of = "dirichlet"
[output.bottom]
kind = "flux"
of = "contact"
[output.cold]
kind = "flux"
of = "left"
[output.skin]
kind = "mean"
of = "left"
[output.warm]
kind = "flux"
of = "right"
[output.given]
kind = "mean"
of = "right"
"#;

#[test]
fn they_hold_the_values_of_an_exact_solution() -> Result<()> {
    // Means of x² − 1 over (−1, 1) and of 1 − y² over (0, 1); fluxes ±2x over sides of length 1.
    let exact = [
        ("top", -2.0 / 3.0),
        ("bottom", 0.0),
        ("cold", 2.0),
        ("skin", 2.0 / 3.0),
        ("warm", 2.0),
        ("given", 2.0 / 3.0),
    ];
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let mut widths = Vec::new();
        for n in [4, 16] {
            let (_, problem) = on_grid(HARMONIC, grid(n, cells))?;
            let solution = solve(&problem, &options())?;
            let found = of_outputs(&problem, &solution);
            for (name, value) in exact {
                let interval = found[name].as_ref().unwrap_or_else(|why| panic!("{name}: {why}"));
                check(name, interval, value);
            }
            widths.push(found["warm"].as_ref().map_or(f64::NAN, |found| found.plus_minus));
        }
        // Of first order: a quarter of the edge is a quarter of the width.
        assert!(widths[1] < 0.3 * widths[0], "{cells:?}: {widths:?}");
    }
    Ok(())
}

/// A bar from x = −1 to 1 and of height 1 with A = 3, u given on the left, heat by a law of transfer with h = 2 on the right.
const BAR: &str = r#"
mesh = "grid"
[material.default]
conductivity = "3"
[source]
f = "0"
[boundary.left]
kind = "dirichlet"
value = "0"
[boundary.right]
kind = "robin"
coefficient = "2"
ambient = "1"
[boundary.dirichlet]
kind = "neumann"
flux = "0"
[boundary.contact]
kind = "neumann"
flux = "0"
[output.cold]
kind = "flux"
of = "left"
[output.skin]
kind = "mean"
of = "right"
[output.roof]
kind = "mean"
of = "dirichlet"
"#;

/// z and ζ are known: z falls from 1 with the slope b, 3b = 2 (1 − 2b), and ‖A∇z‖² = 3 · 2 b² + 2 (1 − 2b)². ζ of the mean on the right
/// is 1 − 2z there, with ‖ζ‖² = 2 ζ²/3 + (1 − ζ)²/2 where ζ = 3z/2.
#[test]
fn weights_of_a_bar_are_those_of_its_resistances() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(BAR, grid(4, cells))?;
        let of_a = |are_balanced| {
            weights::weights(&problem, &weights::Answers { open: &[], total: 0.0, are_balanced })
        };
        let found = of_a(cells == Cells::Triangles);
        let slope: f64 = 2.0 / 7.0;
        let flux = (6.0 * slope * slope + 2.0 * (1.0 - 2.0 * slope).powi(2)).sqrt();
        let through: f64 = 3.0 / 7.0;
        let mean = (2.0 * through * through / 3.0 + (1.0 - through).powi(2) / 2.0).sqrt();
        let weight = |at: usize| found[at].clone().expect("weights").total;
        OUTPUT_WEIGHTS.check_relative("flux", weight(0), flux);
        OUTPUT_WEIGHTS.check_relative("mean", weight(1), mean);
        assert!(weight(2) > 0.0);
        if cells == Cells::Quads {
            // s of a condensed model does not keep the means of u_h between quads.
            let of_u = of_a(true)[1].clone().expect("weights").of_u;
            OUTPUT_WEIGHTS.check_relative("mean of u_h", of_u, mean);
        }
    }
    Ok(())
}

/// On a trapezoid the mean over the area is not the mean in the cell's own coordinates.
#[test]
fn the_mean_over_a_trapezoid_is_that_over_its_area() -> Result<()> {
    const TRAPEZOID: &str = r#"
title = "a linear u"
mesh = "none.msh"
[material.default]
conductivity = "1"
[boundary.default]
kind = "dirichlet"
value = "x + 2*y"
[output.middle]
kind = "probe"
at = [-0.2, 0.4]
[setting]
element = "nonparametric"
"#;
    let mut mesh = grid(1, Cells::Quads);
    // Left of x = 0 a quad with the corners (−1, 0), (0, 0), (0, 3), (−1, 1), of the area 2 and the middle (−5/12, 13/12).
    for vertex in &mut mesh.vertices {
        *vertex = [vertex[0], if vertex[0] < 0.0 { vertex[1] } else { 3.0 * vertex[1] }];
    }
    let (_, problem) = on_grid(TRAPEZOID, mesh)?;
    let found = of_outputs(&problem, &solve(&problem, &options())?);
    let middle = found["middle"].as_ref().expect("an interval");
    check("the area's", middle, -5.0 / 12.0 + 2.0 * 13.0 / 12.0);
    assert!(middle.plus_minus < 1e-6, "{middle:?}");
    Ok(())
}

const ROOF: &str = r#"
title = "an outlet below"
mesh = "none.msh"
[material.default]
conductivity = "1"
[source]
f = "-1"
[boundary.contact]
kind = "contact"
gap = "0"
flux = "0"
[boundary.left]
kind = "robin"
coefficient = "2"
ambient = "0.1"
[boundary.right]
kind = "robin"
coefficient = "0"
ambient = "3"
[boundary.dirichlet]
kind = "neumann"
flux = "0"
[output.below]
kind = "flux"
of = "contact"
[output.side]
kind = "flux"
of = "left"
"#;

/// Where no heat is transferred the condition is that of a wall.
#[test]
fn without_transfer_there_are_intervals_that_hold() -> Result<()> {
    let (_, fine) = on_grid(ROOF, grid(32, Cells::Triangles))?;
    let exact = outputs(&fine, &solve(&fine, &options())?)?;
    let (_, problem) = on_grid(ROOF, grid(4, Cells::Triangles))?;
    let found = of_outputs(&problem, &solve(&problem, &options())?);
    for name in ["below", "side"] {
        check(name, found[name].as_ref().expect("an interval"), exact[name].expect("a value"));
    }
    Ok(())
}

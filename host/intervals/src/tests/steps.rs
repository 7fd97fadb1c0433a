//! Steps in time with an exact solution.

use super::*;
use signorini_problem::State;
use signorini_scene::mesh::Mesh;

/// u = y² + y after a step from 1 + y on (−1, 1) × (0, 1): given below, heat by a law of transfer from above, contact on the right that
/// stays open.
fn slab(dt: f64, capacity: &str) -> String {
    format!(
        r#"
mesh = "grid"
material.default = {{ conductivity = "1", capacity = "{capacity}" }}
source.f = "({capacity})*(y^2 - 1)/{dt:?} - 2"
boundary.contact = {{ kind = "dirichlet", value = "0" }}
boundary.dirichlet = {{ kind = "robin", coefficient = "3", ambient = "3" }}
boundary.left = {{ kind = "neumann", flux = "0" }}
boundary.right = {{ kind = "contact", gap = "-1", flux = "0" }}
time.step = {dt:?}
output.floor = {{ kind = "flux", of = "contact" }}
output.roof = {{ kind = "flux", of = "dirichlet" }}
output.top = {{ kind = "mean", of = "dirichlet" }}
output.wall = {{ kind = "mean", of = "left" }}
output.skin = {{ kind = "mean", of = "right" }}
output.middle = {{ kind = "probe", at = [0.1, 0.55] }}
"#
    )
}

const EXACT: [(&str, f64); 5] =
    [("floor", -2.0), ("roof", 6.0), ("top", 2.0), ("wall", 5.0 / 6.0), ("skin", 5.0 / 6.0)];

/// The step of `slab` from 1 + y.
fn step(text: &str, mesh: Mesh) -> Result<Problem> {
    let (scene, problem) = on_grid(text, mesh)?;
    let at = |place: [f64; 2]| 1.0 + place[1];
    let begin = State {
        u: (0..problem.ends.len()).map(|edge| at(problem.along(edge, 0.5))).collect(),
        vertices: problem.mesh.vertices.iter().map(|&vertex| at(vertex)).collect(),
        ..State::zero(&problem)
    };
    problem.stepping(scene.time.expect("a step").step, begin)
}

/// The mean of y² + y over the cell of the probe.
fn over_cell(problem: &Problem) -> Result<f64> {
    let output = problem.scene.outputs.iter().find(|of| of.name.value == "middle").expect("it");
    let Functional::Probe(cell, _) = Functional::of(problem, output)? else { panic!("a cell") };
    let [mut sum, mut area] = [0.0; 2];
    for point in Cell::of(problem, cell).points(&gauss(3)) {
        sum += point.weight * point.x[1] * (point.x[1] + 1.0);
        area += point.weight;
    }
    Ok(sum / area)
}

/// Half-widths on grids of these cells, and those over the errors of the middles.
fn checked(dt: f64, capacity: &str, mesh: Mesh, of: &str) -> Result<Vec<[f64; 2]>> {
    let problem = step(&slab(dt, capacity), mesh)?;
    let found = of_answer(&problem, &(&solve(&problem, &options())?).into());
    let exact = EXACT.into_iter().chain([("middle", over_cell(&problem)?)]);
    let checked = exact.map(|(name, exact)| {
        let interval = found[name].as_ref().unwrap_or_else(|why| panic!("{of} {name}: {why}"));
        check(&format!("{of} {name}"), interval, exact);
        let OutputBound { center, plus_minus, .. } = interval;
        println!("{of} {name}: {plus_minus:.2e}, {:.1}", plus_minus / (exact - center).abs());
        [*plus_minus, plus_minus / (exact - center).abs()]
    });
    Ok(checked.collect())
}

#[test]
fn intervals_of_a_step_hold_its_exact_solution() -> Result<()> {
    let mut ratios = Vec::new();
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for capacity in ["1", "1 + sign(x)"] {
            for dt in [1e-4, 1e-2, 1.0, 1e2, 1e4] {
                let widths = |n: u32| {
                    checked(dt, capacity, grid(n, cells), &format!("{cells:?} {capacity} {dt} {n}"))
                };
                let [coarse, fine] = [widths(4)?, widths(8)?];
                for ([coarse, _], [fine, ratio]) in coarse.into_iter().zip(fine) {
                    // Of second order, where cells are not smaller too, and the grid resolves the layers of the step.
                    assert!(fine < 0.55 * coarse, "{cells:?} {capacity} {dt}");
                    ratios.push(ratio);
                }
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    println!("median {}, most {}", ratios[ratios.len() / 2], ratios[ratios.len() - 1]);
    Ok(())
}

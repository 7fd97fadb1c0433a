//! The bound holds where rounding is most of it: thin cells, and u large against its changes.

use super::exact::distance;
use crate::fixtures;
use crate::solve::{Options, ScalarKind, solve};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::GUARANTEE;

const PARABOLA: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
source.f = "-2"
boundary.dirichlet = { kind = "dirichlet", value = "x + x^2" }
boundary.contact = { kind = "contact", gap = "x + x^2", flux = "-1" }
exact = { u = "x + x^2", gradient = ["1 + 2*x", "0"] }
"#;

const HIGH_UP: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
source.f = "0"
boundary.left = { kind = "robin", coefficient = "1000", ambient = "OFFSET - 1.001" }
boundary.right = { kind = "robin", coefficient = "1000", ambient = "OFFSET + 1.001" }
boundary.default = { kind = "neumann", flux = "0" }
exact = { u = "OFFSET + x", gradient = ["1", "0"] }
"#;

/// Total and combined error after at most `max_sweeps`, `height` being that of the grid.
fn bound(text: &str, cells: Cells, height: f64, options: Options) -> Result<[f64; 2]> {
    let mut mesh = grid(3, cells);
    mesh.vertices.iter_mut().for_each(|vertex| vertex[1] *= height);
    let (scene, problem) = fixtures::on_grid(text, mesh)?;
    let solution = solve(&problem, &options)?;
    let exact = scene.exact.as_ref().expect("an exact solution");
    let found = distance(exact, &problem, &solution.certified.admissible())?;
    Ok([solution.bound.expect("a bound").total, found.combined])
}

fn holds(text: &str, height: f64, scalar: ScalarKind) -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for max_sweeps in [20, 100_000] {
            let options = Options { scalar, max_sweeps, ..Options::default() };
            let [total, combined] = bound(text, cells, height, options)?;
            GUARANTEE.check_at_most(format_args!("{height} {max_sweeps}"), combined, total);
        }
    }
    Ok(())
}

#[test]
fn of_thin_cells() -> Result<()> {
    for height in [1e-2, 1e-3, 1e-4, 1e-5] {
        holds(PARABOLA, height, ScalarKind::F32)?;
    }
    holds(PARABOLA, 1e-8, ScalarKind::F64)?;
    holds(PARABOLA, 1e-9, ScalarKind::F64)
}

#[test]
fn of_transfer_between_large_values() -> Result<()> {
    for offset in ["1000.3", "10000.3", "1000000.3"] {
        holds(&HIGH_UP.replace("OFFSET", offset), 1.0, ScalarKind::F32)?;
    }
    Ok(())
}

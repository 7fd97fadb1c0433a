//! The bound of a solve: it holds where rounding is most of it (thin cells, u large against its changes), and it is the
//! identity where extensions of rough data are.

use super::judged;
use crate::{Options, ScalarKind, SolverKind};
use signorini_problem::fixtures::{self, on_grid};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::{CURVED_ENERGY, GUARANTEE};

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
    let (solution, found) = judged(&on_grid(text, mesh)?.1, &options)?;
    Ok([solution.bound.expect("a bound").total, found.combined])
}

fn holds(text: &str, height: f64, scalar: ScalarKind) -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for max_sweeps in [20, 100_000] {
            let options = Options { scalar, max_sweeps: Some(max_sweeps), ..Options::default() };
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

#[test]
fn the_bound_is_the_identity_for_gaps_with_kinks() -> Result<()> {
    // u = y² − x² + 1 with σ·n = 0 above a gap that is rough: nothing touches, and the extensions are most of the bound.
    let exact = "[exact]\nu = \"y^2 - x^2 + 1\"\ngradient = [\"-2*x\", \"2*y\"]\n";
    for gap in [
        "-0.5 - 30*max(0, x - 0.99)",
        "-0.5 - 3*max(0, x - 0.85)",
        "-0.5 + 0.3*max(0, 1 - abs(x - 0.3)/0.05)",
        "-0.5 - 30*max(0, x - 0.99) - 3*abs(x + 0.9)",
        "-1.5 + tanh((x - 0.4)/1e-4)",
    ] {
        let text = fixtures::PARABOLA
            .replace("20 + 1e6*y", "y^2 - x^2 + 1")
            .replace("\"-x^2\"", &format!("{gap:?}"));
        for cells in [Cells::Triangles, Cells::Quads] {
            let (_, problem) = on_grid(&(text.clone() + exact), grid(4, cells))?;
            let (solution, found) = judged(&problem, &Options::by(SolverKind::Direct))?;
            let ratio = solution.bound.expect("a bound").duality_gap / found.identity;
            CURVED_ENERGY.check(format_args!("{gap}, {cells:?}"), ratio - 1.0);
        }
    }
    Ok(())
}

/// A transfer coefficient that is narrow inside an edge: true errors are integrated on its parts, as the bound is.
#[test]
fn the_bound_is_the_identity_beside_narrow_transfer_coefficients() -> Result<()> {
    let h = "(1 + 1e5*exp(-((y - 0.31)/2e-4)^2))";
    let u = "value = \"x^2 - y^2\"";
    let boundary = |name: &str| format!("[boundary.{name}]\nkind = \"dirichlet\"\n{u}\n");
    let others = ["contact", "right", "dirichlet"].map(boundary).concat();
    let text = format!(
        "mesh = \"none.msh\"\n[material.default]\nconductivity = \"1\"\n[source]\nf = \"0\"\n{others}[boundary.left]\n\
         kind = \"robin\"\ncoefficient = \"{h}\"\nambient = \"1 - y^2 + 2/{h}\"\n[exact]\nu = \"x^2 - y^2\"\n\
         gradient = [\"2*x\", \"-2*y\"]\n"
    );
    for cells in [Cells::Triangles, Cells::Mixed] {
        let (_, problem) = on_grid(&text, grid(4, cells))?;
        let (solution, found) = judged(&problem, &Options::default())?;
        let bound = solution.bound.expect("a bound");
        assert!(found.combined <= bound.total, "{found:?} {bound:?}");
        assert!((bound.duality_gap / found.identity - 1.0).abs() < 2e-3, "{found:?} {bound:?}");
    }
    Ok(())
}

/// A that no rule of points sees: a step, a bump of a hundredth of a cell and a wave shorter than cells, with u = y along them.
#[test]
fn of_conductivities_that_vary_inside_cells() -> Result<()> {
    let step = "1 + 10*(0.5 + 0.5*sign(x - 0.002))";
    let bump = "1 + 100*exp(-((x - 0.12)/0.004)^2)";
    let wave = "1 + 0.9*sin(48*x)";
    let exact = "[exact]\nu = \"y\"\ngradient = [\"0\", \"1\"]\n";
    for [xx, yy] in [[step; 2], [bump; 2], [wave; 2], ["1", bump], [bump, "1"]] {
        let text = fixtures::PARABOLA
            .replace("\"1\"", &format!("[\"{xx}\", \"0\", \"{yy}\"]"))
            .replace("20 + 1e6*y", "y")
            .replace("gap = \"-x^2\"", "gap = \"0\", flux = \"-2000\"")
            + exact;
        for (cells, height) in [(Cells::Triangles, 1.0), (Cells::Quads, 0.5), (Cells::Mixed, 1.0)] {
            let [total, combined] = bound(&text, cells, height, Options::default())?;
            let what = format!("{xx}, {yy} on {cells:?}");
            GUARANTEE.check_at_most(&what, combined, total);
            assert!(total <= 3.0 * combined + 1e-3, "{what}: {total}, {combined}");
        }
    }
    Ok(())
}

/// Transfer coefficients that 8 points of an edge do not see, with u = x: what passes at the left is 1.
#[test]
fn of_transfer_that_varies_inside_edges() -> Result<()> {
    for h in ["2 + sign(y - 0.4)", "1 + 50*exp(-((y - 0.4)/0.02)^2)", "0.01 + y"] {
        let text = HIGH_UP
            .replace("\"1000\", ambient = \"OFFSET - 1.001\"", "\"H\", ambient = \"-1 - 1/(H)\"")
            .replace("OFFSET + ", "")
            .replace("OFFSET", "0")
            .replace('H', h);
        for cells in [Cells::Triangles, Cells::Quads] {
            let [total, combined] = bound(&text, cells, 1.0, Options::default())?;
            GUARANTEE.check_at_most(format_args!("{h} on {cells:?}"), combined, total);
            assert!(total <= 3.0 * combined + 1e-3, "{h} on {cells:?}: {total}, {combined}");
        }
    }
    Ok(())
}

//! s where the average of u_h is a poor one: sweeps over the vertices make the bound smaller, and it holds.

use super::judged;
use crate::{Options, ScalarKind, SolverKind, solve};
use signorini_problem::Problem;
use signorini_problem::fixtures::{SMOOTH, on_grid};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Mesh, Surface};
use signorini_tolerances::solve::GUARANTEE;

/// By how much the bound falls at least where the average is poor.
const FALLS: f64 = 1.3;

/// A = Q diag(1e4, 1) Qᵀ, turned by 30°, and u = x²y: f = −(2 A₁₁ y + 4 A₁₂ x). Every condition but contact.
const OBLIQUE: &str = r#"
mesh = "grid"
material.default.conductivity = ["7500.25", "4329.693", "2500.75"]
source.f = "-(2*7500.25*y + 4*4329.693*x)"
boundary.dirichlet = { kind = "dirichlet", value = "x^2*y" }
boundary.left = { kind = "robin", coefficient = "1000", ambient = "x^2*y - (7500.25*2*x*y + 4329.693*x^2)/1000" }
boundary.right = { kind = "neumann", flux = "7500.25*2*x*y + 4329.693*x^2" }
boundary.contact = { kind = "dirichlet", value = "x^2*y" }
exact = { u = "x^2*y", gradient = ["2*x*y", "x^2"] }
"#;

/// Each cell has one of five conductivities.
const STONES: &str = r#"
mesh = "grid"
material.k0.conductivity = "1e-3"
material.k1.conductivity = "0.03"
material.k2.conductivity = "1"
material.k3.conductivity = "30"
material.k4.conductivity = "1000"
source.f = "1"
boundary.dirichlet = { kind = "dirichlet", value = "x" }
boundary.left = { kind = "neumann", flux = "0" }
boundary.right = { kind = "robin", coefficient = "1", ambient = "y" }
boundary.contact = { kind = "contact", gap = "-1" }
"#;

/// A grid whose cells are of five materials, without any order.
fn stones(n: u32, cells: Cells) -> Mesh {
    let mut mesh = grid(n, cells);
    let material = |cell: u32| (cell.wrapping_mul(2_654_435_761) >> 16) % 5;
    let of = |at: u32| (0..mesh.cells() as u32).filter(|&cell| material(cell) == at).collect();
    mesh.surfaces = (0..5).map(|at| Surface { name: format!("k{at}"), cells: of(at) }).collect();
    mesh
}

fn options(averages: bool, scalar: ScalarKind) -> Options {
    Options { solver: SolverKind::Factor, averages, scalar, ..Options::default() }
}

/// The totals with the average and with the better s.
fn totals(problem: &Problem, scalar: ScalarKind) -> Result<[f64; 2]> {
    let total = |averages| -> Result<f64> {
        let solution = solve(problem, &options(averages, scalar))?;
        Ok(solution.bound.expect("a bound").total)
    };
    Ok([total(true)?, total(false)?])
}

#[test]
fn a_turned_anisotropy_of_1e4_has_a_better_s_whose_bound_holds() -> Result<()> {
    for (cells, falls) in [(Cells::Triangles, FALLS), (Cells::Mixed, 1.1), (Cells::Quads, 1.0)] {
        let (_, problem) = on_grid(OBLIQUE, grid(16, cells))?;
        let mut errors = [0.0; 2];
        for (error, averages) in errors.iter_mut().zip([true, false]) {
            let (solution, found) = judged(&problem, &options(averages, ScalarKind::F64))?;
            let bound = solution.bound.expect("a bound");
            GUARANTEE.check_at_most(format_args!("{cells:?}"), found.combined, bound.total);
            *error = found.combined;
        }
        let [average, better] = totals(&problem, ScalarKind::F64)?;
        assert!(average >= falls * better, "{cells:?}: {average} {better} {errors:?}");
        assert!(errors[0] >= falls * errors[1], "{cells:?}: {errors:?}");
    }
    Ok(())
}

#[test]
fn contrasts_from_cell_to_cell_have_a_better_s() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(STONES, stones(16, cells))?;
        for scalar in [ScalarKind::F64, ScalarKind::F32] {
            let [average, better] = totals(&problem, scalar)?;
            assert!(average >= FALLS * better, "{cells:?} {scalar:?}: {average} {better}");
        }
    }
    Ok(())
}

/// Where a sweep gains little, nothing changes.
#[test]
fn smooth_scenes_keep_their_bits() -> Result<()> {
    for n in [4, 8, 16] {
        let (_, problem) = on_grid(SMOOTH, grid(n, Cells::Triangles))?;
        let [average, other] = totals(&problem, ScalarKind::F64)?;
        assert_eq!(average, other, "{n}");
    }
    Ok(())
}

/// Gains on the standard scenes, for the record.
#[test]
#[ignore = "prints what docs/benchmarks.md records"]
fn gains_of_the_standard_scenes() -> Result<()> {
    for path in super::standard_scenes() {
        let (_, problem) = super::read(&path)?;
        let clock = std::time::Instant::now();
        let [average, better] = totals(&problem, ScalarKind::F64)?;
        let seconds = clock.elapsed().as_secs_f64();
        println!("{:?} {average:e} {better:e} {:.3} {seconds}", path.file_stem(), average / better);
    }
    Ok(())
}

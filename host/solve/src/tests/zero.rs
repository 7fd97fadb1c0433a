//! A constant added to every datum of u is added to u, and nothing else changes: bounds, norms, fluxes, meshes.

use crate::adaptive::{MOST_UNKNOWNS, Stop, Wanted, refined_until};
use crate::outputs::outputs;
use crate::{Options, ScalarKind, SolverKind, energy_norm, solve};
use signorini_problem::Problem;
use signorini_problem::fixtures::{on_grid, scene, transfer_wall, with_four_sides};
use signorini_scene::error::Result;
use signorini_scene::goal::Goal;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::Tolerance;
use signorini_tolerances::solve::{TRANSFER, ZERO, ZERO_NARROW};

/// A cold spot above a heater, and inputs that add to what air and heater have; `c` is in every datum of u.
fn slab(c: f64, limit: &str) -> String {
    format!(
        r#"
mesh = "grid"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "0.3*x"
boundary.dirichlet = {{ kind = "robin", coefficient = "20", ambient = "{c:?} - 10*exp(-((x-0.5)/0.4)^2)" }}
boundary.left = {{ kind = "dirichlet", value = "{c:?} + 2 - 0.2*y^2" }}
boundary.right = {{ kind = "dirichlet", value = "{c:?} + 2" }}
boundary.contact = {{ kind = "contact", gap = "{c:?} + 0.5 - 0.3*x^2", flux = "0"{limit} }}
input.air = {{ of = "dirichlet", field = "ambient", pattern = "1", default = -1.0, range = [-3.0, 1.0] }}
input.lift = {{ of = "contact", field = "gap", pattern = "1-x^2", default = 0.2, range = [0.0, 0.5] }}
output.force = {{ kind = "force" }}
output.left = {{ kind = "flux", of = "left" }}
output.length = {{ kind = "length", of = "contact" }}
output.skin = {{ kind = "mean", of = "contact" }}
output.inside = {{ kind = "probe", at = [0.21, 0.37] }}
"#
    )
}

const KINDS: [Cells; 3] = [Cells::Triangles, Cells::Quads, Cells::Mixed];

/// Both bounds, without rounding, the norm, and the outputs, of the last two their height above `c`.
fn figures(c: f64, limit: &str, cells: Cells, options: Options) -> Result<[f64; 8]> {
    let (_, problem) = on_grid(&slab(c, limit), grid(4, cells))?;
    let solution = solve(&problem, &options)?;
    let free = problem.topology.counts.free;
    let touches = |at: &usize| solution.u[free + at] == solution.gap(&problem, *at);
    let touching = (0..problem.topology.counts.contact).filter(touches).count();
    assert_eq!(touching, solution.contact_active, "{cells:?}, {options:?}, {c}");
    let bound = solution.bound.expect("a bound");
    let norm = energy_norm::of_solution(&problem, &solution)?.expect("a norm");
    let values = outputs(&problem, &solution)?;
    let [force, left, length, skin, inside] =
        ["force", "left", "length", "skin", "inside"].map(|name| values[name].expect("a value"));
    let [total, of_u] = [bound.total, bound.of_u].map(|all| all - bound.rounding);
    Ok([total, of_u, norm, force, left, length, skin - c, inside - c])
}

fn stay(scalar: ScalarKind, constants: &[f64], allowed: Tolerance) -> Result<()> {
    for cells in KINDS {
        for limit in ["", ", limit = \"7\""] {
            for solver in [SolverKind::Kernel, SolverKind::Factor] {
                let options = Options { solver, scalar, ..Options::default() };
                let near = figures(0.0, limit, cells, options)?;
                for &c in constants {
                    let far = figures(c, limit, cells, options)?;
                    for (at, (far, near)) in far.into_iter().zip(near).enumerate() {
                        let what = format!("{cells:?}{limit}, {solver:?}, {c}: {at}");
                        allowed.check_over(what, far - near, near.abs().max(0.1));
                    }
                }
            }
        }
    }
    Ok(())
}

#[test]
fn figures_stay_whatever_is_added() -> Result<()> {
    stay(ScalarKind::F64, &[20.0, 273.15, -1.3e4], ZERO)
}

#[test]
fn in_f32_rounding_alone_may_grow() -> Result<()> {
    stay(ScalarKind::F32, &[273.15], ZERO_NARROW)
}

#[test]
fn the_mesh_of_an_error_is_the_same_in_celsius_and_kelvin() -> Result<()> {
    let levels = |c: f64| -> Result<(Vec<usize>, Stop, f64)> {
        let options = Options::default();
        let wanted = Wanted { goal: Goal::Part(0.1), most_unknowns: MOST_UNKNOWNS, options };
        let (mesh, mut unknowns) = (with_four_sides(grid(4, Cells::Triangles)), Vec::new());
        let look = |level: &crate::adaptive::Level| {
            unknowns.push(level.unknowns());
            Ok(true)
        };
        let (last, stop) = refined_until(&scene(&slab(c, ""))?, mesh, &wanted, look)?;
        let relative = last.solution.relative_bound(last.energy_norm);
        let why = stop.why(&last.solution);
        Ok((unknowns, stop, relative.unwrap_or_else(|| panic!("{c}: {why:?}"))))
    };
    let (unknowns, stop, part) = levels(0.0)?;
    assert!(unknowns.len() > 2 && stop == Stop::Reached && part <= 0.1, "{unknowns:?} {part}");
    for c in [273.15, 1.3e4] {
        let (others, stop, other) = levels(c)?;
        assert_eq!((others, stop), (unknowns.clone(), Stop::Reached));
        ZERO.check_relative(c, other, part);
    }
    Ok(())
}

/// In series u is 1 above the wall and 0 below it, where air is at −1: ‖A^½∇u‖² = 4, and ∫ h (u − u_ext)² = 4.
#[test]
fn the_norm_holds_what_a_transfer_law_dissipates() -> Result<()> {
    let text = transfer_wall("2", "pattern = \"1\", default = 0.0, range = [0.0, 1.0]");
    for cells in KINDS {
        let (_, problem) = on_grid(&text, grid(3, cells))?;
        let solution = solve(&problem, &Options::default())?;
        let norm = energy_norm::of_solution(&problem, &solution)?.expect("a norm");
        TRANSFER.check_relative(format_args!("{cells:?}"), norm, 8.0_f64.sqrt());
    }
    Ok(())
}

#[test]
fn of_a_constant_solution_no_part_is_told_or_asked_for() -> Result<()> {
    for c in [0.0, 0.1, 273.15] {
        let text = slab(c, "")
            .replace(" - 10*exp(-((x-0.5)/0.4)^2)", "")
            .replace("default = -1.0", "default = 0.0");
        let text =
            text.replace(" + 2 - 0.2*y^2", "").replace(" + 2", "").replace(" + 0.5 - 0.3*x^2", "");
        let text = text.replace("default = 0.2", "default = 0.0").replace("0.3*x", "0");
        let options = Options::default();
        let wanted = Wanted { goal: Goal::Part(0.05), most_unknowns: MOST_UNKNOWNS, options };
        let mesh = with_four_sides(grid(4, Cells::Mixed));
        let (last, stop) = refined_until(&scene(&text)?, mesh, &wanted, |_| Ok(true))?;
        assert_eq!((stop, last.number), (Stop::Constant, 0));
        let bound = last.solution.bound.expect("a bound");
        assert_eq!(last.solution.relative_bound(last.energy_norm), None, "{c}: {bound:?}");
    }
    Ok(())
}

#[test]
fn a_part_where_nothing_is_given_keeps_its_mean_of_0() -> Result<()> {
    let mut mesh = grid(3, Cells::Triangles);
    let count = mesh.vertices.len() as u32;
    mesh.vertices.extend(mesh.vertices.clone().iter().map(|[x, y]| [x + 5.0, *y]));
    mesh.triangles.extend(mesh.triangles.clone().iter().map(|cell| cell.map(|at| at + count)));
    let text = "
mesh = \"grid\"
material.default.conductivity = \"1\"
source.f = \"max(0, sign(x - 2))*(x - 5)\"
boundary.dirichlet = { kind = \"dirichlet\", value = \"273.15 + 0.1*x\" }
boundary.contact = { kind = \"contact\", gap = \"273\" }
boundary.default = { kind = \"neumann\", flux = \"0\" }
";
    let problem = Problem::new(&scene(text)?, mesh)?;
    let solution = solve(&problem, &Options::default())?;
    let beyond = |cell: &&[u32; 3]| cell[0] >= count;
    let mean =
        problem.mesh.triangles.iter().filter(beyond).map(|cell| {
            cell.iter().map(|&at| solution.certified.vertices[at as usize]).sum::<f64>()
        });
    let (sum, number) = mean.fold((0.0, 0.0), |(sum, number), of| (sum + of, number + 3.0));
    assert_eq!(solution.parts.floating, 1);
    assert!((sum / number).abs() < 1.0, "{}", sum / number);
    Ok(())
}

//! A full model with limits of the flux, tick after tick, against the direct solver; and what a baked module refuses.

use signorini_bake::full::{Baked, Controller};
use signorini_kernel::device::tick::Limits;
use signorini_kernel::discrete::rows::{QUADS, TRIANGLES};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::fixtures::on_grid;
use signorini_solve::outputs::outputs;
use signorini_solve::problem::Problem;
use signorini_solve::scalar::Scalar;
use signorini_solve::solve::{Options, SolverKind, solve};
use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{LIMITED_TICK, LIMITED_TICK_NARROW};

/// A heated face below keeps 2 with at most 6 per length, less towards its ends, and may cool by 1; u ≤ 3 on the right, air
/// on the left.
const HEATER: &str = r#"
mesh = "grid"
[material.default]
conductivity = ["2", "0.3", "1"]
[boundary.dirichlet]
kind = "dirichlet"
value = "2 - x/4"
[boundary.left]
kind = "robin"
coefficient = "3"
ambient = "0"
[boundary.right]
kind = "contact"
gap = "3"
flux = "-inf"
limit = "0.5*y"
[boundary.contact]
kind = "contact"
gap = "2"
flux = "-1"
limit = "6 - 3*x^2"
[input.air]
of = "left"
field = "ambient"
pattern = "1"
default = -3.0
[input.sun]
of = "source"
field = "f"
pattern = "1 - x"
[input.wanted]
of = "contact"
field = "gap"
pattern = "1"
[output.power]
kind = "flux"
of = "contact"
[output.short]
kind = "saturated"
of = "contact"
[output.kept]
kind = "length"
of = "contact"
[output.held]
kind = "force"
of = "right"
[output.skin]
kind = "mean"
of = "contact"
"#;

/// Inputs, among them some for each state alone, and back again.
const STEPS: [[f64; 3]; 7] = [
    [-3.0, 0.0, 0.0],
    [-40.0, 0.0, 0.0],
    [4.0, 6.0, 0.0],
    [-3.0, 0.0, 3.0],
    [2.0, 0.5, -0.2],
    [-12.0, 2.0, 0.1],
    [-3.0, 0.0, 0.0],
];

fn against_the_direct_solver<R: Scalar, const WIDTH: usize>(
    problem: &Problem,
    allowed: Tolerance,
) -> Result<()> {
    let baked = Baked::<R>::new(problem)?;
    assert!(baked.has_bound() && baked.features().contains(&"limited"));
    let mut controller = Controller::<R, WIDTH>::new(&baked);
    let (mut short, mut kept) = ([false; 2], [false; 2]);
    for values in STEPS {
        let narrowed: Vec<R> = values.iter().map(|&value| R::narrow(value)).collect();
        let limits = Limits { share: R::narrow(1e-9), ..Limits::default() };
        let (found, report) = controller.tick_within(&narrowed, limits).expect("a tick");
        let now = problem.with_inputs(&values)?;
        let options = Options { solver: SolverKind::Direct, ..Options::default() };
        let solution = solve(&now, &options)?;
        let expected = outputs(&now, &solution)?;
        for (output, found) in now.scene.outputs.iter().zip(&found) {
            let name = &output.name.value;
            let expected = expected[name].expect("a value");
            let size = expected.abs().max(2.0);
            allowed.check_over(format_args!("{name} {values:?}"), found.wide() - expected, size);
        }
        let gap = report.verdict.certificate().expect("a bound").duality_gap.wide();
        let bound = solution.bound.expect("a bound").duality_gap;
        allowed.check_relative(format_args!("gap {values:?}"), gap, bound);
        short[usize::from(found[1] > R::ZERO)] = true;
        kept[usize::from(found[2] > R::ZERO)] = true;
    }
    assert_eq!((short, kept), ([true; 2], [true; 2]));
    Ok(())
}

#[test]
fn a_heater_with_a_limit_is_ticked() -> Result<()> {
    let (_, problem) = on_grid(HEATER, grid(6, Cells::Triangles))?;
    against_the_direct_solver::<f64, TRIANGLES>(&problem, LIMITED_TICK)?;
    against_the_direct_solver::<f32, TRIANGLES>(&problem, LIMITED_TICK_NARROW)?;
    for cells in [Cells::Quads, Cells::Mixed] {
        let (_, problem) = on_grid(HEATER, grid(6, cells))?;
        against_the_direct_solver::<f64, QUADS>(&problem, LIMITED_TICK)?;
    }
    Ok(())
}

#[test]
fn an_infinite_end_has_no_inputs() -> Result<()> {
    let endless = HEATER.replace("field = \"gap\"", "field = \"flux\"");
    let endless =
        endless.replace("of = \"contact\"\nfield = \"flux\"", "of = \"right\"\nfield = \"flux\"");
    let error = on_grid(&endless, grid(2, Cells::Triangles)).err().map(|error| error.to_string());
    let said = error.unwrap_or_default();
    assert!(said.contains("boundary.right.flux is -inf, to which nothing can be added"), "{said}");
    Ok(())
}

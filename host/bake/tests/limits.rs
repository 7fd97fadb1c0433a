//! A full model with limits of the flux, tick after tick, against the direct solver; and what a baked module refuses.

use crate::direct::{Beside, HEATER};
use signorini_kernel::rows::{QUADS, TRIANGLES};
use signorini_problem::Problem;
use signorini_problem::fixtures::{changed, on_grid};
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{LIMITED_TICK, LIMITED_TICK_NARROW};

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
    let steps = STEPS.map(Vec::from).into();
    let beside =
        Beside { problem, feature: "limited", steps, least: |_| 2.0, is_undefined: |_, _| false };
    let (mut short, mut kept) = ([false; 2], [false; 2]);
    beside.ticks::<R, WIDTH>(allowed, |found, _, _| {
        short[usize::from(found[1] > R::ZERO)] = true;
        kept[usize::from(found[2] > R::ZERO)] = true;
    })?;
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
    let inputs = [("of = \"contact\", field = \"gap\"", "of = \"right\", field = \"flux\"")];
    let endless = changed(HEATER, &inputs);
    let error = on_grid(&endless, grid(2, Cells::Triangles)).err().map(|error| error.to_string());
    let said = error.unwrap_or_default();
    assert!(said.contains("boundary.right.flux is -inf, to which nothing can be added"), "{said}");
    Ok(())
}

//! Heat through a boundary whose coefficient is an input.

use crate::outputs::outputs;
use crate::{Options, SolverKind, solve};
use signorini_problem::fixtures::{on_grid, transfer_wall};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::TRANSFER;

/// In series: 1/R = 1/(1/h + 1/2) over a width of 2 and a drop of 2.
#[test]
fn a_wall_passes_what_its_resistances_let_through() -> Result<()> {
    let wall = on_grid(
        &transfer_wall("0", "pattern = \"1\", default = 4.0, range = [0.0, 100.0]"),
        grid(4, Cells::Mixed),
    )?
    .1;
    for h in [4.0, 0.0, 1e-3, 1.0, 100.0] {
        let now = wall.with_inputs(&[h])?;
        for solver in [SolverKind::Kernel, SolverKind::Direct] {
            let solution = solve(&now, &Options::by(solver))?;
            let values = outputs(&now, &solution)?;
            let per_length = h * 2.0 / (h + 2.0);
            let [heat, skin] = ["heat", "skin"].map(|name| values[name].expect("a value"));
            TRANSFER.check(format_args!("h = {h}, {solver:?}"), heat + 2.0 * 2.0 * per_length);
            TRANSFER.check(format_args!("h = {h}, {solver:?}"), skin - (1.0 - per_length));
        }
    }
    Ok(())
}

//! Transfer coefficients that 8 points of an edge do not see have a bound: above the error, near it at the solution.

use super::limits_bound::Certified;
use super::*;
use signorini_problem::fixtures::{SMOOTH, changed, on_grid};
use signorini_scene::mesh::structured::{Cells, grid};

/// SMOOTH, whose solution stays that of any h where u_ext = u + σ·n/h.
#[test]
fn a_step_of_the_transfer_coefficient_has_a_bound() -> Result<()> {
    for (h, near) in [("2 + sign(y - 0.1)", 1.5), ("2 + 40*exp(-((y - 0.3)/0.004)^2)", 1.5)] {
        let ambient = format!("ambient = \"y + y^2 - 1 + (3*y - 6.5)/({h})\"");
        let text = changed(
            SMOOTH,
            &[
                ("coefficient = \"2+y\"", &format!("coefficient = \"{h}\"")),
                ("ambient = \"y + y^2 - 1 + (3*y - 6.5)/(2+y)\"", &ambient),
            ],
        );
        for cells in [Cells::Triangles, Cells::Quads] {
            let certified = Certified::of(on_grid(&text, grid(8, cells))?.1)?;
            let x = certified.model.solve(&certified.model.defaults).expect("a solution");
            let [bound, combined, _] = certified.at(h, &x)?;
            assert!(bound < near * combined, "{h} {cells:?}: {bound} {combined}");
        }
    }
    Ok(())
}

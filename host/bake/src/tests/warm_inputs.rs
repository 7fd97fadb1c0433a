//! Inputs that change from tick to tick where contact alone holds the domain, and every tick is a warm solve.

use super::direct::played;
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::{Options, solve};

const HELD_BY_CONTACT: &str = r#"mesh = "grid"
material.default.conductivity = "1"
source.f = "-1"
boundary.contact = { kind = "contact" }
boundary.default = { kind = "neumann", flux = "0" }
input.rain = { of = "source", field = "f", pattern = "-x^2", default = 0.0 }
"#;

/// The oscillation of −1 is 0, and that of −1 − x² is not: it belongs to the tick's own bound.
#[test]
fn a_bound_is_that_of_the_inputs_of_its_tick() -> Result<()> {
    let (_, problem) = on_grid(HELD_BY_CONTACT, grid(4, Cells::Triangles))?;
    let ticks = played(&problem, &[vec![0.0], vec![1.0]])?;
    let [dry, wet] = [0, 1].map(|at| ticks[at].bound.expect("a bound").oscillation);
    let found = solve(&problem.with_inputs(&[1.0])?, &Options::default())?;
    let expected = found.bound.expect("a bound").oscillation;
    assert!(dry < 1e-12 && expected > 1e-3, "{dry} {expected}");
    assert!((wet / expected - 1.0).abs() < 1e-12, "{wet} {expected}");
    Ok(())
}

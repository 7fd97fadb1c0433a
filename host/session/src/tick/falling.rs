//! A gap that falls by less than the tolerance of a tick: what touches it goes with it.

use super::{Begin, Budget, ScheduledTick, play_on};
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};

const SINKING: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
source.f = "-8"
boundary.dirichlet = { kind = "robin", coefficient = "1", ambient = "1" }
boundary.contact = { kind = "contact", gap = "-1e-8*t" }
output.force = { kind = "force" }
"#;

/// Played in one go and from a saved state, the force stays what it is, though no tick takes a sweep.
#[test]
fn contact_goes_with_a_gap_that_falls_by_less_than_the_tolerance() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Mixed] {
        let (scene, problem) = on_grid(SINKING, grid(4, cells))?;
        let budget = Budget { tolerance: Some(1e-6), intervals: false, ..Budget::of(&scene) };
        let at = |time: u32| ScheduledTick { time: f64::from(time), inputs: Vec::new() };
        let forces = |begin, ticks: std::ops::Range<u32>| -> Result<_> {
            let moments: Vec<_> = ticks.map(at).collect();
            let played = play_on(&problem, begin, &moments, &budget, |_, _| Ok(()))?;
            let forces = played.ticks.iter().map(|tick| tick.outputs[0].expect("a force"));
            Ok((forces.collect::<Vec<_>>(), played.saved.expect("a state")))
        };
        let (first, saved) = forces(Begin::Anew(None), 0..4)?;
        let (then, _) = forces(Begin::From(&saved), 4..8)?;
        assert!(first[0] > 1.0, "contact holds: {first:?}");
        for force in first.iter().chain(&then) {
            assert!((force - first[0]).abs() < 1e-4, "{cells:?}: {first:?} {then:?}");
        }
    }
    Ok(())
}

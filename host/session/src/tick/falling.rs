//! A gap that falls by less than the tolerance of a tick: what touches it goes with it.

use super::{Begin, Budget, ScheduledTick, play, play_on};
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

/// A gap that is gone says that there is no contact: u stays near, and is nothing that overflows.
#[test]
fn what_touched_does_not_follow_a_gap_that_is_gone() -> Result<()> {
    for far in ["1e6", "1e308"] {
        let gone = SINKING.replace("-1e-8*t", &format!("-{far}*max(0, t - 0.5)"));
        let (scene, problem) = on_grid(&gone, grid(4, Cells::Mixed))?;
        let budget = Budget { tolerance: Some(1e-8), intervals: false, ..Budget::of(&scene) };
        let at = |time: u32| ScheduledTick { time: f64::from(time), inputs: Vec::new() };
        let moments = [0, 1, 2].map(at);
        let ticks = play(&problem, None, &moments, &budget, |_, _| Ok(()))?;
        let forces: Vec<_> = ticks.iter().map(|tick| tick.outputs[0]).collect();
        assert!(ticks.iter().all(|tick| !tick.failed()), "{far}: {forces:?}");
        assert!(forces[0] > Some(1.0) && forces[1..] == [Some(0.0); 2], "{far}: {forces:?}");
    }
    Ok(())
}

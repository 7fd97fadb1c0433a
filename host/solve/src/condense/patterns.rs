//! The scene taken apart: everything on the right-hand side is a sum of fixed patterns times inputs.
//!
//! p = (1, p₁ … p_{m−1}): pattern 0 is what the boundary and source tables say, with every input at 0;
//! pattern j is what `[input.…]` j adds for the value 1, on a scene whose own loads are 0. Each is a
//! scene of its own, so that loads, chords, deviations and oscillations come from where they always do.

use crate::certify::ends::Ends;
use crate::certify::{Data, NoBound};
use crate::problem::{Loads, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_scene::scene::term::{left_with, refuse_time};

/// One pattern.
pub(super) struct Pattern {
    /// The scene in which only this pattern is alive.
    pub scene: Scene,
    pub loads: Loads,
    pub ends: Ends,
    /// √Σ osc², see [`crate::certify::oscillation`], and what is left out of ψ and u_D.
    pub oscillation: f64,
    /// Why it allows for no bound.
    pub no_bound: Option<NoBound>,
}

impl Pattern {
    fn new(scene: Scene, problem: &Problem) -> Result<Self> {
        let loads = Loads::at_time(&scene, problem, 0.0)?;
        let ends = Ends::at_time(&scene, problem, 0.0)?;
        let data = Data::<f64>::new(&scene, problem)?;
        let (oscillation, no_bound) = (data.oscillation(), data.no_bound().cloned());
        Ok(Self { scene, loads, ends, oscillation, no_bound })
    }
}

/// The patterns of `scene`: the constant one, then one an input.
///
/// # Errors
/// A load that changes with t, data that are not finite.
pub(super) fn patterns(scene: &Scene, problem: &Problem) -> Result<Vec<Pattern>> {
    refuse_time(scene)?;
    let terms = 0..=scene.inputs.len();
    terms.map(|term| Pattern::new(left_with(scene, &[term]), problem)).collect()
}

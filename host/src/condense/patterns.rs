//! The scene taken apart: everything on the right-hand side is a sum of fixed patterns times inputs.
//!
//! p = (1, p₁ … p_{m−1}): pattern 0 is what the boundary and source tables say, with every input at 0;
//! pattern j is what `[input.…]` j adds for the value 1, on a scene whose own loads are 0. Each is a
//! scene of its own, so that loads, chords, deviations and oscillations come from where they always do.

use crate::certify::ends::Ends;
use crate::certify::oscillation::oscillation;
use crate::error::Result;
use crate::expression::Expression;
use crate::problem::{Loads, Problem};
use crate::scene::{Condition, Located, Scene};

/// One pattern.
pub(super) struct Pattern {
    /// The scene in which only this pattern is alive.
    pub scene: Scene,
    pub loads: Loads,
    pub ends: Ends,
    /// √Σ osc², see [`crate::certify::oscillation`].
    pub oscillation: f64,
}

impl Pattern {
    fn new(scene: Scene, problem: &Problem) -> Result<Self> {
        let loads = Loads::at_time(&scene, problem, 0.0)?;
        let ends = Ends::at_time(&scene, problem, 0.0)?;
        let squares = oscillation(&scene, problem, 0.0)?.into_iter().map(|osc| osc * osc);
        Ok(Self { scene, loads, ends, oscillation: squares.sum::<f64>().sqrt() })
    }
}

/// The patterns of `scene`: the constant one, then one an input.
///
/// # Errors
/// A load that changes with t, data that are not finite.
pub(super) fn patterns(scene: &Scene, problem: &Problem) -> Result<Vec<Pattern>> {
    let mut base = with_inputs(scene, None);
    if let Some(load) = loads(&mut base).into_iter().find(|load| load.value.uses_time()) {
        let message = "changes with t, which a condensed model does not know";
        let hint = "declare an [input.…] with the part in x and y as its pattern, and set its value each \
                    tick";
        return Err(scene.error(load, message).hint(hint).into());
    }
    let inputs = (0..scene.inputs.len()).map(|alive| {
        let mut scene = with_inputs(scene, Some(alive));
        loads(&mut scene).into_iter().for_each(|load| load.value = Expression::constant(0.0));
        scene
    });
    std::iter::once(base.clone()).chain(inputs).map(|scene| Pattern::new(scene, problem)).collect()
}

/// The scene with input `alive` at 1 and the others at 0.
fn with_inputs(scene: &Scene, alive: Option<usize>) -> Scene {
    let mut scene = scene.clone();
    for (at, input) in scene.inputs.iter_mut().enumerate() {
        input.default = if alive == Some(at) { 1.0 } else { 0.0 };
    }
    scene
}

/// All expressions on the right-hand side.
fn loads(scene: &mut Scene) -> Vec<&mut Located<Expression>> {
    let mut loads = vec![&mut scene.source];
    for boundary in &mut scene.boundaries {
        match &mut boundary.condition {
            Condition::Dirichlet { value } => loads.push(value),
            Condition::Neumann { flux } => loads.push(flux),
            Condition::Robin { ambient, .. } => loads.push(ambient),
            Condition::Contact { gap, flux } => loads.extend([gap, flux]),
        }
    }
    loads
}

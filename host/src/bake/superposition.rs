//! Loads and boundary data as a sum over inputs: base + Σ value · pattern, each part by itself.
//!
//! All data are linear in the inputs, so each part is what the rest of the host computes for a scene in
//! which only that part is left.

use crate::certify::Data;
use crate::certify::curved::{Curved, curved};
use crate::certify::ends::Ends;
use crate::certify::oscillation::oscillation;
use crate::certify::robin::{RobinPoints, robin};
use crate::error::Result;
use crate::expression::Expression;
use crate::problem::{Loads, Problem};
use crate::scene::{Condition, Located, Scene};

/// A part of the data: 0 is the base, 1 + j what one unit of input j adds.
pub type Term = usize;

/// The data of one part.
#[derive(Debug, Clone)]
pub struct Part {
    /// Integrals and means.
    pub loads: Loads,
    /// ψ and u_D at the ends of edges.
    pub ends: Ends,
    /// Edges on which ψ or u_D is not affine.
    pub curved: Vec<Curved>,
    /// h and u_ext along the transfer edges.
    pub transfer: Vec<RobinPoints>,
    /// √Σ osc²
    pub oscillation: f64,
    /// Whether these data allow for a bound.
    pub has_bound: bool,
}

/// The base and every input's part, in the order of the terms.
///
/// # Errors
/// A load that depends on t; data that are not finite.
pub fn parts(scene: &Scene, problem: &Problem) -> Result<Vec<Part>> {
    refuse_time(scene)?;
    (0..=scene.inputs.len()).map(|term| Part::new(scene, problem, term)).collect()
}

impl Part {
    fn new(scene: &Scene, problem: &Problem, term: Term) -> Result<Self> {
        let (scene, problem) = (&left_with(scene, &[term]), &mut problem.clone());
        problem.loads = Loads::at_time(scene, problem, 0.0)?;
        let squares = oscillation(scene, problem, 0.0)?.iter().map(|osc| osc * osc).sum::<f64>();
        Ok(Self {
            ends: Ends::at_time(scene, problem, 0.0)?,
            curved: curved(scene, problem, 0.0)?,
            transfer: robin(scene, problem, 0.0)?,
            oscillation: squares.sqrt(),
            has_bound: Data::<f64>::new(scene, problem)?.has_bound(),
            loads: std::mem::take(&mut problem.loads),
        })
    }
}

/// The curved edges where both terms act together, one unit of each.
///
/// # Errors
/// Data that are not finite.
pub fn curved_pair(scene: &Scene, problem: &Problem, pair: [Term; 2]) -> Result<Vec<Curved>> {
    curved(&left_with(scene, &pair), problem, 0.0)
}

/// `scene` with one unit of each of these terms and nothing else.
fn left_with(scene: &Scene, terms: &[Term]) -> Scene {
    let mut scene = scene.clone();
    for (at, input) in scene.inputs.iter_mut().enumerate() {
        input.default = if terms.contains(&(at + 1)) { 1.0 } else { 0.0 };
    }
    if !terms.contains(&0) {
        each_load(&mut scene, |load| load.value = Expression::constant(0.0));
    }
    scene
}

fn each_load(scene: &mut Scene, mut each: impl FnMut(&mut Located<Expression>)) {
    each(&mut scene.source);
    for boundary in &mut scene.boundaries {
        match &mut boundary.condition {
            Condition::Dirichlet { value } => each(value),
            Condition::Neumann { flux } => each(flux),
            Condition::Robin { ambient, .. } => each(ambient),
            Condition::Contact { gap, flux } => {
                each(gap);
                each(flux);
            }
        }
    }
}

/// Firmware has no clock of the scene's.
fn refuse_time(scene: &Scene) -> Result<()> {
    let mut culprit = None;
    each_load(&mut scene.clone(), |load| {
        if load.value.uses_time() && culprit.is_none() {
            culprit = Some(load.clone());
        }
    });
    let Some(culprit) = culprit else { return Ok(()) };
    let message = format!("{} depends on t, which a baked scene does not have", culprit.value);
    let hint = "declare an [input.…] for what changes, and set it every tick";
    Err(scene.error(&culprit, message).hint(hint).into())
}

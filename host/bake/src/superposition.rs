//! Loads and boundary data as a sum over inputs: base + Σ value · pattern, each part by itself.
//!
//! All data are linear in the inputs, so each part is what the rest of the host computes for a scene in
//! which only that part is left.

use signorini_scene::error::Result;
use signorini_scene::scene::term::{Term, left_with};
use signorini_solve::certify::Evaluated;
use signorini_solve::certify::curved::{Curved, curved};
use signorini_solve::certify::ends::Ends;
use signorini_solve::certify::robin::RobinPoints;
use signorini_solve::problem::{Loads, Problem};

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
    /// √Σ osc², and what is left out of ψ and u_D.
    pub oscillation: f64,
    /// Whether these data allow for a bound.
    pub has_bound: bool,
}

/// The base and every input's part, in the order of the terms.
///
/// # Errors
/// Data that are not finite.
pub fn parts(problem: &Problem) -> Result<Vec<Part>> {
    (0..=problem.scene.inputs.len()).map(|term| Part::new(problem, term)).collect()
}

impl Part {
    fn new(problem: &Problem, term: Term) -> Result<Self> {
        let problem = problem.left_with(&[term])?;
        let Evaluated { ends, curved, transfer, oscillation, no_bound } = Evaluated::new(&problem)?;
        let has_bound = no_bound.is_none();
        Ok(Self { ends, curved, transfer, oscillation, has_bound, loads: problem.loads })
    }
}

/// The curved edges where both terms act together, one unit of each.
///
/// # Errors
/// Data that are not finite.
pub fn curved_pair(problem: &Problem, pair: [Term; 2]) -> Result<Vec<Curved>> {
    // They have no use for loads.
    curved(&problem.restated(left_with(&problem.scene, &pair)), 0.0)
}

//! The scene taken apart: everything on the right-hand side is a sum of fixed patterns times inputs.
//!
//! p = (1, p₁ … p_{m−1}): pattern 0 is what the boundary and source tables say, with every input at 0;
//! pattern j is what `[input.…]` j adds for the value 1, on a scene whose own loads are 0. Each is a
//! scene of its own, so that loads, chords, deviations and oscillations come from where they always do.

use signorini_certify::ends::Ends;
use signorini_certify::{Evaluated, NoBound};
use signorini_problem::{Loads, Problem};
use signorini_scene::error::Result;

/// One pattern.
#[derive(Clone)]
pub(super) struct Pattern {
    /// The problem in which only this pattern is alive, with its loads.
    pub problem: Problem,
    pub ends: Ends,
    /// √Σ osc², see [`signorini_certify::oscillation`], and what is left out of ψ and u_D.
    pub oscillation: f64,
    /// Why it allows for no bound.
    pub no_bound: Option<NoBound>,
}

impl Pattern {
    /// None of the terms: the pattern of what is no load of the scene.
    pub fn silent(problem: &Problem) -> Result<Self> {
        Self::new(problem.left_with(&[])?)
    }

    fn new(problem: Problem) -> Result<Self> {
        let Evaluated { ends, oscillation, no_bound, .. } = Evaluated::of_term(&problem)?;
        Ok(Self { problem, ends, oscillation, no_bound })
    }

    /// Its integrals and means.
    pub fn loads(&self) -> &Loads {
        &self.problem.loads
    }
}

/// The patterns of a problem: the constant one, then one an input.
///
/// # Errors
/// Data that are not finite.
pub(super) fn patterns(problem: &Problem) -> Result<Vec<Pattern>> {
    let terms = 0..=problem.scene.inputs.len();
    terms.map(|term| Pattern::new(problem.left_with(&[term])?)).collect()
}

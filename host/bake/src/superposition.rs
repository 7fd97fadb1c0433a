//! Loads and boundary data as a sum over inputs: base + Σ value · pattern, each part by itself.
//!
//! All data but h u_ext are linear in the inputs, so each part is what the rest of the host computes for a scene in which
//! only that part is left. Where inputs change h, all parts have the h that the scene states, and what inputs add to it is a
//! pattern with products ([`TransferPattern`]).
//!
//! What 8 points miss of u_ext weighs √h, and whether h allows for a bound is a comparison of h at two points of an edge,
//! linear in the inputs: both are judged at all corners of the ranges of such inputs.

use signorini_certify::Evaluated;
use signorini_certify::curved::{Curved, curved};
use signorini_certify::ends::Ends;
use signorini_certify::robin::{RobinPoints, robin};
use signorini_problem::{Loads, Problem, RangeTerm, TransferPattern};
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::term::{Term, left_with};
use signorini_scene::scene::{Field, Input, Scene};

/// Inputs of transfer coefficients that a scene may have: every term is evaluated at the 2⁸ corners of their ranges.
const MOST_COEFFICIENTS: usize = 8;

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
    /// What the part adds to h, where it is an input that does.
    pub coefficient: Option<TransferPattern>,
    /// What the part adds to the ranges of contact fluxes, where inputs change an end of one.
    pub range: Option<RangeTerm>,
}

/// The base and every input's part, in the order of the terms.
///
/// # Errors
/// Data that are not finite, too many inputs of transfer coefficients.
pub fn parts(problem: &Problem) -> Result<Vec<Part>> {
    let mut coefficients = problem.scene.inputs.iter().filter(|input| changes_transfer(input));
    if let Some(beyond) = coefficients.nth(MOST_COEFFICIENTS) {
        let message = format!(
            "more than {MOST_COEFFICIENTS} inputs change transfer coefficients: the error bound is worked out at every \
             corner of their ranges, and each input doubles their number"
        );
        let hint = "let one input change what changes together";
        return Err(problem.scene.error(&beyond.field, message).hint(hint).into());
    }
    (0..=problem.scene.inputs.len()).map(|term| Part::new(problem, term)).collect()
}

impl Part {
    fn new(problem: &Problem, term: Term) -> Result<Self> {
        let input = term.checked_sub(1).filter(|&at| changes_transfer(&problem.scene.inputs[at]));
        let coefficient = input.map(|at| problem.transfer_pattern(at)).transpose()?;
        let alone = problem.restated(as_stated(&problem.scene)).left_with(&[term])?;
        let mut corners = corners(&alone.scene).map(|scene| Evaluated::new(&alone.restated(scene)));
        // Without such inputs there is one corner, the scene itself.
        let first = corners.next().unwrap_or_else(|| Evaluated::new(&alone))?;
        let data = corners.try_fold(first, |worst, there| {
            let there = there?;
            let oscillation = worst.oscillation.max(there.oscillation);
            let no_bound = worst.no_bound.or(there.no_bound);
            Ok::<_, Error>(Evaluated { oscillation, no_bound, ..there })
        })?;
        let is_end = problem.scene.limit_input().is_some();
        let range = is_end.then(|| problem.range_term(term)).transpose()?;
        // Which share of the mean hi − lo keeps along an edge depends on the inputs then.
        let keeps = range.as_ref().is_none_or(|range| !range.varies);
        Ok(Self {
            ends: data.ends,
            curved: data.curved,
            transfer: robin(&alone, alone.time)?,
            oscillation: data.oscillation,
            has_bound: data.no_bound.is_none() && keeps,
            coefficient,
            range,
            loads: alone.loads,
        })
    }

    /// What it adds to the bases of contact fluxes.
    pub fn contact_flux(&self) -> &[f64] {
        self.range.as_ref().map_or(&self.loads.contact_flux, |range| &range.fluxes)
    }

    /// What it adds to their spans; for the base these are the spans.
    pub fn spans(&self) -> &[f64] {
        self.range.as_ref().map_or(&self.loads.spans, |range| &range.spans)
    }

    /// Whether h and u_ext are constant along every edge.
    pub fn is_uniform(&self) -> bool {
        let mut added = self.coefficient.iter().flat_map(|of| &of.points);
        self.transfer.iter().all(|edge| edge.iter().all(|point| *point == edge[0]))
            && added.all(|edge| edge.iter().all(|h| *h == edge[0]))
    }
}

fn changes_transfer(input: &Input) -> bool {
    input.field.value == Field::Coefficient
}

/// `scene` with the coefficients that no input changes.
fn as_stated(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let inputs = scene.inputs.iter_mut().filter(|input| changes_transfer(input));
    inputs.for_each(|input| input.default = 0.0);
    scene
}

/// `scene` with the inputs of coefficients at all corners of their ranges.
fn corners(scene: &Scene) -> impl Iterator<Item = Scene> {
    let inputs = scene.inputs.iter().filter(|input| changes_transfer(input)).count();
    (0..1_usize << inputs).map(|corner| {
        let mut scene = scene.clone();
        let inputs = scene.inputs.iter_mut().filter(|input| changes_transfer(input));
        for (at, input) in inputs.enumerate() {
            input.default = input.interval()[(corner >> at) & 1];
        }
        scene
    })
}

/// The curved edges where both terms act together, one unit of each.
///
/// # Errors
/// Data that are not finite.
pub fn curved_pair(problem: &Problem, pair: [Term; 2]) -> Result<Vec<Curved>> {
    // They have no use for loads.
    curved(&problem.restated(left_with(&problem.scene, &pair)), 0.0)
}

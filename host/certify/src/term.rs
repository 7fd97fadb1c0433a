//! The data of a scene as a sum over its inputs: base + Σ value · unit, each term by itself.
//!
//! All data but h u_ext are linear in the inputs, so each term is what the rest of the host computes for a scene in which
//! only that term is left: loads, chords, deviations and oscillations. A condensed model takes h as it stands. Where inputs
//! of a full model change h, all terms have the h that the scene states, and what inputs add to it is a pattern with products
//! ([`TransferPattern`]).
//!
//! What 8 points miss of u_ext weighs √h, in a condensed model too, and whether h allows for a bound is a comparison of h at two points of an edge,
//! linear in the inputs: both are judged at all corners of the ranges of such inputs.
//!
//! The flux of a contact edge goes from a base, which loads contain, over a span to its other end. Where no input changes an
//! end, the base is the smaller end, so that no digit is lost beside a huge one. Where one does, either may be the smaller
//! one: the base is the lower end then, wherever that is finite.

use super::curved::{Curved, curved};
use super::data::Evaluated;
use super::ends::{Ends, of_moved};
use super::no_bound::NoBound;
use super::robin::{RobinPoints, robin};
use signorini_problem::{Loads, Problem, Room, TransferPattern, rooms};
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::term::{Term, left_with};
use signorini_scene::scene::{Field, Input, Scene};

/// Inputs of transfer coefficients that a scene may have: every term is evaluated at the 2⁸ corners of their ranges.
const MOST_COEFFICIENTS: usize = 8;

/// The data of one term.
#[derive(Debug, Clone)]
pub struct TermData {
    /// The problem in which this term alone is left, with its loads: the base of each flux is that of the sum.
    pub problem: Problem,
    /// ψ and u_D at the ends of edges.
    pub ends: Ends,
    /// Edges on which ψ or u_D is not affine.
    pub curved: Vec<Curved>,
    /// h and u_ext along the transfer edges.
    pub transfer: Vec<RobinPoints>,
    /// √Σ osc², see [`super::oscillation`], and what is left out of ψ and u_D.
    pub oscillation: f64,
    /// Why the term allows for no bound.
    pub no_bound: Option<NoBound>,
    /// The amount that the term adds to h, where it is an input that does.
    pub coefficient: Option<TransferPattern>,
    /// What the term adds to the spans of contact fluxes, with an entry for each contact edge; of the base, nothing where all
    /// are ∞.
    pub spans: Vec<f64>,
}

/// The terms of a full model: the base and one for each input, in their order.
///
/// # Errors
/// Data that are not finite, too many inputs of transfer coefficients.
pub fn full_terms(problem: &Problem) -> Result<Vec<TermData>> {
    let mut coefficients = problem.scene.inputs.iter().filter(|input| changes_transfer(input));
    if let Some(beyond) = coefficients.nth(MOST_COEFFICIENTS) {
        let message = format!(
            "more than {MOST_COEFFICIENTS} inputs change transfer coefficients: the error bound is worked out at every \
             corner of their ranges, and each input doubles their number"
        );
        let hint = "let one input change what changes together";
        return Err(problem.scene.error(&beyond.field, message).hint(hint).into());
    }
    let term = |term: Term| {
        let alone = problem.restated(as_stated(&problem.scene)).left_with(&[term])?;
        let mut data = at_all_corners(&alone)?;
        if term == 0 {
            data.oscillation += 2.0 * of_moved(problem, &problem.moved_at_most());
        }
        let input = term.checked_sub(1).filter(|&at| changes_transfer(&problem.scene.inputs[at]));
        Ok(TermData {
            transfer: robin(&alone)?,
            coefficient: input.map(|at| problem.transfer_pattern(at)).transpose()?,
            ..TermData::new(problem, term, alone, data)?
        })
    };
    (0..=problem.scene.inputs.len()).map(term).collect()
}

/// The terms of a condensed model: the base and one for each input, in their order.
///
/// # Errors
/// Data that are not finite.
pub fn condensed_terms(problem: &Problem) -> Result<Vec<TermData>> {
    let term = |term: Term| {
        let alone = problem.left_with(&[term])?;
        let mut data = Evaluated::of_term(&alone)?;
        if alone.scene.inputs.iter().any(changes_transfer) {
            data.oscillation = at_all_corners(&alone)?.oscillation;
        }
        TermData::new(problem, term, alone, data)
    };
    (0..=problem.scene.inputs.len()).map(term).collect()
}

/// Room that inputs leave in the ranges of contact fluxes, from all terms of a model.
pub fn rooms_of(problem: &Problem, terms: &[TermData]) -> Vec<Room> {
    if problem.scene.limit_input().is_none() {
        return Vec::new();
    }
    let counts = problem.topology.counts;
    let ends: Vec<[&[f64]; 2]> =
        terms.iter().map(|term| [&term.loads().contact_flux[..], &term.spans[..]]).collect();
    rooms(&problem.lengths[counts.free..counts.unknowns()], &ends)
}

impl TermData {
    /// None of the terms of a condensed model, for what is no load of the scene.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn silent(problem: &Problem) -> Result<Self> {
        let alone = problem.left_with(&[])?;
        let data = Evaluated::of_term(&alone)?;
        Ok(Self::of(alone, data, Vec::new()))
    }

    fn new(problem: &Problem, term: Term, mut alone: Problem, data: Evaluated) -> Result<Self> {
        if problem.scene.limit_input().is_none() {
            let spans = match term {
                0 => alone.loads.spans.clone(),
                _ => vec![0.0; problem.topology.counts.contact],
            };
            return Ok(Self::of(alone, data, spans));
        }
        let range = problem.range_term(term)?;
        alone.loads.contact_flux = range.fluxes;
        let of_ranges = || NoBound::of_ranges(problem).filter(|_| term == 0);
        let no_bound = data.no_bound.clone().or_else(of_ranges);
        Ok(Self { no_bound, ..Self::of(alone, data, range.spans) })
    }

    fn of(problem: Problem, data: Evaluated, spans: Vec<f64>) -> Self {
        let Evaluated { ends, curved, transfer, oscillation, no_bound, .. } = data;
        Self { problem, ends, curved, transfer, oscillation, no_bound, coefficient: None, spans }
    }

    /// Integrals and means.
    pub fn loads(&self) -> &Loads {
        &self.problem.loads
    }

    /// Whether a full model with these data has a bound.
    pub fn has_bound(&self) -> bool {
        self.no_bound.is_none()
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

/// The data of a term with the most oscillation, and the first reason for no bound, of any coefficients within their ranges.
fn at_all_corners(alone: &Problem) -> Result<Evaluated> {
    let mut corners = corners(&alone.scene).map(|scene| at_corner(&alone.restated(scene)));
    // Without such inputs there is one corner, the scene itself.
    let first = corners.next().unwrap_or_else(|| at_corner(alone))?;
    corners.try_fold(first, |worst, there| {
        let there = there?;
        let oscillation = worst.oscillation.max(there.oscillation);
        let no_bound = worst.no_bound.or(there.no_bound);
        Ok::<_, Error>(Evaluated { oscillation, no_bound, ..there })
    })
}

/// The data of a term at a corner: there is no bound where an input changes an h that points do not see.
fn at_corner(alone: &Problem) -> Result<Evaluated> {
    let data = Evaluated::of_term(alone)?;
    let changed = NoBound::of_changed_transfer(alone, &data.forms.laws);
    Ok(Evaluated { no_bound: data.no_bound.or(changed), ..data })
}

/// `scene` with the inputs of coefficients at all corners of their ranges: once where there are none.
pub fn corners(scene: &Scene) -> impl Iterator<Item = Scene> {
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
    curved(&problem.restated(left_with(&problem.scene, &pair)))
}

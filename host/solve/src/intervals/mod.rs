//! Intervals of outputs: where a force, a flux or a mean of the exact solution lies, in its own unit.
//!
//! ```text
//!   output ─► goal ─► a linear dual problem on the same mesh ─► z and ζ ─► products with the residual ─► interval
//! ```
//! Of s and τ, which the error bound T is about, and of the weights z and ζ of a linear output J (`goal`) follows
//! ```text
//!   {…} = ½⟨τ − A∇s, ζ + A∇z⟩ + ⟨σ − Σ, ζ − A∇z⟩ + ∫_C (σ − τ)·n z′ − ∫_C ζ′ (u − s),      Σ = ½(τ + A∇s)
//! ```
//! The first product is known. ‖σ − Σ‖² = M² − K/2 with M² = ½T² − ¼‖τ − A∇s‖² (Prager and Synge), where K ≥ 0 is what the
//! identity of the bound has on C, and c K/2 bounds the rest (`contact`). The largest value over all K is
//! ```text
//!   ‖ζ − A∇z‖ M,  or where c > ‖ζ − A∇z‖/2M:   c M² + ‖ζ − A∇z‖²/4c.
//! ```
//! Without contact near the output c is 0, and this is of second order, as the error of an output is. Near the end of a contact zone
//! c and ‖ζ − A∇z‖ cannot both be small, and the order is 4/3.

mod contact;
mod dual;
mod estimate;
mod exact;
mod goal;
mod part;
mod products;
#[cfg(test)]
mod tests;
mod values;
pub mod weights;

use std::collections::BTreeMap;

use serde::Serialize;

use crate::certify::curved::followed;
use crate::certify::deviation::Deviations;
use crate::certify::{CertifiedFields, ErrorBound};
use crate::functional::wanted;
use crate::problem::Problem;
use crate::solve::{ScalarKind, SharedFactor, Solution, times};
use crate::threads::on_two_threads;
pub use estimate::estimate;
pub use goal::described;

use contact::{ContactEdge, contact_edges};
use dual::{Dual, Weights};
use goal::Goal;
use products::{Products, Residual};
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity};
use values::{INTEGRATED, Value};

/// Beyond so many unknowns no intervals are worked out: each takes some factors of its own.
pub const MOST_UNKNOWNS: usize = 200_000;

/// Parts c that are tried, and by how much each is larger than the last.
const TRIALS: usize = 8;
const STEP: f64 = 2.5;

/// How far ζ·n may go beyond its usual size on a contact edge, where z is to keep its value: little enough to lose no digit beside.
const FAR: f64 = 1e4;

/// Roundings of the scalar that sums may be off, next to their terms.
const ROUNDINGS: f64 = 512.0;

/// Why an output has no interval where one of its ends is infinite.
const UNBOUNDED: &str = "nothing bounds it from both sides: its boundary meets another one that takes flux too, and no \
                         energy tells one flux from the other there";

/// Where the value of an output lies for the exact solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutputBound {
    /// Its middle, in the unit of the output.
    pub center: f64,
    /// Half of its width: the exact value is not farther from the middle.
    pub plus_minus: f64,
    /// What it is the value of.
    pub of: String,
    /// How far its value on this mesh is from that on the mesh refined once; no guarantee. None for large meshes.
    pub estimate: Option<f64>,
    /// The exact value, where the scene has an exact solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<f64>,
    /// By how much its quadrature is in doubt.
    #[serde(skip)]
    pub doubt: f64,
}

impl OutputBound {
    /// In other units.
    fn times(self, unit: f64) -> Self {
        let Self { center, plus_minus, estimate, exact, doubt, .. } = self;
        let [center, plus_minus, doubt] = [center, plus_minus, doubt].map(|x| x * unit);
        let [estimate, exact] = [estimate, exact].map(|x| x.map(|x| x * unit));
        Self { center, plus_minus, estimate, exact, doubt, ..self }
    }
}

/// An interval, or why there is none.
pub type Found = std::result::Result<OutputBound, String>;

/// An answer of a solve or a tick.
#[derive(Debug, Clone, Copy)]
pub struct Answered<'a> {
    /// s and τ.
    pub certified: &'a CertifiedFields,
    /// How wrong they may be.
    pub bound: Option<ErrorBound>,
    /// What they were worked out in.
    pub scalar: ScalarKind,
}

impl<'a> From<&'a Solution> for Answered<'a> {
    fn from(Solution { certified, bound, scalar, .. }: &'a Solution) -> Self {
        Self { certified, bound: *bound, scalar: *scalar }
    }
}

/// That of every output of a solution, with those that a scene without any has.
///
/// # Errors
/// Data that are not finite.
pub fn of_outputs(problem: &Problem, solution: &Solution) -> Result<BTreeMap<String, Found>> {
    let Some(scaled) = &solution.scaled else { return of_answer(problem, &solution.into()) };
    // Squares of the scene's numbers may overflow or vanish; those of the solve's do not.
    let units = solution.units;
    let mut all = of_answer(scaled, &(&times(&units.inverse(), solution.clone())).into())?;
    for output in wanted(&problem.scene).iter() {
        let unit = match output.quantity {
            Quantity::Flux | Quantity::Force => units.flux(),
            _ => units.u,
        };
        if let Some(Ok(found)) = all.get_mut(&output.name.value) {
            *found = found.clone().times(unit);
        }
    }
    Ok(all)
}

/// The same of any answer, whose numbers are near 1.
///
/// # Errors
/// Data that are not finite.
pub fn of_answer(problem: &Problem, answer: &Answered) -> Result<BTreeMap<String, Found>> {
    let is_small = problem.topology.counts.unknowns() <= MOST_UNKNOWNS;
    let is_bounded = answer.bound.is_some() && is_small;
    let factor = if is_bounded { SharedFactor::of(problem)? } else { None };
    by_factor(problem, answer, factor.as_ref())
}

/// The same by the factor of its matrix.
///
/// # Errors
/// Data that are not finite.
pub fn by_factor(
    problem: &Problem,
    answer: &Answered,
    factor: Option<&SharedFactor>,
) -> Result<BTreeMap<String, Found>> {
    let all = wanted(&problem.scene);
    let names = || all.iter().map(|output| output.name.value.clone());
    let none = |why: &str| Ok(names().map(|name| (name, Err(why.to_owned()))).collect());
    let Some(bound) = answer.bound else { return none("the solution has no error bound") };
    if problem.topology.counts.unknowns() > MOST_UNKNOWNS {
        return none(&format!("the mesh has more than {MOST_UNKNOWNS} unknowns"));
    }
    let Some(factor) = factor else { return none("its linear problem has no factor") };
    let deviations = followed(problem, &answer.certified.admissible())?;
    let known = Known {
        factor,
        problem,
        answer,
        contact: contact_edges(problem, answer, &deviations)?,
        residual: Residual::new(problem, answer, &deviations)?,
        deviations: &deviations,
        bound,
        doubt: values::doubt(problem)? + values::imbalance(problem, answer),
    };
    let found = on_two_threads(&all, |output| known.interval(output), || ())?;
    Ok(names().zip(found).collect())
}

/// What is known of the solution.
struct Known<'p> {
    factor: &'p SharedFactor,
    problem: &'p Problem,
    answer: &'p Answered<'p>,
    deviations: &'p Deviations<'p>,
    contact: Vec<ContactEdge>,
    residual: Residual<'p>,
    bound: ErrorBound,
    /// Loads that are in doubt, and what τ leaves of them.
    doubt: f64,
}

impl Known<'_> {
    fn interval(&self, output: &Output) -> Result<Found> {
        let mut found = self.bounded(output)?;
        if let (Ok(found), Some(exact)) = (&mut found, &self.problem.scene.exact) {
            let [value, doubt] = exact::value(self.problem, exact, output)?;
            (found.exact, found.doubt) = (Some(value), doubt);
        }
        Ok(found)
    }

    fn bounded(&self, output: &Output) -> Result<Found> {
        let goal = match Goal::of(self.problem, self.answer, self.deviations, output)? {
            Ok(goal) => goal,
            Err(why) => return Ok(Err(why)),
        };
        if let Some(start) = Goal::given(self.problem, output)? {
            return Ok(Ok(self.around(&Goal { start, ..goal }, [0.0; 2])));
        }
        let mut dual = Dual::new(self.problem, &goal)?;
        // The least part that may be the best one, and then larger ones as long as they are better.
        let mut rooms: Vec<f64> =
            self.contact.iter().map(|of| of.room).filter(|room| *room > 0.0).collect();
        rooms.sort_by(f64::total_cmp);
        let room = rooms.get(rooms.len() / 2).copied().unwrap_or(1.0);
        let mut part = FAR * goal.size(self.problem) / room;
        let mut best = [f64::NEG_INFINITY, f64::INFINITY];
        for trial in 0..TRIALS {
            let Some(weights) = dual.solve(self.factor, &self.contact, &goal, part) else { break };
            let (first, differ) = self.braces(&goal, &weights, part, true)?;
            let mut ends = first.within(best);
            if differ {
                ends = self.braces(&goal, &weights, part, false)?.0.within(ends);
            }
            let is_better = ends != best;
            best = ends;
            // Below the part that suits its own weights no trial is the last.
            if self.contact.is_empty() || (trial > 0 && !is_better && first.part < part) {
                break;
            }
            part = if trial == 0 { first.part } else { STEP * part };
        }
        Ok(match best.iter().all(|end| end.is_finite()) {
            true => Ok(self.around(&goal, best)),
            false => Err(UNBOUNDED.to_owned()),
        })
    }

    /// {…} with weights that keep to a part of what contact leaves, and whether its edges ask for different values of a vertex.
    fn braces(
        &self,
        goal: &Goal,
        weights: &Weights,
        part: f64,
        takes_least: bool,
    ) -> Result<(Braces, bool)> {
        let (problem, contact, mut weights) = (self.problem, &self.contact, weights.clone());
        let differ = contact::keep(problem, goal, contact, part, takes_least, &mut weights);
        let left = contact::left(problem, goal, contact, &weights);
        let Products { residual, weights: apart, both, sizes } =
            self.residual.with(goal, &weights)?;
        let ErrorBound { total, oscillation, rounding, .. } = self.bound;
        let middle = (0.5 * total * total - 0.25 * residual).max(0.0).sqrt();
        let distance = apart.max(0.0).sqrt();
        let [less, more] = left.part.map(|part| most(distance, middle, part));
        let sizes: f64 = sizes.map(f64::sqrt).iter().sum();
        let most_z = weights.vertices.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
        let rest = (oscillation + rounding + self.rounding() * total) * sizes + self.doubt * most_z;
        let [low, high] = [left.loose[0] - less - rest, left.loose[1] + more + rest];
        let ends = [0.5 * both + low, 0.5 * both + high];
        Ok((Braces { ends, part: distance / (2.0 * middle) }, differ))
    }

    /// J from {…}.
    fn around(&self, goal: &Goal, braces: [f64; 2]) -> OutputBound {
        let Value { value, terms, largest } = goal.start;
        let rounding = self.rounding() * (terms + largest) + INTEGRATED * terms;
        let [low, high] = braces;
        OutputBound {
            center: value + goal.sign * 0.5 * (low + high),
            plus_minus: 0.5 * (high - low) + rounding,
            of: goal.of.clone(),
            estimate: None,
            exact: None,
            doubt: 0.0,
        }
    }

    /// What sums round, next to their terms.
    fn rounding(&self) -> f64 {
        ROUNDINGS * self.answer.scalar.epsilon()
    }
}

/// Where {…} lies.
struct Braces {
    ends: [f64; 2],
    /// The part of contact that would suit these weights best.
    part: f64,
}

impl Braces {
    /// The ends that are nearer to each other.
    fn within(&self, [low, high]: [f64; 2]) -> [f64; 2] {
        [low.max(self.ends[0]), high.min(self.ends[1])]
    }
}

/// The largest distance · √(middle² − k) + part · k.
fn most(distance: f64, middle: f64, part: f64) -> f64 {
    match 2.0 * part * middle > distance {
        true => part * middle * middle + distance * distance / (4.0 * part),
        false => distance * middle,
    }
}

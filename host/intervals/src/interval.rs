//! The interval of one output: weights for more and more of what contact leaves, and the best ends of all.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;

use super::answer::{Found, OnMesh, OutputBound};
use super::contact::ContactEdge;
use super::coverage::Coverage;
use super::dual::{Dual, Weights};
use super::exact;
use super::goal::Goal;
use super::kept::{keep, left};
use super::part::Part;
use super::products::Residual;
use super::squares::Products;
use super::values::{INTEGRATED, Value};
use signorini_certify::ErrorBound;
use signorini_problem::functional::of_one;
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity};
use signorini_solve::SharedSolver;

/// Parts c that are tried, and by how much each is larger than the last.
const TRIALS: usize = 8;
/// The same on meshes without a factor, where each is a solution of its own.
const LARGE_TRIALS: usize = 3;
const STEP: f64 = 2.5;

/// How far ζ·n may go beyond its usual size on a contact edge, where z is to keep its value: little enough to lose no digit beside.
pub(super) const FAR: f64 = 1e4;

/// Shares of R_z′ that are tried in the norm of the storage.
const SHARES: [f64; 2] = [0.0, 1.0];

/// Roundings of the scalar that sums may be off, next to their terms.
const ROUNDINGS: f64 = 512.0;

/// Why an output has no interval where one of its ends is infinite, and what may have one where its boundaries meet others.
pub(super) fn unbounded(problem: &Problem, output: &Output) -> String {
    let boundaries = &problem.scene.boundaries;
    let place = |edge: usize| problem.binding.boundary(problem.ends[edge]);
    let part = Part::new(problem, output);
    let takes_flux =
        |edge: &usize| matches!(problem.kinds[*edge], EdgeKind::Dirichlet | EdgeKind::Contact);
    let edges: Vec<(usize, usize)> = (0..problem.kinds.len())
        .filter(takes_flux)
        .filter_map(|edge| Some((edge, place(edge)?)))
        .collect();
    let (own, others): (Vec<_>, Vec<_>) =
        edges.into_iter().partition(|&(_, at)| part.has_table(at));
    let vertices: BTreeSet<u32> = own.iter().flat_map(|&(edge, _)| problem.ends[edge]).collect();
    let meets = |edge: usize| problem.ends[edge].iter().any(|vertex| vertices.contains(vertex));
    let met: BTreeSet<usize> =
        others.into_iter().filter(|&(edge, _)| meets(edge)).map(|(_, at)| at).collect();
    let own: BTreeSet<usize> = own.into_iter().map(|(_, at)| at).collect();
    let names = |of: &BTreeSet<usize>| -> Vec<String> {
        of.iter().map(|&at| format!("{:?}", boundaries[at].name.value)).collect()
    };
    let (all, met) = ([names(&own), names(&met)].concat().join(", "), names(&met).join(", "));
    let what = "nothing bounds it from both sides";
    match met.is_empty() {
        true => format!("{what}, and no energy tells its flux from that of its neighbours"),
        false => format!(
            "{what}: no energy tells its flux from that of {met}, which it meets; try their sum, kind = \"flux\" and of = [{all}]"
        ),
    }
}

/// Why it has none where nothing weighs its error.
pub(super) const UNSOLVED: &str =
    "the linear problem that weighs its error has no solution, or says nothing of it";

/// Why it has none where data have no number somewhere.
const NO_NUMBER: &str = "its value is no number: the data have none somewhere";

/// Facts on the solution that all intervals share.
pub(super) struct Known<'p> {
    pub solver: &'p SharedSolver,
    /// Weights without contact, by the names of their outputs.
    pub kept: &'p Mutex<BTreeMap<String, Weights>>,
    pub problem: &'p Problem,
    pub on: OnMesh<'p>,
    pub contact: Vec<ContactEdge>,
    pub residual: Residual<'p>,
    pub bound: ErrorBound,
    /// Loads that are in doubt, and what τ leaves of them.
    pub doubt: f64,
}

impl Known<'_> {
    pub fn interval(&self, output: &Output) -> Result<Found> {
        let mut found = self.bounded(output)?;
        if output.quantity == Quantity::Content {
            found = found.map(|found| found.times(of_one(self.problem, output)));
        }
        found = found.and_then(|found| match found.center.is_finite() {
            true => Ok(found),
            false => Err(NO_NUMBER.to_owned()),
        });
        // A stated solution is not that of the step.
        let exact = self.problem.scene.exact.as_ref().filter(|_| self.problem.loads.step.is_none());
        if let (Ok(found), Some(exact)) = (&mut found, exact) {
            let [value, doubt] = exact::value(self.problem, exact, output)?;
            (found.exact, found.doubt) = (Some(value), doubt);
        }
        Ok(found)
    }

    fn bounded(&self, output: &Output) -> Result<Found> {
        if self.on.answer.certified.lifts.moved > 0.0 {
            let why = "a gap or a value that is not linear along an edge moves in this step";
            return Ok(Err(why.to_owned()));
        }
        let goal = match Goal::of(&self.on, output)? {
            Ok(goal) => goal,
            Err(why) => return Ok(Err(why)),
        };
        if let Some(start) = Goal::given(self.problem, output)? {
            return Ok(Ok(self.around(&Goal { start, ..goal }, [0.0; 2])));
        }
        let mut dual = Dual::new(self.problem, &goal)?;
        // The least part that may be the best one, and then larger ones as long as weights ask for them.
        let mut rooms: Vec<f64> =
            self.contact.iter().map(|of| of.room).filter(|room| *room > 0.0).collect();
        rooms.sort_by(f64::total_cmp);
        let room = rooms.get(rooms.len() / 2).copied().unwrap_or(1.0);
        let mut part = FAR * goal.size(self.problem) / room;
        let mut best = [f64::NEG_INFINITY, f64::INFINITY];
        let is_large = !Coverage::Factored.takes(self.problem);
        for trial in 0..if is_large { LARGE_TRIALS } else { TRIALS } {
            let name = &output.name.value;
            let Some(weights) = self.weights(name, &goal, &mut dual, part) else { break };
            let (first, differ) = self.braces(&goal, &weights, part, true)?;
            let mut ends = first.within(best);
            if differ {
                ends = self.braces(&goal, &weights, part, false)?.0.within(ends);
            }
            best = ends;
            // Above the part that suits its own weights no larger one is better.
            if self.contact.is_empty() || (trial > 0 && first.part < part) {
                break;
            }
            part = match trial {
                0 => first.part,
                // Between a part and the one that suits its weights lies the one that suits its own.
                _ if is_large => (part * first.part).sqrt(),
                _ => STEP * part,
            };
        }
        Ok(match best {
            [f64::NEG_INFINITY, f64::INFINITY] => Err(UNSOLVED.to_owned()),
            _ if best.iter().all(|end| end.is_finite()) => Ok(self.around(&goal, best)),
            _ => Err(unbounded(self.problem, output)),
        })
    }

    /// Weights of an output: without contact those of all answers.
    fn weights(&self, name: &str, goal: &Goal, dual: &mut Dual, part: f64) -> Option<Weights> {
        if !self.contact.is_empty() {
            return dual.solve(self.solver, &self.contact, goal, part);
        }
        if let Some(known) = self.kept.lock().ok()?.get(name) {
            return Some(known.clone());
        }
        let found = dual.solve(self.solver, &[], goal, part)?;
        self.kept.lock().ok()?.insert(name.to_owned(), found.clone());
        Some(found)
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
        let differ = keep(problem, goal, contact, part, takes_least, &mut weights);
        let left = left(problem, goal, contact, &weights);
        let Products { residual, weights: apart, both, off, sizes, inside } =
            self.residual.with(goal, &weights)?;
        let ErrorBound { total, rounding, .. } = self.bound;
        let oscillation = self.oscillation();
        let middle = (0.5 * total * total - 0.25 * residual).max(0.0).sqrt();
        let distance = root(apart);
        let [less, more] = left.part.map(|part| {
            let with = |share: f64| {
                let distance = root(apart + 2.0 * share * share * inside[0]);
                most(distance, middle, part) + (1.0 - share) * inside[1].sqrt() * total
            };
            SHARES.map(with).into_iter().fold(f64::INFINITY, f64::min)
        });
        let sizes: f64 = sizes.map(f64::sqrt).iter().sum();
        let most_z = weights.vertices.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
        let rest = (oscillation + rounding + self.rounding() * total) * sizes
            + self.doubt * most_z
            + goal.beside * total
            + 0.5 * off;
        let [low, high] = [left.loose[0] - less - rest, left.loose[1] + more + rest];
        let ends = [0.5 * both + low, 0.5 * both + high];
        Ok((Braces { ends, part: distance / (2.0 * middle) }, differ))
    }

    /// J from {…}, where the conditions keep it.
    fn around(&self, goal: &Goal, braces: [f64; 2]) -> OutputBound {
        let Value { value, terms, largest } = goal.start;
        let rounding = self.rounding() * (terms + largest) + INTEGRATED * terms;
        let [low, high] = if goal.sign < 0.0 { [-braces[1], -braces[0]] } else { braces };
        let ends = [value + low - rounding, value + high + rounding];
        let [least, most] = [goal.law[0] - self.doubt, goal.law[1] + self.doubt];
        let [low, high] = match [ends[0].max(least), ends[1].min(most)] {
            kept @ [low, high] if low <= high => kept,
            _ => ends,
        };
        let [center, plus_minus] = around_ends([low, high], value);
        OutputBound {
            center,
            plus_minus,
            of: goal.of.clone(),
            estimate: None,
            exact: None,
            doubt: 0.0,
        }
    }

    /// An interval's part from data alone: what s changes by inside cells in a step is known.
    fn oscillation(&self) -> f64 {
        let ways = self.on.answer.certified.evolution.iter().map(|way| way.oscillation);
        match self.problem.loads.step {
            Some(_) => ways.fold(f64::NAN, f64::max).min(self.bound.oscillation),
            None => self.bound.oscillation,
        }
    }

    /// Rounding of sums, relative to their terms.
    fn rounding(&self) -> f64 {
        ROUNDINGS * self.on.answer.scalar.epsilon()
    }
}

/// Middle and half-width of what holds two ends, each rounded next to `value`: a large end leaves less of a small one than it rounds.
fn around_ends([low, high]: [f64; 2], value: f64) -> [f64; 2] {
    let rounded = 4.0 * f64::EPSILON * (low.abs() + high.abs() + value.abs());
    [0.5 * (low + high), 0.5 * (high - low) + rounded]
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

/// The root of a square that rounding may have put below 0; of no number all that there is.
fn root(square: f64) -> f64 {
    if square.is_nan() { f64::INFINITY } else { square.max(0.0).sqrt() }
}

/// The largest distance · √(middle² − k) + part · k.
pub(super) fn most(distance: f64, middle: f64, part: f64) -> f64 {
    match 2.0 * part * middle > distance {
        true => part * middle * middle + distance * distance / (4.0 * part),
        false => distance * middle,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_end_does_not_cut_off_a_small_one() {
        for ends in [[-1.65, 1.25e19], [-1e20, 3.0], [0.1, 0.3], [-1e300, 1e300], [0.0, 0.0]] {
            let [center, plus_minus] = around_ends(ends, 0.2);
            assert!(center - plus_minus <= ends[0] && ends[1] <= center + plus_minus, "{ends:?}");
        }
    }
}

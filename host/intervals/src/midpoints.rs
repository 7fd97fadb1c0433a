//! Outputs of the middle between τ and A∇s, for controllers whose s and τ are sums of few columns.
//!
//! ```text
//!   J(u) or J(σ) = Σ_j z_j c_j ± {…},     c_j = J(s_j or τ_j) ± ½⟨τ_j − A∇s_j, ζ + A∇z⟩
//! ```
//! Every part of it is that of a solve ([`super`]), with z and ζ that suit all answers of the controller: z keeps its value and ζ·n its
//! density on contact edges that may be on either side. Where an edge is open in all answers z may be off by a part of the least
//! s − ψ, and where one always touches ζ·n may be off by a part of the least τ·n − lo.

use super::answer::{Answered, OnMesh};
use super::contact::ContactEdge;
use super::dual::{self, Dual};
use super::goal::Goal;
use super::interval::{FAR, most};
use super::kept::{keep, left};
use super::known::Answers;
use super::products::Residual;
use super::values::{self, INTEGRATED};
use super::weights::{Weighed, Weighing};
use signorini_certify::Column;
use signorini_certify::cell::Cell;
use signorini_certify::conductivity::Conductivity;
use signorini_certify::curved::followed;
use signorini_certify::transfer_points::unseen;
use signorini_problem::functional::wanted;
use signorini_problem::{Assembled, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity};
use signorini_solve::{ScalarKind, unfit};

/// Roundings of sums over the mesh, next to their terms.
const ROUNDINGS: f64 = 512.0 * f64::EPSILON;

/// Part of a distance that its factorisation may round.
const FACTORED: f64 = 1e-9;

/// An output of the middle, and how far that of the exact solution may be: numbers of `device::intervals::Midpoint`.
#[derive(Debug, Clone, PartialEq)]
pub struct Midpoint {
    /// c_j, and by how much it may be off. Where an input changes a transfer coefficient, at both ends of its range: c_j is linear in
    /// it. Else the second is empty.
    pub columns: [Vec<[f64; 2]>; 2],
    /// ‖A^{−½}ζ − A^½∇z‖
    pub apart: f64,
    /// The part of what contact leaves that z and ζ take, for the lower and the upper end.
    pub part: [f64; 2],
    /// ‖A^½∇z‖ + ‖A^{−½}ζ‖
    pub sizes: f64,
    /// The part of an output that loads may miss, over the total.
    pub loads: f64,
    /// How much of a certificate's distance counts.
    pub distance: f64,
    /// The value that the law of contact keeps the output above.
    pub least: f64,
}

/// z and ζ, with what is left of {…}.
struct Pair {
    weights: dual::Weights,
    apart: f64,
    sizes: f64,
    /// Below and above {…}.
    part: [f64; 2],
}

/// The weights of every output, in their order, and the midpoints of those that have weights.
pub fn of_controller(
    problem: &Problem,
    answers: &Answers,
) -> (Vec<Weighed>, Vec<Option<Midpoint>>) {
    let outputs = wanted(&problem.scene);
    let none = |why: String| vec![(Err(why), None); outputs.len()];
    let found = match Weighing::new(problem, answers) {
        Ok(Ok(of)) => outputs.iter().map(|output| of.with_midpoint(output)).collect(),
        Ok(Err(why)) => none(why),
        Err(error) => none(error.reason()),
    };
    found.into_iter().unzip()
}

impl Weighing<'_> {
    fn with_midpoint(&self, output: &Output) -> (Weighed, Option<Midpoint>) {
        let weighed = self.output(output).unwrap_or_else(|error| Err(error.reason()));
        let has_columns = self.answers.columns.iter().any(|columns| !columns.is_empty());
        let midpoint = match has_columns && weighed.is_ok() {
            // Without one, weights say what is known.
            true => self.midpoint(output).unwrap_or_default(),
            false => None,
        };
        (weighed, midpoint)
    }

    /// The midpoint of an output; nothing where there is none.
    fn midpoint(&self, output: &Output) -> Result<Option<Midpoint>> {
        let problem = self.problem;
        let Ok(goal) = Goal::of(&self.on_mesh(), output)? else {
            return Ok(None);
        };
        let goal = &goal;
        let is_counted_up = goal.values.iter().all(|&value| value >= 0.0);
        if !is_counted_up {
            return Ok(None);
        }
        let Some(pair) = self.pair(goal)? else { return Ok(None) };
        let mut columns = [Vec::new(), Vec::new()];
        for (columns, of) in columns.iter_mut().zip(self.answers.columns) {
            for of in of {
                let Some(column) = column(goal, output, &pair.weights, of)? else {
                    return Ok(None);
                };
                columns.push(column);
            }
        }
        let [below, above] = pair.part;
        let is_force = output.quantity == Quantity::Force;
        Ok(Some(Midpoint {
            columns,
            apart: pair.apart,
            part: if goal.sign < 0.0 { [above, below] } else { [below, above] },
            sizes: pair.sizes,
            loads: self.of_loads(&pair.weights) + goal.beside,
            distance: certain(problem).unwrap_or(0.0),
            least: if is_force { 0.0 } else { f64::NEG_INFINITY },
        }))
    }

    /// The z and ζ that leave least, of several parts that they may take of what contact leaves.
    fn pair(&self, goal: &Goal) -> Result<Option<Pair>> {
        let (problem, contact) = (self.problem, self.contact());
        let (mut dual, far) = (Dual::new(problem, goal)?, FAR * goal.size(problem));
        let middle = 0.5 * self.answers.total;
        let mut best: Option<(f64, Pair)> = None;
        for part in self.parts(&contact) {
            let held: Vec<_> = contact.iter().map(|of| of.held(of.is_held(part))).collect();
            let (Some(of_z), Some(of_zeta)) = (
                dual.solve(&self.solver, &held, goal, far),
                dual.solve(&self.solver, &contact, goal, part),
            ) else {
                continue;
            };
            for takes_least in [true, false] {
                let weights = dual::Weights { tau: of_zeta.tau.clone(), ..of_z.clone() };
                let (pair, differ) = self.kept(goal, (&contact, part, takes_least), weights)?;
                if let Some(pair) = pair {
                    let [below, above] = pair.part.map(|part| most(pair.apart, middle, part));
                    let width = below + above;
                    if best.as_ref().is_none_or(|(least, _)| width < *least) {
                        best = Some((width, pair));
                    }
                }
                if !differ {
                    break;
                }
            }
        }
        Ok(best.map(|(_, pair)| pair))
    }

    /// The pair of `weights` where z keeps to `part` of what contact leaves, if any part bounds the rest; whether edges ask for
    /// different values of a vertex.
    fn kept(
        &self,
        goal: &Goal,
        (contact, part, takes_least): (&[ContactEdge], f64, bool),
        mut weights: dual::Weights,
    ) -> Result<(Option<Pair>, bool)> {
        let differ = keep(self.problem, goal, contact, part, takes_least, &mut weights);
        let rest = left(self.problem, goal, contact, &weights);
        let [apart, of_z, of_zeta] = self.sizes(goal, &weights)?;
        let sizes = of_z + of_zeta;
        let is_bounded = rest.loose == [0.0; 2]
            && rest.part.iter().chain([&apart, &sizes]).all(|number| number.is_finite());
        let pair = Pair { weights, apart, sizes, part: rest.part };
        Ok((is_bounded.then_some(pair), differ))
    }
}

/// c of a column, and what it may be off; nothing where the output of the column is none.
fn column(
    goal: &Goal,
    output: &Output,
    weights: &dual::Weights,
    Column { problem, certified, laws }: &Column,
) -> Result<Option<[f64; 2]>> {
    let deviations = followed(problem, &certified.admissible())?;
    let answer = Answered { certified, bound: None, scalar: ScalarKind::F64 };
    let on = &OnMesh { problem, answer, deviations: &deviations };
    let Ok(Goal { start, .. }) = Goal::of(on, output)? else { return Ok(None) };
    let residual = Residual::new(on)?;
    let residual = if laws.is_empty() { residual } else { residual.with_laws(laws) };
    let products = residual.with(goal, weights)?;
    let most_z = weights.vertices.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
    let doubt = values::doubt(problem) + values::imbalance(on);
    let sizes: f64 = products.sizes.map(f64::sqrt).iter().sum();
    let rounding = ROUNDINGS * (start.terms + products.residual.max(0.0).sqrt() * sizes);
    // A mean of vertex values alone is exact.
    let is_exact = goal.sign > 0.0 && deviations.found.is_empty();
    let integrated = if is_exact { 0.0 } else { INTEGRATED * start.terms };
    let off = 0.5 * products.off + integrated + rounding + doubt * most_z;
    Ok(Some([start.value + goal.sign * 0.5 * products.both, off]))
}

/// How much of the distance that rows of a condensed model tell is one for certain: they are lengthened where rules may miss a part of
/// A or h.
fn certain(problem: &Problem) -> Result<f64> {
    let mut longest = 1.0_f64;
    for at in 0..problem.cells() {
        let [slack, left] = Conductivity::of(problem, at).missed(Cell::of(problem, at));
        if left > 0.0 {
            return Ok(0.0);
        }
        longest = longest.max(1.0 + slack);
    }
    for record in &problem.loads.robin {
        if unseen(problem, record.edge as usize)?.is_some() {
            return Ok(0.0);
        }
    }
    let assembled = Assembled::<f64>::new(problem).map_err(unfit::<f64>(&problem.scene))?;
    Ok((1.0 - FACTORED) / (longest * (1.0 + assembled.hidden())))
}

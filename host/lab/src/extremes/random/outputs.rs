//! Intervals of outputs: whether they hold what the exact solution says, or meet those of a finer answer. Those that a controller has
//! of its weights and its bound are asked the same.

use std::collections::BTreeMap;

use super::attempt::Held;
use super::case::{RandomCase, Way};
use signorini_bake::intervals::narrowed;
use signorini_certify::cell::Cell;
use signorini_intervals::known::Answers;
use signorini_intervals::weights::weights;
use signorini_intervals::{Answered, Coverage, exact_value, of_answer};
use signorini_kernel::verdict::Certificate;
use signorini_problem::Problem;
use signorini_scene::Scene;
use signorini_scene::scene::{Condition, Located, Output, Quantity};
use signorini_session::with_module;
use signorini_solve::outputs::{Reading, declared};
use signorini_solve::{ScalarKind, Solution};

/// The part of the largest number that sums may round and quadrature of data may miss: intervals of controllers leave it out.
const ROUNDED: f64 = 1e-6;
/// Outputs that one case is asked for; one where the finer mesh is large.
const OUTPUTS: usize = 3;
/// Roundings that a sum over inputs may be off.
const ROUNDINGS: f64 = 16.0;

#[derive(Debug, Clone, PartialEq, Default)]
pub struct Intervals {
    pub found: usize,
    /// The largest distance of the middle to what is known of the value, over the half-width; with a finer answer over both.
    pub worst: f64,
    /// The output of the worst.
    pub name: String,
}

/// A known output by its name: its value, and by how much that may be off.
type Known = BTreeMap<String, [f64; 2]>;

impl Held<'_> {
    /// Intervals of outputs beside the exact solution.
    pub fn intervals_by_exact(&self) -> Intervals {
        let problem = with_outputs(self.problem, self.case, true);
        let value =
            |output: &Output| Some((output.name.value.clone(), exact_value(&problem, output)?));
        self.beside(&problem, &problem.scene.outputs.iter().filter_map(value).collect())
    }

    /// Intervals of outputs beside those of a finer answer.
    pub fn intervals_by_finer(&self, finer: (&Problem, &Solution)) -> Intervals {
        let problem = with_outputs(self.problem, self.case, false);
        let its =
            of_answer(&with_outputs(finer.0, self.case, false), &finer.1.into(), Coverage::Usual);
        let known = its.into_iter().filter_map(|(name, found)| {
            let found = found.ok()?;
            Some((name, [found.center, found.plus_minus]))
        });
        self.beside(&problem, &known.collect())
    }

    fn beside(&self, problem: &Problem, known: &Known) -> Intervals {
        let Solution { certified, .. } = self.answer;
        let (scalar, bound) = (self.case.effort.scalar, Some(self.bound));
        let answered = Answered { certified, bound, scalar };
        let mut all = Intervals::default();
        let mut add = |word: &str, name: &str, middle: f64, by: f64, rounded: f64| {
            if let Some([value, slack]) = known.get(name) {
                all.add(format!("{word}{name}"), (value - middle).abs() - slack - rounded, by);
            }
        };
        for (name, found) in of_answer(problem, &answered, Coverage::Usual) {
            let Ok(found) = found else { continue };
            add("", &name, found.center, found.plus_minus, 0.0);
        }
        for (name, value, by) in self.as_a_controller(problem) {
            add("weights of ", &name, value, by, self.rounded(problem, &name));
        }
        for (name, [least, most]) in self.by_a_module(problem) {
            let (middle, by) = (0.5 * (least + most), 0.5 * (most - least));
            add("midpoint of ", &name, middle, by, self.rounded(problem, &name));
        }
        all
    }

    /// Where a condensed module with these outputs says that they lie, in a first tick.
    fn by_a_module(&self, problem: &Problem) -> Vec<(String, [f64; 2])> {
        if self.case.effort.way != Way::Condensed {
            return Vec::new();
        }
        let inputs: Vec<f64> = problem.scene.inputs.iter().map(|input| input.default).collect();
        let found = with_module(problem, Some(self.case.effort.scalar), |session, module| {
            session.tick(&inputs)?;
            let answer = session.answer(problem)?;
            Ok(module.between(session, &answer.outputs, answer.bound.as_ref()))
        });
        let named = problem.scene.outputs.iter().map(|output| output.name.value.clone());
        let all = named.zip(found.unwrap_or_default());
        all.filter_map(|(name, ends)| Some((name, ends.ok()?))).collect()
    }

    /// The error of an output by rounding and quadrature: a part of the largest flux, or of the largest u.
    fn rounded(&self, problem: &Problem, name: &str) -> f64 {
        let of_u = |output: &Output| output.name.value == name && output.quantity == Quantity::Mean;
        let numbers = match problem.scene.outputs.iter().any(of_u) {
            true => &self.answer.u,
            false => &self.answer.flux,
        };
        ROUNDED * numbers.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
    }

    /// The problem with ψ = u where they differ by rounding: a tick sums ψ over its inputs, in its own scalar.
    fn touching(&self, problem: &Problem) -> Problem {
        let mut touching = problem.clone();
        let gap = &mut touching.loads.gap;
        let size = gap.iter().fold(0.0_f64, |most, psi| most.max(psi.abs()));
        let rounding = ROUNDINGS * self.case.effort.scalar.epsilon() * size;
        let own = &self.answer.u[problem.topology.counts.free..];
        for (psi, u) in gap.iter_mut().zip(own).filter(|(psi, u)| (**psi - **u).abs() <= rounding) {
            *psi = *u;
        }
        touching
    }

    /// Outputs with their values, and how far a controller would say that they are off.
    fn as_a_controller(&self, problem: &Problem) -> Vec<(String, f64, f64)> {
        let touching = self.touching(problem);
        // ψ is u there to the bit, whatever its scalar was.
        let (Solution { u, flux, .. }, bound) = (self.answer, self.bound);
        let reading = Reading { scalar: ScalarKind::F64, u, flux, bound: Some(bound.total) };
        let Ok(values) = declared(&touching, reading) else { return Vec::new() };
        let certificate = Certificate {
            total: bound.total,
            algebraic: bound.algebraic,
            of_u: bound.of_u,
            ..Certificate::default()
        };
        let answers = Answers {
            open: &[],
            pressed: &[],
            columns: &[],
            total: 0.0,
            // All equations but those on contact edges hold.
            are_balanced: self.case.effort.way == Way::Condensed,
        };
        let within = weights(problem, &answers)
            .iter()
            .map(|of| narrowed::<f64>(of).within(&certificate))
            .collect::<Vec<_>>();
        let named = problem.scene.outputs.iter().map(|output| output.name.value.clone());
        let all = named.zip(values).zip(within).filter(|(_, by)| by.is_finite());
        all.filter_map(|((name, value), by)| Some((name, value?, by))).collect()
    }
}

impl Intervals {
    fn add(&mut self, name: String, off: f64, most: f64) {
        self.found += 1;
        let ratio = if off <= 0.0 { 0.0 } else { off / most };
        if ratio >= self.worst || ratio.is_nan() {
            (self.worst, self.name) = (ratio, name);
        }
    }
}

/// The problem with some of the outputs that it may have; others for each number.
fn with_outputs(problem: &Problem, case: &RandomCase, probes: bool) -> Problem {
    let number = case.number as usize / 2;
    let most = if case.feature.is_some() { 1 } else { OUTPUTS };
    let scene = &problem.scene;
    let named = |value: String| Located { value, key: "output".to_owned(), span: 0..0 };
    let mut all = Vec::new();
    let mut add = |name: String, quantity: Quantity, of: Option<&String>| {
        let of = of.cloned().map(named).into_iter().collect();
        all.push(Output { name: named(name), quantity, of, unit: None });
    };
    for boundary in &scene.boundaries {
        let name = &boundary.name.value;
        add(format!("mean of {name}"), Quantity::Mean, Some(name));
        add(format!("flux of {name}"), Quantity::Flux, Some(name));
        if matches!(boundary.condition, Condition::Contact { .. }) {
            add(format!("force of {name}"), Quantity::Force, Some(name));
        }
    }
    add("all".to_owned(), Quantity::Force, None);
    if probes {
        let at = Cell::of(problem, number % problem.cells()).middle();
        add("probe".to_owned(), Quantity::Probe { at }, None);
    }
    let first = number % all.len();
    all.rotate_left(first);
    all.truncate(most);
    problem.restated(Scene { outputs: all, ..Scene::clone(scene) })
}

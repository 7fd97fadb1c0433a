//! Intervals of outputs: whether they hold what the exact solution says, or meet those of a finer answer. Those that a controller has
//! of its weights and its bound are asked the same.

use std::collections::BTreeMap;

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
/// Roundings that a sum over inputs may be off.
const ROUNDINGS: f64 = 16.0;

#[derive(Debug, Clone, PartialEq, Default)]
pub struct Intervals {
    pub found: usize,
    /// The largest distance of the middle to what is known of the value, over the half-width; with a finer answer over both.
    pub worst: f64,
    pub name: String,
}

/// An answer of which outputs are asked.
#[derive(Debug, Clone, Copy)]
pub struct Asked<'a> {
    pub number: u32,
    pub most: usize,
    pub problem: &'a Problem,
    pub answer: Answered<'a>,
    /// The fields that its outputs are read off.
    pub reading: Reading<'a>,
    /// Whether all equations but those on contact edges hold.
    pub is_balanced: bool,
}

/// A known output by its name: its value, and by how much that may be off.
type Known = BTreeMap<String, [f64; 2]>;

impl Asked<'_> {
    /// Its intervals beside the exact solution.
    pub fn by_exact(&self) -> Intervals {
        let problem = with_outputs(self.problem, self, true);
        let value =
            |output: &Output| Some((output.name.value.clone(), exact_value(&problem, output)?));
        self.beside(&problem, &problem.scene.outputs.iter().filter_map(value).collect())
    }

    /// Its intervals beside those of a finer answer.
    pub fn by_finer(&self, finer: (&Problem, &Solution)) -> Intervals {
        let problem = with_outputs(self.problem, self, false);
        let its = of_answer(&with_outputs(finer.0, self, false), &finer.1.into(), Coverage::Small);
        let known = its.into_iter().filter_map(|(name, found)| {
            let found = found.ok()?;
            Some((name, [found.center, found.plus_minus]))
        });
        self.beside(&problem, &known.collect())
    }

    fn beside(&self, problem: &Problem, known: &Known) -> Intervals {
        let mut all = Intervals::default();
        for (name, found) in of_answer(problem, &self.answer, Coverage::Small) {
            if let (Ok(found), Some([value, slack])) = (found, known.get(&name)) {
                all.add(name, (value - found.center).abs() - slack, found.plus_minus);
            }
        }
        for (name, value, by) in self.as_a_controller(problem) {
            if let Some([known, slack]) = known.get(&name) {
                let off = (known - value).abs() - slack - self.rounded(problem, &name);
                all.add(format!("weights of {name}"), off, by);
            }
        }
        for (name, [least, most]) in self.by_a_module(problem) {
            if let Some([known, slack]) = known.get(&name) {
                let (middle, by) = (0.5 * (least + most), 0.5 * (most - least));
                let off = (known - middle).abs() - slack - self.rounded(problem, &name);
                all.add(format!("midpoint of {name}"), off, by);
            }
        }
        all
    }

    /// Where a condensed module with these outputs says that they lie, in a first tick.
    fn by_a_module(&self, problem: &Problem) -> Vec<(String, [f64; 2])> {
        if !self.is_balanced {
            return Vec::new();
        }
        let inputs: Vec<f64> = problem.scene.inputs.iter().map(|input| input.default).collect();
        let found = with_module(problem, Some(self.reading.scalar), |session, module| {
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
            true => self.reading.u,
            false => self.reading.flux,
        };
        ROUNDED * numbers.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
    }

    /// The problem with ψ = u where they differ by rounding: a tick sums ψ over its inputs, in its own scalar.
    fn touching(&self, problem: &Problem) -> Problem {
        let mut touching = problem.clone();
        let gap = &mut touching.loads.gap;
        let size = gap.iter().fold(0.0_f64, |most, psi| most.max(psi.abs()));
        let rounding = ROUNDINGS * self.reading.scalar.epsilon() * size;
        let own = &self.reading.u[problem.topology.counts.free..];
        for (psi, u) in gap.iter_mut().zip(own).filter(|(psi, u)| (**psi - **u).abs() <= rounding) {
            *psi = *u;
        }
        touching
    }

    /// Outputs with their values, and how far a controller would say that they are off.
    fn as_a_controller(&self, problem: &Problem) -> Vec<(String, f64, f64)> {
        let touching = self.touching(problem);
        // ψ is u there to the bit, whatever its scalar was.
        let reading = Reading { scalar: ScalarKind::F64, ..self.reading };
        let (Some(bound), Ok(values)) = (self.answer.bound, declared(&touching, reading)) else {
            return Vec::new();
        };
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
            are_balanced: self.is_balanced,
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
fn with_outputs(problem: &Problem, asked: &Asked, probes: bool) -> Problem {
    let (number, most) = (asked.number as usize, asked.most);
    let scene = &problem.scene;
    let named = |value: String| Located { value, key: "output".to_owned(), span: 0..0 };
    let mut all = Vec::new();
    for boundary in &scene.boundaries {
        let name = &boundary.name.value;
        let mut add = |word: &str, quantity: Quantity| {
            let of = vec![named(name.clone())];
            all.push(Output { name: named(format!("{word} of {name}")), quantity, of, unit: None });
        };
        add("mean", Quantity::Mean);
        add("flux", Quantity::Flux);
        if matches!(boundary.condition, Condition::Contact { .. }) {
            add("force", Quantity::Force);
        }
    }
    all.push(Output {
        name: named("all".to_owned()),
        quantity: Quantity::Force,
        of: Vec::new(),
        unit: None,
    });
    if probes {
        let at = Cell::of(problem, number % problem.cells()).middle();
        let (name, quantity) = (named("probe".to_owned()), Quantity::Probe { at });
        all.push(Output { name, quantity, of: Vec::new(), unit: None });
    }
    let first = number % all.len();
    all.rotate_left(first);
    all.truncate(most);
    problem.restated(Scene { outputs: all, ..Scene::clone(scene) })
}

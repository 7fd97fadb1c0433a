//! What a step begins from: static shapes of inputs and openings, and the start.

use super::super::elimination::{Field, failed};
use super::super::{CondensedModel, Pieces};
use super::modes::Deviations;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_solve::{Start, own_defaults};

/// Static shapes: u of a unit of each input, the constant first, and of each opening.
pub(super) struct Shapes {
    pub inputs: Vec<Vec<f64>>,
    openings: Vec<Vec<f64>>,
    /// The steady model.
    pub(super) steady: CondensedModel,
}

/// Where the first step begins: the inputs, the constant first, openings in units of the model, and a stated u.
pub(super) struct Begun {
    pub inputs: Vec<f64>,
    pub openings: Vec<f64>,
    /// The openings in the unit of u, and u where that is stated.
    stated: Option<(Vec<f64>, Vec<f64>)>,
}

impl Shapes {
    pub fn new(statics: &Pieces) -> Result<Self> {
        let fields = statics.fields(Vec::new())?;
        let means = |fields: &[Field]| fields.iter().map(|field| field.u.clone()).collect();
        let (inputs, openings) = (means(&fields.inputs), means(&fields.openings));
        let (steady, _) = statics.model(fields)?;
        Ok(Self { inputs, openings, steady })
    }

    /// The shapes that a step begins from: of p⁻ without the constant, and of x⁻.
    pub fn columns(&self, openings: &[f64]) -> Vec<Vec<f64>> {
        let of_x = self.openings.iter().zip(openings);
        let of_x = of_x.map(|(shape, d)| shape.iter().map(|u| d * u).collect());
        self.inputs.iter().skip(1).cloned().chain(of_x).collect()
    }

    /// u of a unit of each input without the constant on contact edges, x being held, in units of so large openings.
    pub fn gaps(&self, problem: &Problem, openings: &[f64]) -> Vec<Vec<f64>> {
        let free = problem.topology.counts.free;
        let edges = || self.steady.edges.iter().zip(openings);
        let column = |u: &Vec<f64>| edges().map(|(&edge, d)| u[free + edge] / d).collect();
        self.inputs.iter().skip(1).map(column).collect()
    }

    /// By how much each input and each opening may change, or about that.
    pub fn sizes(&self, openings: &[f64]) -> Vec<f64> {
        let CondensedModel { ranges, defaults, opening, .. } = &self.steady;
        let of_input = |(&[lo, hi], &default): (&[f64; 2], &f64)| match hi - lo {
            width if width.is_finite() => width,
            _ if default == 0.0 => 1.0,
            _ => default.abs(),
        };
        let of_inputs: Vec<f64> = ranges.iter().zip(defaults).map(of_input).collect();
        let mut most = vec![0.0_f64; opening.len()];
        let end = |at: usize, sign: f64| {
            let mut p = defaults.clone();
            p[at] += sign * of_inputs[at];
            p
        };
        let ends = (1..defaults.len()).flat_map(|at| [end(at, -1.0), end(at, 1.0)]);
        for p in ends.chain([defaults.clone()]) {
            for (most, x) in most.iter_mut().zip(self.steady.solve(&p).unwrap_or_default()) {
                *most = most.max(x.abs());
            }
        }
        let largest = most.iter().fold(f64::MIN_POSITIVE, |most: f64, x| most.max(*x));
        let of_x = most.iter().zip(opening).zip(openings);
        let of_x = of_x.map(|((x, steady), own)| x.max(1e-3 * largest) * steady / own);
        of_inputs.iter().skip(1).copied().chain(of_x).collect()
    }

    pub fn start(&self, problem: &Problem, length: f64, openings: &[f64]) -> Result<Begun> {
        let own = own_defaults(&problem.scene)?;
        let inputs: Vec<f64> = std::iter::once(1.0).chain(own).collect();
        let scaled = |v: &[f64]| v.iter().zip(openings).map(|(v, d)| v / d).collect();
        let is_stated = problem.scene.time.as_ref().is_some_and(|time| time.initial.is_some());
        if !is_stated {
            let refused = |error| failed(&problem.scene)(error);
            let x = self.steady.solve(&inputs).map_err(refused)?;
            let v: Vec<f64> = x.iter().zip(&self.steady.opening).map(|(x, d)| x * d).collect();
            return Ok(Begun { inputs, openings: scaled(&v), stated: None });
        }
        let Some(start) = Start::of(problem, length)? else {
            return Ok(Begun { inputs, openings: vec![0.0; openings.len()], stated: None });
        };
        let (u, gap) = (start.solution.u, &start.problem.loads.gap);
        let free = problem.topology.counts.free;
        let v: Vec<f64> = self.steady.edges.iter().map(|&at| u[free + at] - gap[at]).collect();
        Ok(Begun { inputs, openings: scaled(&v), stated: Some((v, u)) })
    }
}

impl Begun {
    /// The coordinates of what a stated u deviates from its static shape.
    pub fn deviation(&self, shapes: &Shapes, deviations: &Deviations) -> Vec<f64> {
        let Some((v, u)) = &self.stated else { return vec![0.0; deviations.count()] };
        let mut rest = u.clone();
        let parts = self.inputs.iter().zip(&shapes.inputs).chain(v.iter().zip(&shapes.openings));
        for (factor, shape) in parts {
            rest.iter_mut().zip(shape).for_each(|(rest, u)| *rest -= factor * u);
        }
        deviations.coordinates(&rest)
    }
}

//! The edges that a coefficient acts on, and the modes of the mesh behind them.

use faer::{Mat, Side};

use crate::Fields;
use crate::elimination::{Field, FieldLoads, silent};
use signorini_problem::{Problem, TransferPattern};
use signorini_scene::error::{InputError, Result};

/// The edges R with W^½.
pub(super) struct Passing {
    edges: Vec<usize>,
    roots: Vec<f64>,
    /// Of each edge, its place among the transfer laws.
    laws: Vec<usize>,
}

/// A mode: g_k = Σ weights · (field of a unit on an edge of R).
pub(super) struct Mode {
    pub vector: Vec<f64>,
    pub weights: Vec<f64>,
    pub compliance: f64,
    /// β_k
    pub of_inputs: Vec<f64>,
    /// α_k where openings are not scaled.
    pub of_contact: Vec<f64>,
}

impl Passing {
    pub(super) fn new(problem: &Problem, pattern: &TransferPattern, input: usize) -> Result<Self> {
        if pattern.integrals.iter().any(|&integral| integral < 0.0) {
            let scene = &problem.scene;
            let message = "negative on an edge: modes need a pattern of one sign";
            return Err(scene.error(&scene.inputs[input].pattern, message).into());
        }
        let acts = pattern.integrals.iter().enumerate().filter(|(_, integral)| **integral > 0.0);
        let laws: Vec<usize> = acts.map(|(law, _)| law).collect();
        let edges = laws.iter().map(|&law| problem.loads.robin[law].edge as usize).collect();
        let roots = laws.iter().map(|&law| pattern.integrals[law].sqrt()).collect();
        Ok(Self { edges, roots, laws })
    }

    /// 1 on each edge of R.
    pub(super) fn unit_loads(&self, problem: &Problem) -> Vec<FieldLoads> {
        let silent = silent(problem);
        let unit = |&law: &usize| {
            let mut loads = silent.clone();
            loads.robin[law].ambient = 1.0;
            FieldLoads { contact: vec![0.0; problem.topology.counts.contact], loads }
        };
        self.laws.iter().map(unit).collect()
    }

    /// Q and ν from the fields of units, and what the modes see of the other fields.
    pub(super) fn modes(
        &self,
        fields: &Fields,
        problem: &Problem,
        pattern: &TransferPattern,
    ) -> Result<Vec<Mode>> {
        let u = |i: usize, j: usize| fields.more[j].u[self.edges[i]];
        let entry = |i: usize, j: usize| self.roots[i] * self.roots[j] * u(i, j);
        let count = self.edges.len();
        let matrix = Mat::from_fn(count, count, |i, j| 0.5 * (entry(i, j) + entry(j, i)));
        let failed = |_| {
            let message = "the modes of the transfer coefficient cannot be found";
            InputError::new(message).file(&problem.scene.path)
        };
        let found = matrix.self_adjoint_eigen(Side::Lower).map_err(failed)?;
        let mode = |k: usize| {
            let vector: Vec<f64> = (0..count).map(|edge| found.U()[(edge, k)]).collect();
            let weights: Vec<f64> = vector.iter().zip(&self.roots).map(|(q, w)| q * w).collect();
            let seen = |of: &[Field]| -> Vec<f64> {
                of.iter().map(|field| self.seen(&weights, field)).collect()
            };
            let (mut of_inputs, of_contact) = (seen(&fields.inputs), seen(&fields.openings));
            for (term, products) in &pattern.ambient {
                of_inputs[*term] += self.brought(&vector, products);
            }
            Mode { vector, weights, compliance: found.S()[k], of_inputs, of_contact }
        };
        Ok((0..count).map(mode).collect())
    }

    /// −q_kᵀ W^½ u_R
    fn seen(&self, weights: &[f64], field: &Field) -> f64 {
        let means = self.edges.iter().map(|&edge| field.u[edge]);
        -weights.iter().zip(means).map(|(weight, u)| weight * u).sum::<f64>()
    }

    /// q_kᵀ W^−½ e, `products` being ∫π u_ext of every law.
    fn brought(&self, vector: &[f64], products: &[f64]) -> f64 {
        let of_edges = self.laws.iter().zip(&self.roots).map(|(&law, root)| products[law] / root);
        vector.iter().zip(of_edges).map(|(q, e)| q * e).sum()
    }
}

pub(super) fn combined(weights: &[f64], fields: &[Field]) -> Field {
    let sum = |of: fn(&Field) -> &Vec<f64>| {
        let mut sum = vec![0.0; fields.first().map_or(0, |field| of(field).len())];
        for (weight, field) in weights.iter().zip(fields) {
            sum.iter_mut().zip(of(field)).for_each(|(sum, entry)| *sum += weight * entry);
        }
        sum
    };
    Field { u: sum(|field| &field.u), flux: sum(|field| &field.flux) }
}

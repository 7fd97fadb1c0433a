//! The solution of the discrete problem (14), by exact condensation to the contact edges.
//!
//! With I the free edges off the contact part and C those on it,
//! ```text
//! S = K_CC − K_CI K_II⁻¹ K_IC,   b̃ = b_C − K_CI K_II⁻¹ b_I,
//! u_C ≥ ψ,   S u_C − b̃ ≥ 0,   (u_C − ψ)·(S u_C − b̃) = 0,   u_I = K_II⁻¹ (b_I − K_IC u_C).
//! ```
//! The small problem is solved by projected Gauss–Seidel, which converges for every symmetric
//! positive definite S, and once more exactly with the edges that it left in contact.

use std::collections::{BTreeMap, BTreeSet};

use crate::cholesky::{Envelope, Factor};
use crate::grid::Edge;
use crate::problem::System;

/// Scaled complementarity residual at which Gauss–Seidel stops; the exact solve comes after it.
const RESIDUAL: f64 = 1e-13;
/// Sweeps after which the scene is taken to be one without a solution.
const MAX_SWEEPS: usize = 1_000_000;

/// Edge means that solve (14).
#[derive(Clone, Debug)]
pub struct Solution {
    /// u_E on every edge.
    pub means: BTreeMap<Edge, f64>,
    /// The contact edges with u_E = ψ_E.
    pub active: BTreeSet<Edge>,
}

/// `None` where there is no solution or no unique one.
pub fn solve(system: &System) -> Option<Solution> {
    let inner = Inner::new(system)?;
    let mut means = system.fixed.clone();
    let condensed = inner.condense(system);
    let (values, active) = condensed.solve()?;
    means.extend(condensed.edges.iter().copied().zip(values));
    let fixed = inner.solve(|e| system.load[&e] - system.row(e, &means));
    means.extend(inner.edges.iter().copied().zip(fixed));
    Some(Solution { means, active })
}

impl System {
    /// Σ_F K_EF u_F over the edges F that `means` has.
    pub fn row(&self, e: Edge, means: &BTreeMap<Edge, f64>) -> f64 {
        self.row_entries(e).filter_map(|(f, k)| Some(k * means.get(&f)?)).sum()
    }

    /// The entries (F, K_EF) of row E.
    pub fn row_entries(&self, e: Edge) -> impl Iterator<Item = (Edge, f64)> {
        let row = (e, (0, 0))..=(e, (u32::MAX, u32::MAX));
        self.stiffness.range(row).map(|(&(_, f), &k)| (f, k))
    }
}

/// The edges I with the factor of K_II.
struct Inner {
    edges: Vec<Edge>,
    factor: Factor,
}

impl Inner {
    fn new(system: &System) -> Option<Self> {
        let is_inner = |e: &&Edge| !system.fixed.contains_key(e) && !system.gap.contains_key(e);
        let edges: Vec<Edge> = system.load.keys().filter(is_inner).copied().collect();
        let number: BTreeMap<Edge, usize> = edges.iter().copied().zip(0..).collect();
        let mut entries = Vec::new();
        for (&(e, f), &k) in &system.stiffness {
            if let (Some(&i), Some(&j)) = (number.get(&e), number.get(&f)) {
                entries.push((i, j, k));
            }
        }
        let factor = Envelope::new(edges.len(), &entries).factor()?;
        Some(Self { edges, factor })
    }

    fn solve(&self, rhs: impl Fn(Edge) -> f64) -> Vec<f64> {
        self.factor.solve(self.edges.iter().map(|&e| rhs(e)).collect())
    }

    /// One solve with K_II for the load and one for each contact edge.
    fn condense(&self, system: &System) -> Condensed {
        let edges: Vec<Edge> = system.gap.keys().copied().collect();
        let gap: Vec<f64> = system.gap.values().copied().collect();
        let entry = |e, f| system.stiffness.get(&(e, f)).copied().unwrap_or(0.0);
        let coupling = |e: Edge, inner: &[f64]| {
            let means = self.edges.iter().copied().zip(inner.iter().copied()).collect();
            system.row(e, &means)
        };
        let known = |e| system.load[&e] - system.row(e, &system.fixed);
        let response = self.solve(known);
        let load = edges.iter().map(|&e| known(e) - coupling(e, &response)).collect();
        let mut matrix = vec![vec![0.0; edges.len()]; edges.len()];
        for (j, &f) in edges.iter().enumerate() {
            let response = self.solve(|e| entry(e, f));
            for (i, &e) in edges.iter().enumerate() {
                matrix[i][j] = entry(e, f) - coupling(e, &response);
            }
        }
        Condensed { edges, matrix, load, gap }
    }
}

/// The problem on the contact edges.
struct Condensed {
    edges: Vec<Edge>,
    matrix: Vec<Vec<f64>>,
    load: Vec<f64>,
    gap: Vec<f64>,
}

impl Condensed {
    /// The edge means and the edges in contact.
    fn solve(&self) -> Option<(Vec<f64>, BTreeSet<Edge>)> {
        let mut u = self.gap.clone();
        let sweeps = (0..MAX_SWEEPS).take_while(|_| self.sweep(&mut u) > RESIDUAL).count();
        if sweeps == MAX_SWEEPS {
            return None;
        }
        let open: Vec<usize> = (0..u.len()).filter(|&i| u[i] > self.gap[i]).collect();
        for &i in &open {
            u[i] = 0.0;
        }
        let rest = open.iter().map(|&i| self.residual(i, &u)).collect();
        let entries: Vec<_> = (0..open.len())
            .flat_map(|i| (0..=i).map(move |j| (i, j)))
            .map(|(i, j)| (i, j, self.matrix[open[i]][open[j]]))
            .collect();
        let exact = Envelope::new(open.len(), &entries).factor()?.solve(rest);
        for (&i, value) in open.iter().zip(exact) {
            u[i] = value;
        }
        let is_active = |i: &usize| !open.contains(i);
        let active = (0..u.len()).filter(is_active).map(|i| self.edges[i]).collect();
        Some((u, active))
    }

    /// b̃_i − Σ_j S_ij u_j.
    fn residual(&self, i: usize, u: &[f64]) -> f64 {
        self.load[i] - self.matrix[i].iter().zip(u).map(|(s, u)| s * u).sum::<f64>()
    }

    /// u_i ← max(ψ_i, u_i + r_i/S_ii) in turn; the largest change over the largest quantity
    /// of the problem. Every change is the complementarity residual of its moment.
    fn sweep(&self, u: &mut [f64]) -> f64 {
        let (mut largest, mut scale) = (0.0f64, f64::MIN_POSITIVE);
        for i in 0..u.len() {
            let step = self.residual(i, u) / self.matrix[i][i];
            let next = self.gap[i].max(u[i] + step);
            largest = largest.max((next - u[i]).abs());
            scale = scale.max(next.abs()).max((self.load[i] / self.matrix[i][i]).abs());
            u[i] = next;
        }
        largest / scale
    }
}

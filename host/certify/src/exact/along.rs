//! Points along boundary edges, with the exact solution, S and τ there.

use super::Integrands;
use crate::conductivity::{Conductivity, apply, dot};
use crate::sampled::Sampled;
use crate::transfer_points::unseen;
use crate::weighed::{Weighed, plus};
use signorini_kernel::mesh::geometry::scaled_normal;
use signorini_problem::pointwise::exact_at;
use signorini_problem::quadrature::{gauss, on_panels};
use signorini_scene::error::Result;

/// Panels on an edge, each with 8 points: the exact flux has kinks where contact ends.
const PANELS: u32 = 8;

/// Values at a point of a boundary edge.
pub(super) struct EdgePoint {
    pub x: [f64; 2],
    /// An element of length.
    pub weight: f64,
    pub u: f64,
    pub s: f64,
    /// σ·n
    pub sigma: f64,
    /// τ·n
    pub tau: f64,
}

impl<U: Sampled, L: Sampled> Integrands<'_, U, L> {
    /// The sum of a term over the points of an edge.
    pub(super) fn on_edge(
        &self,
        edge: usize,
        term: impl Fn(EdgePoint) -> Result<Weighed>,
    ) -> Result<Weighed> {
        let points = self.edge_points(edge)?.into_iter();
        points.map(term).try_fold([0.0; 2], |sum, term| Ok(plus(sum, term?)))
    }

    fn edge_points(&self, edge: usize) -> Result<Vec<EdgePoint>> {
        let (problem, length) = (self.problem, self.problem.lengths[edge]);
        let [a, b] = problem.segment(edge);
        let normal: [f64; 2] = scaled_normal(a, b).into();
        let (at, _) = problem.topology.first_side(edge);
        let conductivity = Conductivity::of(problem, at);
        let deviation = self.deviations.on(edge);
        let point = |[t, weight]: [f64; 2]| {
            let x = problem.along(edge, t);
            let (u, gradient) = exact_at(&self.problem.scene, self.exact, x, self.problem.time)?;
            Ok(EdgePoint {
                x,
                weight: weight * length,
                u,
                s: self.admissible.on_edge(problem, edge, deviation, t)?,
                sigma: dot(apply(&conductivity.at(x), gradient), normal) / length,
                tau: self.admissible.tau[edge] / length,
            })
        };
        self.rule_on(edge)?.into_iter().map(point).collect()
    }

    /// Points along an edge: those of its parts where h varies more than panels see.
    fn rule_on(&self, edge: usize) -> Result<Vec<[f64; 2]>> {
        let parts = unseen(self.problem, edge)?;
        let of_parts = parts.map(|points| points.iter().map(|at| [at.t, at.weight]).collect());
        let panels = || on_panels(self.panels * PANELS / self.fewer, &gauss(8));
        Ok(of_parts.unwrap_or_else(panels))
    }
}

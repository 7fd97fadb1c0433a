//! Transfer laws whose coefficient changes: their share of the residual, for every value of it.
//!
//! Where the flux of an edge is that of its law, ∫τ·n = ∫h(u_ext − u_E), and h is constant along it,
//! ```text
//!   τ·n + h(s − u_ext) = h (s − u_E − u_ext + ū_ext),     ∫(…)²/h = h ∫(s − u_E − u_ext + ū_ext)²,
//! ```
//! so that h is a factor of a form that does not know it.

use signorini_kernel::Real;
use signorini_kernel::mesh::boundary::Robin;

use super::block::{Block, Functions};
use signorini_certify::TermData;
use signorini_certify::robin::{RobinPoints, robin};
use signorini_problem::Problem;
use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::triangular::triangular;
use signorini_scene::error::Result;

/// Points along an edge with their weights.
const RULE: &[[f64; 2]] = f64::GAUSS[DATA_POINTS - 1];

/// Transfer laws whose coefficient changes, constant along each edge.
#[derive(Debug, Clone)]
pub(super) struct Laws {
    /// ∫π of every law, 0 where none changes.
    pub shares: Vec<f64>,
    /// The change of the input for which s is the best one.
    pub change: f64,
}

impl Laws {
    /// The rows that weigh a unit of the input.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn blocks(
        &self,
        problem: &Problem,
        patterns: &[TermData],
        functions: &Functions,
    ) -> Result<Vec<Block>> {
        let transfer = transfer(patterns)?;
        let laws = problem.loads.robin.iter().zip(&self.shares).enumerate();
        let changing = laws.filter(|(_, (_, share))| **share > 0.0);
        let block = |(at, (record, share)): (usize, (&Robin<f64, u32>, &f64))| {
            let ambient: Vec<_> = transfer.iter().map(|edges| edges[at]).collect();
            of_law(problem, record.edge as usize, functions, &ambient, *share)
        };
        Ok(changing.map(block).collect())
    }
}

/// \[h |E|, u_ext\] at the points of every law, for each pattern.
///
/// # Errors
/// Data that are not finite.
pub(super) fn transfer(patterns: &[TermData]) -> Result<Vec<Vec<RobinPoints>>> {
    patterns.iter().map(|pattern| robin(&pattern.problem, 0.0)).collect()
}

/// The rows of a transfer edge whose flux is its law's, h(ū_ext − u_E), where h is constant: τ·n + h(s − u_ext) is
/// h(s − u_E − u_ext + ū_ext) then, whatever h. `weight` is ∫h, or what a part of h adds to it. Means of u stand behind all
/// fluxes.
pub(super) fn of_law(
    problem: &Problem,
    edge: usize,
    functions: &Functions,
    ambient: &[RobinPoints],
    weight: f64,
) -> Block {
    let mean = |points: &RobinPoints| -> f64 {
        points.iter().zip(RULE).map(|(point, gauss)| gauss[1] * point[1]).sum()
    };
    let means: Vec<f64> = ambient.iter().map(mean).collect();
    let at_point = |at: usize, part: f64| {
        let root = (part * weight).sqrt();
        let given = ambient.iter().zip(&means);
        (root, -root, given.map(|(points, mean)| -root * (points[at][1] - mean)).collect())
    };
    let mean_of_u = (problem.ends.len() + edge) as u32;
    let points = RULE.iter().enumerate();
    let points = points.map(|(at, &[t, part])| (t, at_point(at, part)));
    of_edge(problem, edge, functions, (mean_of_u, ambient.len()), points)
}

/// The rows of a Robin edge: `ambient` holds \[h |E|, u_ext\] at its points for each pattern. Where h is
/// 0 the flux is, and there is nothing to add.
pub(super) fn of_robin(
    problem: &Problem,
    edge: usize,
    functions: &Functions,
    ambient: &[RobinPoints],
) -> Block {
    let transfer = |at: usize| ambient.first().map_or(0.0, |points| points[at][0]);
    let at_point = |at: usize, weight: f64| {
        let root = (weight * transfer(at)).sqrt();
        let given = ambient.iter().map(|points| -root * points[at][1]);
        (root, root / transfer(at), given.collect())
    };
    let points = RULE.iter().enumerate().filter(|(at, _)| transfer(*at) > 0.0);
    let points = points.map(|(at, &[t, weight])| (t, at_point(at, weight)));
    of_edge(problem, edge, functions, (edge as u32, ambient.len()), points)
}

/// Rows that weigh s along an edge against one number of it, `taken`. Of each point t there are the factor of s, that of the
/// number, and what the patterns give.
fn of_edge(
    problem: &Problem,
    edge: usize,
    functions: &Functions,
    (taken, patterns): (u32, usize),
    points: impl Iterator<Item = (f64, (f64, f64, Vec<f64>))>,
) -> Block {
    let of_s: Vec<u32> = problem.ends[edge].into_iter().chain(functions.bubble(edge)).collect();
    let mut columns = vec![Vec::new(); of_s.len() + 1 + patterns];
    for (t, (root, of_taken, given)) in points {
        let own = [1.0 - t, t, 4.0 * t * (1.0 - t)].map(|value| root * value);
        let row = own.into_iter().take(of_s.len()).chain([of_taken]).chain(given);
        columns.iter_mut().zip(row).for_each(|(to, entry)| to.push(entry));
    }
    Block { functions: of_s, edges: vec![taken], rows: triangular(columns) }
}

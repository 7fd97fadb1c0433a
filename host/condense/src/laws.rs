//! Transfer laws whose coefficient changes: their share of the residual, for every value of it.
//!
//! Where the flux of an edge is that of its law, ∫τ·n = ∫h(u_ext − u_E), and h is constant along it,
//! ```text
//!   τ·n + h(s − u_ext) = h (s − u_E − u_ext + ū_ext),     ∫(…)²/h = h ∫(s − u_E − u_ext + ū_ext)²,
//! ```
//! so that h is a factor of a form that does not know it.

use signorini_kernel::Real;
use signorini_kernel::mesh::boundary::Robin;

use super::Pieces;
use super::block::{Block, Functions};
use signorini_certify::TermData;
use signorini_certify::robin::{RobinPoints, robin};
use signorini_certify::transfer_points::{EdgePoint, MISSED_BETWEEN, unseen};
use signorini_problem::Problem;
use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::triangular::triangular;
use signorini_scene::error::Result;

/// m of a transfer coefficient that 8 points do not see.
const OPEN: f64 = 0.01;
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
    pub fn blocks(&self, pieces: &Pieces, functions: &Functions) -> Result<Vec<Block>> {
        let Pieces { problem, patterns, .. } = pieces;
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
    patterns.iter().map(|pattern| robin(&pattern.problem)).collect()
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

/// The points of a transfer edge for each pattern: those of its parts where 8 points do not see h.
///
/// # Errors
/// Data that are not finite.
pub(super) fn points_of(
    patterns: &[TermData],
    edge: usize,
    ambient: &[RobinPoints],
) -> Result<Vec<Vec<EdgePoint>>> {
    let own = |points: &RobinPoints| {
        let seen =
            |(&[t, weight], &[h, u]): (&[f64; 2], &[f64; 2])| EdgePoint::seen(t, weight, h, u);
        RULE.iter().zip(points).map(seen).collect::<Vec<_>>()
    };
    let of = |(pattern, points): (&TermData, &RobinPoints)| {
        Ok(unseen(&pattern.problem, edge)?.unwrap_or_else(|| own(points)))
    };
    patterns.iter().zip(ambient).map(of).collect()
}

/// The rows of a Robin edge: `ambient` holds its points for each pattern. Where h is
/// 0 the flux is, and there is nothing to add. Between two parabolas, with m the part that is left open,
/// ```text
///   ∫(τ·n + h(s − u_ext))²/h ≤ (1 + m) ∫(τ·n + h⁻(s − u_ext))²/h⁻ + (1 + 1/m) ∫N′(s − u_ext)²      (TransferForms)
/// ```
pub(super) fn of_robin(
    problem: &Problem,
    edge: usize,
    functions: &Functions,
    ambient: &[Vec<EdgePoint>],
) -> Block {
    let points = ambient.first().map_or(&[][..], |points| points);
    let is_open = points.iter().any(|at| at.above() > 0.0);
    let more = if is_open { (1.0 + OPEN) * (1.0 + MISSED_BETWEEN).powi(2) } else { 1.0 };
    let row = |at: usize, square: f64, of_taken: f64| {
        let root = (points[at].weight * square).sqrt();
        let given = ambient.iter().map(|all| -root * all[at].ambient);
        (points[at].t, (root, root * of_taken, given.collect()))
    };
    let rows = (0..points.len()).filter(|&at| points[at].between[0] > 0.0).flat_map(|at| {
        let [low, above] = [points[at].between[0], points[at].above()];
        let open = (1.0 + 1.0 / OPEN) * above;
        [Some(row(at, more * low, 1.0 / low)), is_open.then(|| row(at, open, 0.0))]
    });
    of_edge(problem, edge, functions, (edge as u32, ambient.len()), rows.flatten())
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

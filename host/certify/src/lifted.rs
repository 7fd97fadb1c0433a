//! What s follows of curved data from step to step.
//!
//! ```text
//!   S = s + L,   L = Σ v_E,   v_E = (1 − η) w(t) in the cell of E,   w = data less their chord
//! ```
//! S follows all curved data in a step of time, wherever it is open: L goes linearly in time from that of the step before, as the data
//! do. It adds k(L − L_old) to what the step leaves of its equation:
//! ```text
//!   |∫ k(L − L_old) e| ≤ (Σ k‖L − L_old‖²)^½ ‖k^½ e‖,      ‖v_E‖² = |T|/2 ∫w² on triangles, at most max|J|/3 ∫w² on quads
//! ```
//! which is 0 where data do not move. What points of an edge miss of both w counts.

use std::collections::BTreeMap;

use super::cell::Cell;
use super::curved::CurvedEdges;
use super::deviation::{Deviation, Deviations};
use signorini_problem::{Problem, Trace};
use signorini_scene::error::Result;
use signorini_scene::scene::units::Units;
use signorini_scene::scene::{Condition, Field};

/// The extensions of a time, and how far they are from those of the step before.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Lifts {
    /// ‖A^½∇L‖
    pub energy: f64,
    /// (Σ k‖L − L_old‖²)^½, 0 outside of steps.
    pub moved: f64,
    /// w along the edges on which data may move.
    pub traces: Vec<Trace>,
}

impl Lifts {
    /// Of `problem`, whose materials store u, by its records and traces.
    pub fn new(problem: &Problem, curved: &CurvedEdges, traces: Vec<Trace>) -> Self {
        let energy: f64 = curved.records.iter().map(|record| record.energy).sum();
        let energy = energy.max(0.0).sqrt() + curved.left_out;
        let moved = problem.loads.step.as_ref().map_or(0.0, |step| {
            moved(problem, [&step.begin.traces, &traces], |cell| step.content(cell))
        });
        Self { energy, moved, traces }
    }

    /// From `units` to those that the problem had before.
    #[must_use]
    pub fn in_units(self, units: &Units) -> Self {
        Self {
            energy: self.energy * units.energy(),
            moved: self.moved * units.energy(),
            traces: self.traces.into_iter().map(|trace| trace.in_unit(units.u.recip())).collect(),
        }
    }
}

/// The traces of these deviations, whose records are `curved`, where they may move.
///
/// # Errors
/// Data that are not finite.
pub fn traces(
    problem: &Problem,
    deviations: &Deviations,
    curved: &CurvedEdges,
) -> Result<Vec<Trace>> {
    let all = deviations.found.iter().zip(curved.points());
    all.filter(|(of, _)| may_move(problem, of.edge)).map(trace).collect()
}

/// Whether time or an input changes ψ or u_D on an edge.
fn may_move(problem: &Problem, edge: usize) -> bool {
    let Some(boundary) = problem.boundary_of(edge) else { return false };
    let datum = match &boundary.condition {
        Condition::Dirichlet { value } => value,
        Condition::Contact { gap, .. } => gap,
        Condition::Neumann { .. } | Condition::Robin { .. } => return false,
    };
    let mut inputs = problem.inputs_of(boundary, &[Field::Value, Field::Gap]);
    datum.value.uses_time() || inputs.next().is_some()
}

fn trace((deviation, (points, missed)): (&Deviation, (Vec<[f64; 2]>, f64))) -> Result<Trace> {
    let sample = |[t, weight]: [f64; 2]| Ok([t, weight, deviation.at(t)?[0]]);
    let samples = points.into_iter().map(sample).collect::<Result<_>>()?;
    Ok(Trace { edge: deviation.edge as u32, samples, missed })
}

/// (Σ k‖L − L_old‖²)^½ for traces of before and now.
fn moved(problem: &Problem, [before, now]: [&[Trace]; 2], content: impl Fn(usize) -> f64) -> f64 {
    let mut of_cells = BTreeMap::new();
    let mut edges: Vec<u32> = before.iter().chain(now).map(|trace| trace.edge).collect();
    edges.sort_unstable();
    edges.dedup();
    for edge in edges {
        let of = |all: &[Trace]| all.iter().position(|trace| trace.edge == edge);
        let root = match [of(before).map(|at| &before[at]), of(now).map(|at| &now[at])] {
            [Some(old), Some(new)] => apart(old, new),
            either => either.into_iter().flatten().map(Trace::size).sum(),
        };
        let (cell, _) = problem.topology.first_side(edge as usize);
        *of_cells.entry(cell).or_insert(0.0) +=
            (share(problem, cell) * content(cell)).sqrt() * root;
    }
    of_cells.values().fold(0.0_f64, |sum, of| sum.hypot(*of))
}

/// (∫(w − w_old)²)^½
fn apart(old: &Trace, new: &Trace) -> f64 {
    let is_same = |(a, b): (&[f64; 3], &[f64; 3])| a[0] == b[0];
    if old.samples.len() != new.samples.len() || !old.samples.iter().zip(&new.samples).all(is_same)
    {
        // What one rule misses of the other's data is not known.
        return old.size() + new.size();
    }
    let square =
        |([_, weight, before], [.., now]): (&[f64; 3], &[f64; 3])| weight * (now - before).powi(2);
    let sum: f64 = old.samples.iter().zip(&new.samples).map(square).sum();
    sum.sqrt() + old.missed.sqrt() + new.missed.sqrt()
}

/// ‖v_E‖² over |T|∫w² at most.
pub(crate) fn share(problem: &Problem, at: usize) -> f64 {
    let cell = Cell::of(problem, at);
    if cell.corners().len() == 3 {
        return 0.5;
    }
    let element = |[x, y]: [f64; 2]| cell.determinant([x, y, 0.0]);
    let most = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(element);
    most.into_iter().fold(0.0, f64::max) / (3.0 * element([0.5, 0.5]))
}

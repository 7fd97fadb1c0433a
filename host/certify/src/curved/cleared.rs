//! Where S is so far from ψ that it needs no extension: the kernel leaves it out there, and so do these norms.
//!
//! w is 0 at both ends of its edge, so that
//! ```text
//!   |w| ≤ ½ ∫₀¹ |w′| dt ≤ ½ (∫₀¹ w′² dt)^½ =: peak.
//! ```
//! On quads the bubbles of S make up for w, and where more sides of a cell are curved, their products are in the records.

use std::collections::BTreeMap;

use signorini_bound::certificate::is_clear;

use super::panels::Panels;
use crate::admissible::{Admissible, Following};
use crate::deviation::{Deviation, Deviations};
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::error::Result;

/// Peaks are rounded up by this part, for scalars that are narrower.
const ROOM: f64 = 1e-6;

/// Selects those `edges` that are the only ones of a triangle, and on C: S may have no extension there.
pub fn may_be_cleared(problem: &Problem, edges: impl Iterator<Item = usize> + Clone) -> Vec<bool> {
    let cell = |edge: usize| problem.topology.first_side(edge).0;
    let mut of_cells = BTreeMap::new();
    edges.clone().for_each(|edge| *of_cells.entry(cell(edge)).or_insert(0) += 1);
    let is_alone = |edge: usize| {
        let is_triangle = cell(edge) < problem.mesh.triangles.len();
        is_triangle && problem.kinds[edge] == EdgeKind::Contact && of_cells[&cell(edge)] == 1
    };
    edges.map(is_alone).collect()
}

/// The deviations that S follows into its cells.
///
/// # Errors
/// Data that are not finite.
pub fn followed<'s>(problem: &'s Problem, s: &Admissible) -> Result<Deviations<'s>> {
    let mut deviations = Deviations::of(problem)?;
    if let Following::Except(edges) = s.following {
        deviations.found.retain(|deviation| !edges.contains(&(deviation.edge as u32)));
        return Ok(deviations);
    }
    let may = may_be_cleared(problem, deviations.found.iter().map(|deviation| deviation.edge));
    let is_followed = |(deviation, may): (&Deviation, bool)| {
        let above =
            deviation.above_chord(problem.ends[deviation.edge].map(|v| s.vertices[v as usize]));
        Ok(!(may && is_clear(above, peak(deviation)?)))
    };
    let followed: Result<Vec<bool>> = deviations.found.iter().zip(may).map(is_followed).collect();
    let mut followed = followed?.into_iter();
    deviations.found.retain(|_| followed.next().unwrap_or(true));
    Ok(deviations)
}

/// A bound of |w|; infinite where w has no finite energy.
///
/// # Errors
/// Data that are not finite.
pub fn peak(deviation: &Deviation) -> Result<f64> {
    peak_on(deviation, &Panels::along(deviation)?)
}

/// Largest rise on an edge, with the panels that its data need.
pub(super) fn peak_on(deviation: &Deviation, panels: &Panels) -> Result<f64> {
    if panels.rough.is_some() {
        return Ok(f64::INFINITY);
    }
    let slope = |[t, weight]: [f64; 2]| Ok((deviation.at(t)?[1], weight));
    let found: Vec<_> = panels.rule().into_iter().map(slope).collect::<Result<_>>()?;
    let slopes = norm(found.into_iter()) + panels.missed[1].sqrt();
    Ok(0.5 * slopes * (1.0 + ROOM))
}

/// (Σ weight · slope²)^½, whatever the unit of w is.
fn norm(slopes: impl Iterator<Item = (f64, f64)>) -> f64 {
    slopes.fold(0.0, |norm: f64, (slope, weight)| norm.hypot(slope * weight.sqrt()))
}

//! The mean of u over a part P of the boundary.
//!
//! A flux ζ without sources that leaves through P alone, evenly, weighs the error of u there:
//! ```text
//!   mean_P (u − s) = ∫ ζ·∇(u − s) − ∫_R θ (u − s),    ∇·ζ = 0,  ζ·n = 1/|P| on P, 0 on the rest of N and C,  θ on R
//!   |…| ≤ (‖A^{−½}ζ‖² + ∫_R θ²/h)^½ · (error bound + oscillation)
//! ```
//! ζ is the balanced flux of the linear problem with these data, whose norm is at most that of its s and its error bound together. Where P
//! has a transfer law, ∫_R h (u − s)² alone tells how far the mean can be off.

use super::dual::{Data, Dual};
use super::part::Part;
use super::{Found, OutputBound, none};
use crate::certify::curved::followed;
use crate::certify::robin::robin;
use crate::energy_norm;
use crate::problem::{EdgeKind, Problem};
use crate::quadrature::DATA_POINTS;
use crate::solve::Solution;
use signorini_kernel::Real;
use signorini_scene::error::Result;

/// The interval; `reach` is how far u and s are from each other, with what data lose between their means.
pub(super) fn interval(
    problem: &Problem,
    solution: &Solution,
    part: &Part,
    reach: f64,
) -> Result<Found> {
    let width = match part.kind() {
        None => return none("its boundary has no edge"),
        Some(EdgeKind::Robin) => of_transfer(problem, part)?,
        Some(_) => of_flux(problem, part)?,
    };
    let width = match width {
        Ok(width) => reach * width,
        Err(why) => return Ok(Err(why)),
    };
    let (center, terms) = mean(problem, solution, part)?;
    let of = format!("the mean of u over {}", part.name());
    Ok(Ok(OutputBound::between(center - width, center + width, terms, of)))
}

fn length(problem: &Problem, part: &Part) -> f64 {
    part.edges().map(|edge| problem.lengths[edge]).sum()
}

/// The mean of s, and the size of what it is summed from.
fn mean(problem: &Problem, solution: &Solution, part: &Part) -> Result<(f64, f64)> {
    let s = solution.certified.admissible();
    let deviations = followed(problem, &s)?;
    let [mut sum, mut terms] = [0.0; 2];
    for edge in part.edges() {
        for &[t, weight] in f64::GAUSS[DATA_POINTS - 1] {
            let value = s.on_edge(problem, edge, deviations.on(edge), t)?;
            sum += problem.lengths[edge] * weight * value;
            terms += problem.lengths[edge] * weight * value.abs();
        }
    }
    let length = length(problem, part);
    Ok((sum / length, terms / length))
}

/// (∫_P 1/(|P|² h))^½
fn of_transfer(problem: &Problem, part: &Part) -> Result<std::result::Result<f64, String>> {
    let transfer = robin(problem, problem.time)?;
    let mut square = 0.0;
    for (record, points) in problem.loads.robin.iter().zip(&transfer) {
        let edge = record.edge as usize;
        if part.has(edge) {
            let length = problem.lengths[edge];
            for (&[_, weight], [h, _]) in f64::GAUSS[DATA_POINTS - 1].iter().zip(points) {
                square += weight * length * length / h;
            }
        }
    }
    let norm = square.sqrt() / length(problem, part);
    Ok(if norm.is_finite() {
        Ok(norm)
    } else {
        Err("its transfer coefficient is 0 somewhere".to_owned())
    })
}

/// A limit of (‖A^{−½}ζ‖² + ∫_R θ²/h)^½
fn of_flux(problem: &Problem, part: &Part) -> Result<std::result::Result<f64, String>> {
    if part.kind() == Some(EdgeKind::Dirichlet) {
        // s is what is given, but for what its oscillation counts.
        return Ok(Ok(0.0));
    }
    let is_held = |kind: &EdgeKind| matches!(kind, EdgeKind::Dirichlet | EdgeKind::Robin);
    if !problem.kinds.iter().any(is_held) {
        return Ok(Err("contact alone holds the domain".to_owned()));
    }
    let density = 1.0 / length(problem, part);
    let dual = Dual::solve(problem, |at| {
        use signorini_scene::scene::Condition::{Dirichlet, Robin};
        match problem.scene.boundaries[at].condition {
            Dirichlet { .. } | Robin { .. } => Data::Value(0.0),
            _ if part.has_table(at) => Data::Flux(density),
            _ => Data::Flux(0.0),
        }
    })?;
    let (problem, solution) = dual.parts();
    let norm = energy_norm::of_solution(problem, solution)?;
    Ok(match (norm, solution.bound) {
        (Some(norm), Some(bound)) => Ok(norm + bound.total),
        _ => Err("the flux that weighs its error has no bound".to_owned()),
    })
}

//! Ranges of inputs within which a limit may fall below the least flux: refused before a controller is written.
//!
//! ```text
//!   min (hi − lo)(x) = hi₀ − lo₀ + Σ_j min(a_j c_j, b_j c_j),   c_j = ϖ_j − π_j at x,   a_j ≤ p_j ≤ b_j
//! ```
//! at the points of the rule for edge data and at the ends of every edge. An input without a range counts at its default: what
//! else it may be is refused tick by tick.

use signorini_kernel::Real;
use signorini_kernel::flux_range::settled;

use super::limits::TERMS;
use super::{Problem, Sum};
use crate::quadrature::DATA_POINTS;
use signorini_scene::error::Result;
use signorini_scene::scene::{Boundary, Condition, Field, Input};

impl Problem {
    /// Refuses ranges of inputs that leave a contact edge no flux.
    ///
    /// # Errors
    /// The first point with such a corner of the ranges, at the range of its first input.
    pub fn check_limits_within_ranges(&self) -> Result<()> {
        let counts = self.topology.counts;
        (counts.free..counts.unknowns()).try_for_each(|edge| {
            let Some(boundary) = self.binding.boundary(self.ends[edge]) else { return Ok(()) };
            let boundary = &self.scene.boundaries[boundary];
            if inputs(self, boundary).all(|input| input.range.is_none()) {
                return Ok(());
            }
            let [a, b] = self.segment(edge);
            let inside = f64::GAUSS[DATA_POINTS - 1].iter().map(|point| point[0]);
            let points = inside.chain([0.0, 1.0]);
            let mut points = points.map(|t| [0, 1].map(|k| a[k] + t * (b[k] - a[k])));
            points.try_for_each(|point| check_at(self, boundary, point))
        })
    }
}

/// The inputs of either end of a boundary's flux.
fn inputs<'p>(problem: &'p Problem, boundary: &'p Boundary) -> impl Iterator<Item = &'p Input> {
    let is_end = |input: &&Input| matches!(input.field.value, Field::Flux | Field::Limit);
    let of_it = |input: &&Input| input.of.value == boundary.name.value;
    problem.scene.inputs.iter().filter(is_end).filter(of_it)
}

fn check_at(problem: &Problem, boundary: &Boundary, [x, y]: [f64; 2]) -> Result<()> {
    let Condition::Contact { flux, limit, .. } = &boundary.condition else { return Ok(()) };
    let at = |expression| Sum::alone(&problem.scene, expression, problem.time).at(x, y);
    let [mut least, mut most] = [flux, limit].map(at);
    if !(least.is_finite() && most.is_finite()) {
        return Ok(());
    }
    let (mut size, mut worst) = (least.abs() + most.abs(), Vec::new());
    for input in inputs(problem, boundary) {
        let pattern = at(&input.pattern);
        let is_limit = input.field.value == Field::Limit;
        let opens = if is_limit { pattern } else { -pattern };
        let value = match &input.range {
            Some(range) if opens > 0.0 => range.value.lo,
            Some(range) => range.value.hi,
            None => input.default,
        };
        *(if is_limit { &mut most } else { &mut least }) += value * pattern;
        size += (value * pattern).abs();
        if opens != 0.0 {
            worst.push((input, value));
        }
    }
    if settled(most - least, size, TERMS).is_some() {
        return Ok(());
    }
    let corner: Vec<_> =
        worst.iter().map(|(input, value)| format!("{} = {value}", input.name.value)).collect();
    let message = format!(
        "with {} the limit of boundary.{} is {most} at ({x}, {y}), less than flux = {least} there",
        corner.join(" and "),
        boundary.name.value
    );
    let hint = "narrow the range: whatever inputs are within it, the flux must have room between both ends";
    let culprit = worst.iter().find_map(|(input, _)| input.range.as_ref());
    let refused = culprit.map_or_else(
        || problem.scene.error(limit, &message),
        |range| problem.scene.error(range, &message),
    );
    Err(refused.hint(hint).into())
}

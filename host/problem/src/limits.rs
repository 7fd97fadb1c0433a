//! The ends of a contact edge's flux: nowhere the wrong way round, as they stand and for whatever inputs are in their ranges.
//!
//! ```text
//!   lo(x) = flux + Σ_j p_j π_j ≤ hi(x) = limit + Σ_j p_j ϖ_j
//!   min (hi − lo)(x) = hi₀ − lo₀ + Σ_j min(a_j c_j, b_j c_j),   c_j = ϖ_j − π_j at x,   a_j ≤ p_j ≤ b_j
//! ```
//! at the points of the rule for edge data, at the ends of every edge and where parts of it are proved to hold the least. An input without a range counts at its default: what
//! else it may be is refused tick by tick.
//!
//! Means of them are what the kernel has: the smaller one in size as the base of the range, and the way to the other as its
//! span. Where inputs change either end, both are sums over these:
//! ```text
//!   ∫lo = Σ_j p_j ∫π_j,   ∫(hi − lo) = Σ_j p_j ∫(ϖ_j − π_j),   p_0 = 1 for what the scene states
//! ```
//! The base of a range is its lower end then, wherever that is finite, else the upper one: the smaller of both would depend on
//! the inputs.

use signorini_kernel::flux_range::settled;

use super::widths::{self, ENDS};
use super::{Problem, Sum};
use crate::quadrature::enclosed::Integral;
use signorini_scene::error::Result;
use signorini_scene::scene::term::Term;
use signorini_scene::scene::{Boundary, Condition, Field};

/// The means of both ends of a contact edge's flux, and what is missed of them; an infinite end is its own mean.
pub(super) fn ends(problem: &Problem, edge: usize) -> Result<([f64; 2], f64)> {
    let mean = |field, unlimited: f64| {
        let stated = |value| Integral { value, missed: 0.0 };
        let Some(end) = Sum::on_edge(problem, edge, field) else {
            return Ok(stated(unlimited));
        };
        let infinite = end.constant().filter(|end| end.is_infinite());
        infinite.map_or_else(|| end.mean_and_missed(problem.segment(edge)), |end| Ok(stated(end)))
    };
    let [least, most] = [mean(Field::Flux, f64::NEG_INFINITY)?, mean(Field::Limit, f64::INFINITY)?];
    Ok(([least.value, most.value], least.missed.max(most.missed)))
}

/// Base and span of a contact edge from the means of its ends over a length of `length`, and by how much either end was moved:
/// where rounding has put the upper one below the lower one, both are their mean.
pub(super) fn base_and_span([least, most]: [f64; 2], length: f64) -> [f64; 3] {
    if most < least {
        let half = 0.5 * (least - most);
        return [length * (most + half), 0.0, length * half];
    }
    let span = length * (most - least);
    match most.abs() < least.abs() {
        true => [length * most, -span, 0.0],
        false => [length * least, span, 0.0],
    }
}

/// Refuses a lower end above the upper one.
///
/// # Errors
/// The first edge with such a point, with both values.
pub(super) fn check(problem: &Problem) -> Result<()> {
    let scene = &problem.scene;
    if !scene.boundaries.iter().any(|boundary| boundary.condition.is_limited()) {
        return Ok(());
    }
    let counts = problem.topology.counts;
    (counts.free..counts.unknowns()).try_for_each(|edge| check_edge(problem, edge))
}

fn check_edge(problem: &Problem, edge: usize) -> Result<()> {
    let end = |field| Sum::on_edge(problem, edge, field);
    let (Some(least), Some(most)) = (end(Field::Flux), end(Field::Limit)) else { return Ok(()) };
    let Some(range) = widths::now(problem, edge) else { return Ok(()) };
    for [x, y] in problem.looks(edge, &[range]) {
        let (low, high) = (least.at(x, y), most.at(x, y));
        let terms = || least.terms_at(x, y) + most.terms_at(x, y);
        if low > high && settled(high - low, terms()).is_none() {
            let message = format!(
                "the limit is {high} at ({x}, {y}), less than flux = {low} there{}",
                problem.inputs_there(edge)
            );
            let hint =
                "the flux of a contact boundary lies between `flux` and `limit`, inputs included";
            return Err(problem.scene.error(most.key(), message).hint(hint).into());
        }
    }
    Ok(())
}

impl Problem {
    /// The inputs that move an end of this edge's flux, with their values.
    fn inputs_there(&self, edge: usize) -> String {
        let boundary = self.boundary_of(edge).into_iter();
        let inputs = boundary.flat_map(|boundary| self.inputs_of(boundary, &ENDS));
        let all: Vec<_> =
            inputs.map(|input| format!("input.{} = {}", input.name.value, input.default)).collect();
        if all.is_empty() { String::new() } else { format!(", with {}", all.join(", ")) }
    }
}

/// Contribution of one term of the loads to the ranges, with an entry for each contact edge.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RangeTerm {
    /// To the base: ∫lo, or ∫hi where lo = −∞.
    pub fluxes: Vec<f64>,
    /// To ∫(hi − lo), which has either sign; ±∞ stands in the first term alone.
    pub spans: Vec<f64>,
    /// By how much ends were moved to their mean at most, on edges where no input moves one.
    pub moved: f64,
}

impl Problem {
    /// Refuses ranges of inputs that leave a contact edge no flux, before a controller is written.
    ///
    /// # Errors
    /// The first point with such a corner of the ranges, at the range of its first input.
    pub fn check_limits_within_ranges(&self) -> Result<()> {
        let counts = self.topology.counts;
        (counts.free..counts.unknowns()).try_for_each(|edge| {
            let Some(boundary) = self.boundary_of(edge) else { return Ok(()) };
            if self.inputs_of(boundary, &ENDS).all(|input| input.range.is_none()) {
                return Ok(());
            }
            let Some(terms) = widths::terms(self, boundary) else { return Ok(()) };
            self.looks(edge, &terms).try_for_each(|point| check_at(self, boundary, point))
        })
    }

    /// Contribution of one unit of `term`, which is 0 for what the scene states.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn range_term(&self, term: Term) -> Result<RangeTerm> {
        let alone = self.left_with(&[term])?;
        let counts = self.topology.counts;
        let mut all = RangeTerm::default();
        for edge in counts.free..counts.unknowns() {
            let (ends, _) = ends(&alone, edge)?;
            let [mut base, mut span] = lower_and_span(ends, self.lengths[edge]);
            // Where an input moves an end, a tick does that.
            let of_inputs = || {
                self.boundary_of(edge).is_some_and(|of| self.inputs_of(of, &ENDS).next().is_some())
            };
            if span < 0.0 && span.is_finite() && !of_inputs() {
                all.moved = all.moved.max(-0.5 * span);
                (base, span) = (base + 0.5 * span, 0.0);
            }
            all.fluxes.push(base);
            all.spans.push(if term == 0 || span.is_finite() { span } else { 0.0 });
        }
        Ok(all)
    }
}

fn check_at(problem: &Problem, boundary: &Boundary, [x, y]: [f64; 2]) -> Result<()> {
    let Condition::Contact { flux, limit, .. } = &boundary.condition else { return Ok(()) };
    let at = |expression| Sum::alone(&problem.scene, expression, problem.time).at(x, y);
    let [mut least, mut most] = [flux, limit].map(at);
    if !(least.is_finite() && most.is_finite()) {
        return Ok(());
    }
    let (mut size, mut worst) = (least.abs() + most.abs(), Vec::new());
    for input in problem.inputs_of(boundary, &ENDS) {
        let pattern = at(&input.pattern);
        let is_limit = input.field.value == Field::Limit;
        let opens = if is_limit { pattern } else { -pattern };
        let value = input.end(opens <= 0.0);
        *(if is_limit { &mut most } else { &mut least }) += value * pattern;
        size += (value * pattern).abs();
        if opens != 0.0 {
            worst.push((input, value));
        }
    }
    if settled(most - least, size).is_some() {
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

/// The base that no input may change, and the way to the other end.
fn lower_and_span([least, most]: [f64; 2], length: f64) -> [f64; 2] {
    match least == f64::NEG_INFINITY {
        true => [length * most, f64::NEG_INFINITY],
        false => [length * least, length * (most - least)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{PARABOLA, changed, on_grid};
    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_tolerances::solve::RANGE_TERMS;

    /// PARABOLA's contact, with ends of its own and inputs of either.
    fn scene() -> String {
        let inputs = "
input.weak = { of = \"contact\", field = \"limit\", pattern = \"1 + x\", default = 0.5 }
input.leak = { of = \"contact\", field = \"flux\", pattern = \"-2\" }
";
        let limited = ("gap = \"-x^2\"", "gap = \"-x^2\", limit = \"4 - x^2\"");
        changed(PARABOLA, &[limited]) + inputs
    }

    #[test]
    fn terms_add_up_to_the_ranges_of_every_input() -> Result<()> {
        let (_, problem) = on_grid(&scene(), grid(5, Cells::Triangles))?;
        let terms: Vec<_> = (0..3).map(|term| problem.range_term(term)).collect::<Result<_>>()?;
        for [weak, leak] in [[0.5, 0.0], [-1.0, 1.0], [3.0, -0.5]] {
            let now = problem.with_inputs(&[weak, leak])?;
            let sum = |of: fn(&RangeTerm) -> &Vec<f64>, at: usize| {
                of(&terms[0])[at] + weak * of(&terms[1])[at] + leak * of(&terms[2])[at]
            };
            for at in 0..problem.topology.counts.contact {
                let [least, most] = now.loads.flux_range(at).ends();
                let base = sum(|term| &term.fluxes, at);
                RANGE_TERMS.check(format_args!("lo, {at}"), base - least);
                let span = sum(|term| &term.spans, at);
                RANGE_TERMS.check(format_args!("hi, {at}"), base + span - most);
            }
        }
        Ok(())
    }
}

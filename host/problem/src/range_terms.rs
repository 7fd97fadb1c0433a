//! Ranges of contact fluxes as sums over inputs, where inputs change either end.
//!
//! ```text
//!   ∫lo = Σ_j p_j ∫π_j,   ∫(hi − lo) = Σ_j p_j ∫(ϖ_j − π_j),   p_0 = 1 for what the scene states
//! ```
//! The base of a range is its lower end wherever that is finite, else the upper one. (Where no input acts on a range it is the
//! smaller of both, [`super::limits`]; that choice would depend on the inputs.)

use super::{Problem, limits};
use signorini_scene::error::Result;
use signorini_scene::scene::term::Term;

/// Contribution of one term of the loads to the ranges, with an entry for each contact edge.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RangeTerm {
    /// To the base: ∫lo, or ∫hi where lo = −∞.
    pub fluxes: Vec<f64>,
    /// To ∫(hi − lo), which has either sign; ±∞ stands in the first term alone.
    pub spans: Vec<f64>,
    /// Whether hi − lo varies along an edge.
    pub varies: bool,
}

impl Problem {
    /// Contribution of one unit of `term`, which is 0 for what the scene states.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn range_term(&self, term: Term) -> Result<RangeTerm> {
        let alone = self.left_with(&[term])?;
        let counts = self.topology.counts;
        let mut all = RangeTerm::default();
        for edge in counts.free..counts.unknowns() {
            let ends = limits::ends(&alone, edge, self.time)?;
            let [base, span] = lower_and_span(ends, self.lengths[edge]);
            all.fluxes.push(base);
            all.spans.push(if term == 0 || span.is_finite() { span } else { 0.0 });
            all.varies |= limits::spread(&alone, edge, self.time).is_some();
        }
        Ok(all)
    }
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
        assert_eq!([0, 1, 2].map(|term: usize| terms[term].varies), [true, true, false]);
        Ok(())
    }
}

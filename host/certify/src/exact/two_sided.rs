//! Charge of the bound on a contact edge whose flux has two ends, lo and hi.

use super::{EdgePoint, Integrands};
use crate::sampled::Sampled;
use crate::weighed::{Weighed, plus, twice};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

impl<U: Sampled, L: Sampled> Integrands<'_, U, L> {
    /// The contact term of an edge, where τ has for its flux the mean of τ*·n = lo + θ (hi − lo) = τ·n − c:
    /// ```text
    ///   2∫[(σ·n − lo)(S − ψ)⁺ + (hi − σ·n)(ψ − S)⁺ + (τ*·n − lo)(u − ψ)⁺ + (hi − τ*·n)(ψ − u)⁺ − c (S − u)]
    ///   + 2∫ (most − (hi − lo)) (θ (S − ψ)⁺ + (1 − θ)(ψ − S)⁺)
    /// ```
    /// The last term is where hi − lo varies: the bound has for hi − lo the largest value that it may have.
    pub(super) fn two_sided(&self, edge: usize) -> Result<Weighed> {
        let ends = [Field::Flux, Field::Limit].map(|field| self.data(edge, field));
        let ([Some(least), Some(most)], Some(gap)) = (ends, self.data(edge, Field::Gap)) else {
            return Ok([0.0; 2]);
        };
        let (problem, length) = (self.problem, self.problem.lengths[edge]);
        let range = problem.loads.flux_range(edge - problem.topology.counts.free);
        let means = range.ends().map(|end| end / length);
        let tau = self.admissible.tau[edge] / length;
        let theta = match (means[0].is_finite(), means[1].is_finite()) {
            (true, true) if means[0] < means[1] => (tau - means[0]) / (means[1] - means[0]),
            (is_finite, _) => f64::from(u8::from(!is_finite)),
        };
        let largest = means[1] - means[0] + problem.loads.span_excess / length;
        let varies = problem.loads.span_excess > 0.0 && largest.is_finite() && means[0] < means[1];
        let term = |point: EdgePoint| {
            let [x, y] = point.x;
            let (ends, psi) = ([least.at(x, y), most.at(x, y)], gap.at(x, y));
            let EdgePoint { weight, u, s, sigma, tau, .. } = point;
            let moved = |end: usize, share: f64| match share == 0.0 {
                true => 0.0,
                false => share * (means[end] - ends[end]),
            };
            let c = moved(0, 1.0 - theta) + moved(1, theta);
            let mut sum = twice(weight, [s, u], [0.0, c]);
            for (flux, end, value) in [(sigma, ends, s), (tau, ends.map(|end| end + c), u)] {
                if end[0].is_finite() && (value > psi || !end[1].is_finite()) {
                    sum = plus(sum, twice(weight, [flux, end[0]], [value, psi]));
                } else if end[1].is_finite() {
                    sum = plus(sum, twice(weight, [flux, end[1]], [value, psi]));
                }
            }
            if varies {
                let share = if s < psi { 1.0 - theta } else { theta };
                let spans = [share * largest, share * (ends[1] - ends[0])];
                sum = plus(sum, twice(weight, spans, [s.max(psi), s.min(psi)]));
            }
            Ok(sum)
        };
        self.on_edge(edge, term)
    }
}

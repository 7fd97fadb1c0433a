//! By how much the range of a contact flux, hi − lo, varies along an edge.
//!
//! The kernel has its mean alone. There is a flux with τ·n = lo + θ (hi − lo) all along the edge, θ being that of its mean: it
//! is within the law wherever lo ≤ hi. The contact term of the bound has the true range then,
//! ```text
//!   2∫ θ (hi − lo)(s − ψ)⁺ + (1 − θ)(hi − lo)(ψ − s)⁺,
//! ```
//! and is bounded by the largest value of hi − lo on each side: its mean and an excess.

use super::limits::ENDS;
use super::{Problem, Sum};
use crate::quadrature::{gauss, on_panels};
use signorini_scene::scene::{Datum, Field, Input};

/// Gauss points a panel, and panels on an edge, at which the least and the largest span are looked for.
const POINTS: usize = 8;
const PANELS: u32 = 4;
/// Part of a constant difference that rounding may leave.
const CONSTANT: f64 = 1e-12;

/// By how much |E| (hi − lo) exceeds its integral somewhere on a contact edge; `None` where an end is infinite, or hi − lo is
/// constant along the edge.
pub fn excess(problem: &Problem, edge: usize, time: f64) -> Option<f64> {
    let [least, most] = ENDS.map(|field| Sum::on_edge(problem, edge, field, time));
    let whole = Width { least, most: Some(most?), values: [1.0; 2] };
    whole.is_finite().then(|| excess_of(problem, edge, &[whole])).flatten()
}

/// [`excess`] for all inputs within their ranges, at most:
/// ```text
///   (hi − lo) − its mean = Σ_j p_j d_j ≤ Σ_j max(a_j d_j, b_j d_j),   a_j ≤ p_j ≤ b_j,   p_0 = 1
/// ```
/// Infinite where an input of an end has no range: ticks refuse values that leave the edge no flux in the mean, not those that
/// leave none in a part of it.
pub fn excess_within_ranges(problem: &Problem, edge: usize) -> Option<f64> {
    let boundary = problem.boundary_of(edge)?;
    let alone = |expression| Sum::alone(&problem.scene, expression, problem.time);
    let [least, most] = ENDS.map(|field| boundary.condition.load(field).map(alone));
    let stated = Width { least, most: Some(most?), values: [1.0; 2] };
    if !stated.is_finite() {
        return None;
    }
    let inputs = problem.inputs_of(boundary, &ENDS).map(|input| Width::of_input(input, alone));
    let all: Vec<_> = std::iter::once(stated).chain(inputs).collect();
    let is_ranged = problem.inputs_of(boundary, &ENDS).all(|input| input.range.is_some());
    let most = excess_of(problem, edge, &all)?;
    Some(if is_ranged { most } else { f64::INFINITY })
}

/// A term of hi − lo, with the least and the largest factor that it may have.
struct Width<'s> {
    least: Option<Sum<'s>>,
    most: Option<Sum<'s>>,
    values: [f64; 2],
}

impl<'s> Width<'s> {
    fn of_input(input: &'s Input, alone: impl Fn(&'s Datum) -> Sum<'s>) -> Self {
        let (pattern, values) = (Some(alone(&input.pattern)), input.interval());
        match input.field.value {
            Field::Limit => Self { least: None, most: pattern, values },
            _ => Self { least: pattern, most: None, values },
        }
    }

    fn is_finite(&self) -> bool {
        let is_infinite = |end: &Sum| end.constant().is_some_and(f64::is_infinite);
        !self.least.iter().chain(&self.most).any(is_infinite)
    }

    fn is_constant(&self) -> bool {
        self.least.iter().chain(&self.most).all(|end| end.constant().is_some())
    }

    /// Its value at a point, and the size of what that is summed from.
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let value = |end: &Option<Sum>| end.as_ref().map_or(0.0, |end| end.at(x, y));
        let size = |end: &Option<Sum>| end.as_ref().map_or(0.0, |end| end.terms_at(x, y));
        [value(&self.most) - value(&self.least), size(&self.least) + size(&self.most)]
    }

    /// It less its mean at so many points of an edge, times the factor with which that is largest; nothing where it is constant
    /// but for rounding.
    fn above_mean(&self, points: &[([f64; 2], f64)]) -> Option<Vec<f64>> {
        if self.is_constant() {
            return None;
        }
        let (mut low, mut high, mut mean) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        let (mut spans, mut terms) = (Vec::with_capacity(points.len()), 0.0_f64);
        for &(point, weight) in points {
            let [span, size] = self.at(point);
            (low, high, mean) = (low.min(span), high.max(span), mean + weight * span);
            terms = terms.max(size);
            spans.push(span);
        }
        // Of ends that are equal rounding leaves a part of themselves.
        let varies = high - low > (CONSTANT * mean.abs()).max(64.0 * f64::EPSILON * terms);
        let times = |factor: f64, d: f64| if d == 0.0 { 0.0 } else { factor * d };
        let most =
            |span: &f64| times(self.values[0], span - mean).max(times(self.values[1], span - mean));
        varies.then(|| spans.iter().map(most).collect())
    }
}

/// The excess of a sum of such terms.
fn excess_of(problem: &Problem, edge: usize, terms: &[Width]) -> Option<f64> {
    let inside = on_panels(PANELS, &gauss(POINTS));
    let along = inside.iter().map(|&[t, weight]| (t, weight)).chain([(0.0, 0.0), (1.0, 0.0)]);
    let points: Vec<_> = along.map(|(t, weight)| (problem.along(edge, t), weight)).collect();
    let sums = terms.iter().filter_map(|term| term.above_mean(&points));
    let sum = sums.reduce(|sum, more| sum.iter().zip(more).map(|(a, b)| a + b).collect())?;
    Some(problem.lengths[edge] * sum.into_iter().fold(f64::NEG_INFINITY, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{PARABOLA, changed, on_grid};
    use signorini_scene::error::Result;
    use signorini_scene::mesh::structured::{Cells, grid};

    /// PARABOLA's contact with 4 − x² for its range, and inputs of either end that may have these values.
    fn scene(weak: &str, leak: &str) -> String {
        let limited = ("gap = \"-x^2\"", "gap = \"-x^2\", limit = \"4 - x^2\"");
        changed(PARABOLA, &[limited])
            + &format!(
                "
input.weak = {{ of = \"contact\", field = \"limit\", pattern = \"1 + x\", default = 0.5{weak} }}
input.leak = {{ of = \"contact\", field = \"flux\", pattern = \"-2\"{leak} }}
"
            )
    }

    /// hi − lo = 4 − x² + p (1 + x) + 2 p′ on an edge: its largest value over both ranges, less its mean there.
    #[test]
    fn the_excess_is_that_of_the_worst_inputs() -> Result<()> {
        let [ranges, none] = [[", range = [-1, 3]", ", range = [0, 9]"], [", range = [-1, 3]", ""]];
        let (_, problem) = on_grid(&scene(ranges[0], ranges[1]), grid(5, Cells::Triangles))?;
        let (_, open) = on_grid(&scene(none[0], none[1]), grid(5, Cells::Triangles))?;
        let counts = problem.topology.counts;
        for edge in counts.free..counts.unknowns() {
            let [[a, _], [b, _]] = problem.segment(edge);
            let (length, middle) = ((b - a).abs(), 0.5 * (a + b));
            let at = |p: f64, x: f64| {
                let mean = 4.0 - middle.powi(2) - length.powi(2) / 12.0 + p * (1.0 + middle);
                length * (4.0 - x * x + p * (1.0 + x) - mean)
            };
            let most = |p: f64| {
                let inside = (0.5 * p).clamp(a.min(b), a.max(b));
                [a, b, inside].map(|x| at(p, x)).into_iter().fold(0.0, f64::max)
            };
            let expected = most(-1.0).max(most(3.0));
            let found = excess_within_ranges(&problem, edge).expect("it varies");
            // The maximum inside is looked for at points.
            let off = (found - expected) / expected;
            assert!((-0.01..1e-12).contains(&off), "{found} {expected}");
            let default = excess(&problem, edge, 0.0).expect("it varies");
            assert!((default - most(0.5)).abs() < 0.01 * default, "{default} {}", most(0.5));
            assert_eq!(excess_within_ranges(&open, edge), Some(f64::INFINITY));
        }
        Ok(())
    }
}

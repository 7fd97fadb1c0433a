//! By how much the range of a contact flux, hi − lo, varies along an edge.
//!
//! The kernel has its mean alone. There is a flux with τ·n = lo + θ (hi − lo) all along the edge, θ being that of its mean: it
//! is within the law wherever lo ≤ hi. The contact term of the bound has the true range then,
//! ```text
//!   2∫ θ (hi − lo)(s − ψ)⁺ + (1 − θ)(hi − lo)(ψ − s)⁺,
//! ```
//! and is bounded by the largest value of hi − lo on each side: its mean and an excess.

use super::lowest::{Ranged, lowest};
use super::{Problem, Sum};
use signorini_scene::expression::enclosure::Interval;
use signorini_scene::scene::{Boundary, Datum, Field};

/// Fields of either end.
pub(super) const ENDS: [Field; 2] = [Field::Flux, Field::Limit];

/// Part of an excess up to which it need not be known.
const KNOWN: f64 = 1e-3;
/// Part of hi − lo that its rounding may be, and part of the terms that either end is summed from.
const CONSTANT: f64 = 1e-12;
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// By how much |E| (hi − lo) exceeds its integral somewhere on a contact edge, at most; `None` where an end is infinite, or hi − lo is
/// constant along the edge.
pub fn excess(problem: &Problem, edge: usize) -> Option<f64> {
    excess_of(problem, edge, &[now(problem, edge)?])
}

/// hi − lo of an edge with its inputs as they are; `None` where an end is infinite.
pub(super) fn now(problem: &Problem, edge: usize) -> Option<Ranged<'_>> {
    let [minus, plus] = ENDS.map(|field| Sum::on_edge(problem, edge, field));
    let whole = Ranged { minus, plus: Some(plus?), factor: [1.0; 2] };
    is_finite(&whole).then_some(whole)
}

/// hi − lo of a boundary as the scene states it, and what each input adds within its range, or at its default where it has none;
/// `None` where an end is infinite.
pub(super) fn terms<'p>(problem: &'p Problem, boundary: &'p Boundary) -> Option<Vec<Ranged<'p>>> {
    let alone = |expression: &'p Datum| Sum::alone(&problem.scene, expression, problem.time);
    let [minus, plus] = ENDS.map(|field| boundary.condition.datum(field).map(alone));
    let stated = Ranged { minus, plus: Some(plus?), factor: [1.0; 2] };
    if !is_finite(&stated) {
        return None;
    }
    let inputs = problem.inputs_of(boundary, &ENDS).map(|input| {
        let factor = input.range.as_ref().map_or([input.default; 2], |_| input.interval());
        let pattern = Some(alone(&input.pattern));
        match input.field.value {
            Field::Limit => Ranged { minus: None, plus: pattern, factor },
            _ => Ranged { minus: pattern, plus: None, factor },
        }
    });
    Some(std::iter::once(stated).chain(inputs).collect())
}

fn is_finite(of: &Ranged) -> bool {
    !of.data().any(|end| end.constant().is_some_and(f64::is_infinite))
}

/// [`excess`] for all inputs within their ranges, at most:
/// ```text
///   (hi − lo) − its mean = Σ_j p_j d_j ≤ Σ_j max(a_j d_j, b_j d_j),   a_j ≤ p_j ≤ b_j,   p_0 = 1
/// ```
/// Infinite where an input of an end has no range: ticks refuse values that leave the edge no flux in the mean, not those that
/// leave none in a part of it.
pub fn excess_within_ranges(problem: &Problem, edge: usize) -> Option<f64> {
    let boundary = problem.boundary_of(edge)?;
    let mut all = terms(problem, boundary)?;
    if problem.inputs_of(boundary, &ENDS).all(|input| input.range.is_some()) {
        return excess_of(problem, edge, &all);
    }
    // Whether any of them varies, by whatever it is multiplied.
    all.iter_mut().for_each(|of| of.factor = [-1.0, 1.0]);
    excess_of(problem, edge, &all).map(|_| f64::INFINITY)
}

fn is_constant(of: &Ranged) -> bool {
    of.data().all(|end| end.constant().is_some())
}

/// No excess of a sum of such terms is above this one; `None` where all are constant but for rounding.
fn excess_of(problem: &Problem, edge: usize, terms: &[Ranged]) -> Option<f64> {
    let varying: Vec<_> = terms.iter().filter(|of| !is_constant(of)).collect();
    if varying.is_empty() {
        return None;
    }
    let segment = problem.segment(edge);
    let mean = |of: &Option<Sum>| match of.as_ref().map(|of| of.mean_and_missed(segment)) {
        None => Interval::point(0.0),
        Some(Ok(mean)) => Interval::point(mean.value).widened(mean.missed),
        Some(Err(_)) => Interval::around(f64::INFINITY),
    };
    let means: Vec<_> = varying.iter().map(|of| mean(&of.plus) - mean(&of.minus)).collect();
    // What exceeds the mean is the least of what lacks.
    let lacks = |d: &dyn Fn(&Ranged) -> Interval| -> f64 {
        varying.iter().zip(&means).map(|(of, mean)| of.least(*mean - d(of))).sum()
    };
    let size: f64 = varying.iter().map(|of| of.size_at(problem.along(edge, 0.5))).sum();
    let widest = means.iter().fold(0.0_f64, |most, mean| most.max(mean.size()));
    let rounding = (CONSTANT * widest).max(ROUNDING * size);
    let found = lowest(
        segment,
        |at| lacks(&|of| Interval::point(of.at(at))),
        |part| lacks(&|of| of.within(part)),
        |value, bound| -bound <= rounding || value - bound <= KNOWN * value.abs(),
    );
    (-found.bound > rounding).then(|| -problem.lengths[edge] * found.bound)
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
            // It is no less, and known to a thousandth.
            let is_known = |off: f64| (-1e-12..KNOWN).contains(&off);
            assert!(is_known((found - expected) / expected), "{found} {expected}");
            let default = excess(&problem, edge).expect("it varies");
            assert!(is_known((default - most(0.5)) / default), "{default} {}", most(0.5));
            assert_eq!(excess_within_ranges(&open, edge), Some(f64::INFINITY));
        }
        let constant =
            scene("", "").replace("4 - x^2", "4").replace("default = 0.5", "default = 0");
        let (_, open) = on_grid(&constant, grid(5, Cells::Triangles))?;
        let edge = open.topology.counts.free;
        assert_eq!(excess_within_ranges(&open, edge), Some(f64::INFINITY));
        assert_eq!(excess(&open, edge), None);
        Ok(())
    }

    /// A peak of hi − lo of 10 and a notch of it to −5, both of 1e−5 of an edge.
    #[test]
    fn peaks_and_notches_between_points_are_found() -> Result<()> {
        let limited = |limit: &str| {
            let limit = format!("gap = \"-x^2\", limit = \"{limit}\"");
            on_grid(&changed(PARABOLA, &[("gap = \"-x^2\"", &limit)]), grid(5, Cells::Triangles))
        };
        let (_, problem) = limited("4 + 10*exp(-((x - 0.433)/2e-6)^2)")?;
        let counts = problem.topology.counts;
        let edges = counts.free..counts.unknowns();
        let found: Vec<f64> = edges.filter_map(|edge| excess(&problem, edge)).collect();
        let [peak] = found[..] else { panic!("{found:?}") };
        assert!((peak / 2.0 - 1.0).abs() < 2.0 * KNOWN, "{peak}");
        let refused = limited("4 - 9*exp(-((x - 0.433)/2e-6)^2)").expect_err("a notch");
        assert!(refused.to_string().contains("the limit is -"), "{refused}");
        Ok(())
    }
}

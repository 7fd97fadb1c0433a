//! Functions that are no expressions of the scene, on edges: by the rule for data, and on halves where a smaller rule disagrees.
//!
//! A kink or a jump inside is cut off level by level; smooth ones are integrated by the rule alone, with its bits. Nothing is proved:
//! loads are integrated in [`super::enclosed`].

use std::cell::Cell as Count;

use signorini_kernel::Real;

use super::{DATA_POINTS, on_panels};

/// Two rules that differ by less than this part of ∫|f| agree.
const AGREE: f64 = 1e-9;
/// Most bisections of an edge. A jump that comes to lie beside the end of a part is not cut off further:
/// 2e−2 of that part may be missed, since no point of either rule lies nearer to its end.
const LEVELS: u32 = 40;
/// Points a direction of the other rule, less than the rule's: with an odd number in one of both, no jump lies in the
/// middle of either.
const FEWER: usize = 1;
/// Panels of the other rule on an edge: a jump nearer to an end than its first point is not seen.
const LOOKS: u32 = 7;

/// Most cuts of an edge: data that are rough everywhere, or nothing but rounding, end there.
const MOST: u32 = 120;

type Function<'f> = &'f dyn Fn(f64, f64) -> f64;
/// Mean and size over a segment by either rule.
type Rules<'r> = &'r dyn Fn(&[[f64; 2]; 2]) -> [[f64; 2]; 2];

/// The mean of `f` over the segment from `a` to `b`.
pub fn mean_on_edge(segment: [[f64; 2]; 2], f: Function) -> f64 {
    mean_and_doubt(segment, f)[0]
}

/// Mean over a segment, on halves where rules differ, and by how much they still do on parts that are cut no further.
fn mean_and_doubt(segment: [[f64; 2]; 2], f: Function) -> [f64; 2] {
    let rules = |&[a, b]: &[[f64; 2]; 2]| {
        let at = |t: f64| [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
        let mean = |rule: &[[f64; 2]]| {
            rule.iter().fold([0.0; 2], |[sum, size], &[t, weight]| {
                let [x, y] = at(t);
                let value = weight * f(x, y);
                [sum + value, size + value.abs()]
            })
        };
        let rule = f64::GAUSS[DATA_POINTS - 1];
        [mean(rule), mean(&on_panels(LOOKS, f64::GAUSS[DATA_POINTS - FEWER - 1]))]
    };
    let [[value, size], [other, _]] = rules(&segment);
    let tolerance = AGREE * size;
    if (value - other).abs() <= tolerance || !value.is_finite() {
        return [value, 0.0];
    }
    cut(segment, LEVELS, tolerance, &rules, &Count::new(MOST))
}

/// Ends of parts that are the shorter the nearer they are to those of the whole.
const ENDS: [f64; 6] = [0.0, 0.01, 0.1, 0.9, 0.99, 1.0];

/// The mean over parts that are the shorter the nearer they are to an end, where the whole would not see a jump or a singularity,
/// and by how much rules still differ, or the whole does.
pub fn graded_mean([a, b]: [[f64; 2]; 2], f: Function) -> [f64; 2] {
    let at = |t: f64| [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
    let of_part = |part: &[f64]| {
        let share = part[1] - part[0];
        mean_and_doubt([at(part[0]), at(part[1])], f).map(|x| share * x)
    };
    let parts = ENDS.windows(2).map(of_part);
    let [mean, doubt] = parts.fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]);
    let [whole, own] = mean_and_doubt([a, b], f);
    [mean, doubt + own + (whole - mean).abs()]
}

/// The tolerance of a mean stays: halves weigh half as much.
fn cut(
    [a, b]: [[f64; 2]; 2],
    levels: u32,
    tolerance: f64,
    rules: Rules,
    left: &Count<u32>,
) -> [f64; 2] {
    left.set(left.get().saturating_sub(1));
    let middle = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
    let sums = [[a, middle], [middle, b]].into_iter().fold([0.0; 2], |[sum, doubt], part| {
        let [[value, _], [other, _]] = rules(&part);
        let off = (value - other).abs();
        let agrees = off <= tolerance;
        let is_last = levels <= 1 || left.get() == 0;
        let [value, off] = match agrees || is_last || !value.is_finite() {
            true => [value, if agrees { 0.0 } else { off }],
            false => cut(part, levels - 1, tolerance, rules, left),
        };
        [sum + value, doubt + off]
    });
    sums.map(|sum| 0.5 * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::solve::{BISECTED, BISECTED_KINK};

    #[test]
    fn kinks_and_jumps_are_cut_off() {
        let (edge, a) = ([[0.0, 0.0], [1.0, 0.0]], 0.3711);
        let jump = mean_on_edge(edge, &|x, _| if x > a { 1.0 } else { 0.0 });
        // It lies 1.6e−3 of a part of 1/256 beside its end.
        BISECTED.check("a jump", jump - (1.0 - a));
        let kink = mean_on_edge(edge, &|x, _| (x - a).abs());
        BISECTED_KINK.check("a kink", kink - 0.5 * (a * a + (1.0 - a).powi(2)));
    }
}

//! Loads on edges and cells: by the rule for their data, and on halves or quarters where a smaller rule disagrees.
//!
//! What the rule misses of a load's mean is out of balance in the discrete problem, and no bound of the oscillation, which
//! has no mean, sees it; a part that is held weakly moves by what is missed over what holds it. A kink or a jump inside is
//! cut off level by level; smooth data are integrated by the rule alone, with its bits.

use std::cell::Cell as Count;

use signorini_kernel::Real;

use super::{DATA_POINTS, Point, TRIANGLE_POINTS, on_panels};
use crate::cell::Cell;

/// Two rules that differ by less than this part of ∫|f| agree.
const AGREE: f64 = 1e-9;
/// Most bisections of an edge, and of a cell. A jump that comes to lie beside the end of a part is not cut off further:
/// 2e−2 of that part may be missed, since no point of either rule lies nearer to its end.
const LEVELS: [u32; 2] = [40, 5];
/// Points a direction of the other rule, less than the rule's: with an odd number in one of both, no jump lies in the
/// middle of either.
const FEWER: usize = 1;
/// Panels of the other rule on an edge: a jump nearer to an end than its first point is not seen.
const LOOKS: u32 = 7;

/// Most cuts of an edge or a cell: data that are rough everywhere, or nothing but rounding, end there.
const MOST: u32 = 120;

type Function<'f> = &'f dyn Fn(f64, f64) -> f64;

/// The mean of `f` over the segment from `a` to `b`.
pub fn mean_on_edge(segment: [[f64; 2]; 2], f: Function) -> f64 {
    mean_and_doubt(segment, f)[0]
}

/// Mean over a segment, and by how much rules still differ on parts that are cut no further.
pub fn mean_and_doubt(segment: [[f64; 2]; 2], f: Function) -> [f64; 2] {
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
    let halves = |&[a, b]: &[[f64; 2]; 2]| {
        let middle = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
        [[a, middle], [middle, b]]
    };
    // Means over halves, whose sum counts twice.
    over(segment, LEVELS[0], 0.5, &rules, &halves)
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

/// ∫f over a cell; the quarters of a quad, in the bilinear coordinates, are quads again.
pub fn over_cell(cell: Cell, f: Function) -> f64 {
    cell_and_doubt(cell, f)[0]
}

/// Integral over a cell, and by how much rules still differ on parts that are cut no further.
pub fn cell_and_doubt(cell: Cell, f: Function) -> [f64; 2] {
    let rules = |cell: &Cell| {
        let most = match cell {
            Cell::Triangle(_) => TRIANGLE_POINTS,
            Cell::Quad(_) => DATA_POINTS,
        };
        [most, most - FEWER].map(|points| integral(f, &cell.points(f64::GAUSS[points - 1])))
    };
    over(cell, LEVELS[1], 1.0, &rules, &quarters)
}

/// The quarters of a cell, of a quad in its bilinear coordinates.
pub fn quarters(cell: &Cell) -> [Cell; 4] {
    match *cell {
        Cell::Triangle([a, b, c]) => {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]].map(Cell::Triangle)
        }
        Cell::Quad([a, b, c, d]) => {
            let [ab, bc, cd, da] = [middle(a, b), middle(b, c), middle(c, d), middle(d, a)];
            let o = middle(ab, cd);
            [[a, ab, o, da], [ab, b, bc, o], [o, bc, c, cd], [da, o, cd, d]].map(Cell::Quad)
        }
    }
}

/// ∫f over parts of a quad that are the thinner the nearer they are to a side, and by how much rules still differ. A triangle is
/// a quad whose last corners are one.
pub fn graded_over_quad([a, b, c, d]: [[f64; 2]; 4], f: Function) -> [f64; 2] {
    let at = |s: f64, t: f64| {
        [0, 1].map(|k| (1.0 - t) * (a[k] + s * (b[k] - a[k])) + t * (d[k] + s * (c[k] - d[k])))
    };
    let pairs = || ENDS.windows(2).map(|part| [part[0], part[1]]);
    let parts =
        pairs().flat_map(|[s, e]| pairs().map(move |[t, u]| [[s, t], [e, t], [e, u], [s, u]]));
    let sums = parts.map(|corners| cell_and_doubt(Cell::Quad(corners.map(|[s, t]| at(s, t))), f));
    sums.fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]])
}

fn middle(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| 0.5 * (a[k] + b[k]))
}

/// ∫f and ∫|f|.
fn integral(f: Function, points: &[Point]) -> [f64; 2] {
    points.iter().fold([0.0; 2], |[sum, size], point| {
        let value = point.weight * f(point.x[0], point.x[1]);
        [sum + value, size + value.abs()]
    })
}

/// The sum over parts, times `share` at each level, and what is in doubt of it; `rules` gives integral and size by both rules.
fn over<C: Copy, const PARTS: usize>(
    cell: C,
    levels: u32,
    share: f64,
    rules: &dyn Fn(&C) -> [[f64; 2]; 2],
    parts: &dyn Fn(&C) -> [C; PARTS],
) -> [f64; 2] {
    let [[value, size], [other, _]] = rules(&cell);
    let tolerance = AGREE * size;
    if (value - other).abs() <= tolerance || !value.is_finite() {
        return [value, 0.0];
    }
    cut(&cell, levels, share, tolerance, rules, parts, &Count::new(MOST))
}

/// The tolerance is halved from level to level, as fast as the part of a cell beside a line through it grows in number.
fn cut<C: Copy, const PARTS: usize>(
    cell: &C,
    levels: u32,
    share: f64,
    tolerance: f64,
    rules: &dyn Fn(&C) -> [[f64; 2]; 2],
    parts: &dyn Fn(&C) -> [C; PARTS],
    left: &Count<u32>,
) -> [f64; 2] {
    left.set(left.get().saturating_sub(1));
    let sums = parts(cell).iter().fold([0.0; 2], |[sum, doubt], part| {
        let [[value, _], [other, _]] = rules(part);
        let off = (value - other).abs();
        let agrees = off <= tolerance;
        let is_last = levels <= 1 || left.get() == 0;
        let [value, off] = match agrees || is_last || !value.is_finite() {
            true => [value, if agrees { 0.0 } else { off }],
            false => cut(part, levels - 1, share, 0.5 * tolerance / share, rules, parts, left),
        };
        [sum + value, doubt + off]
    });
    sums.map(|sum| share * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::solve::{BISECTED, BISECTED_KINK, BISECTED_LINE, GRADED};

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];

    #[test]
    fn kinks_and_jumps_are_cut_off() {
        let (edge, a) = ([[0.0, 0.0], [1.0, 0.0]], 0.3711);
        let jump = mean_on_edge(edge, &|x, _| if x > a { 1.0 } else { 0.0 });
        // It lies 1.6e−3 of a part of 1/256 beside its end.
        BISECTED.check("a jump", jump - (1.0 - a));
        let kink = mean_on_edge(edge, &|x, _| (x - a).abs());
        BISECTED_KINK.check("a kink", kink - 0.5 * (a * a + (1.0 - a).powi(2)));
        let over_square = over_cell(Cell::Quad(SQUARE), &|x, _| (x - a).abs());
        BISECTED_LINE.check("over a square", over_square - 0.5 * (a * a + (2.0 - a).powi(2)));
        let halves = [[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]], [[0.0, 0.0], [2.0, 1.0], [0.0, 1.0]]];
        let of_halves: f64 =
            halves.map(|half| over_cell(Cell::Triangle(half), &|x, _| (x - a).abs())).iter().sum();
        BISECTED_LINE.check("over its halves", of_halves - over_square);
    }

    #[test]
    fn jumps_beside_a_side_are_seen_by_thin_parts() {
        let [a, b, c, _] = SQUARE;
        for (corners, area) in [(SQUARE, 2.0), ([a, b, c, c], 1.0)] {
            for x0 in [0.002, 0.008, 1.99, 1.998] {
                let jump = |x: f64, _: f64| if x > x0 { 1.0 } else { 0.0 };
                let [sum, doubt] = graded_over_quad(corners, &jump);
                // Left of x0 lies x0 · 1 of the square, and x0²/4 of the triangle.
                let left = if area == 2.0 { x0 } else { 0.25 * x0 * x0 };
                GRADED.check("beside a side", (sum - (area - left)).abs().max(doubt));
            }
        }
    }

    #[test]
    fn smooth_data_keep_the_bits_of_the_rule() {
        let f = |x: f64, y: f64| 1.0 + x * y - x.powi(3);
        let square = Cell::Quad(SQUARE);
        let points = square.points(f64::GAUSS[DATA_POINTS - 1]);
        assert_eq!(over_cell(square, &f), integral(&f, &points)[0]);
    }

    #[test]
    fn what_is_not_finite_stays_so() {
        assert!(!over_cell(Cell::Quad(SQUARE), &|x, _| 1.0 / (x - x)).is_finite());
    }
}

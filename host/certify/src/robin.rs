//! Robin data at the points of edges: ∫_R (τ·n + h(s − u_ext))²/h is not a function of their means.
//!
//! 8 points see of u_ext the û for which √h û is a polynomial. With h constant the sum over them is the integral for û,
//! and what it misses weighs
//! ```text
//!   2∫_R (u_ext − û) [(τ − σ)·n + h(s − u)] ≤ 2 Σ_T √2 ‖√h (u_ext − û)‖_{R ∩ ∂T} (combined_T),
//! ```
//! as much as an oscillation of √2 ‖√h (u_ext − û)‖ in the edge's cell.

use signorini_kernel::Real;

use super::between::{form_missed, value_missed};
use super::transfer_points::{EdgePoint, unseen};
use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::quadrature::refined::{Part, refined};
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::expression::enclosure::{Region, root};

/// \[h |E|, u_ext\] at the 8 Gauss points of an edge, in its direction.
pub type RobinPoints = [[f64; 2]; DATA_POINTS];

/// Evaluates the data of each record of `problem.loads.robin`, in that order, at its time.
///
/// # Errors
/// Data that are not finite at a point.
pub fn robin(problem: &Problem) -> Result<Vec<RobinPoints>> {
    let edges = problem.loads.robin.iter().map(|record| record.edge as usize);
    let laws = edges.filter_map(|edge| Some((edge, Sum::of_law(problem, edge)?)));
    laws.map(|(edge, [h, ambient])| points(problem, edge, &h, &ambient)).collect()
}

fn points(problem: &Problem, edge: usize, h: &Sum, ambient: &Sum) -> Result<RobinPoints> {
    let mut values = RobinPoints::default();
    for (value, &[t, _]) in values.iter_mut().zip(f64::GAUSS[DATA_POINTS - 1]) {
        let at = problem.along(edge, t);
        *value = [problem.lengths[edge] * h.finite_at(at)?, ambient.finite_at(at)?];
    }
    Ok(values)
}

/// Lebesgue's constant of the 8 Gauss points, at the ends: rounded up.
const LEBESGUE: f64 = 5.0;
/// Parts of an edge, at most.
const MOST: usize = 400;
/// Part of ‖√h (u_ext − û)‖, or of ‖√h (u_ext − mean)‖, up to which it need not be known.
const LEFT: [f64; 2] = [1e-3, 1e-5];

/// √2 ‖√h (u_ext − û)‖ on an edge of R, in the unit of ‖A^½∇u‖: as points in between find it, and what is not resolved.
///
/// # Errors
/// Data that are not finite at a point.
pub fn missed(problem: &Problem, edge: usize) -> Result<[f64; 2]> {
    let law = Sum::of_law(problem, edge);
    let Some([h, ambient]) = &law else { return Ok([0.0; 2]) };
    let (unseen, is_even) = (unseen(problem, edge)?, h.constant().is_some());
    if ambient.constant().is_some() && (is_even || unseen.is_some()) {
        return Ok([0.0; 2]);
    }
    let length = problem.lengths[edge];
    let weighed =
        Weighed { problem, edge, ambient, h: Some(h).filter(|_| unseen.is_none() && !is_even) };
    let middle = problem.along(edge, 0.5);
    let ranges = match &unseen {
        Some(points) => points.chunks(DATA_POINTS).map(|of| (ends_of(of), highest(of))).collect(),
        None if is_even => vec![([0.0, 1.0], length * h.at(middle[0], middle[1]))],
        None => vec![([0.0, 1.0], length)],
    };
    let pieces = ranges.into_iter().map(|(range, factor)| weighed.piece(range, factor));
    let pieces = pieces.collect::<Result<Vec<_>>>()?;
    let spread: f64 = pieces.iter().map(Piece::spread).sum();
    let regions = pieces.iter().map(|of| Region::segment(of.range.map(|t| problem.along(edge, t))));
    let is_enough = |size: f64, missed: f64| {
        missed <= LEFT[0].powi(2) * size || missed <= LEFT[1].powi(2) * spread
    };
    let parts = refined(
        |region| ambient.cut(region),
        regions.enumerate(),
        MOST + pieces.len(),
        is_enough,
        |of, region| weighed.square(&pieces[of], region),
    );
    let sum = |of: fn(&Part) -> f64| (2.0 * parts.iter().map(of).sum::<f64>()).sqrt();
    Ok([sum(|part| part.value), sum(|part| part.missed)])
}

/// The part of an edge that 8 points are those of.
fn ends_of(points: &[EdgePoint]) -> [f64; 2] {
    let (rule, [first, last]) = (
        f64::GAUSS[DATA_POINTS - 1],
        [points.first(), points.last()].map(|of| of.map_or(0.0, |of| of.t)),
    );
    let width = (last - first) / (rule[DATA_POINTS - 1][0] - rule[0][0]);
    let from = first - rule[0][0] * width;
    [from, from + width]
}

/// The most that H is at these points.
fn highest(points: &[EdgePoint]) -> f64 {
    points.iter().fold(0.0, |most: f64, at| most.max(at.between[1]))
}

/// A part of an edge, between whose 8 points û is a polynomial; a factor of the square, and the values at the points.
struct Piece {
    range: [f64; 2],
    factor: f64,
    known: Vec<[f64; 2]>,
}

impl Piece {
    /// factor ∫(f − mean)² by the points.
    fn spread(&self) -> f64 {
        let width = self.factor * (self.range[1] - self.range[0]);
        let values = || self.known.iter().map(|of| of[1]).zip(f64::GAUSS[DATA_POINTS - 1]);
        let mean: f64 = values().map(|(value, [_, weight])| weight * value).sum();
        width * values().map(|(value, [_, weight])| weight * (value - mean).powi(2)).sum::<f64>()
    }
}

/// f: u_ext, or √h u_ext where points see an h that varies.
struct Weighed<'p> {
    problem: &'p Problem,
    edge: usize,
    ambient: &'p Sum<'p>,
    h: Option<&'p Sum<'p>>,
}

impl Weighed<'_> {
    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.ambient.at(x, y) * self.h.map_or(1.0, |h| h.at(x, y).max(0.0).sqrt())
    }

    fn piece(&self, range @ [from, to]: [f64; 2], factor: f64) -> Result<Piece> {
        let known = f64::GAUSS[DATA_POINTS - 1].iter().map(|[own, _]| {
            let t = from + own * (to - from);
            let place = self.problem.along(self.edge, t);
            Ok([t, self.ambient.finite(self.at(place), place)?])
        });
        Ok(Piece { range, factor, known: known.collect::<Result<_>>()? })
    }

    /// factor ∫(f − û)² over a part of a piece, by 8 points of its own, and what these miss.
    fn square(&self, piece: &Piece, region: &Region) -> [f64; 2] {
        let ([a, b], length) = (self.problem.segment(self.edge), self.problem.lengths[self.edge]);
        let way = [0, 1].map(|k| (b[k] - a[k]) / length / length);
        let points = region.along(f64::GAUSS[DATA_POINTS - 1]).into_iter();
        let square = points.map(|(at, weight)| {
            let t = (at[0] - a[0]) * way[0] + (at[1] - a[1]) * way[1];
            weight / length * (self.at(at) - interpolated(&piece.known, t)).powi(2)
        });
        let (square, width): (f64, _) = (square.sum(), region.measure() / length);
        let missed = match self.h {
            None => value_missed(self.ambient, region, width),
            Some(h) => {
                form_missed(&root(&h.enclose(region)).times(&self.ambient.enclose(region)), width)
            }
        };
        match (missed.is_finite(), self.h) {
            (false, None) => [0.0, piece.factor * self.grown(piece, region)],
            _ => [square, missed].map(|of| piece.factor * of),
        }
    }

    /// ∫(f − û)² ≤ 2∫f² + 2∫û² over a part where f is not bounded, but known to grow like a power.
    fn grown(&self, piece: &Piece, region: &Region) -> f64 {
        let Some(growth) = self.ambient.growth(region) else { return f64::INFINITY };
        let length = self.problem.lengths[self.edge];
        let most = piece.known.iter().map(|of| of[1].abs()).fold(0.0, f64::max);
        // The largest value of a polynomial of degree 7 over that at its Gauss points.
        let of_u = (LEBESGUE * most).powi(2) * region.measure();
        2.0 * (region.grown(&growth, 2.0).high + of_u) / length
    }
}

/// The polynomial through `known` points (t, value) at t, by Lagrange's formula.
fn interpolated(known: &[[f64; 2]], t: f64) -> f64 {
    let basis = |at: usize| {
        let others = known.iter().enumerate().filter(|&(other, _)| other != at);
        others.fold(1.0, |product, (_, [other, _])| product * (t - other) / (known[at][0] - other))
    };
    known.iter().enumerate().map(|(at, [_, value])| value * basis(at)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{self, SMOOTH};
    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_tolerances::solve::{NARROW_BUMP, POINTS};

    /// And they run in the direction of the edge.
    #[test]
    fn the_points_add_up_to_the_loads() -> Result<()> {
        let (_, problem) = fixtures::on_grid(SMOOTH, grid(4, Cells::Mixed))?;
        let data = robin(&problem)?;
        assert_eq!(data.len(), 4);
        for (record, points) in problem.loads.robin.iter().zip(&data) {
            let rule = f64::GAUSS[DATA_POINTS - 1];
            let weighted = || points.iter().zip(rule).map(|(point, gauss)| (point, gauss[1]));
            let h: f64 = weighted().map(|([h, _], weight)| weight * h).sum();
            let both: f64 = weighted().map(|([h, u], weight)| weight * h * u).sum();
            POINTS.check("coefficient", h - record.coefficient);
            POINTS.check("ambient", both - record.ambient);
            let [[_, start], [_, end]] = problem.segment(record.edge as usize);
            for ([h, ambient], [t, _]) in points.iter().zip(rule) {
                let y = start + t * (end - start);
                let outside = y + y * y - 1.0 + (3.0 * y - 6.5) / (2.0 + y);
                POINTS.check("coefficient", h - 0.25 * (2.0 + y));
                POINTS.check("outside", ambient - outside);
            }
        }
        Ok(())
    }

    #[test]
    fn eight_points_miss_nothing_of_a_polynomial_and_half_of_a_narrow_bump() -> Result<()> {
        let missed_of = |coefficient: &str, ambient: &str| -> Result<f64> {
            let text = SMOOTH
                .replace("coefficient = \"2+y\"", &format!("coefficient = \"{coefficient}\""));
            let old = "ambient = \"y + y^2 - 1 + (3*y - 6.5)/(2+y)\"";
            let text = text.replace(old, &format!("ambient = \"{ambient}\""));
            let (_, problem) = fixtures::on_grid(&text, grid(1, Cells::Quads))?;
            missed(&problem, problem.loads.robin[0].edge as usize).map(|both| both.iter().sum())
        };
        POINTS.check("a polynomial", missed_of("4", "y^7 - 3*y^2")?);
        assert_eq!(missed_of("4", "3")?, 0.0);
        // Between all 8 points: û = 0, and √2 (4 ∫ (1 − |y − ½|/0.05)² dy)^½ is left.
        let expected = (2.0 * 4.0 * 2.0 * 0.05 / 3.0_f64).sqrt();
        let found = missed_of("4", "max(0, 1 - abs(y-0.5)/0.05)")?;
        NARROW_BUMP.check_relative("a bump", found, expected);
        for width in [1e-3, 1e-6] {
            let found = missed_of("4", &format!("exp(-((y-0.3)/{width:e})^2)"))?;
            // ∫exp(−2z²) = √(π/2)
            let expected = (8.0 * width * (0.5 * std::f64::consts::PI).sqrt()).sqrt();
            NARROW_BUMP.check_relative("a Gaussian", found, expected);
        }
        // √2 (4 ∫ (|y − 0.3|^p − û)²)^½, which is less than that without û and more than that of points.
        let found = missed_of("4", "abs(y-0.3)^(-0.3)")?;
        let whole = (8.0 * (0.3_f64.powf(0.4) + 0.7_f64.powf(0.4)) / 0.4).sqrt();
        assert!(found > 0.1 * whole && found < whole, "{found} {whole}");
        assert!(missed_of("4", "abs(y-0.3)^(-0.5)")?.is_infinite());
        // A layer that no point of the first panels sees: √2 (4 ∫ exp(−2y/ℓ) dy)^½ = 2√ℓ.
        let found = missed_of("4", "exp(-y/1e-5)")?;
        NARROW_BUMP.check_relative("a layer", found, 2.0 * 1e-5_f64.sqrt());
        Ok(())
    }
}

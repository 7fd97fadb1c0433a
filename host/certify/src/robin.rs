//! Robin data at the points of edges: ∫_R (τ·n + h(s − u_ext))²/h is not a function of their means.
//!
//! 8 points see of u_ext the û for which √h û is a polynomial. With h constant the sum over them is the integral for û,
//! and what it misses weighs
//! ```text
//!   2∫_R (u_ext − û) [(τ − σ)·n + h(s − u)] ≤ 2 Σ_T √2 ‖√h (u_ext − û)‖_{R ∩ ∂T} (combined_T),
//! ```
//! as much as an oscillation of √2 ‖√h (u_ext − û)‖ in the edge's cell.

use signorini_kernel::Real;

use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

/// \[h |E|, u_ext\] at the 8 Gauss points of an edge, in its direction.
pub type RobinPoints = [[f64; 2]; DATA_POINTS];

/// Evaluates the data of each record of `problem.loads.robin`, in that order, at time `time`.
///
/// # Errors
/// Data that are not finite at a point.
pub fn robin(problem: &Problem, time: f64) -> Result<Vec<RobinPoints>> {
    let records = problem.loads.robin.iter();
    let edges = records.filter_map(|record| {
        let edge = record.edge as usize;
        let ambient = Sum::on_edge(problem, edge, Field::Ambient, time)?;
        Some((edge, Sum::transfer(problem, edge, time)?, ambient))
    });
    edges.map(|(edge, h, ambient)| points(problem, edge, &h, &ambient)).collect()
}

fn points(problem: &Problem, edge: usize, h: &Sum, ambient: &Sum) -> Result<RobinPoints> {
    let mut values = RobinPoints::default();
    for (value, &[t, _]) in values.iter_mut().zip(f64::GAUSS[DATA_POINTS - 1]) {
        let [x, y] = problem.along(edge, t);
        let coefficient = h.finite(h.at(x, y), [x, y])?;
        *value = [problem.lengths[edge] * coefficient, ambient.finite(ambient.at(x, y), [x, y])?];
    }
    Ok(values)
}

/// Panels on an edge to begin with, in search of what 8 points miss.
const PANELS: u32 = 8;
/// Most bisections of a panel, and most panels: a layer of 10⁻⁷ of the edge is a few panels wide then.
const LEVELS: u32 = 24;
const MOST: usize = 256;
/// Part of a panel's integral up to which its halves may differ from it.
const SETTLED: f64 = 1e-2;
/// Differences below this part of √h u_ext are those of rounding: nothing is gained by bisecting for them.
const ROUNDING: f64 = 1e-13;
/// Roundings of a constant that was taken from u_ext, which are in it.
const OF_LEVEL: f64 = 4.0;

/// √2 ‖√h (u_ext − û)‖ on an edge of R, in the unit of ‖A^½∇u‖.
///
/// # Errors
/// Data that are not finite at a point.
pub fn missed(problem: &Problem, edge: usize, time: f64) -> Result<f64> {
    let Some(h) = Sum::transfer(problem, edge, time) else { return Ok(0.0) };
    let Some(ambient) = Sum::on_edge(problem, edge, Field::Ambient, time) else {
        return Ok(0.0);
    };
    if h.constant().is_some() && ambient.constant().is_some() {
        return Ok(0.0);
    }
    // √h and √h u_ext
    let root = |t: f64| -> Result<f64> {
        let [x, y] = problem.along(edge, t);
        Ok(h.finite(h.at(x, y), [x, y])?.max(0.0).sqrt())
    };
    let weighted = |t: f64| -> Result<f64> {
        let [x, y] = problem.along(edge, t);
        Ok(root(t)? * ambient.finite(ambient.at(x, y), [x, y])?)
    };
    let known = f64::GAUSS[DATA_POINTS - 1].iter().map(|&[t, _]| Ok([t, weighted(t)?]));
    let known = known.collect::<Result<Vec<_>>>()?;
    let size = known.iter().fold(0.0, |most: f64, [_, value]| most.max(value.abs()));
    let square = |t: f64| Ok((weighted(t)? - interpolated(&known, t)).powi(2));
    let level = OF_LEVEL * f64::EPSILON * problem.units.level();
    let roots = f64::GAUSS[DATA_POINTS - 1].iter().map(|&[t, _]| root(t));
    let noise = roots.collect::<Result<Vec<_>>>()?.into_iter().fold(0.0, f64::max) * level;
    let square = integral(square, noise.max(ROUNDING * size).powi(2))?;
    Ok((2.0 * problem.lengths[edge] * square).sqrt())
}

/// The integral of a square over \[0, 1\] on panels as fine as it needs; where it does not settle, an end may count for all
/// of its panel. Values below `rounding` need no finer ones.
fn integral(square: impl Fn(f64) -> Result<f64>, rounding: f64) -> Result<f64> {
    let on = |[a, b]: [f64; 2]| {
        let points = f64::GAUSS[DATA_POINTS - 1].iter();
        points
            .map(|[t, weight]| Ok((b - a) * weight * square(a + (b - a) * t)?))
            .sum::<Result<f64>>()
    };
    let width = 1.0 / f64::from(PANELS);
    let panel = |at| [width * f64::from(at), width * f64::from(at + 1)];
    let mut open: Vec<[f64; 2]> = (0..PANELS).map(panel).collect();
    let (mut sum, mut count) = (0.0, open.len());
    for level in 0..=LEVELS {
        let mut finer = Vec::new();
        for [a, b] in open {
            let middle = 0.5 * (a + b);
            let halves = on([a, middle])? + on([middle, b])?;
            let ends = (b - a) * square(a)?.max(square(b)?);
            let is_settled = (halves - on([a, b])?).abs() <= SETTLED * halves
                && ends <= halves / SETTLED
                || ends.max(halves) <= (b - a) * rounding;
            if is_settled || level == LEVELS || count >= MOST {
                sum += if is_settled { halves } else { halves.max(ends) };
            } else {
                finer.extend([[a, middle], [middle, b]]);
                count += 1;
            }
        }
        open = finer;
    }
    Ok(sum)
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

    #[test]
    fn the_points_add_up_to_the_loads() -> Result<()> {
        let (_, problem) = fixtures::on_grid(SMOOTH, grid(4, Cells::Mixed))?;
        let data = robin(&problem, 0.0)?;
        assert_eq!(data.len(), 4);
        for (record, points) in problem.loads.robin.iter().zip(&data) {
            let rule = f64::GAUSS[DATA_POINTS - 1];
            let weighted = || points.iter().zip(rule).map(|(point, gauss)| (point, gauss[1]));
            let h: f64 = weighted().map(|([h, _], weight)| weight * h).sum();
            let both: f64 = weighted().map(|([h, u], weight)| weight * h * u).sum();
            POINTS.check("coefficient", h - record.coefficient);
            POINTS.check("ambient", both - record.ambient);
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
            missed(&problem, problem.loads.robin[0].edge as usize, 0.0)
        };
        POINTS.check("a polynomial", missed_of("4", "y^7 - 3*y^2")?);
        assert_eq!(missed_of("4", "3")?, 0.0);
        // Between all 8 points: û = 0, and √2 (4 ∫ (1 − |y − ½|/0.05)² dy)^½ is left.
        let expected = (2.0 * 4.0 * 2.0 * 0.05 / 3.0_f64).sqrt();
        let found = missed_of("4", "max(0, 1 - abs(y-0.5)/0.05)")?;
        NARROW_BUMP.check_relative("a bump", found, expected);
        // A layer that no point of the first panels sees: √2 (4 ∫ exp(−2y/ℓ) dy)^½ = 2√ℓ.
        let found = missed_of("4", "exp(-y/1e-5)")?;
        NARROW_BUMP.check_relative("a layer", found, 2.0 * 1e-5_f64.sqrt());
        Ok(())
    }

    #[test]
    fn the_points_run_in_the_direction_of_the_edge() -> Result<()> {
        let (_, problem) = fixtures::on_grid(SMOOTH, grid(4, Cells::Mixed))?;
        for (record, points) in problem.loads.robin.iter().zip(robin(&problem, 0.0)?) {
            let [[_, start], [_, end]] = problem.segment(record.edge as usize);
            for ([h, ambient], [t, _]) in points.into_iter().zip(f64::GAUSS[DATA_POINTS - 1]) {
                let y = start + t * (end - start);
                let outside = y + y * y - 1.0 + (3.0 * y - 6.5) / (2.0 + y);
                POINTS.check("coefficient", h - 0.25 * (2.0 + y));
                POINTS.check("outside", ambient - outside);
            }
        }
        Ok(())
    }
}

//! Transfer coefficients that the 8 points of an edge do not see: on parts of it h lies between two parabolas;
//! the kernel takes them by forms ([`super::transfer_forms`]). A part is halved until both are 1e−4 apart, or it is 2⁻²⁴ of the edge
//! long, or there are 4096 points.

use signorini_kernel::Real;
use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::expression::enclosure::{Interval, Region};

/// Part of an integral that points may miss: a ten-thousandth of the norm.
const MISSED: f64 = 1e-8;
/// By how much h may vary along an edge that points see: ∫(τ·n)²/h is beyond them where it nearly vanishes.
const VARYING: f64 = 10.0;
/// Halvings of an edge.
const HALVINGS: u32 = 24;
/// Points of an edge, about, at most.
const MOST: usize = 4096;
/// Rounding of a parabola, relative to it.
const ROUNDED: f64 = 1e-14;
/// Part of its terms that a sum may leave which is nothing.
const ROUNDING: f64 = 1e-12;
/// By how much h may vary in a part, and leave its parabola.
const SMOOTH: [f64; 2] = [0.1, 1e-4];
/// Part of the root of an integral over a part that its 8 points miss: η⁴ of a parabola that varies by η = 0.05 (`pieces`).
pub const MISSED_BETWEEN: f64 = 1e-5;
/// Powers of t: those of squares of functions of degree 2.
const POWERS: i32 = 5;

/// A point of an edge.
#[derive(Debug, Clone, Copy)]
pub struct EdgePoint {
    /// From 0 to 1.
    pub t: f64,
    /// Of the mean over the edge.
    pub weight: f64,
    /// H = |E|h
    pub h: f64,
    /// H⁻ and H⁺
    pub between: [f64; 2],
    /// u_ext
    pub ambient: f64,
}

impl EdgePoint {
    /// A point of an edge whose points see H.
    pub fn seen(t: f64, weight: f64, h: f64, ambient: f64) -> Self {
        Self { t, weight, h, between: [h; 2], ambient }
    }

    /// N′ = min(1, N/H⁻) N, N being what H may have above H⁻.
    pub fn above(&self) -> f64 {
        let [low, high] = self.between;
        ((high - low) / low).min(1.0) * (high - low)
    }
}

/// The points of the parts of an edge; nothing where its own 8 points see its coefficient.
///
/// # Errors
/// Data that are not finite.
pub fn unseen(problem: &Problem, edge: usize) -> Result<Option<Vec<EdgePoint>>> {
    let Some([h, ambient]) = Sum::of_law(problem, edge) else { return Ok(None) };
    if h.constant().is_some() {
        return Ok(None);
    }
    let data = Data { problem, edge, h: &h, ambient: &ambient };
    let mut own = Vec::new();
    data.add_points([0.0, 1.0], false, &mut own)?;
    if data.is_nothing() {
        return Ok(None);
    }
    let parts = data.parts()?;
    Ok((!is_seen(&own, &parts)).then_some(parts))
}

/// Whether points see ∫H tᵏ and ∫1/H, and H varies little at them.
fn is_seen(own: &[EdgePoint], parts: &[EdgePoint]) -> bool {
    let of = |points: &[EdgePoint], value: &dyn Fn(&EdgePoint) -> f64| -> f64 {
        points.iter().map(|at| at.weight * value(at)).sum()
    };
    let agrees = |value: &dyn Fn(&EdgePoint) -> f64, size: f64| {
        (of(own, value) - of(parts, value)).abs() <= MISSED * size
    };
    let [low, high] = own
        .iter()
        .fold([f64::INFINITY, 0.0_f64], |[low, high], at| [low.min(at.h), high.max(at.h)]);
    let size = of(parts, &|at| at.h);
    high <= VARYING * low
        && agrees(&|at| 1.0 / at.h, of(parts, &|at| 1.0 / at.h))
        && (0..POWERS).all(|k| agrees(&|at| at.h * at.t.powi(k), size))
}

/// Data along an edge.
struct Data<'p> {
    problem: &'p Problem,
    edge: usize,
    h: &'p Sum<'p>,
    ambient: &'p Sum<'p>,
}

impl Data<'_> {
    /// The points of parts that h varies little in, of all at once a half at a time.
    fn parts(&self) -> Result<Vec<EdgePoint>> {
        let (mut open, mut points) = (vec![[0.0, 1.0]], Vec::new());
        for level in 0..=HALVINGS {
            let mut finer = Vec::new();
            for part @ [from, to] in open {
                let is_last = level == HALVINGS || points.len() + 16 * finer.len() > MOST;
                let is_smooth = self.is_smooth(part);
                if is_last || is_smooth {
                    self.add_points(part, is_smooth, &mut points)?;
                    continue;
                }
                let middle = 0.5 * (from + to);
                finer.extend([[from, middle], [middle, to]]);
            }
            open = finer;
        }
        Ok(points)
    }

    fn is_smooth(&self, part: [f64; 2]) -> bool {
        let form = self.h.enclose(&self.region(part));
        let (range, rest) = (form.range(), form.remainder.width());
        range.width() <= SMOOTH[0] * range.low && rest <= SMOOTH[1] * range.low
    }

    /// Whether h is 0 all along the edge, but for the rounding of its terms.
    fn is_nothing(&self) -> bool {
        let [x, y] = self.problem.along(self.edge, 0.5);
        let size = self.h.enclose(&self.region([0.0, 1.0])).range().size();
        size <= ROUNDING * self.h.terms_at(x, y)
    }

    fn region(&self, part: [f64; 2]) -> Region {
        Region::segment(part.map(|t| self.problem.along(self.edge, t)))
    }

    /// The 8 points of a part, between two parabolas where H is smooth in it, else between its ends.
    fn add_points(
        &self,
        part @ [from, to]: [f64; 2],
        is_smooth: bool,
        to_all: &mut Vec<EdgePoint>,
    ) -> Result<()> {
        let (length, form) = (self.problem.lengths[self.edge], self.h.enclose(&self.region(part)));
        let [middle, slope, _, bend, ..] = form.coefficients;
        for &[own, share] in f64::GAUSS[DATA_POINTS - 1] {
            let (t, weight) = (from + own * (to - from), share * (to - from));
            let (x, xi) = (self.problem.along(self.edge, t), 2.0 * own - 1.0);
            let parabola = Interval::point(middle + xi * (slope + xi * bend)) + form.remainder;
            let Interval { low, high } = if is_smooth { parabola } else { form.range() };
            let rounding = ROUNDED * high.abs();
            to_all.push(EdgePoint {
                t,
                weight,
                h: length * self.h.finite_at(x)?,
                between: [length * (low - rounding), length * (high + rounding)],
                ambient: self.ambient.finite_at(x)?,
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{SMOOTH as SCENE, on_grid};
    use signorini_scene::mesh::structured::{Cells, grid};

    /// A jump in the middle of an edge has the right mean at the points, by symmetry, and wrong moments.
    #[test]
    fn jumps_and_bumps_inside_an_edge_are_found() -> Result<()> {
        for (h, are_seen) in [
            ("2 + y", true),
            ("1 + 8*y", true),
            ("exp(2*y)", true),
            ("2 + sign(y - 0.125)", false),
            ("2 + sign(y - 0.25)", true),
            ("1 + 1000*(0.5 + 0.5*sign(0.002 - abs(y - 0.07)))", false),
            ("1 + exp(-((y - 0.4)/0.001)^2)", false),
        ] {
            let text = SCENE.replace("coefficient = \"2+y\"", &format!("coefficient = \"{h}\""));
            let (_, problem) = on_grid(&text, grid(4, Cells::Triangles))?;
            let laws = problem.loads.robin.iter().map(|law| unseen(&problem, law.edge as usize));
            let found = laws.collect::<Result<Vec<_>>>()?;
            assert_eq!(found.iter().all(Option::is_none), are_seen, "{h}");
        }
        Ok(())
    }
}

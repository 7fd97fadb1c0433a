//! Whether the 8 points of an edge see a transfer coefficient h: ∫h tᵏ, from which all integrals of h s² follow, and ∫1/h of a flux.

use signorini_kernel::Real;
use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::{Problem, Sum};
use signorini_scene::expression::enclosure::Region;

/// Part of an integral that points may miss: a hundredth of the norm.
const MISSED: f64 = 1e-4;
/// Halvings of an edge in search of what varies inside it.
const HALVINGS: u32 = 24;
/// By how much h may vary in a part, and leave its polynomial of degree 2, where 8 points see it.
const SMOOTH: [f64; 2] = [0.5, 1e-2];
/// Powers of t: those of squares of functions of degree 2.
const POWERS: usize = 5;

/// ∫1/h and ∫h tᵏ
type Integrals = [f64; 1 + POWERS];

/// Whether the points of an edge, whose condition has a transfer coefficient, see it.
pub fn are_enough(problem: &Problem, edge: usize) -> bool {
    let Some(h) = Sum::transfer(problem, edge, problem.time) else { return true };
    if h.constant().is_some() {
        return true;
    }
    let [a, b] = problem.segment(edge);
    let by_points = on_part(&h, [a, b], [0.0, 1.0]);
    let parts = on_parts(&h, [a, b], [0.0, 1.0], HALVINGS);
    let sizes = [parts[0]].into_iter().chain([parts[1]; POWERS]);
    let mut all = by_points.iter().zip(parts).zip(sizes);
    all.all(|((seen, known), size)| (seen - known).abs() <= MISSED * size)
}

/// The integrals on parts that h varies little in.
fn on_parts(h: &Sum, segment: [[f64; 2]; 2], [from, to]: [f64; 2], left: u32) -> Integrals {
    let [a, b] = segment;
    let place = |t: f64| [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
    let form = h.enclose(&Region::segment([place(from), place(to)]));
    let (range, rest) = (form.range(), form.remainder.width());
    let is_smooth = range.width() <= SMOOTH[0] * range.low
        && rest <= SMOOTH[1] * range.width() + MISSED * range.low;
    if left == 0 || is_smooth {
        return on_part(h, segment, [from, to]);
    }
    let middle = 0.5 * (from + to);
    let [one, other] =
        [[from, middle], [middle, to]].map(|part| on_parts(h, segment, part, left - 1));
    std::array::from_fn(|k| one[k] + other[k])
}

/// The integrals over a part by its 8 points.
fn on_part(h: &Sum, [a, b]: [[f64; 2]; 2], [from, to]: [f64; 2]) -> Integrals {
    let mut sums = [0.0; 1 + POWERS];
    for &[t, weight] in f64::GAUSS[DATA_POINTS - 1] {
        let (t, weight) = (from + t * (to - from), weight * (to - from));
        let [x, y] = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
        let h = h.at(x, y);
        sums[0] += weight / h;
        for (k, sum) in sums[1..].iter_mut().enumerate() {
            *sum += weight * h * t.powi(k as i32);
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{SMOOTH, on_grid};
    use signorini_scene::error::Result;
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
            let text = SMOOTH.replace("coefficient = \"2+y\"", &format!("coefficient = \"{h}\""));
            let (_, problem) = on_grid(&text, grid(4, Cells::Triangles))?;
            let mut edges = problem.loads.robin.iter().map(|record| record.edge as usize);
            assert_eq!(edges.all(|edge| are_enough(&problem, edge)), are_seen, "{h}");
        }
        Ok(())
    }
}

//! Transfer coefficients that inputs change: not negative anywhere, for all inputs within their ranges.
//!
//! ```text
//!   h(x) = h_0(x) + Σ_j p_j π_j(x) ≥ h_0(x) + Σ_j min(lo_j π_j(x), hi_j π_j(x)) ≥ 0
//! ```
//! at the points of the rule for edge data and at the ends of every edge.

use signorini_kernel::Real;

use super::{Problem, Sum};
use crate::quadrature::DATA_POINTS;
use signorini_scene::error::Result;
use signorini_scene::scene::{Field, Input};

/// Refuses a coefficient that is negative with the inputs as they are.
///
/// # Errors
/// The first place where one is.
pub(super) fn check_now(problem: &Problem) -> Result<()> {
    for record in &problem.loads.robin {
        let edge = record.edge as usize;
        let Some(h) = Sum::transfer(problem, edge, problem.time) else { continue };
        for [x, y] in points(problem.segment(edge)) {
            let value = h.at(x, y);
            if value < 0.0 {
                let message = format!("the coefficient is {value} at ({x}, {y}), expected ≥ 0");
                let hint =
                    "flux = coefficient · (ambient − u) with a negative coefficient has no limit";
                return Err(problem.scene.error(h.key(), message).hint(hint).into());
            }
        }
    }
    Ok(())
}

/// The points of the rule for edge data, and both ends.
fn points([a, b]: [[f64; 2]; 2]) -> impl Iterator<Item = [f64; 2]> {
    let inside = f64::GAUSS[DATA_POINTS - 1].iter().map(|point| point[0]);
    inside.chain([0.0, 1.0]).map(move |t| [0, 1].map(|k| a[k] + t * (b[k] - a[k])))
}

/// Refuses ranges within which a coefficient is negative.
///
/// # Errors
/// The first input that can make one negative, with the place and the least value.
pub(super) fn check(problem: &Problem) -> Result<()> {
    if problem.scene.transfer_input().is_none() {
        return Ok(());
    }
    let records = problem.loads.robin.iter();
    records.map(|record| record.edge as usize).try_for_each(|edge| check_edge(problem, edge))
}

fn check_edge(problem: &Problem, edge: usize) -> Result<()> {
    let scene = &problem.scene;
    let Some(at) = problem.binding.boundary(problem.ends[edge]) else { return Ok(()) };
    let boundary = &scene.boundaries[at];
    let Some(base) = boundary.condition.transfer() else { return Ok(()) };
    let acts = |input: &&Input| {
        input.field.value == Field::Coefficient && input.of.value == boundary.name.value
    };
    let inputs: Vec<&Input> = scene.inputs.iter().filter(acts).collect();
    for [x, y] in points(problem.segment(edge)) {
        let parts = inputs.iter().map(|input| (input, least(input, x, y)));
        let parts: Vec<_> = parts.collect();
        let total = parts.iter().fold(base.value.eval(x, y, 0.0), |sum, (_, part)| sum + part);
        // A NaN is told with the loads, at the inputs that make it.
        if total < 0.0
            && let Some((input, _)) = parts.iter().min_by(|a, b| a.1.total_cmp(&b.1))
            && let Some(range) = &input.range
        {
            let message =
                format!("{} falls to {total} at ({x}, {y}) within it, expected ≥ 0", base.key);
            let hint = "narrow the range, or state a larger coefficient";
            return Err(scene.error(range, message).hint(hint).into());
        }
    }
    Ok(())
}

/// The least that an input adds.
fn least(input: &Input, x: f64, y: f64) -> f64 {
    let pattern = input.pattern.value.eval(x, y, 0.0);
    let ends = input.interval().map(|end| end * pattern);
    ends[0].min(ends[1])
}

#[cfg(test)]
mod tests {
    use crate::fixtures::{on_grid, transfer_wall};
    use crate::{Approach, Problem};
    use signorini_scene::error::Result;
    use signorini_scene::mesh::structured::{Cells, grid};

    fn problem(coefficient: &str, input: &str) -> Result<Problem> {
        Ok(on_grid(&transfer_wall(coefficient, input), grid(4, Cells::Mixed))?.1)
    }

    #[test]
    fn a_coefficient_is_negative_nowhere_in_its_range() {
        let said = |coefficient: &str, input: &str| match problem(coefficient, input) {
            Ok(_) => "sound".to_owned(),
            Err(error) => error.to_string(),
        };
        let input = |pattern: &str, range: &str| {
            format!("pattern = \"{pattern}\", default = 0.5, range = {range}")
        };
        assert_eq!(said("3", &input("1", "[-3, 1]")), "sound");
        assert_eq!(said("3", &input("x", "[-3, 3]")), "sound");
        let message = said("3", &input("1", "[-3.5, 1]"));
        let expected = "input.h.range: boundary.contact.coefficient falls to -0.5 at (";
        assert!(message.contains(expected), "{message}");
        let message = said("3", &input("x", "[-1, 4]"));
        assert!(
            message.contains("coefficient falls to -0.9") && message.contains("within it"),
            "{message}"
        );
        let message = said("3", "pattern = \"1\", default = 0.5");
        assert!(message.contains("input.h.range: missing"), "{message}");
    }

    #[test]
    fn what_keeps_its_matrix_refuses_it() -> Result<()> {
        let wall = problem("1", "pattern = \"1\", range = [0.0, 1.0]")?;
        for approach in [Approach::Condensation, Approach::FactoredTicks, Approach::Export] {
            let error = approach.check(&wall).expect_err("a coefficient that changes").to_string();
            assert!(error.contains("input.h.field: it changes the matrix"), "{error}");
        }
        for approach in [Approach::Factor, Approach::Tick, Approach::FullModel] {
            assert!(approach.check(&wall).is_ok(), "{approach:?}");
        }
        Ok(())
    }
}

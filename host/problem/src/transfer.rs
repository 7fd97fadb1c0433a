//! Transfer coefficients that inputs change: not negative anywhere, for all inputs within their ranges.
//!
//! ```text
//!   h(x) = h_0(x) + Σ_j p_j π_j(x) ≥ h_0(x) + Σ_j min(lo_j π_j(x), hi_j π_j(x)) ≥ 0
//! ```
//! at the points of the rule for edge data, at the ends of every edge and where parts of it are proved to hold the least. And the least transfer that they leave: what holds a
//! part, or takes its surplus, does so for all of them then.
//! ```text
//!   min ∫h = ∫h_0 + Σ_j min(lo_j ∫π_j, hi_j ∫π_j)
//! ```
//! edge by edge. What is left where the terms cancel is rounding: nothing passes there. One unit of an input adds to the
//! coefficient, and with it to the load, which has integrals over products of patterns:
//! ```text
//!   ∫h u_ext = ∫(h_0 + Σ_c p_c π_c)(u_0 + Σ_a p_a w_a)
//! ```

use signorini_kernel::Real;

use super::lowest::Ranged;
use super::{EdgeKind, Problem, Sum};
use crate::quadrature::{DATA_POINTS, mean_on_edge};
use signorini_scene::error::Result;
use signorini_scene::expression::Expression;
use signorini_scene::scene::term::Term;
use signorini_scene::scene::{Boundary, Field, Input, Located};

/// The part of its terms below which a coefficient is 0. In f32 the rounding of three terms is less than this.
const CANCELLED: f64 = 1e-6;

/// Part of a least coefficient up to which it is known.
const NEAR: f64 = 1e-3;

/// Refuses a coefficient that is negative with the inputs as they are.
///
/// # Errors
/// The first place where one is.
pub(super) fn check_now(problem: &Problem) -> Result<()> {
    for record in &problem.loads.robin {
        let edge = record.edge as usize;
        let Some(h) = Sum::transfer(problem, edge) else { continue };
        let (key, h) = (h.key(), Ranged::of(h, [1.0; 2]));
        for at @ [x, y] in problem.looks(edge, std::slice::from_ref(&h)) {
            let value = h.at(at);
            if value < 0.0 {
                let message = format!("the coefficient is {value} at ({x}, {y}), expected ≥ 0");
                let hint =
                    "flux = coefficient · (ambient − u) with a negative coefficient has no limit";
                return Err(problem.scene.error(key, message).hint(hint).into());
            }
        }
    }
    Ok(())
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
    let Some(boundary) = problem.boundary_of(edge) else { return Ok(()) };
    let Some(base) = boundary.condition.transfer() else { return Ok(()) };
    let terms = terms(problem, boundary, base, 0.0);
    for at @ [x, y] in problem.looks(edge, &terms) {
        let parts: Vec<f64> = terms.iter().map(|of| least(of, at)).collect();
        let total = parts.iter().sum::<f64>();
        let added = inputs(problem, boundary).zip(&parts[1..]);
        // A NaN is told with the loads, at the inputs that make it: it is not below 0.
        if total < 0.0
            && let Some((input, _)) = added.min_by(|a, b| a.1.total_cmp(b.1))
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

/// The least that a term adds at a point; NaN where it has no number there.
fn least(of: &Ranged, at: [f64; 2]) -> f64 {
    let value = of.at(at);
    let [a, b] = of.factor.map(|end| end * value);
    a.min(b)
}

/// h of a boundary: what the scene states, and what each input adds within its range.
fn terms<'p>(
    problem: &'p Problem,
    boundary: &'p Boundary,
    base: &'p Located<Expression>,
    time: f64,
) -> Vec<Ranged<'p>> {
    let alone = |of| Sum::alone(&problem.scene, of, time);
    let added = |input: &'p Input| Ranged::of(alone(&input.pattern), input.interval());
    let stated = Ranged::of(alone(base), [1.0; 2]);
    std::iter::once(stated).chain(inputs(problem, boundary).map(added)).collect()
}

impl Problem {
    /// This problem with the least ∫h on every transfer edge; other loads stay.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn at_least_transfer(&self) -> Result<Self> {
        let mut least = self.clone();
        if self.scene.transfer_input().is_none() {
            return Ok(least);
        }
        for record in &mut least.loads.robin {
            if let Some(coefficient) = self.least_on(record.edge as usize)? {
                record.coefficient = coefficient;
            }
        }
        Ok(least)
    }

    /// A lower bound of h along a transfer edge, whatever inputs are in their ranges.
    pub fn least_transfer(&self, edge: usize) -> f64 {
        let Some(boundary) = self.transfers_at(edge) else { return 0.0 };
        let Some(base) = boundary.condition.transfer() else { return 0.0 };
        let terms = terms(self, boundary, base, self.time);
        let is_near = |value: f64, bound: f64| value - bound <= NEAR * value.abs();
        self.lowest_sum(edge, &terms, is_near).bound.max(0.0)
    }

    /// The first input that can take all transfer from an edge.
    pub(super) fn insulating_input(&self) -> Option<&Input> {
        let least = self.at_least_transfer().ok()?;
        let mut closed = least.loads.robin.iter().filter(|record| record.coefficient == 0.0);
        closed.find_map(|record| {
            let boundary = self.transfers_at(record.edge as usize)?;
            inputs(self, boundary).next()
        })
    }

    /// The least ∫h of an edge whose coefficient inputs change.
    fn least_on(&self, edge: usize) -> Result<Option<f64>> {
        let Some(boundary) = self.transfers_at(edge) else { return Ok(None) };
        let Some(base) = boundary.condition.transfer() else { return Ok(None) };
        if inputs(self, boundary).next().is_none() {
            return Ok(None);
        }
        let (segment, length) = (self.segment(edge), self.lengths[edge]);
        let integral = |of| Sum::alone(&self.scene, of, self.time).mean(segment);
        let first = length * integral(base)?;
        let (mut sum, mut terms) = (first, first.abs());
        for input in inputs(self, boundary) {
            let share = length * integral(&input.pattern)?;
            let [a, b] = input.interval().map(|end| end * share);
            sum += a.min(b);
            terms += a.min(b).abs();
        }
        Ok(Some(if sum > CANCELLED * terms { sum } else { 0.0 }))
    }

    /// The boundary of an edge with a transfer law.
    fn transfers_at(&self, edge: usize) -> Option<&Boundary> {
        self.boundary_of(edge).filter(|_| self.kinds[edge] == EdgeKind::Robin)
    }
}

/// The inputs that add to the coefficient of a boundary.
fn inputs<'p>(problem: &'p Problem, boundary: &'p Boundary) -> impl Iterator<Item = &'p Input> {
    problem.inputs_of(boundary, &[Field::Coefficient])
}

/// The pattern π of an input, with an entry for each record of `problem.loads.robin`: 0 where it does not act.
#[derive(Debug, Clone)]
pub struct TransferPattern {
    /// ∫π
    pub integrals: Vec<f64>,
    /// ∫π u_0 of the base, ∫π w of each input that adds w to u_ext.
    pub ambient: Vec<(Term, Vec<f64>)>,
    /// |E|π at the 8 Gauss points of the edge, in its direction.
    pub points: Vec<[f64; DATA_POINTS]>,
}

impl Problem {
    /// Pattern of the input at this place in the scene, which adds to a coefficient.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn transfer_pattern(&self, input: usize) -> Result<TransferPattern> {
        let of = &self.scene.inputs[input];
        let pattern = &Sum::alone(&self.scene, &of.pattern, self.time);
        let integral = |edge: usize| Ok(self.lengths[edge] * pattern.mean(self.segment(edge))?);
        let ambient = self.ambient_terms(of).map(|(term, outside)| {
            let outside = Sum::alone(&self.scene, outside, self.time);
            let product = |edge: usize| {
                let segment = self.segment(edge);
                let both = mean_on_edge(segment, |x, y| pattern.at(x, y) * outside.at(x, y));
                outside.finite(self.lengths[edge] * both, segment[0])
            };
            Ok((term, self.each_law(of, product)?))
        });
        Ok(TransferPattern {
            integrals: self.each_law(of, integral)?,
            ambient: ambient.collect::<Result<_>>()?,
            points: self.each_law(of, |edge| self.pattern_at_points(pattern, edge))?,
        })
    }

    fn pattern_at_points(&self, pattern: &Sum, edge: usize) -> Result<[f64; DATA_POINTS]> {
        let mut values = [0.0; DATA_POINTS];
        for (value, [t, _]) in values.iter_mut().zip(f64::GAUSS[DATA_POINTS - 1]) {
            let [x, y] = self.along(edge, *t);
            *value = pattern.finite(self.lengths[edge] * pattern.at(x, y), [x, y])?;
        }
        Ok(values)
    }

    /// Terms of u_ext on the boundary of an input: the base, and every input that adds to it.
    fn ambient_terms<'s>(
        &'s self,
        of: &'s Input,
    ) -> impl Iterator<Item = (Term, &'s Located<Expression>)> {
        let scene = &self.scene;
        let boundary = scene.boundaries.iter().find(|known| known.name.value == of.of.value);
        let base = boundary.and_then(|known| known.condition.datum(Field::Ambient));
        let acts = |(_, other): &(Term, &Input)| {
            other.field.value == Field::Ambient && other.of.value == of.of.value
        };
        let inputs = (1..).zip(&scene.inputs).filter(acts);
        base.map(|base| (0, base)).into_iter().chain(inputs.map(|(at, of)| (at, &of.pattern)))
    }

    /// A number for each transfer law: `take` of its edge where `of` acts, else 0.
    fn each_law<T: Default>(
        &self,
        of: &Input,
        take: impl Fn(usize) -> Result<T>,
    ) -> Result<Vec<T>> {
        let records = self.loads.robin.iter().map(|record| record.edge as usize);
        let entry = |edge: usize| {
            let name = self.boundary_of(edge).map(|boundary| &boundary.name.value);
            if name == Some(&of.of.value) { take(edge) } else { Ok(T::default()) }
        };
        records.map(entry).collect()
    }
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
        // At x = 0 it has no number, which is not below 0; loads ask inside edges alone.
        assert_eq!(said("1 + sin(x)/x", &input("1", "[0, 1]")), "sound");
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

//! Contribution of one unit of an input to a transfer coefficient, and with it to the load: integrals over products of patterns.
//!
//! ```text
//!   ∫h u_ext = ∫(h_0 + Σ_c p_c π_c)(u_0 + Σ_a p_a w_a)
//! ```

use signorini_kernel::Real;

use super::{Problem, Sum};
use crate::quadrature::{DATA_POINTS, mean_on_edge};
use signorini_scene::error::Result;
use signorini_scene::expression::Expression;
use signorini_scene::scene::term::Term;
use signorini_scene::scene::{Field, Input, Located};

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
        let base = boundary.and_then(|known| known.condition.load(Field::Ambient));
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

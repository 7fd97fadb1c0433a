//! The least transfer that inputs leave within their ranges: what holds a part, or takes its surplus, does so for all of them.
//!
//! ```text
//!   min ∫h = ∫h_0 + Σ_j min(lo_j ∫π_j, hi_j ∫π_j)
//! ```
//! edge by edge. What is left where the terms cancel is rounding: nothing passes there.

use super::{EdgeKind, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::{Boundary, Field, Input, Scene};

/// The part of its terms below which a coefficient is 0. In f32 the rounding of three terms is less than this.
const CANCELLED: f64 = 1e-6;

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

    /// The first input that can take all transfer from an edge.
    pub(super) fn insulating_input(&self) -> Option<&Input> {
        let least = self.at_least_transfer().ok()?;
        let mut closed = least.loads.robin.iter().filter(|record| record.coefficient == 0.0);
        closed.find_map(|record| {
            let boundary = self.boundary_of(record.edge as usize)?;
            inputs(&self.scene, boundary).next()
        })
    }

    /// The least ∫h of an edge whose coefficient inputs change.
    fn least_on(&self, edge: usize) -> Result<Option<f64>> {
        let Some(boundary) = self.boundary_of(edge) else { return Ok(None) };
        let Some(base) = boundary.condition.transfer() else { return Ok(None) };
        if inputs(&self.scene, boundary).next().is_none() {
            return Ok(None);
        }
        let (segment, length) = (self.segment(edge), self.lengths[edge]);
        let integral = |of| Sum::alone(&self.scene, of, self.time).mean(segment);
        let first = length * integral(base)?;
        let (mut sum, mut terms) = (first, first.abs());
        for input in inputs(&self.scene, boundary) {
            let share = length * integral(&input.pattern)?;
            let [a, b] = input.interval().map(|end| end * share);
            sum += a.min(b);
            terms += a.min(b).abs();
        }
        Ok(Some(if sum > CANCELLED * terms { sum } else { 0.0 }))
    }

    fn boundary_of(&self, edge: usize) -> Option<&Boundary> {
        let at = self.binding.boundary(self.ends[edge])?;
        (self.kinds[edge] == EdgeKind::Robin).then(|| &self.scene.boundaries[at])
    }
}

/// The inputs that add to the coefficient of a boundary.
fn inputs<'s>(scene: &'s Scene, boundary: &'s Boundary) -> impl Iterator<Item = &'s Input> {
    let acts = |input: &&Input| {
        input.field.value == Field::Coefficient && input.of.value == boundary.name.value
    };
    scene.inputs.iter().filter(acts)
}

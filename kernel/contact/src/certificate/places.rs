//! Where s − ψ comes from on the contact boundary: vertices between contact edges, and corners at Dirichlet values.

use crate::outputs::dot;
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::read;

/// A contact vertex that no Dirichlet edge ends at, where e = s − ψ is a sum of two openings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex<R, I = u16> {
    /// The contact edges whose openings tell e there.
    pub edges: [I; 2],
    /// How much each counts.
    pub weights: [R; 2],
    /// Its own contact edges; an end of the contact has one, named twice.
    pub beside: [I; 2],
}

impl<R: Real> Vertex<R> {
    /// The two terms of e.
    pub(crate) fn terms(&self, x: &[R]) -> [R; 2] {
        let [a, b] = self.edges.map(|edge| read(x, usize::from(edge)));
        [self.weights[0] * a, self.weights[1] * b]
    }
}

/// A contact edge that ends at a Dirichlet value above ψ.
#[derive(Debug, Clone, Copy)]
pub struct Corner<'a, R> {
    /// The edge.
    pub edge: u16,
    /// (u_D − ψ) at its end as a linear form of the inputs, in the unit of 1/r.
    pub excess: &'a [R],
    /// Twice what moving u_D there by a unit of that costs, in the unit of energy: s is moved so that rounding of the excess
    /// leaves it on its side, and what holds for s then is off by as much on both sides.
    pub energy: R,
}

impl<R: Real> Corner<'_, R> {
    /// The excess, and what rounding may hide of it.
    pub(super) fn at(&self, inputs: &[R]) -> Result<[R; 2], Error> {
        same_length(Array::Load, self.excess.len(), inputs.len())?;
        let terms = self.excess.iter().zip(inputs);
        let size = terms.fold(R::ZERO, |sum, (&e, &p)| sum + (e * p).magnitude());
        let slack = R::from_count(inputs.len() as u32 + 8) * R::EPSILON * size;
        Ok([dot(self.excess, inputs), slack])
    }

    /// Excess and rounding for the inputs of the last tick, which come without the constant.
    pub(crate) fn before(&self, inputs: &[R]) -> [R; 2] {
        let Some((&constant, of_inputs)) = self.excess.split_first() else { return [R::ZERO; 2] };
        let terms = of_inputs.iter().zip(inputs).map(|(&e, &p)| e * p);
        let [sum, size] = terms.fold([constant, constant.magnitude()], |[sum, size], term| {
            [sum + term, size + term.magnitude()]
        });
        [sum, R::from_count(inputs.len() as u32 + 8) * R::EPSILON * size]
    }
}

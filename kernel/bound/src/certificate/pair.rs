//! Terms of the bound for any s and τ, such as an s between those of two ticks.

use super::parts::Parts;
use super::walk::{share_of_quad, share_of_triangle};
use super::{Continuous, Discretization, LoadCase, boundary};
use crate::cells::Either;
use crate::equilibrium::Iterate;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::read;
use signorini_kernel::law::Law;
use signorini_kernel::{Index, Real};

/// s by its values at the vertices and the bubbles of edges, and τ by ∫_E τ·n of every edge (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Pair<'a, R> {
    /// s at the vertices.
    pub vertices: &'a [R],
    /// The bubbles of s, one per edge.
    pub bubbles: &'a [R],
    /// τ, along the direction of each edge.
    pub tau: &'a [R],
}

impl<R: Real> Pair<'_, R> {
    /// ‖A^½∇s − A^{−½}τ‖² + ∫_R (τ·n + h(s − u_ext))²/h
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn distance<I: Index>(
        &self,
        discretization: &Discretization<R, I>,
        given: &LoadCase<R, I>,
        law: Law<R>,
    ) -> Result<R, Error> {
        let (mut parts, s) = (self.checked(discretization)?, self.s());
        let (cells, metric) = (discretization.cells, discretization.metric);
        for cell in cells.from_leaves() {
            let share = match cell {
                Either::Triangle(cell) => cell.outward(self.tau).and_then(|out| {
                    share_of_triangle(metric, cell, s, self.tau, (balanced(&out), out))
                }),
                Either::Quad(cell) => cell.outward(self.tau).and_then(|out| {
                    let number = cell.number.at().wrapping_sub(cells.triangles.len());
                    share_of_quad(metric, (cell, number), s, self.tau, (balanced(&out), out))
                }),
            };
            let Some(share) = share else { break };
            parts.add(share);
        }
        let without_contact = LoadCase { ends: Default::default(), ..*given };
        let iterate = Iterate { u: self.tau, law };
        boundary::add(discretization, &without_contact, iterate, s, self.tau, &mut [], &mut parts);
        Ok(parts.gap.value())
    }

    /// Fills in the means of (s − ψ)⁺ and (ψ − s)⁺ along each contact edge; without limits that of s − ψ, and 0.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn openings<I: Index>(
        &self,
        discretization: &Discretization<R, I>,
        given: &LoadCase<R, I>,
        law: Law<R>,
        openings: &mut [[R; 2]],
    ) -> Result<(), Error> {
        self.checked(discretization)?;
        same_length(Array::Contact, openings.len(), given.ends.gap.len())?;
        for (at, opening) in openings.iter_mut().enumerate() {
            *opening = boundary::opening(discretization, given, law, self.s(), at);
        }
        Ok(())
    }

    /// 2∫_C (τ·n − lo)(s − ψ)⁺ + (hi − τ·n)(ψ − s)⁺ for the `openings` of an s and a gap.
    pub fn contact<I: Index>(
        &self,
        discretization: &Discretization<R, I>,
        given: &LoadCase<R, I>,
        law: Law<R>,
        openings: &[[R; 2]],
    ) -> R {
        let free = discretization.edges.counts().free;
        let term = |(at, &opening): (usize, &[R; 2])| {
            let range = given.boundary.contact_flux(at);
            boundary::charge(range, law, read(self.tau, free + at), opening).0
        };
        openings.iter().enumerate().map(term).fold(R::ZERO, |sum, term| sum + term)
    }

    fn checked<I: Index>(&self, of: &Discretization<R, I>) -> Result<Parts<R>, Error> {
        let edges = of.edges.counts().edges();
        same_length(Array::Vertices, self.vertices.len(), of.mesh.vertices().len())?;
        same_length(Array::Edges, self.bubbles.len(), edges)?;
        same_length(Array::Fluxes, self.tau.len(), edges)?;
        Ok(Parts::default())
    }

    fn s(&self) -> Continuous<'_, R> {
        Continuous { vertices: self.vertices, bubbles: self.bubbles }
    }
}

/// The load that these outward fluxes balance.
fn balanced<R: Real>(out: &[R]) -> R {
    out.iter().fold(R::ZERO, |sum, &flux| sum - flux)
}

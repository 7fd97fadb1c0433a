//! Terms of a step in time, in which s goes linearly from where the step before has left it, and τ stays.

use super::boundary;
use super::change::mean;
use super::parts::Distance;
use super::{Continuous, Discretization, LoadCase};
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::read;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::Robin;
use signorini_kernel::{Index, Real};

/// s when a step begins and ends; τ by ∫_E τ·n along every edge's direction (borrowed).
#[derive(Clone, Copy)]
pub(super) struct Motion<'a, R> {
    pub begin: Continuous<'a, R>,
    pub end: Continuous<'a, R>,
    pub tau: &'a [R],
}

impl<R: Real> Motion<'_, R> {
    /// Adds ∫ along the edge of a transfer law, between these vertices, to `sums` for s at the beginning and in the middle.
    #[inline(always)]
    pub fn add_transfer<I: Index>(
        &self,
        given: &LoadCase<R, I>,
        (at, law): (usize, &Robin<R, I>),
        vertices: [I; 2],
        sums: &mut [Distance<R>; 2],
    ) {
        let edge = law.edge.at();
        let of = |s: Continuous<R>| (s.at(&vertices), [read(s.bubbles, edge)]);
        let (now, old) = (of(self.end), of(self.begin));
        let middle = (mean(old.0, now.0), mean(old.1, now.1));
        for (sum, (s, [bubble])) in sums.iter_mut().zip([old, middle]) {
            let transfer = boundary::Transfer { flux: read(self.tau, edge), s, bubble };
            let [term, _, open] = boundary::of_transfer(given, (at, law), &transfer);
            sum.add([term, open]);
        }
    }

    /// 2∫_C (τ·n − lo)(s − ψ)⁺ + (hi − τ·n)(ψ − s)⁺ at the beginning, where `openings` are those of s and the gap then.
    pub fn contact<I: Index>(
        &self,
        discretization: &Discretization<R, I>,
        given: &LoadCase<R, I>,
        law: Law<R>,
        openings: &[[R; 2]],
    ) -> R {
        let on_contact = self.tau.iter().skip(discretization.edges.counts().free);
        let all = openings.iter().zip(on_contact).enumerate();
        all.fold(R::ZERO, |sum, (at, (&opening, &tau))| {
            sum + boundary::charge(given.boundary.contact_flux(at), law, tau, opening).0
        })
    }
}

/// Fills in the means of (s − ψ)⁺ and (ψ − s)⁺ along each contact edge, of s by its values at the vertices and its bubbles; without limits
/// that of s − ψ, and 0.
///
/// # Errors
/// Arrays of the wrong length.
pub fn openings<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    law: Law<R>,
    [vertices, bubbles]: [&[R]; 2],
    openings: &mut [[R; 2]],
) -> Result<(), Error> {
    same_length(Array::Contact, openings.len(), given.ends.gap.len())?;
    same_length(Array::Vertices, vertices.len(), discretization.mesh.vertices().len())?;
    let s = Continuous { vertices, bubbles };
    for (at, opening) in openings.iter_mut().enumerate() {
        *opening = boundary::opening(discretization, given, law, s, at);
    }
    Ok(())
}

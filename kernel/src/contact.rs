//! Force, length and active edges of the contact boundary.
//!
//! The flux (15) keeps the law of contact only as far as the solver has converged. Forces are those of the
//! flux τ that keeps it at any stop:
//! ```text
//!   τ = q where u_E > ψ_E,    τ = the larger of q and σ·n of (15) where u_E = ψ_E
//! ```
//! so that λ = τ − q ≥ 0 on every edge, and of their sum, to the last bit. What the law takes from a flux is
//! missing elsewhere: the sum over all of the boundary is −∫f only for the solution.

use crate::index::{Index, read};
use crate::law::Law;
use crate::mesh::boundary::Boundary;
use crate::mesh::edges::{EdgeCounts, Edges};
use crate::{Math, Mesh, Real};

/// ∫_C (τ·n − q) ≥ 0, the sum of the multiplier λ over the contact boundary. `u` holds the means of u
/// and `flux` the fluxes, one an edge each: those of [`crate::flux::recover`], or τ
/// itself.
pub fn force<R: Real, I: Index>(
    counts: EdgeCounts,
    boundary: &Boundary<R, I>,
    law: Law<R>,
    u: &[R],
    flux: &[R],
) -> R {
    let on_contact = u.iter().zip(flux).skip(counts.free).zip(law.edges()).enumerate();
    on_contact.fold(R::ZERO, |sum, (at, ((&u, &flux), law))| {
        let range = boundary.contact_flux(at);
        sum + range.multiplier(law.flux(u, flux, range))
    })
}

/// Force from the fluxes of the cells, as filled by [`crate::flux::of_triangles`] and
/// [`crate::flux::of_quads`]: a contact edge has one cell.
pub fn force_of_cells<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    law: Law<R>,
    u: &[R],
    triangles: &[[R; 3]],
    quads: &[[R; 4]],
) -> R {
    let (triangles, quads) = (triangles.as_flattened(), quads.as_flattened());
    let sides = edges.half_edges().iter().zip(u).skip(edges.counts().free);
    sides.zip(law.edges()).enumerate().fold(R::ZERO, |sum, (at, ((pair, &u), law))| {
        let flux = match pair[0].at().checked_sub(triangles.len()) {
            None => read(triangles, pair[0].at()),
            Some(rest) => read(quads, rest),
        };
        let range = boundary.contact_flux(at);
        sum + range.multiplier(law.flux(u, flux, range))
    })
}

/// Whether contact edge `contact` (counted from the first one) is active: u_E = ψ_E.
pub fn is_active<R: Real>(counts: EdgeCounts, law: Law<R>, u: &[R], contact: usize) -> bool {
    contact < counts.contact && law.on(contact).touches(read(u, counts.free + contact))
}

/// Σ|E| over the active contact edges, in the length unit of the mesh.
pub fn length<R: Real, I: Index, M: Math<R>>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    law: Law<R>,
    u: &[R],
) -> R {
    let counts = edges.counts();
    let active = (0..counts.contact).filter(|&at| is_active(counts, law, u, at));
    active.fold(R::ZERO, |sum, at| sum + edges.length::<R, M>(mesh, counts.free + at))
}

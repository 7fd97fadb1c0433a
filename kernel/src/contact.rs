//! What a controller reads off the contact boundary: force, length, active edges.

use crate::boundary::Boundary;
use crate::edges::{EdgeCounts, Edges};
use crate::index::{Index, read};
use crate::math::Math;
use crate::mesh::Mesh;
use crate::real::Real;

/// ∫_C (σ·n − q), the sum of the multiplier λ over the contact boundary; `flux` as filled by
/// [`crate::flux::recover`].
pub fn force<R: Real, I: Index>(counts: EdgeCounts, boundary: &Boundary<R, I>, flux: &[R]) -> R {
    let on_contact = flux.iter().skip(counts.free).take(counts.contact).enumerate();
    on_contact.fold(R::ZERO, |sum, (at, &flux)| sum + (flux - boundary.contact_flux(at)))
}

/// The same from the fluxes of the cells, as filled by [`crate::flux::of_triangles`] and
/// [`crate::flux::of_quads`]: a contact edge has one cell.
pub fn force_of_cells<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    triangles: &[[R; 3]],
    quads: &[[R; 4]],
) -> R {
    let (triangles, quads) = (triangles.as_flattened(), quads.as_flattened());
    let counts = edges.counts();
    let on_contact = edges.half_edges().iter().skip(counts.free).take(counts.contact);
    on_contact.enumerate().fold(R::ZERO, |sum, (at, pair)| {
        let flux = match pair[0].at().checked_sub(triangles.len()) {
            None => read(triangles, pair[0].at()),
            Some(rest) => read(quads, rest),
        };
        sum + (flux - boundary.contact_flux(at))
    })
}

/// Whether contact edge `contact` (counted from the first one) is active: u_E = ψ_E.
pub fn is_active<R: Real>(counts: EdgeCounts, lower: &[R], u: &[R], contact: usize) -> bool {
    contact < counts.contact && read(u, counts.free + contact) == read(lower, contact)
}

/// Σ|E| over the active contact edges, in the length unit of the mesh.
pub fn length<R: Real, I: Index, M: Math<R>>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    lower: &[R],
    u: &[R],
) -> R {
    let counts = edges.counts();
    let active = (0..counts.contact).filter(|&at| is_active(counts, lower, u, at));
    active.fold(R::ZERO, |sum, at| sum + edges.length::<R, M>(mesh, counts.free + at))
}

//! A flux that is admissible, from one that is not yet: the equilibrated τ of the error bound.
//!
//! The fluxes of the cells, formula (15), balance every cell but disagree across an edge while the
//! solver has not converged. τ has one value an edge and satisfies, up to rounding,
//! ```text
//!   Σ_i τ_i = −∫_T f on every cell,    τ = ∫g on N,    τ ≥ ∫q on C,    τ = ∫q where u > ψ.
//! ```
//! In three steps: one value an edge ([`crate::averages`]), what the boundary asks ([`impose`]), and a walk
//! over the cells from the leaves of a forest to its roots that hands each cell's surplus on through its
//! last side ([`crate::cells::Cell::settle`], or [`walk`] for all of them).

use crate::cells::{Cells, Either};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::edges::{Block, Edges};
use signorini_kernel::{Real, features};

/// The iterate whose flux is equilibrated.
#[derive(Debug, Clone, Copy)]
pub struct Iterate<'a, R> {
    /// Means of u, one an edge.
    pub u: &'a [R],
    /// The law on the contact edges.
    pub law: Law<'a, R>,
}

/// Sets τ on the boundary, but for D, as the conditions there ask; it is 0 on N and R so far.
#[inline(always)]
pub fn impose<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    iterate: Iterate<R>,
    tau: &mut [R],
) {
    let counts = edges.counts();
    for record in boundary.neumann() {
        let sum = read(tau, record.edge.at()) + record.flux;
        write(tau, record.edge.at(), sum);
    }
    let robin = if features::ROBIN { boundary.robin() } else { &[] };
    for record in robin {
        let law = record.ambient - record.coefficient * read(iterate.u, record.edge.at());
        let sum = read(tau, record.edge.at()) + law;
        write(tau, record.edge.at(), sum);
    }
    if !features::CONTACT {
        return;
    }
    let on_contact = iterate.u.iter().zip(tau.iter_mut()).skip(counts.free);
    for (at, ((&u, tau), law)) in on_contact.zip(iterate.law.edges()).enumerate() {
        *tau = law.flux(u, *tau, boundary.contact_flux(at));
    }
}

/// Hands each cell's surplus on: τ alone, without a bound.
pub fn walk<R: Real, I: Index>(cells: &Cells<R, I>, loads: CellLoads<R>, tau: &mut [R]) {
    for cell in cells.from_leaves() {
        match cell {
            Either::Triangle(cell) => {
                cell.settle(read(loads.triangles, cell.number.at()), tau);
            }
            Either::Quad(cell) => {
                let number = cell.number.at().wrapping_sub(cells.triangles.len());
                cell.settle(read(loads.quads, number), tau);
            }
        }
    }
}

/// Contact edges may have taken a surplus; they must not be pulled at. The edge where τ < q, if any.
#[inline(always)]
pub fn pulled<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    tau: &[R],
) -> Option<usize> {
    if !features::CONTACT {
        return None;
    }
    let counts = edges.counts();
    let mut on_contact = tau.iter().skip(counts.free).take(counts.contact).enumerate();
    let outside = |(at, tau): (usize, &R)| !boundary.contact_flux(at).admits(*tau);
    on_contact.position(outside).map(|at| counts.free + at)
}

/// Whether the flux through an edge may take a surplus whatever the iterate: on D, and on R with h > 0.
pub fn is_root<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    edge: usize,
) -> bool {
    match edges.counts().block(edge) {
        Block::Dirichlet => true,
        Block::Contact => false,
        Block::Free => {
            let records = boundary.robin();
            let found = records.binary_search_by(|record| record.edge.at().cmp(&edge));
            found.is_ok_and(|at| records.get(at).is_some_and(|law| law.coefficient > R::ZERO))
        }
    }
}

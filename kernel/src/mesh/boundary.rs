//! Boundary conditions as integrals over edges, one record type for each kind.
//!
//! ```text
//!   Dirichlet   u = u_D                     value: mean of u_D, stands in u behind the unknowns
//!   Neumann     A∇u·n = g                   b_E += ∫g
//!   Robin       A∇u·n = h (u_ext − u)       K_EE += ∫h,  b_E += ∫h u_ext
//!   contact     u ≥ ψ, A∇u·n ≥ q, and       b_E += ∫q,  u_E ≥ mean of ψ
//!               (u − ψ)(A∇u·n − q) = 0      or any other range of fluxes: `flux_range` beside it
//! ```
//! n points out of the domain, and flux is A∇u·n without a minus sign: heat that flows *in* when u
//! is a temperature. A new kind of condition is a record here with what it adds to the load;
//! [`crate::mesh::diagonal`] has what it adds to the matrix.

use crate::error::{Array, Error, all_finite, known, same_length};
use crate::flux_range::{FluxRange, Spans};
use crate::index::{Index, read};
use crate::mesh::edges::Edges;
use crate::{Real, features};

/// A given flux on a free boundary edge. An edge without a record has flux 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Neumann<R, I> {
    /// The edge.
    pub edge: I,
    /// ∫_E g
    pub flux: R,
}

/// A transfer law on a free boundary edge.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Robin<R, I> {
    /// The edge.
    pub edge: I,
    /// ∫_E h, not negative.
    pub coefficient: R,
    /// ∫_E h u_ext
    pub ambient: R,
}

/// The conditions on all boundary edges (borrowed, validated); by default there are no records, and q = 0.
#[derive(Debug, Clone, Copy, Default)]
pub struct Boundary<'a, R, I> {
    neumann: &'a [Neumann<R, I>],
    robin: &'a [Robin<R, I>],
    contact_flux: &'a [R],
    spans: Spans<'a, R>,
}

impl<'a, R: Real, I: Index> Boundary<'a, R, I> {
    /// `contact_flux` holds ∫_E q for every contact edge in order, or nothing where q = 0. Transfer
    /// laws stand in the order of their edges, one an edge.
    ///
    /// # Errors
    /// Records of edges that are not free boundary edges, transfer laws out of order, numbers that are not finite, negative
    /// Robin coefficients, a wrong number of contact fluxes.
    pub fn new(
        edges: &Edges<I>,
        neumann: &'a [Neumann<R, I>],
        robin: &'a [Robin<R, I>],
        contact_flux: &'a [R],
    ) -> Result<Self, Error> {
        known(Array::Robin, features::ROBIN, robin.len())?;
        let is_free_boundary = |edge: I| {
            edge.at() < edges.counts().free
                && edges.half_edges().get(edge.at()).is_some_and(|pair| pair[1] == I::NONE)
        };
        for (at, record) in neumann.iter().enumerate() {
            if !is_free_boundary(record.edge) {
                return Err(Error::OutOfRange { of: Array::Neumann, at });
            }
            if !record.flux.finite() {
                return Err(Error::NotFinite { of: Array::Neumann, at });
            }
        }
        for (at, record) in robin.iter().enumerate() {
            if !is_free_boundary(record.edge) {
                return Err(Error::OutOfRange { of: Array::Robin, at });
            }
            if !(record.coefficient.finite() && record.ambient.finite()) {
                return Err(Error::NotFinite { of: Array::Robin, at });
            }
            if record.coefficient < R::ZERO {
                return Err(Error::NegativeRobin { edge: record.edge.at() });
            }
            let before = at.checked_sub(1).and_then(|before| robin.get(before));
            if before.is_some_and(|before| before.edge >= record.edge) {
                return Err(Error::OutOfRange { of: Array::Robin, at });
            }
        }
        if !contact_flux.is_empty() {
            same_length(Array::Contact, contact_flux.len(), edges.counts().contact)?;
        }
        all_finite(Array::Contact, contact_flux)?;
        Ok(Self { neumann, robin, contact_flux, spans: Spans::UNLIMITED })
    }

    /// This boundary with other ranges than "from ∫q on": `contact_flux` holds their bases then.
    ///
    /// # Errors
    /// Another number of spans than there are contact edges.
    pub fn with_spans(self, edges: &Edges<I>, spans: Spans<'a, R>) -> Result<Self, Error> {
        spans.check_length(edges.counts().contact)?;
        Ok(Self { spans, ..self })
    }

    /// Given fluxes.
    pub fn neumann(&self) -> &'a [Neumann<R, I>] {
        self.neumann
    }

    /// Transfer laws.
    pub fn robin(&self) -> &'a [Robin<R, I>] {
        self.robin
    }

    /// Range of ∫_E A∇u·n on a contact edge, counted from the first contact edge.
    #[inline(always)]
    pub fn contact_flux(&self, contact: usize) -> FluxRange<R> {
        FluxRange::new(read(self.contact_flux, contact), self.spans.on(contact))
    }

    /// Adds what the conditions contribute to the load b (one entry an unknown).
    pub fn add_to_load(&self, edges: &Edges<I>, load: &mut [R]) {
        let neumann = self.neumann.iter().map(|record| (record.edge.at(), record.flux));
        let robin = self.robin.iter().map(|record| (record.edge.at(), record.ambient));
        let contact = self.contact_flux.iter().enumerate();
        let contact = contact.map(|(at, &flux)| (edges.counts().free + at, flux));
        for (edge, integral) in neumann.chain(robin).chain(contact) {
            if let Some(entry) = load.get_mut(edge) {
                *entry += integral;
            }
        }
    }
}

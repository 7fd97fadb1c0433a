//! Loads and boundary data of one tick: the statics, or copies of them with the inputs' shares.

use super::curved::CurvedSum;
use super::pattern::{DataMemory, Pattern};
use crate::tick::{Data, IfStoring};
use signorini_bound::certificate::{Curved, LoadCase, TransferForms};
use signorini_bound::conforming::VertexData;
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::error::{Array, Error, same_length_or_empty};
use signorini_kernel::flux_range::{Room, Spans};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::{Index, Real, features};

/// What the bound takes along transfer edges (borrowed).
#[derive(Debug, Clone, Copy)]
pub enum Along<'a, R, I> {
    /// ∫h and u_ext at the Gauss points of every edge, or nothing where both are constant along them.
    Seen(&'a [[[R; 2]; 8]]),
    /// The same, and the forms of edges whose points do not see h. Behind one pointer, a scene without them takes nothing for it.
    Unseen(&'a (&'a [[[R; 2]; 8]], TransferForms<'a, R, I>)),
}

/// The data where all inputs are 0 (borrowed), as [`Data`] takes them.
#[derive(Debug, Clone, Copy, Default)]
pub struct Base<'a, R, I> {
    /// ∫f of the cells.
    pub loads: CellLoads<'a, R>,
    /// Given fluxes: every edge on which there may be one.
    pub neumann: &'a [Neumann<R, I>],
    /// Transfer laws.
    pub robin: &'a [Robin<R, I>],
    /// ∫q, one a contact edge, or nothing where q = 0.
    pub contact_flux: &'a [R],
    /// The ranges of the fluxes on contact edges, whose bases `contact_flux` holds then.
    pub spans: Spans<'a, R>,
    /// Room that inputs leave in ranges that they change.
    pub rooms: &'a [Room<'a, R>],
    /// What it costs in ‖A^½∇u‖ that each end of such a range has moved by 1.
    pub settling: R,
    /// Means of ψ, one a contact edge.
    pub gap: &'a [R],
    /// Means of u_D, one a Dirichlet edge.
    pub dirichlet: &'a [R],
    /// ψ and u_D at the ends of the edges.
    pub ends: VertexData<'a, R>,
    /// Edges on which ψ or u_D is not affine, where no input bends them.
    pub curved: &'a [Curved<R, I>],
    /// The same where inputs do, `curved` being empty then.
    pub curved_sums: &'a [CurvedSum<'a, R, I>],
    /// h and u_ext along transfer edges.
    pub transfer: Along<'a, R, I>,
}

impl<R, I> Default for Along<'_, R, I> {
    fn default() -> Self {
        Self::Seen(&[])
    }
}

impl<'a, R, I> Along<'a, R, I> {
    /// ∫h and u_ext at the points.
    pub const fn points(&self) -> &'a [[[R; 2]; 8]] {
        match self {
            Self::Seen(points) | Self::Unseen((points, _)) => points,
        }
    }

    /// The forms for these inputs.
    pub(super) fn forms<'v>(&self, values: &'v [R]) -> Option<TransferForms<'v, R, I>>
    where
        'a: 'v,
    {
        match self {
            Self::Unseen((_, forms)) if features::PIECES => {
                Some(TransferForms { values, ..*forms })
            }
            _ => None,
        }
    }
}

impl<R: Real, I: Index> DataMemory<'_, R, I> {
    /// Fills it in for these inputs; returns by how much ends of fluxes were moved at most.
    pub(super) fn evaluate(
        &mut self,
        base: &Base<R, I>,
        patterns: &[Pattern<R, I>],
        inputs: &[R],
    ) -> Result<R, Error> {
        copy(Array::CellLoads, base.loads.triangles, self.triangles)?;
        copy(Array::CellLoads, base.loads.quads, self.quads)?;
        copy(Array::Neumann, base.neumann, self.neumann)?;
        copy(Array::Robin, base.robin, self.robin)?;
        copy(Array::Contact, base.contact_flux, self.contact_flux)?;
        copy(Array::LowerBounds, base.gap, self.gap)?;
        copy(Array::Contact, base.ends.gap, self.gap_ends)?;
        copy(Array::Dirichlet, base.dirichlet, self.dirichlet)?;
        copy(Array::Dirichlet, base.ends.given, self.dirichlet_ends)?;
        copy(Array::Robin, base.transfer.points(), self.transfer)?;
        copy(Array::ContactSpans, base.spans.lengths(), self.spans)?;
        for (pattern, &p) in patterns.iter().zip(inputs) {
            pattern.add(p, self);
        }
        if features::TRANSFER {
            self.transfer(patterns, inputs);
        }
        let mut moved = R::ZERO;
        if features::LIMITED {
            let ranges = (&mut *self.contact_flux, &mut *self.spans);
            moved = super::ranges::check(ranges, base.spans.lengths(), base.rooms, inputs)?;
        }
        if features::CURVED {
            same_length_or_empty(Array::Edges, self.curved.len(), base.curved_sums.len())?;
            let sums = base.curved_sums.iter().zip(self.curved.iter_mut());
            sums.for_each(|(sum, record)| *record = sum.at(inputs));
        }
        Ok(moved)
    }

    /// What a tick takes.
    pub(super) fn view<'d>(
        &'d self,
        base: &Base<'d, R, I>,
        edges: &Edges<I>,
        forms: &'d [TransferForms<'d, R, I>],
        oscillation: R,
    ) -> Result<Data<'d, R, I>, Error> {
        let contact_flux = own_or(self.contact_flux, base.contact_flux);
        let spans = self.spans(base.spans);
        let (neumann, robin) = (own_or(self.neumann, base.neumann), own_or(self.robin, base.robin));
        let given = LoadCase {
            loads: CellLoads {
                triangles: own_or(self.triangles, base.loads.triangles),
                quads: own_or(self.quads, base.loads.quads),
            },
            boundary: Boundary::new(edges, neumann, robin, contact_flux)?
                .with_spans(edges, spans)?,
            ends: VertexData {
                gap: own_or(self.gap_ends, base.ends.gap),
                given: own_or(self.dirichlet_ends, base.ends.given),
            },
            curved: own_or(self.curved, base.curved),
            transfer: own_or(self.transfer, base.transfer.points()),
            forms,
            oscillation,
        };
        let law = Law::above(own_or(self.gap, base.gap)).with_spans(spans);
        let dirichlet = own_or(self.dirichlet, base.dirichlet);
        Ok(Data { given, law, dirichlet, step: IfStoring::NOTHING })
    }

    /// The ranges of fluxes on contact edges.
    fn spans<'d>(&'d self, base: Spans<'d, R>) -> Spans<'d, R> {
        if self.spans.is_empty() { base } else { Spans::baked(self.spans, base.excess()) }
    }
}

fn copy<T: Copy>(of: Array, base: &[T], own: &mut [T]) -> Result<(), Error> {
    same_length_or_empty(of, own.len(), base.len())?;
    own.iter_mut().zip(base).for_each(|(own, &base)| *own = base);
    Ok(())
}

fn own_or<'d, T>(own: &'d [T], base: &'d [T]) -> &'d [T] {
    if own.is_empty() { base } else { own }
}

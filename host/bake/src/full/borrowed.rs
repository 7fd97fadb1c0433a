//! A baked scene as the kernel takes it: what the desk solves, and what the module lists.

use signorini_bound::certificate::TransferForms;
use signorini_bound::conforming::VertexData;
use signorini_device::full::{Along, Base, CurvedSum, Full, Functional, Lengths};
use signorini_kernel::flux_range::{Room, Spans};
use signorini_kernel::storage::IfStoring;

use super::arrays::Baked;
use super::data::Data;
use super::output::Output;
use super::pattern::Pattern;
use super::storing::Stored;
use crate::Bakes;
use signorini_certify::transfer_forms::Forms;
use signorini_problem::scalar::Scalar;

impl<R: Bakes> Baked<R> {
    /// How long the memory is.
    pub(super) fn lengths(&self) -> Lengths {
        self.with(Lengths::of)
    }

    /// Lends the arrays as the kernel takes them.
    pub(super) fn with<T>(&self, take: impl FnOnce(&Full<R, u32>) -> T) -> T {
        // What patterns borrow beyond their own arrays.
        let all = &self.data.patterns;
        let ambient: Vec<_> = all.iter().map(Pattern::ambient).collect();
        let transfer: Vec<_> = all.iter().zip(&ambient).map(|(of, all)| of.transfer(all)).collect();
        let patterns: Vec<_> = all.iter().zip(&transfer).map(|(of, law)| of.view(law)).collect();
        let outputs: Vec<_> = self.outputs.iter().map(Output::view).collect();
        let sums = self.data.curved_sums.iter();
        let sums: Vec<_> = sums
            .map(|of| CurvedSum { edge: of.edge, parts: &of.parts, energy: &of.energy })
            .collect();
        let rooms: Vec<_> = self.data.rooms.iter().map(|room| room.view()).collect();
        let storing = self.stored.as_ref().map(Stored::view);
        let along = (&self.data.transfer[..], self.data.view_of_forms());
        take(&Full {
            discretization: self.discretization(),
            base: self.data.base(&sums, &rooms, &along),
            patterns: &patterns,
            oscillation: &self.data.oscillation,
            outputs: &outputs,
            has_bound: self.has_bound(),
            corners: &self.corners,
            start: self.start,
            relaxation: self.how.relaxation,
            storing: storing.as_ref().map_or(IfStoring::NOTHING, IfStoring::of),
        })
    }
}

impl<R: Scalar> Data<R> {
    fn view_of_forms(&self) -> TransferForms<'_, R, u32> {
        let Forms { laws, factors, .. } = &self.forms;
        TransferForms { laws, inputs: &self.of_ambient, values: &[], factors }
    }

    fn base<'a>(
        &'a self,
        curved_sums: &'a [CurvedSum<'a, R, u32>],
        rooms: &'a [Room<'a, R>],
        along: &'a (&'a [[[R; 2]; 8]], TransferForms<'a, R, u32>),
    ) -> Base<'a, R, u32> {
        let loads = &self.loads;
        Base {
            loads: loads.cells(),
            neumann: &loads.neumann,
            robin: &loads.robin,
            contact_flux: &loads.contact_flux,
            spans: match loads.spans.is_empty() {
                true => Spans::UNLIMITED,
                false => Spans::baked(&loads.spans, loads.span_excess),
            },
            rooms,
            settling: self.settling,
            gap: &loads.gap,
            dirichlet: &loads.dirichlet,
            ends: VertexData { gap: &self.gap_ends, given: &self.dirichlet_ends },
            curved: &self.curved,
            curved_sums,
            transfer: match along.1.laws {
                [] => Along::Seen(along.0),
                _ => Along::Unseen(along),
            },
        }
    }
}

impl<R: Scalar> Output<R> {
    fn view(&self) -> Functional<'_, R, u32> {
        match self {
            Self::Flux(edges) => Functional::Flux(edges),
            Self::Force(edges) => Functional::Force(edges),
            Self::Length(shares) => Functional::Length(shares),
            Self::Saturated(shares) => Functional::Saturated(shares),
            Self::Probe(shares) => Functional::Probe(shares),
            Self::Bound => Functional::Bound,
        }
    }
}

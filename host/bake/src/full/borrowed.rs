//! A baked scene as the kernel takes it: what the desk solves, and what the module lists.

use signorini_bound::conforming::VertexData;
use signorini_device::full::{self, Base, CurvedSum, Full, Functional, Lengths, TransferPattern};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::flux_range::Spans;

use super::arrays::Baked;
use super::data::{Data, Pattern};
use super::output::Output;
use super::transfer::Transfer;
use signorini_problem::scalar::Scalar;

impl<R: Scalar> Baked<R> {
    /// How long the memory is.
    pub(super) fn lengths(&self) -> Lengths {
        self.with(Lengths::of)
    }

    /// Lends the arrays as the kernel takes them.
    pub(super) fn with<T>(&self, take: impl FnOnce(&Full<R, u32>) -> T) -> T {
        // What patterns borrow beyond their own arrays.
        let of_coefficients: Vec<_> = self.data.patterns.iter().map(Pattern::transfer).collect();
        let products: Vec<_> = of_coefficients.iter().map(|of| of.map(Transfer::shares)).collect();
        let transfer = of_coefficients.iter().zip(&products);
        let transfer: Vec<_> =
            transfer.map(|(of, products)| Some(of.as_ref()?.view(products.as_ref()?))).collect();
        let patterns = self.data.patterns.iter().zip(&transfer);
        let patterns: Vec<_> = patterns.map(|(of, transfer)| of.view(transfer.as_ref())).collect();
        let outputs: Vec<_> = self.outputs.iter().map(Output::view).collect();
        let sums = self.data.curved_sums.iter();
        let sums: Vec<_> = sums
            .map(|of| CurvedSum { edge: of.edge, parts: &of.parts, energy: &of.energy })
            .collect();
        take(&Full {
            discretization: self.discretization(),
            base: self.data.base(&sums),
            patterns: &patterns,
            oscillation: &self.data.oscillation,
            outputs: &outputs,
            has_bound: self.data.has_bound,
            corners: &self.corners,
            start: self.start,
            relaxation: self.how.relaxation,
        })
    }
}

impl<R: Scalar> Data<R> {
    fn base<'a>(&'a self, curved_sums: &'a [CurvedSum<'a, R, u32>]) -> Base<'a, R, u32> {
        Base {
            loads: CellLoads { triangles: &self.triangles, quads: &self.quads },
            neumann: &self.neumann,
            robin: &self.robin,
            contact_flux: &self.contact_flux,
            spans: match self.spans.is_empty() {
                true => Spans::UNLIMITED,
                false => Spans::baked(&self.spans, self.span_excess),
            },
            gap: &self.gap,
            dirichlet: &self.dirichlet,
            ends: VertexData { gap: &self.gap_ends, given: &self.dirichlet_ends },
            curved: &self.curved,
            curved_sums,
            transfer: &self.transfer,
        }
    }
}

impl<R: Scalar> Pattern<R> {
    fn transfer(&self) -> Option<&Transfer<R>> {
        match self {
            Self::Coefficient(of) => Some(of),
            _ => None,
        }
    }

    fn view<'a>(
        &'a self,
        transfer: Option<&'a TransferPattern<'a, R, u32>>,
    ) -> full::Pattern<'a, R, u32> {
        match self {
            Self::Source { triangles, quads } => full::Pattern::Source { triangles, quads },
            Self::Neumann(shares) => full::Pattern::Neumann(shares),
            Self::ContactFlux(shares) => full::Pattern::ContactFlux(shares),
            Self::ContactRange { fluxes, spans } => full::Pattern::ContactRange { fluxes, spans },
            Self::Gap(chords) => full::Pattern::Gap(chords),
            Self::Value(chords) => full::Pattern::Value(chords),
            Self::Ambient { integrals, points } => full::Pattern::Ambient { integrals, points },
            Self::Coefficient(_) => match transfer {
                Some(transfer) => full::Pattern::Coefficient(transfer),
                None => full::Pattern::Neumann(&[]),
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

//! A baked scene as the kernel takes it: what the desk solves, and what the module lists.

use signorini_kernel::bound::conforming::VertexData;
use signorini_kernel::device::full::{self, Base, CurvedSum, Full, Functional, Lengths};
use signorini_kernel::discrete::assembly::CellLoads;

use super::arrays::Baked;
use super::data::{Data, Pattern};
use super::output::Output;
use signorini_solve::scalar::Scalar;

impl<R: Scalar> Baked<R> {
    /// How long the memory is.
    pub(super) fn lengths(&self) -> Lengths {
        self.with(Lengths::of)
    }

    /// Lends the arrays as the kernel takes them.
    pub(super) fn with<T>(&self, take: impl FnOnce(&Full<R, u32>) -> T) -> T {
        let patterns: Vec<_> = self.data.patterns.iter().map(Pattern::view).collect();
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
    fn view(&self) -> full::Pattern<'_, R, u32> {
        match self {
            Self::Source { triangles, quads } => full::Pattern::Source { triangles, quads },
            Self::Neumann(shares) => full::Pattern::Neumann(shares),
            Self::ContactFlux(shares) => full::Pattern::ContactFlux(shares),
            Self::Gap(chords) => full::Pattern::Gap(chords),
            Self::Value(chords) => full::Pattern::Value(chords),
            Self::Ambient { integrals, points } => full::Pattern::Ambient { integrals, points },
        }
    }
}

impl<R: Scalar> Output<R> {
    fn view(&self) -> Functional<'_, R, u32> {
        match self {
            Self::Flux(edges) => Functional::Flux(edges),
            Self::Force(edges) => Functional::Force(edges),
            Self::Length(shares) => Functional::Length(shares),
            Self::Probe(shares) => Functional::Probe(shares),
            Self::Bound => Functional::Bound,
        }
    }
}

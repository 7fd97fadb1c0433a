//! The statics of a baked module, each with its name, its meaning and its size.

use signorini_kernel::bound::cells::{Quad, Triangle};
use signorini_kernel::bound::certificate::{Curved, POINTS};
use signorini_kernel::device::full::{Contribution, CurvedPart, EdgeTrace, Points, Product};
use signorini_kernel::discrete::rows::{QUADS, TRIANGLES};
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::solve::sparse::storage;
use signorini_kernel::{Index, Tensor};

use super::arrays::Baked;
use super::data::Pattern;
use super::list::{Item, List};
use super::output::Output;
use signorini_solve::scalar::Scalar;

/// What the model takes of a device, code and stack aside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sizes {
    /// Bytes of the `Controller`.
    pub ram: usize,
    /// Bytes of the statics.
    pub flash: usize,
}

/// The sizes, exact but for alignment.
pub fn sizes<R: Scalar>(baked: &Baked<R>) -> Sizes {
    let (ram, items) = match baked.index() {
        "u16" => (memory::<R, u16>(baked), statics::<R, u16>(baked)),
        _ => (memory::<R, u32>(baked), statics::<R, u32>(baked)),
    };
    Sizes { ram, flash: items.iter().map(|item| item.bytes).sum() }
}

/// The name of an input's or output's array.
pub(super) fn named(identifier: &str, what: &str) -> String {
    format!("{}_{what}", identifier.trim_end_matches('_').to_ascii_uppercase())
}

/// Everything in flash, in the index type `I`.
#[rustfmt::skip] // A table.
pub(super) fn statics<R: Scalar, I: Index>(baked: &Baked<R>) -> Vec<Item> {
    let (mut list, data) = (List::default(), &baked.data);
    list.put::<[R; 2]>("VERTICES", "Vertex coordinates, moved into the box [−1, 1]²; only their number is read.", "[Scalar; 2]", &baked.vertices);
    list.put::<[I; 3]>("TRIANGLES", "Vertices of each triangle, counterclockwise.", "[Index; 3]", &baked.triangles);
    list.put::<[I; 4]>("QUADS", "Vertices of each quad, counterclockwise.", "[Index; 4]", &baked.quads);
    list.put::<[I; 3]>("EDGES_OF_TRIANGLES", "The edge of each side of each triangle.", "[Index; 3]", &baked.of_triangles);
    list.put::<[I; 4]>("EDGES_OF_QUADS", "The edge of each side of each quad.", "[Index; 4]", &baked.of_quads);
    list.put::<[I; 2]>("HALF_EDGES", "The one or two half-edges of each edge: interior, Neumann and Robin edges, then contact, then Dirichlet.", "[Index; 2]", &baked.half_edges);
    list.put::<[R; 3]>("STIFFNESS_OF_TRIANGLES", "Element matrices: entries 01, 12, 20.", "[Scalar; 3]", &baked.stiffness_of_triangles);
    list.put::<[R; 6]>("STIFFNESS_OF_QUADS", "Element matrices: entries 01, 02, 03, 12, 13, 23.", "[Scalar; 6]", &baked.stiffness_of_quads);
    list.put::<Triangle<R, I>>("PACKED_TRIANGLES", "Triangles in the order in which the error bound walks over them.", "Triangle<Scalar, Index>", &baked.packed_triangles);
    list.put::<Quad<R, I>>("PACKED_QUADS", "Quads in the order in which the error bound walks over them.", "Quad<Scalar, Index>", &baked.packed_quads);
    list.put::<R>("VERTEX_WEIGHTS", "1/Σα of the cells at each vertex.", "Scalar", &baked.vertex_weights);
    list.put::<R>("EDGE_WEIGHTS", "1/Σ(1/α) of the cells of each edge, 0 on Neumann and Robin edges.", "Scalar", &baked.edge_weights);
    list.put::<I>("ORDER", "The cells from roots to leaves of the forest.", "Index", &baked.order);
    list.put::<[Tensor<R>; POINTS * POINTS]>("METRIC", "A in reference coordinates at 64 points of the cells in which it varies.", "[Tensor<Scalar>; 64]", &baked.metric);
    list.put::<u32>("METRIC_PLACE", "Where each cell stands in `METRIC`; beyond its end where A is constant.", "u32", &baked.metric_place);
    list.put::<[R; 2]>("QUAD_DISTORTIONS", "By how much each quad is no parallelogram.", "[Scalar; 2]", &baked.distortions);
    list.put::<R>("SOURCE_OF_TRIANGLES", "∫f of each triangle.", "Scalar", &data.triangles);
    list.put::<R>("SOURCE_OF_QUADS", "∫f of each quad.", "Scalar", &data.quads);
    list.put::<Neumann<R, I>>("NEUMANN", "∫g of the edges with a given flux.", "Neumann<Scalar, Index>", &data.neumann);
    list.put::<Robin<R, I>>("ROBIN", "Transfer laws: ∫h and ∫h u_ext.", "Robin<Scalar, Index>", &data.robin);
    list.put::<[[R; 2]; 8]>("TRANSFER", "∫h and u_ext at 8 points of each transfer edge.", "[[Scalar; 2]; 8]", &data.transfer);
    list.put::<R>("CONTACT_FLUX", "∫q of each contact edge.", "Scalar", &data.contact_flux);
    list.put::<R>("GAP", "Mean of ψ on each contact edge.", "Scalar", &data.gap);
    list.put::<[R; 2]>("GAP_ENDS", "ψ at the ends of each contact edge.", "[Scalar; 2]", &data.gap_ends);
    list.put::<R>("DIRICHLET", "Mean of u_D on each Dirichlet edge.", "Scalar", &data.dirichlet);
    list.put::<[R; 2]>("DIRICHLET_ENDS", "u_D at the ends of each Dirichlet edge.", "[Scalar; 2]", &data.dirichlet_ends);
    list.put::<Curved<R, I>>("CURVED", "Edges on which ψ or u_D is not affine.", "Curved<Scalar, Index>", &data.curved);
    for (at, bent) in data.curved_sums.iter().enumerate() {
        list.put::<CurvedPart<R>>(&format!("CURVED_{at}_PARTS"), "What base and inputs add to a curved edge.", "CurvedPart<Scalar>", &bent.parts);
        list.put::<Product<R>>(&format!("CURVED_{at}_ENERGY"), "Its energy, a quadratic form in the inputs.", "Product<Scalar>", &bent.energy);
    }
    list.put::<[I; 2]>("CORNERS", "Where contact meets Dirichlet: an end of either edge.", "[Index; 2]", &baked.corners);
    list.put::<R>("OSCILLATION", "What the bound's means leave out of the base, then of a unit of each input.", "Scalar", &data.oscillation);
    for (pattern, input) in data.patterns.iter().zip(baked.face.inputs()) {
        let mut shares = |what: &str, doc: &str, shares: &[Contribution<R, u32>]| {
            list.put::<Contribution<R, I>>(&named(input, what), &format!("{doc} that a unit of `{input}` adds."), "Contribution<Scalar, Index>", shares);
        };
        match pattern {
            Pattern::Source { triangles, quads } => {
                shares("TO_TRIANGLES", "∫f", triangles);
                shares("TO_QUADS", "∫f", quads);
            }
            Pattern::Neumann(all) => shares("PATTERN", "∫g", all),
            Pattern::ContactFlux(all) => shares("PATTERN", "∫q", all),
            Pattern::Gap(chords) | Pattern::Value(chords) => list.put::<EdgeTrace<R, I>>(&named(input, "PATTERN"), &format!("Mean and end values that a unit of `{input}` adds."), "EdgeTrace<Scalar, Index>", chords),
            Pattern::Ambient { integrals, points } => {
                shares("PATTERN", "∫h u_ext", integrals);
                list.put::<Points<R, I>>(&named(input, "AT_POINTS"), &format!("u_ext that a unit of `{input}` adds."), "Points<Scalar, Index>", points);
            }
        }
    }
    for (output, name) in baked.outputs.iter().zip(baked.face.outputs()) {
        let array = named(name, "EDGES");
        match output {
            Output::Flux(edges) => list.put::<I>(&array, &format!("Edges whose fluxes add up to `{name}`."), "Index", edges),
            Output::Force(edges) => list.put::<I>(&array, &format!("Contact edges whose forces add up to `{name}`."), "Index", edges),
            Output::Length(edges) => list.put::<Contribution<R, I>>(&array, &format!("Contact edges whose lengths add up to `{name}`."), "Contribution<Scalar, Index>", edges),
            Output::Probe(edges) => list.put::<Contribution<R, I>>(&array, &format!("Edges whose means make `{name}`."), "Contribution<Scalar, Index>", edges),
            Output::Bound => {}
        }
    }
    if let Some(factored) = &baked.factored {
        factored.statics::<I>(&mut list);
    }
    list.0
}

/// Bytes of the controller, in the index type `I`.
fn memory<R: Scalar, I: Index>(baked: &Baked<R>) -> usize {
    let lengths = baked.lengths();
    let own = match baked.width() {
        TRIANGLES => lengths.bytes::<R, I, TRIANGLES>(),
        _ => lengths.bytes::<R, I, QUADS>(),
    };
    let exchanges = baked.factored.as_ref().map(|_| storage::bytes::<R>(lengths.active));
    own + exchanges.unwrap_or(0)
}

impl<R: Scalar> Baked<R> {
    /// What the record of `cargo xtask size` calls scenes with the code of this one.
    pub fn code(&self) -> &'static str {
        if self.factored.is_some() { ", by a factor" } else { ", on " }
    }

    /// Room in a packed row.
    pub(super) fn width(&self) -> usize {
        if self.of_quads.is_empty() { TRIANGLES } else { QUADS }
    }

    /// The index type: the shorter one that can number everything.
    pub(super) fn index(&self) -> &'static str {
        let half_edges = 3 * self.of_triangles.len() + 4 * self.of_quads.len();
        let addressable = (u16::LIMIT - 1) / size_of::<R>();
        let ends = 2 * self.counts.contact.max(self.counts.dirichlet);
        let numbered = half_edges.max(self.vertices.len()).max(ends);
        let short = numbered < u16::LIMIT && self.counts.edges() <= addressable;
        if short { "u16" } else { "u32" }
    }
}

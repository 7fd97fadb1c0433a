//! The module of statics: one walk over what the kernel borrows writes every array and says where it belongs.

use std::fmt::Write as _;

use signorini_device::full::Full;
use signorini_kernel::Index;

use super::arrays::Baked;
use super::foundation::{base, discretization};
use super::linear::{outputs, patterns};
use crate::module_api::ModuleApi;
use crate::statics::{Statics, tall_record};
use signorini_problem::scalar::Scalar;

/// Items of the kernel that they may use.
pub(super) const NAMES: &str = "\
    kernel::assembly::CellLoads contact::dense::tableau::InitialTableau \
    kernel::mesh::boundary::Neumann kernel::mesh::boundary::Robin bound::cells::Cell \
    bound::cells::Cells bound::cells::Quad bound::cells::Triangle bound::certificate::Curved \
    bound::certificate::Discretization bound::certificate::Metric bound::certificate::Stability \
    bound::conforming::VertexData kernel::mesh::edges::EdgeCounts kernel::mesh::edges::Edges \
    full::AmbientShare full::Base full::EdgeTrace full::CurvedPart full::CurvedSum full::Full \
    full::Functional full::Pattern full::Points full::TransferPattern full::Product \
    full::Contribution kernel::Mesh kernel::relaxation::Relaxation sparse::Factor \
    sparse::Factored kernel::flux_range::Spans kernel::stiffness::Stiffness kernel::Tensor";

/// Everything in flash.
pub(super) fn listed<R: Scalar>(baked: &Baked<R>) -> Statics {
    match baked.index() {
        "u16" => written::<R, u16>(baked),
        _ => written::<R, u32>(baked),
    }
}

fn written<R: Scalar, I: Index>(baked: &Baked<R>) -> Statics {
    let mut to = Statics::default();
    baked.with(|of| full::<R, I>(of, &baked.face, &mut to));
    if let Some(factored) = &baked.factored {
        factored.write::<I>(&mut to);
    }
    to
}

#[rustfmt::skip] // A table.
fn full<R: Scalar, I: Index>(of: &Full<R, u32>, face: &ModuleApi, to: &mut Statics) {
    let (discretization, base) = (discretization::<R, I>(&of.discretization, to), base::<R, I>(&of.base, to));
    let corners = to.array::<[I; 2]>("CORNERS", "Where contact meets Dirichlet: an end of either edge.", "[Index; 2]", of.corners);
    let oscillation = to.numbers("OSCILLATION", "What the bound's means leave out of the base, then of a unit of each input.", of.oscillation);
    let full = tall_record("Full", 4, [
        ("discretization", discretization),
        ("base", base),
        ("patterns", patterns::<R, I>(of.patterns, face, to)),
        ("oscillation", oscillation),
        ("outputs", outputs::<R, I>(of.outputs, face, to)),
        ("has_bound", of.has_bound.to_string()),
        ("corners", corners),
        ("start", format!("{:?}", of.start)),
        ("relaxation", format!("Relaxation::{:?}", of.relaxation)),
    ]);
    let _ = write!(
        to.text,
        "
    /// The scene as the kernel takes it.
    pub(super) static FULL: Full<'static, Scalar, Index> = {full};
"
    );
}

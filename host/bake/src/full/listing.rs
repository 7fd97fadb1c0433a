//! The module of statics: one walk over what the kernel borrows writes every array and says where it belongs.

use std::fmt::Write as _;

use signorini_device::full::Full;
use signorini_kernel::Index;

use super::arrays::Baked;
use super::foundation::{base, discretization};
use super::linear::{outputs, patterns};
use crate::module_api::ModuleApi;
use crate::statics::Statics;
use signorini_problem::scalar::Scalar;

/// Names that they may use, with their place in the kernel.
const NAMES: &[(&str, &str)] = &[
    ("CellLoads", "kernel::assembly::CellLoads"),
    ("InitialTableau", "contact::dense::tableau::InitialTableau"),
    ("Neumann", "kernel::mesh::boundary::Neumann"),
    ("Robin", "kernel::mesh::boundary::Robin"),
    ("Cell", "bound::cells::Cell"),
    ("Cells", "bound::cells::Cells"),
    ("Quad", "bound::cells::Quad"),
    ("Triangle", "bound::cells::Triangle"),
    ("Curved", "bound::certificate::Curved"),
    ("Discretization", "bound::certificate::Discretization"),
    ("Metric", "bound::certificate::Metric"),
    ("Stability", "bound::certificate::Stability"),
    ("VertexData", "bound::conforming::VertexData"),
    ("EdgeCounts", "kernel::mesh::edges::EdgeCounts"),
    ("Edges", "kernel::mesh::edges::Edges"),
    ("AmbientShare", "full::AmbientShare"),
    ("Base", "full::Base"),
    ("EdgeTrace", "full::EdgeTrace"),
    ("CurvedPart", "full::CurvedPart"),
    ("CurvedSum", "full::CurvedSum"),
    ("Full", "full::Full"),
    ("Functional", "full::Functional"),
    ("Pattern", "full::Pattern"),
    ("Points", "full::Points"),
    ("TransferPattern", "full::TransferPattern"),
    ("Product", "full::Product"),
    ("Contribution", "full::Contribution"),
    ("Mesh", "kernel::Mesh"),
    ("Relaxation", "kernel::relaxation::Relaxation"),
    ("Factor", "sparse::Factor"),
    ("Factored", "sparse::Factored"),
    ("Spans", "kernel::flux_range::Spans"),
    ("Stiffness", "kernel::stiffness::Stiffness"),
    ("Tensor", "kernel::Tensor"),
];

/// The statics, in a module of their own.
pub(super) fn listing<R: Scalar>(baked: &Baked<R>) -> String {
    listed(baked).module(NAMES, "Index, Scalar")
}

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

fn full<R: Scalar, I: Index>(of: &Full<R, u32>, face: &ModuleApi, to: &mut Statics) {
    let Full {
        discretization: on,
        base: first,
        patterns: added,
        oscillation,
        outputs: read,
        has_bound,
        corners,
        start,
        relaxation,
    } = of;
    let (discretization, base) = (discretization::<R, I>(on, to), base::<R, I>(first, to));
    let corners = to.array::<[I; 2]>(
        "CORNERS",
        "Where contact meets Dirichlet: an end of either edge.",
        "[Index; 2]",
        corners,
    );
    let oscillation = to.array::<R>(
        "OSCILLATION",
        "What the bound's means leave out of the base, then of a unit of each input.",
        "Scalar",
        oscillation,
    );
    let patterns = patterns::<R, I>(added, face, to);
    let outputs = outputs::<R, I>(read, face, to);
    let _ = write!(
        to.text,
        "
    /// The scene as the kernel takes it.
    pub(super) static FULL: Full<'static, Scalar, Index> = Full {{
        discretization: {discretization},
        base: {base},
        patterns: {patterns},
        oscillation: {oscillation},
        outputs: {outputs},
        has_bound: {has_bound},
        corners: {corners},
        start: {start:?},
        relaxation: Relaxation::{relaxation:?},
    }};
"
    );
}

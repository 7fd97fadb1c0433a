//! The module of statics: one walk over what the kernel borrows writes every array and says where it belongs.

use std::fmt::Write as _;

use signorini_bound::cells::{Cells, Quad, Triangle};
use signorini_bound::certificate::{
    Above, Curved, Discretization, ENTRIES, Factor, Metric, POINTS, StoredCell, TransferForms,
};
use signorini_device::full::{Along, Base, CurvedPart, CurvedSum, Full, Product, Storing};
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::storage::IfStoring;
use signorini_kernel::{Index, Tensor};

use super::arrays::Baked;
use super::linear::{outputs, patterns};
use crate::Bakes;
use crate::module_api::ModuleApi;
use crate::room;
use crate::statics::{Statics, lines, record, tall_record};
use crate::text::array;
use signorini_problem::scalar::Scalar;

/// Items of the kernel that they may use.
pub(super) const NAMES: &str = "\
    kernel::assembly::CellLoads kernel::flux_range::Room contact::dense::tableau::InitialTableau \
    kernel::mesh::boundary::Neumann kernel::mesh::boundary::Robin bound::cells::Cell \
    bound::cells::Cells bound::cells::Quad bound::cells::Triangle bound::certificate::Curved \
    bound::certificate::Discretization bound::certificate::Metric bound::certificate::Stability \
    bound::certificate::TransferForms full::Along \
    bound::conforming::VertexData kernel::mesh::edges::EdgeCounts kernel::mesh::edges::Edges \
    kernel::storage::IfStoring kernel::evolution::Carried kernel::evolution::Rates \
    bound::certificate::StoredCell full::Begin full::Storing \
    full::AmbientShare full::Base full::EdgeTrace full::CurvedPart full::CurvedSum full::Full \
    full::Functional full::Pattern full::Points full::TransferPattern full::Product \
    full::Contribution kernel::Mesh kernel::relaxation::Relaxation sparse::Factor \
    sparse::Factored kernel::flux_range::Spans kernel::stiffness::Stiffness kernel::Tensor";

/// Everything in flash.
pub(super) fn listed<R: Bakes>(baked: &Baked<R>) -> Statics {
    match baked.index() {
        "u16" => written::<R, u16>(baked),
        _ => written::<R, u32>(baked),
    }
}

fn written<R: Bakes, I: Index>(baked: &Baked<R>) -> Statics {
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
    let storing = storing(of.storing, to);
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
        ("storing", storing),
    ]);
    let _ = write!(
        to.text,
        "
    /// The scene as the kernel takes it.
    pub(super) static FULL: Full<'static, Scalar, Index> = {full};
"
    );
}

/// What cells store, and the start.
#[rustfmt::skip] // A table.
fn storing<R: Scalar>(of: IfStoring<Storing<R>>, to: &mut Statics) -> String {
    let Some(of) = of.get() else { return "IfStoring::NOTHING".to_owned() };
    let [triangles, quads] = of.masses;
    let triangles = to.numbers("STORED_IN_TRIANGLES", "What each triangle stores by each of its sides: a third of c|T|/dt.", triangles);
    let quads = to.numbers("STORED_IN_QUADS", "What each quad stores by each of its sides: a quarter of c|T|/dt.", quads);
    let (begin, carried) = (&of.begin, of.begin.carried);
    let carried = [("bound", number(carried.bound)), ("before", number(carried.before))];
    let begin = record("Begin", [
        ("u", to.numbers("U_AT_START", "Means of u over the edges at the start.", begin.u)),
        ("vertices", to.numbers("VERTICES_AT_START", "The function of the error bound at the start, at the vertices.", begin.vertices)),
        ("bubbles", to.numbers("BUBBLES_AT_START", "The same on edges of quads.", begin.bubbles)),
        ("openings", to.array::<[R; 2]>("OPENINGS_AT_START", "How far that is above the gap and below it, the mean of each contact edge.", "[Scalar; 2]", begin.openings)),
        ("carried", record("Carried", carried)),
    ]);
    let fields = [
        ("length", format!("{:?}", of.length)),
        ("masses", format!("[{triangles}, {quads}]")),
        ("diagonal", to.numbers("DIAGONAL_IN_STEP", "What each unknown has on the diagonal beyond the element matrices.", of.diagonal)),
        ("cells", to.array::<StoredCell<R>>("STORED_CELLS", "What each cell stores, as the error bound takes it.", "StoredCell<Scalar>", of.cells)),
        ("rates", format!("{:?}", of.rates)),
        ("begin", begin),
        ("is_cold", of.is_cold.to_string()),
    ];
    let storing = record("Storing", fields);
    let _ = write!(to.text, "\n    /// A step in time, and the start of the first one.\n    static STORING: Storing<'static, Scalar> = {storing};\n");
    "IfStoring::of(&STORING)".to_owned()
}

/// A number that may be infinite.
fn number<R: Scalar>(x: R) -> String {
    if x.finite() { format!("{x:?}") } else { "Scalar::INFINITY".to_owned() }
}

/// Mesh, A and ways out.
fn discretization<R: Scalar, I: Index>(of: &Discretization<R, u32>, to: &mut Statics) -> String {
    let fields = [
        ("mesh", mesh::<R, I>(&of.mesh, to)),
        ("edges", edges::<I>(&of.edges, to)),
        ("stiffness", stiffness(&of.stiffness, to)),
        ("cells", cells::<R, I>(&of.cells, to)),
        ("metric", metric(&of.metric, to)),
        ("stability", format!("{:?}", of.stability)),
    ];
    tall_record("Discretization", 8, fields)
}

#[rustfmt::skip] // A table; so below.
fn mesh<R: Scalar, I: Index>(of: &Mesh<R, u32>, to: &mut Statics) -> String {
    let vertices = to.array::<[R; 2]>("VERTICES", "Vertex coordinates, moved into the box [−1, 1]²; only their number is read.", "[Scalar; 2]", of.vertices());
    let triangles = to.array::<[I; 3]>("TRIANGLES", "Vertices of each triangle, counterclockwise.", "[Index; 3]", of.triangles());
    let quads = to.array::<[I; 4]>("QUADS", "Vertices of each quad, counterclockwise.", "[Index; 4]", of.quads());
    format!("Mesh::baked({vertices}, {triangles}, {quads})")
}

#[rustfmt::skip]
fn edges<I: Index>(of: &Edges<u32>, to: &mut Statics) -> String {
    let triangles = to.array::<[I; 3]>("EDGES_OF_TRIANGLES", "The edge of each side of each triangle.", "[Index; 3]", of.of_triangles());
    let quads = to.array::<[I; 4]>("EDGES_OF_QUADS", "The edge of each side of each quad.", "[Index; 4]", of.of_quads());
    let half_edges = of.half_edges();
    // "There is none" is the largest index of either type.
    let text = array(half_edges, 4).replace(&u32::MAX.to_string(), "Index::MAX");
    let half_edges = to.spelt::<[I; 2]>("HALF_EDGES", "The one or two half-edges of each edge: interior, Neumann and Robin edges, then contact, then Dirichlet.", "[Index; 2]", half_edges.len(), &text);
    format!("Edges::baked({triangles}, {quads}, {half_edges}, {:?})", of.counts())
}

#[rustfmt::skip]
fn stiffness<R: Scalar>(of: &Stiffness<R>, to: &mut Statics) -> String {
    record("Stiffness", [
        ("triangles", to.array::<[R; 3]>("STIFFNESS_OF_TRIANGLES", "Element matrices: entries 01, 12, 20.", "[Scalar; 3]", of.triangles)),
        ("quads", to.array::<[R; 6]>("STIFFNESS_OF_QUADS", "Element matrices: entries 01, 02, 03, 12, 13, 23.", "[Scalar; 6]", of.quads)),
    ])
}

#[rustfmt::skip]
fn cells<R: Scalar, I: Index>(of: &Cells<R, u32>, to: &mut Statics) -> String {
    let [of_vertices, of_edges] = of.weights();
    let triangles = to.array::<Triangle<R, I>>("PACKED_TRIANGLES", "Triangles in the order in which the error bound walks over them.", "Triangle<Scalar, Index>", of.triangles());
    let quads = to.array::<Quad<R, I>>("PACKED_QUADS", "Quads in the order in which the error bound walks over them.", "Quad<Scalar, Index>", of.quads());
    let of_vertices = to.numbers("VERTEX_WEIGHTS", "1/Σα of the cells at each vertex.", of_vertices);
    let of_edges = to.numbers("EDGE_WEIGHTS", "1/Σ(1/α) of the cells of each edge, 0 on Neumann and Robin edges.", of_edges);
    let order = to.array::<I>("ORDER", "The cells from roots to leaves of the forest.", "Index", of.order());
    format!("Cells::baked({triangles}, {quads}, {of_vertices}, {of_edges}, {order})")
}

#[rustfmt::skip]
fn metric<R: Scalar>(of: &Metric<R>, to: &mut Statics) -> String {
    record("Metric", [
        ("at_points", to.array::<[Tensor<R>; POINTS * POINTS]>("METRIC", "A in reference coordinates at 64 points of the cells in which it varies.", "[Tensor<Scalar>; 64]", of.at_points)),
        ("factors", to.array::<Factor<R>>("METRIC_INTEGRALS", "Triangular factors of the integrals over cells whose 64 points do not resolve A.", &format!("[Scalar; {ENTRIES}]"), of.factors)),
        ("above", to.array::<Above<R>>("METRIC_ABOVE", "What A has above these points and factors.", "[Scalar; 2]", of.above)),
        ("missed", format!("{:?}", of.missed)),
        ("place", to.array::<u32>("METRIC_PLACE", "Where each cell stands in `METRIC` and `METRIC_INTEGRALS` behind it; beyond both where A is constant.", "u32", of.place)),
        ("distortions", to.array::<[R; 2]>("QUAD_DISTORTIONS", "By how much each quad is no parallelogram.", "[Scalar; 2]", of.distortions)),
    ])
}

/// Loads and boundary data where all inputs are 0.
#[rustfmt::skip]
fn base<R: Scalar, I: Index>(of: &Base<R, u32>, to: &mut Statics) -> String {
    let loads = record("CellLoads", [
        ("triangles", to.numbers("SOURCE_OF_TRIANGLES", "∫f of each triangle.", of.loads.triangles)),
        ("quads", to.numbers("SOURCE_OF_QUADS", "∫f of each quad.", of.loads.quads)),
    ]);
    let neumann = to.array::<Neumann<R, I>>("NEUMANN", "∫g of the edges with a given flux.", "Neumann<Scalar, Index>", of.neumann);
    let robin = to.array::<Robin<R, I>>("ROBIN", "Transfer laws: ∫h and ∫h u_ext.", "Robin<Scalar, Index>", of.robin);
    let points = to.array::<[[R; 2]; 8]>("TRANSFER", "∫h and u_ext at 8 points of each transfer edge.", "[[Scalar; 2]; 8]", of.transfer.points());
    let transfer = match &of.transfer {
        Along::Seen(_) => format!("Along::Seen({points})"),
        Along::Unseen((_, forms)) => format!("Along::Unseen(&({points}, {}))", forms_written::<R, I>(forms, to)),
    };
    let contact_flux = to.numbers("CONTACT_FLUX", "∫q of each contact edge.", of.contact_flux);
    let spans = match of.spans.lengths() {
        [] => "Spans::UNLIMITED".to_owned(),
        lengths => {
            let text = array(lengths, 8);
            let lengths = to.spelt::<R>("SPANS", "∫(limit − flux) of each contact edge; −∞ where there is no least flux.", "Scalar", lengths.len(), &text);
            format!("Spans::baked({lengths}, {:?})", of.spans.excess())
        }
    };
    let gap = to.numbers("GAP", "Mean of ψ on each contact edge.", of.gap);
    let gap_ends = to.array::<[R; 2]>("GAP_ENDS", "ψ at the ends of each contact edge.", "[Scalar; 2]", of.ends.gap);
    let dirichlet = to.numbers("DIRICHLET", "Mean of u_D on each Dirichlet edge.", of.dirichlet);
    let given = to.array::<[R; 2]>("DIRICHLET_ENDS", "u_D at the ends of each Dirichlet edge.", "[Scalar; 2]", of.ends.given);
    tall_record("Base", 8, [
        ("loads", loads),
        ("neumann", neumann),
        ("robin", robin),
        ("contact_flux", contact_flux),
        ("spans", spans),
        ("rooms", room::written(of.rooms, to)),
        ("settling", format!("{:?}", of.settling)),
        ("gap", gap),
        ("dirichlet", dirichlet),
        ("ends", record("VertexData", [("gap", gap_ends), ("given", given)])),
        ("curved", to.array::<Curved<R, I>>("CURVED", "Edges on which ψ or u_D is not affine.", "Curved<Scalar, Index>", of.curved)),
        ("curved_sums", lines(of.curved_sums.iter().enumerate().map(|(at, of)| curved_sum(at, of, to)))),
        ("transfer", transfer),
    ])
}

#[rustfmt::skip]
fn forms_written<R: Scalar, I: Index>(of: &TransferForms<R, u32>, to: &mut Statics) -> String {
    record("TransferForms", [
        ("laws", to.array::<I>("UNSEEN_TRANSFER", "Transfer laws whose points do not see h.", "Index", of.laws)),
        ("inputs", to.array::<u16>("INPUTS_OF_AMBIENT", "The inputs that change u_ext.", "u16", of.inputs)),
        ("values", "&[]".to_owned()),
        ("factors", to.numbers("TRANSFER_FACTORS", "Triangular factors of ∫(τ·n + h(s − u_ext))²/h.", of.factors)),
    ])
}

#[rustfmt::skip]
fn curved_sum<R: Scalar>(at: usize, of: &CurvedSum<R, u32>, to: &mut Statics) -> String {
    record("CurvedSum", [
        ("edge", of.edge.to_string()),
        ("parts", to.array::<CurvedPart<R>>(&format!("CURVED_{at}_PARTS"), "What base and inputs add to a curved edge.", "CurvedPart<Scalar>", of.parts)),
        ("energy", to.array::<Product<R>>(&format!("CURVED_{at}_ENERGY"), "Its energy, a quadratic form in the inputs.", "Product<Scalar>", of.energy)),
    ])
}

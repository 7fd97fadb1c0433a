//! The statics of mesh and data without inputs, written by the structs that borrow them.

use signorini_bound::cells::{Cells, Quad, Triangle};
use signorini_bound::certificate::{Curved, Discretization, Metric, POINTS, Stability};
use signorini_bound::conforming::VertexData;
use signorini_device::full::{Base, CurvedPart, CurvedSum, Product};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Index, Tensor};

use crate::statics::{Statics, lines};
use crate::text::array;
use signorini_problem::scalar::Scalar;

/// Mesh, A and ways out.
pub(super) fn discretization<R: Scalar, I: Index>(
    of: &Discretization<R, u32>,
    to: &mut Statics,
) -> String {
    let Discretization { mesh, edges, stiffness, cells, metric, stability } = of;
    let (mesh, edges) = (self::mesh::<R, I>(mesh, to), self::edges::<I>(edges, to));
    let (stiffness, cells) = (self::stiffness(stiffness, to), self::cells::<R, I>(cells, to));
    let metric = self::metric(metric, to);
    let Stability { largest, weighed, oblique } = stability;
    format!(
        "Discretization {{
            mesh: {mesh},
            edges: {edges},
            stiffness: {stiffness},
            cells: {cells},
            metric: {metric},
            stability: Stability {{ largest: {largest:?}, weighed: {weighed:?}, oblique: {oblique:?} }},
        }}"
    )
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
    let Stiffness { triangles, quads } = of;
    let triangles = to.array::<[R; 3]>("STIFFNESS_OF_TRIANGLES", "Element matrices: entries 01, 12, 20.", "[Scalar; 3]", triangles);
    let quads = to.array::<[R; 6]>("STIFFNESS_OF_QUADS", "Element matrices: entries 01, 02, 03, 12, 13, 23.", "[Scalar; 6]", quads);
    format!("Stiffness {{ triangles: {triangles}, quads: {quads} }}")
}

#[rustfmt::skip]
fn cells<R: Scalar, I: Index>(of: &Cells<R, u32>, to: &mut Statics) -> String {
    let [of_vertices, of_edges] = of.weights();
    let triangles = to.array::<Triangle<R, I>>("PACKED_TRIANGLES", "Triangles in the order in which the error bound walks over them.", "Triangle<Scalar, Index>", of.triangles());
    let quads = to.array::<Quad<R, I>>("PACKED_QUADS", "Quads in the order in which the error bound walks over them.", "Quad<Scalar, Index>", of.quads());
    let of_vertices = to.array::<R>("VERTEX_WEIGHTS", "1/Σα of the cells at each vertex.", "Scalar", of_vertices);
    let of_edges = to.array::<R>("EDGE_WEIGHTS", "1/Σ(1/α) of the cells of each edge, 0 on Neumann and Robin edges.", "Scalar", of_edges);
    let order = to.array::<I>("ORDER", "The cells from roots to leaves of the forest.", "Index", of.order());
    format!("Cells::baked({triangles}, {quads}, {of_vertices}, {of_edges}, {order})")
}

#[rustfmt::skip]
fn metric<R: Scalar>(of: &Metric<R>, to: &mut Statics) -> String {
    let Metric { at_points, place, distortions } = of;
    let at_points = to.array::<[Tensor<R>; POINTS * POINTS]>("METRIC", "A in reference coordinates at 64 points of the cells in which it varies.", "[Tensor<Scalar>; 64]", at_points);
    let place = to.array::<u32>("METRIC_PLACE", "Where each cell stands in `METRIC`; beyond its end where A is constant.", "u32", place);
    let distortions = to.array::<[R; 2]>("QUAD_DISTORTIONS", "By how much each quad is no parallelogram.", "[Scalar; 2]", distortions);
    format!("Metric {{ at_points: {at_points}, place: {place}, distortions: {distortions} }}")
}

/// Loads and boundary data where all inputs are 0.
#[rustfmt::skip]
pub(super) fn base<R: Scalar, I: Index>(of: &Base<R, u32>, to: &mut Statics) -> String {
    let Base { loads, neumann, robin, contact_flux, spans, gap, dirichlet, ends, curved, curved_sums, transfer } = of;
    let CellLoads { triangles, quads } = loads;
    let VertexData { gap: gap_ends, given } = ends;
    let triangles = to.array::<R>("SOURCE_OF_TRIANGLES", "∫f of each triangle.", "Scalar", triangles);
    let quads = to.array::<R>("SOURCE_OF_QUADS", "∫f of each quad.", "Scalar", quads);
    let neumann = to.array::<Neumann<R, I>>("NEUMANN", "∫g of the edges with a given flux.", "Neumann<Scalar, Index>", neumann);
    let robin = to.array::<Robin<R, I>>("ROBIN", "Transfer laws: ∫h and ∫h u_ext.", "Robin<Scalar, Index>", robin);
    let transfer = to.array::<[[R; 2]; 8]>("TRANSFER", "∫h and u_ext at 8 points of each transfer edge.", "[[Scalar; 2]; 8]", transfer);
    let contact_flux = to.array::<R>("CONTACT_FLUX", "∫q of each contact edge.", "Scalar", contact_flux);
    let spans = match spans.lengths() {
        [] => "Spans::UNLIMITED".to_owned(),
        lengths => {
            let text = array(lengths, 8);
            let lengths = to.spelt::<R>("SPANS", "∫(limit − flux) of each contact edge; −∞ where there is no least flux.", "Scalar", lengths.len(), &text);
            format!("Spans::baked({lengths}, {:?})", spans.excess())
        }
    };
    let gap = to.array::<R>("GAP", "Mean of ψ on each contact edge.", "Scalar", gap);
    let gap_ends = to.array::<[R; 2]>("GAP_ENDS", "ψ at the ends of each contact edge.", "[Scalar; 2]", gap_ends);
    let dirichlet = to.array::<R>("DIRICHLET", "Mean of u_D on each Dirichlet edge.", "Scalar", dirichlet);
    let given = to.array::<[R; 2]>("DIRICHLET_ENDS", "u_D at the ends of each Dirichlet edge.", "[Scalar; 2]", given);
    let curved = to.array::<Curved<R, I>>("CURVED", "Edges on which ψ or u_D is not affine.", "Curved<Scalar, Index>", curved);
    let curved_sums = self::curved_sums(curved_sums, to);
    format!(
        "Base {{
            loads: CellLoads {{ triangles: {triangles}, quads: {quads} }},
            neumann: {neumann},
            robin: {robin},
            contact_flux: {contact_flux},
            spans: {spans},
            gap: {gap},
            dirichlet: {dirichlet},
            ends: VertexData {{ gap: {gap_ends}, given: {given} }},
            curved: {curved},
            curved_sums: {curved_sums},
            transfer: {transfer},
        }}"
    )
}

fn curved_sums<R: Scalar>(all: &[CurvedSum<R, u32>], to: &mut Statics) -> String {
    let sums = all.iter().enumerate().map(|(at, CurvedSum { edge, parts, energy })| {
        let parts = to.array::<CurvedPart<R>>(
            &format!("CURVED_{at}_PARTS"),
            "What base and inputs add to a curved edge.",
            "CurvedPart<Scalar>",
            parts,
        );
        let energy = to.array::<Product<R>>(
            &format!("CURVED_{at}_ENERGY"),
            "Its energy, a quadratic form in the inputs.",
            "Product<Scalar>",
            energy,
        );
        format!("CurvedSum {{ edge: {edge}, parts: {parts}, energy: {energy} }}")
    });
    lines(&sums.collect::<Vec<_>>())
}

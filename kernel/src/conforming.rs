//! A continuous, admissible function near u_h: the s of the error bound, by its vertex values.
//!
//! u_h jumps across edges. At each vertex its values from the cells around are averaged, weighted by
//! α = ½ tr A: without weights a jump of 10⁴ in A costs a factor of 12 in the bound. Then
//! ```text
//!   s = ψ              at a vertex of an active contact edge (u = ψ there),
//!   s = max(ψ, mean)   at the other vertices of contact edges,
//!   s = u_D            on D, which wins where both meet.
//! ```
//! With the chord of ψ for the gap and that of u_D for the boundary value, s is admissible; what lies
//! between a curved gap and its chord is another term of the bound.

use crate::contact::is_active;
use crate::edges::Edges;
use crate::element::{crouzeix_raviart, rannacher_turek};
use crate::error::{Array, Error, same_length};
use crate::index::{Index, read, write};
use crate::mesh::Mesh;
use crate::real::Real;

/// Boundary data at the two ends of each edge, in the direction of the edge (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct VertexData<'a, R> {
    /// ψ, one pair a contact edge.
    pub gap: &'a [[R; 2]],
    /// u_D, one pair a Dirichlet edge.
    pub given: &'a [[R; 2]],
}

/// Memory for [`fill`]; both arrays have one entry a vertex.
#[derive(Debug)]
pub struct VertexBuffers<'a, R> {
    /// Becomes s.
    pub values: &'a mut [R],
    /// Scratch.
    pub weights: &'a mut [R],
}

/// Fills in s; `alpha` is positive, one a cell, triangles first. Returns by how much u_D lies below ψ
/// where D and C meet, at most 0 for admissible data up to rounding.
///
/// # Errors
/// Arrays of the wrong length.
pub fn fill<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    alpha: &[R],
    u: &[R],
    lower: &[R],
    data: VertexData<R>,
    buffers: VertexBuffers<R>,
) -> Result<R, Error> {
    let VertexBuffers { values, weights } = buffers;
    let counts = edges.counts();
    same_length(Array::Vertices, values.len(), mesh.vertices().len())?;
    same_length(Array::Vertices, weights.len(), values.len())?;
    same_length(Array::Triangles, mesh.triangles().len(), edges.of_triangles().len())?;
    same_length(Array::Quads, mesh.quads().len(), edges.of_quads().len())?;
    same_length(Array::Coefficients, alpha.len(), mesh.cells())?;
    same_length(Array::Unknowns, u.len(), counts.edges())?;
    same_length(Array::LowerBounds, lower.len(), counts.contact)?;
    same_length(Array::Contact, data.gap.len(), counts.contact)?;
    same_length(Array::Dirichlet, data.given.len(), counts.dirichlet)?;
    average(mesh, edges, alpha, u, values, weights);

    let on_contact = || data.gap.iter().enumerate().map(|(at, gap)| (at, counts.free + at, gap));
    for (at, edge, gap) in on_contact() {
        if is_active(counts, lower, u, at) {
            each_end(mesh, edges, edge, gap, |vertex, psi| write(values, vertex, psi));
        }
    }
    for (_, edge, gap) in on_contact() {
        each_end(mesh, edges, edge, gap, |vertex, psi| {
            let lifted = read(values, vertex).or_larger(psi);
            write(values, vertex, lifted);
        });
    }
    for (at, given) in data.given.iter().enumerate() {
        let edge = counts.unknowns() + at;
        each_end(mesh, edges, edge, given, |vertex, value| write(values, vertex, value));
    }
    let mut below = R::ZERO;
    for (_, edge, gap) in on_contact() {
        each_end(mesh, edges, edge, gap, |vertex, psi| {
            below = below.or_larger(psi - read(values, vertex));
        });
    }
    Ok(below)
}

/// The weighted means of u_h at the vertices; 0 at a vertex without cells.
fn average<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    alpha: &[R],
    u: &[R],
    values: &mut [R],
    weights: &mut [R],
) {
    values.fill(R::ZERO);
    weights.fill(R::ZERO);
    let mut add = |vertices: &[I], at_vertices: &[R], alpha: R| {
        for (vertex, &value) in vertices.iter().zip(at_vertices) {
            let sum = read(values, vertex.at()) + alpha * value;
            write(values, vertex.at(), sum);
            let weight = read(weights, vertex.at()) + alpha;
            write(weights, vertex.at(), weight);
        }
    };
    let triangles = mesh.triangles().iter().zip(edges.of_triangles());
    for ((vertices, sides), &alpha) in triangles.zip(alpha) {
        let means = sides.map(|edge| read(u, edge.at()));
        add(vertices, &crouzeix_raviart::at_vertices(&means), alpha);
    }
    let quads = mesh.quads().iter().zip(edges.of_quads());
    for ((vertices, sides), &alpha) in quads.zip(alpha.iter().skip(mesh.triangles().len())) {
        let means = sides.map(|edge| read(u, edge.at()));
        add(vertices, &rannacher_turek::at_vertices(&means), alpha);
    }
    for (value, &weight) in values.iter_mut().zip(weights.iter()) {
        if weight > R::ZERO {
            *value /= weight;
        }
    }
}

fn each_end<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    edge: usize,
    data: &[R; 2],
    mut each: impl FnMut(usize, R),
) {
    for (vertex, &value) in edges.endpoints(mesh, edge).iter().zip(data) {
        each(vertex.at(), value);
    }
}

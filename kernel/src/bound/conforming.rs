//! A continuous, admissible function near u_h: the s of the error bound, by its vertex values.
//!
//! u_h jumps across edges. At each vertex its values from the cells around are averaged
//! ([`crate::bound::averages`]). Then
//! ```text
//!   s = ψ              at a vertex of an active contact edge (u = ψ there),
//!   s = max(ψ, mean)   at the other vertices of contact edges,
//!   s = u_D            on D, which wins where both meet.
//! ```
//! With the chord of ψ for the gap and that of u_D for the boundary value, s is admissible; what lies
//! between a curved gap and its chord is another term of the bound.
//!
//! On triangles s is linear. On quads the bilinear s is the weak part of the bound, so every edge
//! between quads gets a bubble 4t(1 − t) d that gives s the mean of u_h there:
//! ```text
//!   d = 3/2 (u_E − mean of s)              inside, on N and on R;   0 on D and on active edges,
//!   d = 3/2 (u_E − ψ_E − (e_a + e_b)/2)    elsewhere on C, e = s − ψ ≥ 0 at the ends a and b,
//!       but not below −(√e_a + √e_b)²/4, so that s ≥ ψ stays true inside the edge.
//! ```

use crate::discrete::contact::is_active;
use crate::discrete::law::Law;
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::features;
use crate::index::{Index, read, write};
use crate::mesh::Mesh;
use crate::mesh::edges::{Block, Edges};
use crate::real::Real;

/// Boundary data at the two ends of each edge, in the direction of the edge (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct VertexData<'a, R> {
    /// ψ, one pair a contact edge.
    pub gap: &'a [[R; 2]],
    /// u_D, one pair a Dirichlet edge.
    pub given: &'a [[R; 2]],
}

impl<R: Real> VertexData<'_, R> {
    /// How far u_D may lie below ψ where D and C meet and still be rounding: 64 ε of the largest value.
    #[inline(never)]
    pub(crate) fn slack(&self) -> R {
        let values = self.gap.as_flattened().iter().chain(self.given.as_flattened());
        let largest = values.fold(R::ZERO, |most, value| most.or_larger(value.magnitude()));
        R::from_count(64) * R::EPSILON * largest
    }
}

/// Imposes what the boundary asks on `values`, the means at the vertices. Returns by how much u_D lies
/// below ψ where D and C meet, at most 0 for admissible data up to rounding.
///
/// # Errors
/// Arrays of the wrong length.
pub fn impose<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    u: &[R],
    law: Law<R>,
    data: VertexData<R>,
    values: &mut [R],
) -> Result<R, Error> {
    let counts = edges.counts();
    same_length(Array::Vertices, values.len(), mesh.vertices().len())?;
    same_length(Array::Unknowns, u.len(), counts.edges())?;
    law.check_length(counts)?;
    same_length(Array::Contact, data.gap.len(), counts.contact)?;
    same_length(Array::Dirichlet, data.given.len(), counts.dirichlet)?;
    let gap = if features::CONTACT { data.gap } else { &[] };
    let on_contact = || gap.iter().enumerate().map(|(at, gap)| (at, counts.free + at, gap));
    for (at, edge, gap) in on_contact() {
        if is_active(counts, law, u, at) {
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

/// Fills in d for every edge, 0 where a cell of the edge is a triangle; `values` as from [`impose`].
/// Where the mesh has no quads, `bubbles` may be empty.
///
/// # Errors
/// Arrays of the wrong length.
pub fn bubbles<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    u: &[R],
    law: Law<R>,
    data: VertexData<R>,
    values: &[R],
    bubbles: &mut [R],
) -> Result<(), Error> {
    let counts = edges.counts();
    if !features::QUADS || mesh.quads().is_empty() {
        bubbles.fill(R::ZERO);
        return same_length_or_empty(Array::Scratch, bubbles.len(), counts.edges());
    }
    same_length(Array::Scratch, bubbles.len(), counts.edges())?;
    same_length(Array::Unknowns, u.len(), counts.edges())?;
    law.check_length(counts)?;
    same_length(Array::Contact, data.gap.len(), counts.contact)?;
    let triangles = 3 * mesh.triangles().len();
    for (at, (pair, bubble)) in edges.half_edges().iter().zip(bubbles).enumerate() {
        let of_quads = pair.iter().all(|half| half.at() >= triangles);
        let ends = edges.endpoints(mesh, at).map(|vertex| read(values, vertex.at()));
        *bubble = match counts.block(at) {
            Block::Free if of_quads => missing(read(u, at), ends),
            Block::Contact if of_quads => {
                let contact = at - counts.free;
                let [gap_a, gap_b] = read(data.gap, contact);
                let opening = law.on(contact).opening(read(u, at));
                lift(opening, [ends[0] - gap_a, ends[1] - gap_b])
            }
            _ => R::ZERO,
        };
    }
    Ok(())
}

/// The d that gives a linear function with these end values the mean `mean`.
fn missing<R: Real>(mean: R, [a, b]: [R; 2]) -> R {
    (R::ONE + R::HALF) * (mean - R::HALF * (a + b))
}

/// The same for an excess that must stay ≥ 0; `opening` is 0 on active edges.
fn lift<R: Real>(opening: R, excess: [R; 2]) -> R {
    if !(opening > R::ZERO) {
        return R::ZERO;
    }
    let [a, b] = excess.map(|e| e.or_larger(R::ZERO));
    let roots = a + b + R::TWO * (a * b).rounded_sqrt();
    // A shade above the limit, for the rounding of all this.
    let limit = -R::QUARTER * roots * (R::ONE - R::from_count(8) * R::EPSILON);
    missing(opening, [a, b]).or_larger(limit)
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

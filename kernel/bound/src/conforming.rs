//! A continuous, admissible function near u_h: the s of the error bound, by its vertex values.
//!
//! u_h jumps across edges. At each vertex its values from the cells around are averaged
//! ([`crate::averages`]). Then
//! ```text
//!   s = ψ              at a vertex of an active contact edge (u = ψ there),
//!   s = max(ψ, mean)   at the other vertices of contact edges,
//!   s = u_D            on D, which wins where both meet.
//! ```
//! Where the flux of a contact edge has two finite ends, s may be on either side of ψ, and pays for the side that u is not
//! on (`relax_to_gap`).
//!
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

use signorini_kernel::contact::is_active;
use signorini_kernel::error::{Array, Error, same_length, same_length_or_empty};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::edges::{Block, Edges};
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Mesh, Real, features};

/// Boundary data at the two ends of each edge, in the direction of the edge (borrowed).
#[derive(Debug, Clone, Copy, Default)]
pub struct VertexData<'a, R> {
    /// ψ, one pair a contact edge.
    pub gap: &'a [[R; 2]],
    /// u_D, one pair a Dirichlet edge.
    pub given: &'a [[R; 2]],
}

impl<R: Real> VertexData<'_, R> {
    /// How far u_D may lie below ψ where D and C meet and still be rounding: 64 ε of the largest value.
    #[inline(never)]
    pub fn slack(&self) -> R {
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
    for (at, edge, gap) in on_contact() {
        each_end(mesh, edges, edge, gap, |vertex, psi| {
            write(values, vertex, law.on(at).nearest_at(read(values, vertex), psi));
        });
    }
    for (at, given) in data.given.iter().enumerate() {
        let edge = counts.unknowns() + at;
        each_end(mesh, edges, edge, given, |vertex, value| write(values, vertex, value));
    }
    let mut below = R::ZERO;
    for (at, edge, gap) in on_contact() {
        each_end(mesh, edges, edge, gap, |vertex, psi| {
            below = below.or_larger(law.on(at).depth_at(read(values, vertex), psi));
        });
    }
    Ok(below)
}

/// Where both ends of an edge's flux are finite, s with values on the other side of ψ than u pays (hi − lo) for each unit of
/// them, and ½K for its square: `values`, the means at the vertices, become those that pay least of both.
/// ```text
///   u > ψ:  s ← min(ψ, s + (hi − lo)/K)  where s < ψ        u < ψ:  s ← max(ψ, s − (hi − lo)/K)  where s > ψ
/// ```
/// To be called before [`impose`]. For huge limits that is the law without one, for lo = hi nothing is changed. Where hi − lo
/// varies along edges, s is put on the side of u: its price is known in the mean alone.
pub(crate) fn relax_to_gap<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    u: &[R],
    law: Law<R>,
    gap: &[[R; 2]],
    values: &mut [R],
) {
    let free = edges.counts().free;
    let varies = law.spans().excess() > R::ZERO;
    for (at, (gap, law)) in gap.iter().zip(law.edges()).enumerate() {
        let opening = law.opening(read(u, free + at));
        if !law.has_both_sides() || opening == R::ZERO {
            continue;
        }
        let reach = match varies {
            true => R::INFINITY,
            false => law.reach(stiffness.of_boundary_edge(edges, free + at)),
        };
        each_end(mesh, edges, free + at, gap, |vertex, psi| {
            let excess = read(values, vertex) - psi;
            if opening > R::ZERO && excess < R::ZERO {
                write(values, vertex, psi + (excess + reach).or_smaller(R::ZERO));
            } else if opening < R::ZERO && excess > R::ZERO {
                write(values, vertex, psi + (excess - reach).or_larger(R::ZERO));
            }
        });
    }
}

/// Fills in d for every edge, 0 where a cell of the edge is a triangle; `values` as from [`impose`].
/// Where the mesh has no quads, `bubbles` may be empty.
///
/// # Errors
/// Arrays of the wrong length.
#[inline(always)]
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
                let excess = [ends[0] - gap_a, ends[1] - gap_b];
                if features::LIMITED && opening < R::ZERO {
                    -lift(-opening, excess.map(|e| -e))
                } else {
                    lift(opening, excess)
                }
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

/// Lifts an excess that must stay ≥ 0; `opening` is 0 on active edges. No lift where s crosses the gap.
fn lift<R: Real>(opening: R, excess: [R; 2]) -> R {
    let crosses = features::LIMITED && !(excess[0] >= R::ZERO && excess[1] >= R::ZERO);
    if !(opening > R::ZERO) || crosses {
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

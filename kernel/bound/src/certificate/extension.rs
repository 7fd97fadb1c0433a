//! Extension of s into a boundary cell where ψ or u_D leaves its chord, and its part of the bound.

use super::parts::Parts;
use super::{Continuous, Discretization, LoadCase};
use signorini_kernel::Real;
use signorini_kernel::element::{crouzeix_raviart, rannacher_turek};
use signorini_kernel::index::{Index, read};
use signorini_kernel::mesh::edges::Side;

/// An edge on which ψ or u_D differs from the chord w of its end values by more than rounding.
///
/// In the edge's cell s gets the extension v = (1 − η) w(t), with t along the edge and η away from it:
/// 0 on all other sides. Its integrals hold for this w and grow with it, `energy` with its square.
///
/// s is admissible without it where it is farther from the chord of ψ than `peak` at both ends of a contact edge. It is left
/// out there: on open edges it would only take s away from u.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Curved<R, I> {
    /// The edge, on C or D.
    pub edge: I,
    /// ∫₀¹ w dt
    pub mean: R,
    /// At least |w| all along the edge. Infinite where s has the extension in any case: on D, in a quad, whose bubble makes up for
    /// it, and where more edges of the cell are curved, since `energy` counts their products.
    pub peak: R,
    /// ∫_T A∇v·∇v, and 2∫_T A∇v·∇v' for an earlier curved edge of the same cell.
    pub energy: R,
    /// ∫_T A∇v·∇N for the (bi)linear function N of each vertex of the cell and then, on quads, for the
    /// bubble of each side.
    pub coupling: [R; 8],
}

/// Whether s, which is so far above the chord of ψ at the ends of a contact edge, is on one side of ψ all along it, ψ being
/// nowhere farther from its chord than `peak`.
pub fn is_clear<R: Real>([a, b]: [R; 2], peak: R) -> bool {
    (a >= peak && b >= peak) || (a <= -peak && b <= -peak)
}

/// s − u_h or s in a boundary cell, by the functions of [`Curved::coupling`].
pub(super) struct InCell<R> {
    values: [R; 8],
    /// ∫_T f times κ.
    source: R,
}

impl<R: Real> InCell<R> {
    fn triangle(corners: [R; 3], load: R) -> Self {
        let ([a, b, c], zero) = (corners, R::ZERO);
        Self {
            values: [zero, b - a, c - a, zero, zero, zero, zero, zero],
            source: R::TWO * R::THIRD * load,
        }
    }

    fn quad([a, b, c, d]: [R; 4], [e, f, g, h]: [R; 4], load: R) -> Self {
        Self { values: [R::ZERO, b - a, c - a, d - a, e, f, g, h], source: R::HALF * load }
    }

    /// Its product with the extension, and the size of what that was summed from.
    fn product(&self, curved: &Curved<R, impl Index>) -> (R, R) {
        self.values.iter().zip(curved.coupling).fold(
            (R::ZERO, R::ZERO),
            |(sum, terms), (&value, coupling)| {
                (sum + value * coupling, terms + (value * coupling).magnitude())
            },
        )
    }
}

/// s in the cell of a curved edge.
pub(super) fn of_s<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    s: Continuous<R>,
    edge: usize,
) -> InCell<R> {
    let (edges, loads) = (&discretization.edges, given.loads);
    match edges.first_side(edge) {
        Side::Triangle(at, _) => {
            let corners = s.at(&read(discretization.mesh.triangles(), at));
            InCell::triangle(corners, read(loads.triangles, at))
        }
        Side::Quad(at, _) => {
            let corners = s.at(&read(discretization.mesh.quads(), at));
            let bubbles = s.on(&read(edges.of_quads(), at));
            InCell::quad(corners, bubbles, read(loads.quads, at))
        }
    }
}

/// u_h there; nothing on a distorted quad, where it is no sum of these functions. On other quads
/// X² − Y² = (b₁ + b₃ − b₀ − b₂)/4 with the bubbles b of the sides.
pub(super) fn of_means<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    u: &[R],
    edge: usize,
) -> Option<InCell<R>> {
    let edges = &discretization.edges;
    match edges.first_side(edge) {
        Side::Triangle(at, _) => {
            let means = read(edges.of_triangles(), at).map(|edge| read(u, edge.at()));
            Some(InCell::triangle(crouzeix_raviart::at_vertices(&means), R::ZERO))
        }
        Side::Quad(at, _) => {
            let means = read(edges.of_quads(), at).map(|edge| read(u, edge.at()));
            let [u0, u1, u2, u3] = means;
            let arch = R::THREE * R::HALF * R::QUARTER * ((u1 - u0) + (u3 - u2));
            let corners = rannacher_turek::at_vertices(&means);
            let is_distorted = discretization.metric.distortion(at) != [R::ZERO; 2];
            (!is_distorted).then(|| InCell::quad(corners, [-arch, arch, -arch, arch], R::ZERO))
        }
    }
}

/// The extension's energy and twice its product with A∇s − τ:
/// ```text
///   ∫_T ∇v·τ = w̄ (τ_E + κ∫f),      κ = 2/3 on triangles, 1/2 on quads.
/// ```
/// Returns the term and the size of what it was summed from.
pub(super) fn extension<R: Real, I: Index>(
    s: &InCell<R>,
    tau: &[R],
    curved: &Curved<R, I>,
) -> (R, R) {
    let (product, terms) = s.product(curved);
    let flux = curved.mean * (read(tau, curved.edge.at()) + s.source);
    let size = R::TWO * (terms + flux.magnitude()) + curved.energy.magnitude();
    (R::TWO * (product - flux) + curved.energy, size)
}

/// Adds the terms of ‖A^½∇(s + v − u_h)‖² to its sums.
pub(super) fn jump<R: Real, I: Index>(
    s: &InCell<R>,
    u: Option<&InCell<R>>,
    curved: &Curved<R, I>,
    parts: &mut Parts<R>,
) {
    let Some(u) = u else {
        parts.lifted += curved.energy;
        return;
    };
    let ((of_s, terms_of_s), (of_u, terms_of_u)) = (s.product(curved), u.product(curved));
    parts.nonconforming += R::TWO * (of_s - of_u) + curved.energy;
    let size = R::TWO * (terms_of_s + terms_of_u) + curved.energy.magnitude();
    parts.direct_of_u += R::from_count(8) * R::EPSILON * size;
}

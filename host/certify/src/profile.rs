//! How the flux that f makes varies along sides between quads: what τ misses there, with its mean alone.
//!
//! ```text
//!   f = φ″(k·x):   u = −φ/(k·Ak),   σ = −φ′ Ak/(k·Ak),   (τ − σ)·n|E| = (∇f·e)(∇f·A ê)/(∇f·A∇f) (∫₀ᵗ f − its mean)
//! ```
//! for e from one end of an edge to the other and ê = |E| n. Any such profile, one for both cells of an edge, is as good as 0 for the
//! bound: what leaves one cell enters the other; on D s − u is 0, and a weight of an output is constant along each edge. This one is the right one for waves, in whatever
//! direction they run through the mesh.

use signorini_problem::quadrature::gauss;
use signorini_problem::{EdgeKind, Problem, Sum};

use super::conductivity::{Conductivity, apply, dot};
use super::legendre::{DEGREES, legendre};
use super::stretch::is_even;

/// Factors of Legendre's polynomials in |E| times a flux without a mean along a side, outward, in the direction of that side.
pub type Profile = [f64; DEGREES];

/// The profiles of a cell's sides; those of a triangle are 0.
pub type Sides = [Profile; 4];

/// Nothing leaves through any side.
pub const NO_SIDES: Sides = [[0.0; DEGREES]; 4];

/// Gauss points on an edge.
const POINTS: usize = 16;

/// The profiles of all edges, in the direction of each; nothing where all are 0.
pub fn profiles(problem: &Problem, f: &Sum) -> Vec<Profile> {
    let quads = problem.mesh.triangles.len()..problem.cells();
    if f.constant().is_some() || quads.is_empty() {
        return Vec::new();
    }
    let is_open: Vec<bool> =
        (0..problem.cells()).map(|at| quads.contains(&at) && !is_even(problem, at)).collect();
    let of_edge = |edge: usize| {
        let is_open = match problem.kinds[edge] {
            EdgeKind::Interior => problem.topology.cells_of(edge).iter().all(|&at| is_open[at]),
            EdgeKind::Dirichlet => is_open[problem.topology.first_side(edge).0],
            EdgeKind::Neumann | EdgeKind::Robin | EdgeKind::Contact => false,
        };
        if is_open { profile(problem, edge, f) } else { [0.0; DEGREES] }
    };
    let all: Vec<_> = (0..problem.kinds.len()).map(of_edge).collect();
    let is_zero = all.as_flattened().iter().all(|&factor| factor == 0.0);
    if is_zero { Vec::new() } else { all }
}

/// The profiles of the sides of a cell.
pub fn of_cell(problem: &Problem, at: usize, profiles: &[Profile]) -> Sides {
    let mut sides = NO_SIDES;
    for (side, (&edge, own)) in problem.topology.edges_of(at).iter().zip(&mut sides).enumerate() {
        let Some(profile) = profiles.get(edge as usize) else { continue };
        // Backwards t is 1 − t, and out is in.
        let is_along = problem.topology.first_side(edge as usize) == (at, side);
        let sign = |n: usize| if is_along || n % 2 == 1 { 1.0 } else { -1.0 };
        *own = std::array::from_fn(|n| sign(n) * profile[n]);
    }
    sides
}

fn profile(problem: &Problem, edge: usize, f: &Sum) -> Profile {
    let (at, _) = problem.topology.first_side(edge);
    let ([a, b], [x, y]) = (problem.segment(edge), problem.along(edge, 0.5));
    let (along, tensor) = ([b[0] - a[0], b[1] - a[1]], Conductivity::of(problem, at).at([x, y]));
    let gradient = f.gradient_at(x, y);
    let through = dot(gradient, apply(&tensor, [along[1], -along[0]]));
    let share = dot(gradient, along) * (through / dot(gradient, apply(&tensor, gradient)));
    let mut factors = [0.0; DEGREES];
    for [t, weight] in gauss(POINTS) {
        let ([x, y], p) = (problem.along(edge, t), legendre(t));
        let value = weight * share * f.at(x, y);
        (0..DEGREES).for_each(|n| factors[n] += (2 * n + 1) as f64 * value * p[n]);
    }
    // ∫P_n = (P_{n+1} − P_{n−1})/(2(2n + 1)), and half of P_1 for n = 0.
    let half = |n: usize| factors.get(n).map_or(0.0, |factor| 0.5 * factor / (2 * n + 1) as f64);
    let own = |n: usize| if n == 0 { 0.0 } else { half(n - 1) - half(n + 1) };
    let profile: Profile = std::array::from_fn(own);
    if profile.iter().all(|factor| factor.is_finite()) { profile } else { [0.0; DEGREES] }
}

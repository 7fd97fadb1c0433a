//! Triangles paired into quads: two with a common edge become the quad around both.
//!
//! The fewer triangles stay alone the better, but a quad far from a rectangle is worse than two
//! triangles. Its skew is the largest |cos θ| of its four angles θ, 0 in a rectangle; pairs are
//! taken in the order of their skew, up to `MOST_SKEW`, and what then stands alone is paired by
//! exchange (`matching`).

use std::f64::consts::FRAC_1_SQRT_2;

use super::check::{CellSide, sides};
use super::matching::matching;
use super::shape::{Orientation, direction, orientation};
use super::{Curve, Mesh};

/// |cos θ| up to which a quad is taken: angles from 45° to 135°, bounds excluded whatever the rounding.
const MOST_SKEW: f64 = FRAC_1_SQRT_2 - 1e-6;

/// Skews are compared in steps of this size: rounding does not decide between equal quads.
const STEP: f64 = 1e-9;

/// `mesh` with its triangles paired as far as they can be; quads, vertices and curves stay.
///
/// A pair lies in the same surfaces, and its common edge on no curve. The mesh's quads come first,
/// then the pairs in the order of their first triangle, whose first corner they start with as far
/// as the common edge allows.
pub fn paired(mesh: &Mesh) -> Mesh {
    let candidates = candidates(mesh);
    let pairs: Vec<_> = candidates.iter().map(|candidate| candidate.triangles).collect();
    let chosen = matching(mesh.triangles.len(), &pairs);
    let of_triangles = || (0..).zip(&mesh.triangles).zip(&chosen);
    let lone = of_triangles().filter(|(_, pair)| pair.is_none()).map(|(alone, _)| alone);
    let (alone, triangles): (Vec<u32>, Vec<_>) = lone.unzip();
    let pairs = of_triangles().filter_map(|((first, _), pair)| {
        let candidate = &candidates[(*pair)? as usize];
        (candidate.triangles[0] == first).then_some((first, candidate.quad))
    });
    let (firsts, quads): (Vec<u32>, Vec<_>) = pairs.unzip();
    let whole = mesh.triangles.len() as u32..mesh.cells() as u32;
    let origins: Vec<_> = alone.into_iter().chain(whole).chain(firsts).collect();
    Mesh {
        vertices: mesh.vertices.clone(),
        triangles,
        quads: mesh.quads.iter().copied().chain(quads).collect(),
        surfaces: mesh.inherited(&origins),
        curves: mesh.curves.clone(),
    }
}

/// Two triangles and the quad around them.
struct Candidate {
    /// Its skew, in steps.
    steps: u32,
    /// The lower number first.
    triangles: [u32; 2],
    quad: [u32; 4],
}

/// All pairs that may be taken, the best first.
fn candidates(mesh: &Mesh) -> Vec<Candidate> {
    let regions = regions(mesh);
    let (sides, triangles) = (sides(mesh), mesh.triangles.len() as u32);
    let pairs = sides.chunk_by(|a, b| a.edge == b.edge).filter_map(|sides| {
        let &[first, second] = sides else { return None };
        let [here, there] = [first, second].map(|side| &regions[side.cell as usize]);
        let divides = |curve: &Curve| curve.edges.binary_search(&first.edge).is_ok();
        let are_alike = second.cell < triangles && here == there;
        (are_alike && !mesh.curves.iter().any(divides)).then_some([first, second])
    });
    let mut found: Vec<_> = pairs.filter_map(|pair| candidate(mesh, pair)).collect();
    found.sort_by_key(|candidate| (candidate.steps, candidate.triangles));
    found
}

/// The surfaces of each cell.
fn regions(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut regions = vec![Vec::new(); mesh.cells()];
    for (number, surface) in mesh.surfaces.iter().enumerate() {
        surface.cells.iter().for_each(|&cell| regions[cell as usize].push(number));
    }
    regions
}

/// The quad around two triangles, if it is convex and not too skew.
fn candidate(mesh: &Mesh, [first, second]: [CellSide; 2]) -> Option<Candidate> {
    let [a, b, c] = mesh.triangles[first.cell as usize];
    let opposite = mesh.triangles[second.cell as usize][(second.side + 2) % 3];
    let quad = match first.side {
        0 => [a, opposite, b, c],
        1 => [a, b, opposite, c],
        _ => [a, b, c, opposite],
    };
    let points = quad.map(|vertex| mesh.vertices[vertex as usize]);
    let skew = skew(points);
    if orientation(&points) != Ok(Orientation::Counterclockwise) || skew > MOST_SKEW {
        return None;
    }
    let triangles = [first.cell, second.cell];
    Some(Candidate { steps: (skew / STEP).round() as u32, triangles, quad })
}

/// The largest |cos θ| of the four angles.
fn skew(corners: [[f64; 2]; 4]) -> f64 {
    let directions: [_; 4] = std::array::from_fn(|k| direction(corners[k], corners[(k + 1) % 4]));
    let cosine = |k: usize| {
        let (came, goes) = (directions[k], directions[(k + 1) % 4]);
        (came[0] * goes[0] + came[1] * goes[1]).abs()
    };
    (0..4).map(cosine).fold(0.0, f64::max)
}

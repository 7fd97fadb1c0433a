//! The mesh that a uniform refinement was made of: `refined` undone.

use std::collections::BTreeMap;

use crate::mesh::shape::mean;
use crate::mesh::{Curve, Mesh, Surface};

/// The mesh of which [`refined`](super::refined) makes `mesh`; none where the cells of `mesh` are not numbered as those of a
/// refinement. Slits are not looked for: one that is a single edge long is closed in the mesh before.
pub fn coarsened(mesh: &Mesh) -> Option<Mesh> {
    let mut means = Vec::new();
    let triangles = fours(&mesh.triangles, |of| triangle(of, &mut means))?;
    let quads = fours(&mesh.quads, |of| quad(of, &mut means))?;
    let corners = triangles.as_flattened().iter().chain(quads.as_flattened());
    // Vertices of whole cells come first.
    let count = corners.max()? + 1;
    let is_mean = |(vertex, of): &(u32, [u32; 4])| {
        let distinct = if of[..2] == of[2..] { &of[..2] } else { &of[..] };
        *vertex >= count && mesh.vertices[*vertex as usize] == mean(&mesh.vertices, distinct)
    };
    let curves = mesh.curves.iter().map(|curve| joined(curve, count)).collect::<Option<_>>()?;
    let surfaces = mesh.surfaces.iter().map(of_wholes).collect::<Option<_>>()?;
    let vertices = mesh.vertices[..count as usize].to_vec();
    let whole = Mesh { vertices, triangles, quads, surfaces, curves };
    means.iter().all(is_mean).then_some(whole)
}

/// A cell for each four.
fn fours<const N: usize>(
    cells: &[[u32; N]],
    whole: impl FnMut(&[[u32; N]; 4]) -> Option<[u32; N]>,
) -> Option<Vec<[u32; N]>> {
    let (fours, rest) = cells.as_chunks();
    if rest.is_empty() { fours.iter().map(whole).collect() } else { None }
}

/// Vertices, each with the four that it is the mean of: both ends of an edge twice, or the corners of a quad.
type Means = Vec<(u32, [u32; 4])>;

/// The triangle of which red refinement makes these four.
fn triangle(children: &[[u32; 3]; 4], means: &mut Means) -> Option<[u32; 3]> {
    let &[[a, l, n], [_, b, m], [_, _, c], _] = children;
    means.extend([(l, [a, b, a, b]), (m, [b, c, b, c]), (n, [c, a, c, a])]);
    (*children == [[a, l, n], [l, b, m], [n, m, c], [m, n, l]]).then_some([a, b, c])
}

/// The quad of which red refinement makes these four.
fn quad(children: &[[u32; 4]; 4], means: &mut Means) -> Option<[u32; 4]> {
    let &[[a, l, z, o], [_, b, m, _], [_, _, c, n], [_, _, _, d]] = children;
    means.extend([(l, [a, b, a, b]), (m, [b, c, b, c]), (n, [c, d, c, d]), (o, [d, a, d, a])]);
    means.push((z, [a, b, c, d]));
    (*children == [[a, l, z, o], [l, b, m, z], [z, m, c, n], [o, z, n, d]]).then_some([a, b, c, d])
}

/// Edges of which each two halves, of vertices below `count` and one midpoint, make one.
fn joined(curve: &Curve, count: u32) -> Option<Curve> {
    let mut halves: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &[end, midpoint] in &curve.edges {
        halves.entry(midpoint).or_default().push(end);
    }
    let whole = |(midpoint, ends): (u32, Vec<u32>)| match ends[..] {
        [a, b] if a.max(b) < count && midpoint >= count => Some([a.min(b), a.max(b)]),
        _ => None,
    };
    let mut edges = halves.into_iter().map(whole).collect::<Option<Vec<_>>>()?;
    edges.sort_unstable();
    Some(Curve { name: curve.name.clone(), edges })
}

/// The wholes whose children a surface has.
fn of_wholes(surface: &Surface) -> Option<Surface> {
    let (fours, rest) = surface.cells.as_chunks();
    let whole =
        |&[first, .., last]: &[u32; 4]| (first % 4 == 0 && last == first + 3).then_some(first / 4);
    let cells = fours.iter().map(whole).collect::<Option<_>>()?;
    rest.is_empty().then(|| Surface { name: surface.name.clone(), cells })
}

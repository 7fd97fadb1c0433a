//! Groups of edges that stand for a curve: what is guaranteed of a solution is so for the edges.

use std::collections::BTreeMap;

use signorini_scene::mesh::Mesh;

/// Turns that a curve has between its edges, in degrees: less is straight, more is a corner.
const TURNS: [f64; 2] = [1.0, 75.0];
/// Turns of fewer vertices are corners of a domain.
const FEWEST: usize = 4;

/// By how many degrees edges turn at most from one to the next, where at most vertices of the group they do; nothing of straight sides.
pub(crate) fn turn(mesh: &Mesh, edges: &[[u32; 2]]) -> Option<f64> {
    let mut beside = BTreeMap::<u32, Vec<u32>>::new();
    for &[a, b] in edges {
        beside.entry(a).or_default().push(b);
        beside.entry(b).or_default().push(a);
    }
    let angle = |(&vertex, others): (&u32, &Vec<u32>)| {
        let [before, after] = others[..] else { return None };
        let [p, q, r] = [before, vertex, after].map(|at| mesh.vertices[at as usize]);
        let ([a, b], [c, d]) = ([q[0] - p[0], q[1] - p[1]], [r[0] - q[0], r[1] - q[1]]);
        Some((a * d - b * c).atan2(a * c + b * d).to_degrees().abs())
    };
    let angles: Vec<f64> = beside.iter().filter_map(angle).collect();
    let turns = angles.iter().copied().filter(|of| (TURNS[0]..TURNS[1]).contains(of));
    let count = turns.clone().count();
    (count >= FEWEST && 2 * count > angles.len()).then(|| turns.fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_scene::mesh::structured::{Cells, grid};

    #[test]
    fn a_ring_of_edges_is_a_curve_and_a_rectangle_is_none() {
        let mut mesh = grid(4, Cells::Triangles);
        assert_eq!(turn(&mesh, &mesh.outer_edges()), None);
        let ring = |n: u32| (0..n).map(|at| [at, (at + 1) % n]).collect::<Vec<_>>();
        for n in [3, 4, 12, 400] {
            let angle = |at: u32| std::f64::consts::TAU * f64::from(at) / f64::from(n);
            mesh.vertices = (0..n).map(|at| [angle(at).cos(), angle(at).sin()]).collect();
            let found = turn(&mesh, &ring(n));
            let is_near = |found: f64| (found - 360.0 / f64::from(n)).abs() < 1e-9;
            match n {
                12 => assert!(found.is_some_and(is_near), "{found:?}"),
                _ => assert_eq!(found, None, "{n}"),
            }
        }
    }
}

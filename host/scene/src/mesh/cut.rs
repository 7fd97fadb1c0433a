//! Quads cut into triangles along the shorter diagonal.
//!
//! Where both are equally long, as in a rectangle, the diagonal that rises to the right is taken:
//! from lower left to upper right, as the catalogue cuts its squares.

use super::Mesh;
use super::shape::edge_length;

/// Lengths that differ by less, as part of the longer one, count as equal: coordinates are rounded.
const EQUAL: f64 = 1e-9;

/// `mesh` with every quad cut; its triangles come first, vertices and curves stay.
pub fn cut(mesh: &Mesh) -> Mesh {
    let (whole, all) = (mesh.triangles.len() as u32, mesh.cells() as u32);
    let halves = mesh.quads.iter().flat_map(|&quad| halves(mesh, quad));
    let origins: Vec<_> = (0..whole).chain((whole..all).flat_map(|quad| [quad; 2])).collect();
    Mesh {
        vertices: mesh.vertices.clone(),
        triangles: mesh.triangles.iter().copied().chain(halves).collect(),
        quads: Vec::new(),
        surfaces: mesh.inherited(&origins),
        curves: mesh.curves.clone(),
    }
}

fn halves(mesh: &Mesh, [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let diagonals = [[a, c], [b, d]].map(|ends| ends.map(|vertex| mesh.vertices[vertex as usize]));
    let ([ac, bd], [rise_ac, rise_bd]) = (diagonals.map(edge_length), diagonals.map(rise));
    let from_a = match (ac - bd).abs() <= EQUAL * ac.max(bd) {
        true => rise_ac >= rise_bd,
        false => ac < bd,
    };
    if from_a { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] }
}

/// sin 2φ of a segment at the angle φ, times its length squared.
fn rise([from, to]: [[f64; 2]; 2]) -> f64 {
    (to[0] - from[0]) * (to[1] - from[1])
}

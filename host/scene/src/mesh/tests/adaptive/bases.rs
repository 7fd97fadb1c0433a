//! Base meshes: the standard scenes', grids moved at random, corners, slits with and without common ends.

use crate::mesh::structured::{Cells, grid};
use crate::mesh::tests::{Draw, meshes};
use crate::mesh::{Curve, Mesh, Surface};

/// Every base mesh, by name.
pub fn all() -> Vec<(String, Mesh)> {
    let mut all = meshes();
    for (cells, seed) in [(Cells::Triangles, 1), (Cells::Quads, 2), (Cells::Mixed, 3)] {
        let mesh = moved(grid(3, cells), seed);
        for tips in [[false; 2], [true, false], [false, true], [true; 2]] {
            all.push((format!("slit {cells:?} {tips:?}"), with_slit(mesh.clone(), tips)));
        }
        all.push((format!("moved {cells:?}"), mesh));
    }
    all.push(("corner".to_owned(), corner()));
    all.push(("lone quad".to_owned(), lone_quad()));
    all
}

/// The mesh with its vertices off the outline moved by less than what makes a cell not convex, and stretched.
pub fn moved(mut mesh: Mesh, seed: u64) -> Mesh {
    let mut draw = Draw(seed);
    let width = mesh.vertices[1][0] - mesh.vertices[0][0];
    for [x, y] in &mut mesh.vertices {
        let inside = x.abs() < 1.0 && *y > 0.0 && *y < 1.0;
        let [dx, dy] = [0, 1].map(|_| 0.24 * width * (2.0 * draw.unit() - 1.0));
        if inside {
            *x += if *x == 0.0 { 0.0 } else { dx };
            *y += dy;
        }
        *y *= 0.3;
    }
    mesh
}

/// Three triangles around the re-entrant corner of an L, far from equal; each a surface of its own.
pub fn corner() -> Mesh {
    let vertices = vec![[0.0, 0.0], [1.0, 0.1], [0.2, 1.0], [-1.0, 0.3], [0.1, -1.0]];
    let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]];
    let surface = |cell: u32| Surface { name: format!("part {cell}"), cells: vec![cell] };
    let surfaces = (0..3).map(surface).collect();
    let curves = vec![Curve { name: "corner".to_owned(), edges: vec![[0, 1], [0, 4]] }];
    Mesh { vertices, triangles, quads: Vec::new(), surfaces, curves }
}

/// A quad with one angle near 180° and one acute.
pub fn lone_quad() -> Mesh {
    let vertices = vec![[0.0, 0.0], [3.0, 0.0], [2.0, 0.8], [0.5, 1.6]];
    let curves = vec![Curve { name: "foot".to_owned(), edges: vec![[0, 1]] }];
    Mesh { vertices, quads: vec![[0, 1, 2, 3]], curves, ..Mesh::default() }
}

/// Cut along x = 0, where the curves `left lip` and `right lip` run; the lower and the upper end are common
/// to both where `tips` says so.
pub fn with_slit(mut mesh: Mesh, tips: [bool; 2]) -> Mesh {
    let along: Vec<u32> =
        (0..mesh.vertices.len() as u32).filter(|&v| mesh.vertices[v as usize][0] == 0.0).collect();
    let end = |at: usize| tips[0] && at == 0 || tips[1] && at + 1 == along.len();
    let mut copies = along.clone();
    for (at, copy) in copies.iter_mut().enumerate().filter(|(at, _)| !end(*at)) {
        mesh.vertices.push(mesh.vertices[along[at] as usize]);
        *copy = mesh.vertices.len() as u32 - 1;
    }
    let vertices = &mesh.vertices;
    let part = |corners: &mut [u32]| {
        if corners.iter().any(|&vertex| vertices[vertex as usize][0] > 0.0) {
            for vertex in corners {
                *vertex = along.iter().position(|a| a == vertex).map_or(*vertex, |at| copies[at]);
            }
        }
    };
    mesh.triangles.iter_mut().for_each(|corners| part(corners));
    mesh.quads.iter_mut().for_each(|corners| part(corners));
    for curve in &mut mesh.curves {
        for edge in &mut curve.edges {
            part(edge);
            edge.sort_unstable();
        }
        curve.edges.sort_unstable();
    }
    for (name, lip) in [("left lip", &along), ("right lip", &copies)] {
        let edge = |pair: &[u32]| [pair[0].min(pair[1]), pair[0].max(pair[1])];
        let mut edges: Vec<_> = lip.windows(2).map(edge).collect();
        edges.sort_unstable();
        mesh.curves.push(Curve { name: name.to_owned(), edges });
    }
    mesh
}

//! The catalogue's rectangle with its four sides told apart, regular or scattered.

use std::collections::BTreeMap;

use signorini_problem::fixtures::with_four_sides;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Mesh};
use signorini_tests::random::Random;

/// How far a vertex may move, in mesh widths: every quad stays convex, every triangle positive.
const MOVE: f64 = 0.2;

/// 2n × n squares; curves `contact`, `left`, `right`, `top`.
pub fn regular(n: u32, cells: Cells) -> Mesh {
    four_sides(grid(n, cells))
}

/// A mesh of the rectangle whose curve `dirichlet` becomes `left`, `right`, `top`.
pub fn four_sides(mesh: Mesh) -> Mesh {
    let mut mesh = with_four_sides(mesh);
    mesh.curves[1].name = "top".to_owned();
    mesh.curves[1..].rotate_left(1);
    mesh
}

/// A copy with all vertices moved: along the boundary there, along x = 0 where A may jump.
pub fn scattered(random: &mut Random, n: u32, cells: Cells) -> Mesh {
    let mut mesh = regular(n, cells);
    let most = MOVE / f64::from(n);
    for place in &mut mesh.vertices {
        let [x, y] = *place;
        let moves = [random.between(-most, most), random.between(-most, most)];
        if x.abs() != 1.0 && x != 0.0 {
            place[0] += moves[0];
        }
        if y != 0.0 && y != 1.0 {
            place[1] += moves[1];
        }
    }
    mesh
}

/// A copy with its cells listed backwards and each from its next corner on.
pub fn relisted(mut mesh: Mesh) -> Mesh {
    let (triangles, quads) = (mesh.triangles.len() as u32, mesh.quads.len() as u32);
    mesh.triangles.reverse();
    mesh.quads.reverse();
    mesh.triangles.iter_mut().for_each(|corners| corners.rotate_left(1));
    mesh.quads.iter_mut().for_each(|corners| corners.rotate_left(1));
    let mirrored = |cell: u32| match cell.checked_sub(triangles) {
        None => triangles - 1 - cell,
        Some(quad) => triangles + quads - 1 - quad,
    };
    for surface in &mut mesh.surfaces {
        surface.cells = surface.cells.iter().map(|&cell| mirrored(cell)).collect();
        surface.cells.sort_unstable();
    }
    mesh
}

/// A copy in another unit of length.
pub fn scaled(mut mesh: Mesh, length: f64) -> Mesh {
    mesh.vertices.iter_mut().for_each(|place| *place = place.map(|x| length * x));
    mesh
}

/// The rectangle cut along x = 0, where the curve `slit` runs on both sides.
pub fn split(mut mesh: Mesh) -> Mesh {
    let all = (0u32..).zip(&mesh.vertices);
    let middle: Vec<u32> = all.filter(|(_, place)| place[0] == 0.0).map(|(at, _)| at).collect();
    let copies: Vec<u32> = (mesh.vertices.len() as u32..).take(middle.len()).collect();
    let copy: BTreeMap<_, _> = middle.iter().zip(&copies).collect();
    let vertices = &mesh.vertices;
    let part = |corners: &mut [u32]| {
        if corners.iter().any(|&vertex| vertices[vertex as usize][0] > 0.0) {
            corners
                .iter_mut()
                .for_each(|vertex| *vertex = copy.get(vertex).map_or(*vertex, |&&copy| copy));
        }
    };
    mesh.triangles.iter_mut().for_each(|corners| part(corners));
    mesh.quads.iter_mut().for_each(|corners| part(corners));
    for edge in mesh.curves.iter_mut().flat_map(|curve| &mut curve.edges) {
        part(edge);
        edge.sort_unstable();
    }
    let chain = |ends: &[u32]| ends.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>();
    let edges = [chain(&middle), chain(&copies)].concat();
    mesh.curves.push(Curve { name: "slit".to_owned(), edges });
    let places: Vec<_> = middle.iter().map(|&vertex| mesh.vertices[vertex as usize]).collect();
    mesh.vertices.extend(places);
    mesh
}

/// Triangles, quads, both.
pub const KINDS: [Cells; 3] = [Cells::Triangles, Cells::Quads, Cells::Mixed];

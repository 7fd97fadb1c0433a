//! The mesh of conforming P1: the same triangles, and quads cut from their first to their third corner.

use signorini_scene::mesh::{Mesh, Surface};

/// `mesh` in triangles.
pub(super) fn cut(mesh: &Mesh) -> Mesh {
    let triangles = mesh.triangles.len() as u32;
    let halves = mesh.quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let cells = |cell: u32| match cell.checked_sub(triangles) {
        None => cell..cell + 1,
        Some(quad) => triangles + 2 * quad..triangles + 2 * quad + 2,
    };
    let surface = |surface: &Surface| Surface {
        name: surface.name.clone(),
        cells: surface.cells.iter().flat_map(|&cell| cells(cell)).collect(),
    };
    Mesh {
        vertices: mesh.vertices.clone(),
        triangles: mesh.triangles.iter().copied().chain(halves).collect(),
        quads: Vec::new(),
        surfaces: mesh.surfaces.iter().map(surface).collect(),
        curves: mesh.curves.clone(),
    }
}

//! The Gmsh reader, and what becomes of a mesh that it accepts.

use std::path::Path;

use signorini_scene::mesh::adaptive::{self, Hierarchy};
use signorini_scene::mesh::shape::{self, Orientation};
use signorini_scene::mesh::{self, Mesh, check, cut, gmsh, pairing};
use signorini_scene::scene::Scene;

use super::{bytes, solved};

/// The bytes of a Gmsh file.
pub fn mesh(data: &[u8]) {
    match mesh::parse(data) {
        Err(error) => {
            let length = error.message().len();
            assert!(0 < length && length < 400 + data.len(), "{}", error.message());
        }
        Ok(mesh) => {
            sound(&mesh, data.len());
            oriented(&mesh);
            changed(&mesh);
            if mesh.cells() <= MOST_SOLVED {
                answered(mesh, bytes::sum(data));
            }
        }
    }
}

/// Cells of a mesh that is worth solving on.
const MOST_SOLVED: usize = 24;

/// The promises of [`Mesh`], and no more of anything than the file can hold.
fn sound(mesh: &Mesh, length: usize) {
    let Mesh { vertices, triangles, quads, surfaces, curves } = mesh;
    assert!(mesh.cells() > 0 && vertices.len() + mesh.cells() <= length);
    assert!(vertices.iter().flatten().all(|x| x.is_finite()));
    let corners = triangles.as_flattened().iter().chain(quads.as_flattened());
    let mut used = vec![false; vertices.len()];
    corners.for_each(|&corner| used[corner as usize] = true);
    assert!(used.iter().all(|&used| used), "a vertex without a cell");
    let edges = check::edges(mesh).expect("cells that meet as they may");
    for surface in surfaces {
        assert!(surface.cells.is_sorted_by(|a, b| a < b), "{surface:?}");
        assert!(surface.cells.last().is_some_and(|&last| (last as usize) < mesh.cells()));
    }
    for curve in curves {
        assert!(!curve.edges.is_empty() && curve.edges.is_sorted_by(|a, b| a < b), "{curve:?}");
        assert!(curve.edges.iter().all(|edge| edges.binary_search(edge).is_ok()));
    }
}

fn oriented(mesh: &Mesh) {
    let corner = |&vertex: &u32| mesh.vertices[vertex as usize];
    let left = |cell: &[u32]| {
        let corners: Vec<_> = cell.iter().map(corner).collect();
        shape::orientation(&corners) == Ok(Orientation::Counterclockwise)
    };
    assert!(mesh.triangles.iter().all(|cell| left(cell)));
    assert!(mesh.quads.iter().all(|cell| left(cell)));
}

/// Refined it is still a mesh. Cut and paired too, unless cells far from each other overlap, which the reader
/// cannot know: then whoever numbers the edges refuses them.
fn changed(mesh: &Mesh) {
    for other in [cut::cut(mesh), pairing::paired(mesh)] {
        let corners = |mesh: &Mesh| 2 * mesh.quads.len() + mesh.triangles.len();
        assert_eq!(corners(&other), corners(mesh));
        let _ = check::edges(&other);
    }
    let fine = adaptive::refined(mesh).expect("few cells");
    assert_eq!(fine.cells(), 4 * mesh.cells());
    check::edges(&fine).expect("a mesh");
    refined_in_part(mesh);
}

/// Every other cell refined, and of the new ones again: a mesh each time, unless rounding hides a cell.
fn refined_in_part(mesh: &Mesh) {
    let mut hierarchy = Hierarchy::new(mesh.clone()).expect("edges that were found before");
    for _ in 0..3 {
        let cells = hierarchy.mesh().cells();
        let marks: Vec<_> = (0..cells).map(|cell| cell.is_multiple_of(2)).collect();
        let Ok(carried) = hierarchy.refine(&marks) else { return };
        let fine = hierarchy.mesh();
        check::edges(fine).expect("a mesh");
        oriented(fine);
        assert_eq!(carried.cells.len(), fine.cells());
        assert!(carried.cells.iter().all(|&cell| (cell as usize) < cells));
        assert_eq!(mesh::parse(gmsh::write::text(fine).as_bytes()).as_ref().ok(), Some(fine));
    }
}

/// Held by the whole boundary, or with contact all along its first curve.
fn answered(mesh: Mesh, way: u8) {
    let contact = match mesh.curves.first() {
        Some(curve) => format!("[boundary.{:?}]\nkind = \"contact\"\n", curve.name),
        None => String::new(),
    };
    let text = format!(
        "mesh = \"m\"\n[material.default]\nconductivity = 2\n[source]\nf = -1\n[boundary.default]\n\
         kind = \"dirichlet\"\nvalue = \"1\"\n{contact}"
    );
    // Not every name that a mesh may have is a string of Rust and of TOML alike.
    let Ok(scene) = Scene::parse(&text, Path::new("hostile.toml")) else { return };
    solved::answer(&scene, mesh, way);
}

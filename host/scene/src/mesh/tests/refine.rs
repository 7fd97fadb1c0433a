//! Counts, sizes, the grid again, and what is refused.

use super::*;
use crate::mesh::adapted::adapted;
use crate::mesh::adaptive::{coarsened, refined};
use crate::mesh::check::MOST_CELLS;
use crate::mesh::structured::{Cells, grid};

#[test]
fn counts_and_sizes_on_every_mesh() {
    for (what, mesh) in meshes() {
        let fine = refined(&mesh).expect("a mesh");
        assert_same_domain(&what, &mesh, &fine);
        let count = edges(&mesh).expect("edges").len();
        let (triangles, quads) = (mesh.triangles.len(), mesh.quads.len());
        let vertices = mesh.vertices.len();
        assert_eq!(fine.vertices.len(), vertices + count + quads, "{what}");
        assert_eq!((fine.triangles.len(), fine.quads.len()), (4 * triangles, 4 * quads), "{what}");
        let finer = edges(&fine).expect("edges").len();
        assert_eq!(finer, 2 * count + 3 * triangles + 4 * quads, "{what}");
        assert_eq!(fine.vertices[..vertices], mesh.vertices, "{what}");
        for (fine, coarse) in fine.curves.iter().zip(&mesh.curves) {
            assert_eq!(fine.edges.len(), 2 * coarse.edges.len(), "{what}: {}", fine.name);
        }
    }
}

#[test]
fn a_refinement_is_undone_and_nothing_else_is() {
    for (what, mesh) in meshes() {
        let fine = refined(&mesh).expect("a mesh");
        assert_eq!(coarsened(&fine).as_ref(), Some(&mesh), "{what}");
        let mut moved = fine.clone();
        moved.vertices[mesh.vertices.len()][0] += 1e-9;
        assert_eq!(coarsened(&moved), None, "{what}");
        let mut half = fine.clone();
        half.curves[0].edges.pop();
        assert_eq!(coarsened(&half), None, "{what}");
        let mut part = fine;
        part.surfaces.push(Surface { name: "part".to_owned(), cells: vec![1, 2, 3, 4] });
        assert_eq!(coarsened(&part), None, "{what}");
    }
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        assert_eq!(coarsened(&grid(4, cells)), None);
    }
    assert_eq!(coarsened(&Mesh::default()), None);
}

#[test]
fn the_refined_grid_is_the_finer_grid() {
    for cells in [Cells::Triangles, Cells::Quads] {
        for n in [1, 2, 4] {
            let fine = refined(&grid(n, cells)).expect("a mesh");
            assert_eq!(shape(&fine), shape(&grid(2 * n, cells)), "{cells:?} {n}");
        }
    }
    let three = adapted(grid(1, Cells::Quads), None, 3).expect("a mesh");
    assert_eq!(shape(&three), shape(&grid(8, Cells::Quads)));
}

#[test]
fn a_curve_inside_the_domain_is_halved_too() {
    let mut mesh = grid(2, Cells::Mixed);
    // The line x = 0, between left and right.
    let edges = vec![[2, 7], [7, 12]];
    mesh.curves.push(Curve { name: "inside".to_owned(), edges });
    let fine = refined(&mesh).expect("a mesh");
    assert_same_domain("inside", &mesh, &fine);
    assert_eq!(fine.curves[2].edges.len(), 4);
    assert!(fine.curves[2].edges.iter().flatten().all(|&v| fine.vertices[v as usize][0] == 0.0));
}

#[test]
fn what_has_no_refinement_is_refused() {
    let said = |mesh: &Mesh| refined(mesh).expect_err("no mesh").to_string();
    let mut mesh = grid(1, Cells::Triangles);
    mesh.curves[0].edges.push([0, 5]);
    assert_eq!(said(&mesh), "curve `contact`: no cell has the edge from 0 to 5");
    let mut mesh = grid(1, Cells::Triangles);
    mesh.triangles.push(mesh.triangles[0]);
    assert!(said(&mesh).contains("share the edge") || said(&mesh).contains("overlap"));

    let mesh = Mesh { triangles: vec![[0; 3]; MOST_CELLS / 4 + 1], ..Mesh::default() };
    assert_eq!(said(&mesh), "the refined mesh would have 8000004 cells, expected at most 8000000");
    for refine in [6, 16, 40, u32::MAX] {
        let error = adapted(grid(32, Cells::Quads), None, refine).expect_err("too fine");
        let message = format!("setting.refine: 2048 cells, refined {refine} times, make more");
        assert!(error.to_string().starts_with(&message), "{error}");
        assert_eq!(error.exit_status(), 2);
    }
}

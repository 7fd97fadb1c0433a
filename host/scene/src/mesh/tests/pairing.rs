//! Pairs and halves: the catalogue's grids into each other, and what keeps triangles apart.

use super::*;
use crate::mesh::cut::cut;
use crate::mesh::pairing::paired;
use crate::mesh::structured::{Cells, grid};

#[test]
fn triangles_of_the_catalogue_pair_into_its_squares_and_back() {
    let [triangles, quads, mixed] =
        ["tri", "quad", "mixed"].map(|kind| standard(&format!("catalogue/square-{kind}-16.msh")));
    assert_eq!(paired(&triangles), quads);
    assert_eq!(shape(&paired(&mixed)), shape(&quads));
    assert_eq!(cut(&quads), triangles);
    assert_eq!(shape(&cut(&mixed)), shape(&triangles));
    assert_eq!((paired(&quads), cut(&triangles)), (quads, triangles));
    // Coordinates that are no binary fractions: squares within rounding.
    let [triangles, quads] = [Cells::Triangles, Cells::Quads].map(|cells| grid(7, cells));
    assert_eq!(paired(&triangles), quads);
    assert_eq!(cut(&quads), triangles);
}

#[test]
fn every_mesh_keeps_its_domain_and_few_triangles_stay_alone() {
    for (what, mesh) in meshes() {
        let halves = cut(&mesh);
        assert_same_domain(&what, &mesh, &halves);
        assert_eq!(halves.triangles.len(), mesh.triangles.len() + 2 * mesh.quads.len(), "{what}");
        for mesh in [mesh, halves] {
            let pairs = paired(&mesh);
            assert_same_domain(&what, &mesh, &pairs);
            let (before, alone) = (mesh.triangles.len(), pairs.triangles.len());
            assert_eq!(2 * (pairs.quads.len() - mesh.quads.len()), before - alone, "{what}");
            assert!(10 * alone <= before, "{what}: {alone} of {before}");
            for quad in &pairs.quads[mesh.quads.len()..] {
                let corners = points(&pairs, quad);
                let angles =
                    (0..4).map(|k| angle(corners[(k + 3) % 4], corners[k], corners[(k + 1) % 4]));
                assert!(angles.into_iter().all(|angle| (44.9..135.1).contains(&angle)), "{what}");
            }
        }
    }
}

/// No matching leaves fewer alone between 45° and 135°: blossoms, elsewhere, found the same number.
#[test]
fn the_matching_of_an_unstructured_mesh_is_a_largest_one() {
    let mesh = standard("scenes/levee.msh");
    let pairs = paired(&mesh);
    assert_eq!((mesh.triangles.len(), pairs.triangles.len(), pairs.quads.len()), (1515, 107, 704));
}

/// The angle at `at`, in degrees.
fn angle(before: [f64; 2], at: [f64; 2], after: [f64; 2]) -> f64 {
    let [a, b] = [after, before].map(|to| (to[1] - at[1]).atan2(to[0] - at[0]));
    (b - a).to_degrees().rem_euclid(360.0)
}

#[test]
fn surfaces_and_curves_keep_triangles_apart() {
    let apart = |change: fn(&mut Mesh)| {
        let mut mesh = grid(4, Cells::Triangles);
        change(&mut mesh);
        let pairs = paired(&mesh);
        assert_same_domain("apart", &mesh, &pairs);
        pairs.triangles
    };
    assert!(apart(|_| {}).is_empty());
    let first = [[0, 1, 10], [0, 10, 9]];
    assert_eq!(apart(|mesh| mesh.surfaces[0].cells.retain(|&cell| cell != 0)), first);
    let crack = |mesh: &mut Mesh| {
        mesh.curves.push(Curve { name: "crack".to_owned(), edges: vec![[0, 10]] });
    };
    assert_eq!(apart(crack), first);
    // A surface that covers both halves of a square divides nothing.
    let both = |mesh: &mut Mesh| {
        mesh.surfaces.push(Surface { name: "both".to_owned(), cells: vec![0, 1] });
    };
    assert!(apart(both).is_empty());
}

#[test]
fn a_skew_quad_is_no_pair_and_a_lone_triangle_stays() {
    let vertices = vec![[0.0, 0.0], [1.0, 0.0], [1.3, 0.2], [0.3, 0.2]];
    let mesh = Mesh { vertices, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    assert_eq!(paired(&mesh), mesh);
    let mesh = Mesh { triangles: vec![[0, 1, 2]], ..mesh };
    assert_eq!(paired(&mesh), mesh);
    assert_eq!(paired(&Mesh::default()), Mesh::default());
}

#[test]
fn quads_are_cut_along_the_shorter_diagonal_whatever_the_numbering() {
    let vertices = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [0.4, 1.0]];
    for quad in [[0, 1, 2, 3], [1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2]] {
        let mesh = Mesh { vertices: vertices.clone(), quads: vec![quad], ..Mesh::default() };
        let halves = cut(&mesh);
        assert!(halves.triangles.iter().all(|half| half.contains(&1) && half.contains(&3)));
        let flat = |[x, y]: [f64; 2]| [x.min(1.0).round(), 0.1 * y];
        let rectangle = vertices.iter().map(|&point| flat(point)).collect();
        let mesh = Mesh { vertices: rectangle, ..mesh };
        let halves = cut(&mesh);
        let rising = |half: &[u32; 3]| half.contains(&0) && half.contains(&2);
        assert!(halves.triangles.iter().all(rising), "{quad:?}");
    }
}

//! Meshes that are written are read back as they were: groups that overlap, slits, every bit of a coordinate.

use super::super::write::text;
use super::encode::Coding;
use super::mesh;
use super::valid::model;
use crate::mesh::structured::{Cells, grid};
use crate::mesh::tests::Draw;
use crate::mesh::{Curve, Mesh, Surface};

fn assert_kept(mesh: &Mesh) {
    assert_eq!(&self::mesh(text(mesh).as_bytes()), mesh);
}

#[test]
fn what_was_read_is_written_and_read_again() {
    for bytes in [model().v22(Coding::Ascii), model().v41(Coding::Big)] {
        assert_kept(&mesh(&bytes));
    }
}

#[test]
fn the_file_of_two_cells() {
    let vertices = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.0, 0.5], [1e-7, 2e22]];
    let surface = |name: &str, cells: &[u32]| Surface { name: name.into(), cells: cells.into() };
    let mesh = Mesh {
        vertices,
        triangles: vec![[3, 2, 4]],
        quads: vec![[0, 1, 2, 3]],
        surfaces: vec![surface("both", &[0, 1]), surface("a \"quad\"", &[1])],
        curves: vec![Curve { name: "foot".into(), edges: vec![[0, 1]] }],
    };
    let expected = "\
        $MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
        $PhysicalNames\n3\n1 1 \"foot\"\n2 1 \"both\"\n2 2 \"a \"quad\"\"\n$EndPhysicalNames\n\
        $Entities\n0 2 3 0\n\
        1 0.0 0.0 0 1.0 2e22 0 0 0\n2 0.0 0.0 0 1.0 2e22 0 1 1 0\n\
        1 0.0 0.0 0 1.0 2e22 0 0 0\n2 0.0 0.0 0 1.0 2e22 0 1 1 0\n3 0.0 0.0 0 1.0 2e22 0 2 1 2 0\n\
        $EndEntities\n\
        $Nodes\n1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n\
        0.0 0.0 0\n1.0 0.0 0\n1.0 0.5 0\n0.0 0.5 0\n1e-7 2e22 0\n$EndNodes\n\
        $Elements\n3 3 1 3\n1 2 1 1\n1 1 2\n2 2 2 1\n2 4 3 5\n2 3 3 1\n3 1 2 3 4\n$EndElements\n";
    assert_eq!(text(&mesh), expected);
    assert_kept(&mesh);
}

#[test]
fn groups_that_overlap_at_random() {
    let mut draw = Draw(1);
    let mut chance = || draw.below(4) == 0;
    let mut mesh = grid(5, Cells::Mixed);
    let edges = crate::mesh::check::edges(&mesh).expect("a mesh");
    for number in 0..12 {
        let cells: Vec<_> = (0..mesh.cells() as u32).filter(|_| chance()).collect();
        let edges = edges.iter().copied().filter(|_| chance()).collect();
        mesh.surfaces.push(Surface { name: format!("{number}"), cells });
        mesh.curves.push(Curve { name: format!("{number}"), edges });
    }
    for [x, y] in &mut mesh.vertices {
        (*x, *y) = (1e-300 * (*x + 0.1) / 3.0, 1e300 * *y / 7.0);
    }
    assert_kept(&mesh);
}

#[test]
fn a_mesh_without_groups() {
    let mesh = Mesh { surfaces: Vec::new(), curves: Vec::new(), ..grid(2, Cells::Quads) };
    assert_kept(&mesh);
}

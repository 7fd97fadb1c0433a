//! A curve inside the domain is read from every format and encoding, whatever a scene makes of it.

use super::encode::{CODINGS, Model};
use super::mesh;
use super::valid::model;
use crate::mesh::Mesh;

/// The plate and the fin of [`model`] with a curve along `nodes`.
fn meshes(nodes: &[[i32; 2]]) -> Vec<Mesh> {
    let mut model = model();
    model.names.push((1, 9, "drain"));
    let lines = (11..).zip(nodes).map(|(tag, nodes)| (tag, 1, vec![9], nodes.to_vec()));
    model.elements.extend(lines);
    let both = |coding| [Model::v22, Model::v41].map(|write| mesh(&write(&model, coding)));
    CODINGS.into_iter().flat_map(both).collect()
}

#[test]
fn a_curve_between_two_cells_is_kept() {
    for nodes in [&[[7, 1_000_000_000]][..], &[[1_000_000_000, 7], [7, 99]]] {
        let meshes = meshes(nodes);
        for mesh in &meshes {
            let drain = mesh.curves.iter().find(|curve| curve.name == "drain").expect("the drain");
            assert_eq!(drain.edges.len(), nodes.len());
            assert_eq!(mesh, &meshes[0]);
        }
    }
}

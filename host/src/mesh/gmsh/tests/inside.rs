//! A condition inside the domain is refused whatever file it came in.

use std::path::Path;

use super::encode::{CODINGS, Model};
use super::mesh;
use super::valid::model;
use crate::mesh::Mesh;
use crate::problem::Problem;
use crate::scene::Scene;

const SCENE: &str = "mesh = 'a.msh'
material.default = { conductivity = 1 }
boundary.default = { kind = 'dirichlet', value = 1 }
";
const DRAIN: &str = "boundary.drain = { kind = 'dirichlet', value = 0 }\n";

/// The plate and the fin of [`model`] with a curve between them, in every format and encoding.
fn meshes(nodes: &[[i32; 2]]) -> Vec<Mesh> {
    let mut model = model();
    model.names.push((1, 9, "drain"));
    let lines = (11..).zip(nodes).map(|(tag, nodes)| (tag, 1, vec![9], nodes.to_vec()));
    model.elements.extend(lines);
    let both = |coding| [Model::v22, Model::v41].map(|write| mesh(&write(&model, coding)));
    CODINGS.into_iter().flat_map(both).collect()
}

fn bound(text: &str, mesh: Mesh) -> Result<Vec<String>, String> {
    let scene = Scene::parse(text, Path::new("a.toml")).expect("a scene");
    match Problem::new(&scene, mesh) {
        Ok(problem) => Ok(problem.warnings),
        Err(error) => {
            assert_eq!(error.exit_status(), 2);
            Err(error.to_string())
        }
    }
}

#[test]
fn a_table_for_a_curve_between_two_cells() {
    for mesh in meshes(&[[7, 1_000_000_000]]) {
        let refused = "a.toml:4: boundary.drain: the physical curve \"drain\" lies inside the domain, where no condition \
             acts: 1 of its 1 edges have cells on both sides, the first (1, 0)–(1, 1)";
        let text = format!("{SCENE}{DRAIN}");
        assert_eq!(bound(&text, mesh.clone()), Err(refused.to_owned()));
        // The default says nothing about it.
        assert_eq!(bound(SCENE, mesh), Ok(Vec::new()));
    }
}

#[test]
fn a_table_for_a_curve_that_goes_inside() {
    for mesh in meshes(&[[1_000_000_000, 7], [7, 99]]) {
        let refused = bound(&format!("{SCENE}{DRAIN}"), mesh).expect_err("a part lies inside");
        assert!(refused.contains("lies partly inside the domain"), "{refused}");
        assert!(refused.contains("1 of its 2 edges"), "{refused}");
    }
}

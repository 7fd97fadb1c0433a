//! A condition on a curve inside the domain is refused.

use std::path::Path;

use crate::Problem;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Mesh};
use signorini_scene::scene::Scene;

const SCENE: &str = "mesh = 'a.msh'
material.default = { conductivity = 1 }
boundary.default = { kind = 'dirichlet', value = 1 }
";
const DRAIN: &str = "boundary.drain = { kind = 'dirichlet', value = 0 }\n";

/// A grid of 4 × 2 quads on (−1, 1) × (0, 1) with a curve along these edges.
fn with_drain(edges: &[[u32; 2]]) -> Mesh {
    let mut mesh = grid(2, Cells::Quads);
    mesh.curves.push(Curve { name: "drain".into(), edges: edges.to_vec() });
    mesh
}

fn posed(text: &str, mesh: Mesh) -> Result<Vec<String>, String> {
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
    let mesh = with_drain(&[[2, 7]]);
    let refused = "a.toml:4: boundary.drain: the physical curve \"drain\" lies inside the domain, where no condition \
         acts: 1 of its 1 edges have cells on both sides, the first (0, 0)–(0, 0.5)";
    assert_eq!(posed(&format!("{SCENE}{DRAIN}"), mesh.clone()), Err(refused.to_owned()));
    // The default says nothing about it.
    assert_eq!(posed(SCENE, mesh), Ok(Vec::new()));
}

#[test]
fn a_table_for_a_curve_that_goes_inside() {
    let mesh = with_drain(&[[1, 2], [2, 7]]);
    let refused = posed(&format!("{SCENE}{DRAIN}"), mesh).expect_err("a part lies inside");
    assert!(refused.contains("lies partly inside the domain"), "{refused}");
    assert!(refused.contains("1 of its 2 edges"), "{refused}");
}

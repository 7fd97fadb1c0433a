//! Warnings of what may not be meant: once on standard error, and in the summary.

use signorini_scene::mesh::gmsh::write;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Mesh};

use crate::command::{Folder, refused, run, says_of};

const SCENE: &str = r#"mesh = "plate.msh"
material.default.conductivity = "1"
boundary.sides = { kind = "dirichlet", value = "1" }
boundary.bottom = { kind = "contact" }
boundary.default = { kind = "neumann", flux = "0" }
setting.scalar = "f64"
"#;

/// (−1, 1) × (0, 1) in 8 × 4 squares; the line x = 0 is the curve `drain`, or torn where nodes are not `merged`.
fn mesh(merged: bool) -> Mesh {
    let mut mesh = grid(4, Cells::Quads);
    let middle = |row: u32| 9 * row + 4;
    let drain = (0..4).map(|row| [middle(row), middle(row + 1)]).collect();
    let is_on_side = |&end: &u32| mesh.vertices[end as usize][0].abs() == 1.0;
    let on_sides = |edge: &[u32; 2]| edge.iter().all(is_on_side);
    let sides = mesh.curves[1].edges.iter().copied().filter(on_sides).collect();
    let mut bottom = mesh.curves[0].edges.clone();
    if !merged {
        // The right half has nodes of its own on x = 0.
        let own = |node: &mut u32| {
            if *node % 9 == 4 {
                *node = 45 + *node / 9;
            }
        };
        let right = mesh.quads.iter_mut().filter(|quad| quad[0] % 9 >= 4);
        right.flatten().for_each(own);
        bottom.iter_mut().filter(|edge| edge[0] % 9 >= 4).flatten().for_each(own);
        let copies: Vec<_> = (0..5).map(|row| mesh.vertices[middle(row) as usize]).collect();
        mesh.vertices.extend(copies);
    }
    let curve = |name: &str, edges| Curve { name: name.to_owned(), edges };
    mesh.curves = vec![curve("sides", sides), curve("bottom", bottom), curve("drain", drain)];
    mesh
}

/// A folder with the scene, and the path of that.
fn folder(scene: &str, merged: bool) -> (Folder, String) {
    let folder = Folder::new();
    folder.write("plate.msh", write::text(&mesh(merged)));
    let path = folder.write("plate.toml", scene);
    (folder, path)
}

/// The warnings in the summary of a solve, and its standard error.
fn solved(scene: &str, merged: bool) -> (Vec<String>, String) {
    let (folder, path) = folder(scene, merged);
    let (run, summary) = folder.solve(&path, &[]);
    let list = summary["warnings"].as_array().expect("a list");
    let list = list.iter().map(|text| text.as_str().expect("a sentence").to_owned());
    (list.collect(), run.succeeds().stderr)
}

#[test]
fn a_slit_is_said_by_solve_and_stands_in_its_summary() {
    let (warnings, said) = solved(SCENE, false);
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].starts_with("8 boundary edges lie on others without being joined"));
    assert!(warnings[0].contains("all between (0, 0) and (0, 1)"), "{warnings:?}");
    assert_eq!(said, format!("warning: {}\n", warnings[0]));
    assert_eq!(solved(SCENE, true), (Vec::new(), String::new()));
}

#[test]
fn every_command_on_a_mesh_says_it_once() {
    let text = SCENE.replace("= \"f64\"", "= \"f64\"\nsetting.model = \"condensed\"");
    let (_plain, plain) = folder(SCENE, false);
    let (folder, condensed) = folder(&text, false);
    let [rust, out] = ["a.rs", "out"].map(|name| folder.word(name));
    for arguments in [
        &["tick", &plain, "--ticks", "2", "--out", &out][..],
        &["bake", &condensed, "-o", &rust],
        &["trade", &condensed, "--no-peers", "--out", &out],
    ] {
        let said = run(arguments).succeeds().stderr;
        let count = said.matches("lie on others without being joined").count();
        assert_eq!(count, 1, "{arguments:?}: {said}");
    }
}

#[test]
fn data_that_depend_on_t_are_those_of_0_and_solve_says_so() {
    let (warnings, said) = solved(&SCENE.replace("value = \"1\"", "value = \"1 + t\""), true);
    let expected = "boundary.sides.value = \"1 + t\" depends on t: all data are those of t = 0";
    assert!(warnings.len() == 1 && warnings[0].starts_with(expected), "{warnings:?}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

#[test]
fn a_condition_inside_ends_with_status_2_file_line_and_hint() {
    let drain = "boundary.drain = { kind = \"dirichlet\", value = \"0\" }\nboundary.default";
    for setting in ["", "setting.refine = 1\n", "setting.cells = \"triangles\"\n"] {
        let scene = SCENE.replace("boundary.default", drain);
        let (_folder, path) = folder(&(scene + setting), true);
        let said = refused("solve", &path, &[]);
        let culprit = "plate.toml:5: boundary.drain: ";
        says_of(setting, &said, &[culprit, "inside the domain", "Crack", "remove the table"]);
    }
}

//! Files that Gmsh 4.15.2 wrote (`tests/fixtures/gmsh/generate.py`): an L of area 3.

use signorini_tolerances::scene::{DIGITS, MEASURE};
use std::path::Path;

use crate::mesh::tests::{area, measures, points};
use crate::mesh::{Mesh, read};

const KINDS: [&str; 2] = ["triangles", "mixed"];
const VARIANTS: [&str; 4] = ["2.2-ascii", "2.2-binary", "4.1-ascii", "4.1-binary"];

fn path(kind: &str, variant: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fixtures/gmsh");
    folder.join(format!("{kind}-{variant}.msh"))
}

#[test]
fn areas_lengths_and_names() {
    let expected = [
        ("domain", 3.0),
        ("sand", 1.0),
        ("contact zone", 3.0),
        ("dirichlet \"ü\"", 1.0),
        ("7", 1.0),
        ("", 3.0),
    ];
    for (kind, variant) in KINDS.iter().flat_map(|kind| VARIANTS.map(|variant| (kind, variant))) {
        let mesh = read(&path(kind, variant)).unwrap();
        assert_eq!(mesh.quads.is_empty(), *kind == "triangles");
        assert!(mesh.corners().all(|cell| area(&points(&mesh, cell)) > 0.0));
        let found = measures(&mesh);
        assert_eq!(found.len(), expected.len(), "{kind} {variant}");
        for ((name, size), expected) in found.iter().zip(expected) {
            assert_eq!(name, expected.0);
            MEASURE.check(format_args!("{kind} {variant} {name}"), size - expected.1);
        }
    }
}

#[test]
fn encodings_agree() {
    for kind in KINDS {
        let [text22, binary22, text41, binary41] =
            VARIANTS.map(|variant| read(&path(kind, variant)).unwrap());
        // Gmsh prints 16 digits: coordinates differ in the last one.
        let topology = |mesh: &Mesh| Mesh { vertices: Vec::new(), ..mesh.clone() };
        assert_eq!(topology(&text22), topology(&binary22));
        assert_eq!(topology(&text41), topology(&binary41));
        assert_eq!(text22.vertices, text41.vertices);
        let [text, binary] = [&text22, &binary41].map(|mesh| mesh.vertices.as_flattened());
        DIGITS.check_each(kind, text, binary);
    }
}

/// The bytes of every file.
pub(super) fn files() -> impl Iterator<Item = Vec<u8>> {
    let paths = KINDS.iter().flat_map(|kind| VARIANTS.map(|variant| path(kind, variant)));
    paths.map(|path| std::fs::read(path).unwrap())
}

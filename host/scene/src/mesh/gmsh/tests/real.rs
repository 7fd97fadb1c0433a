//! Files that Gmsh 4.15.2 wrote (`tests/fixtures/gmsh/generate.py`): an L of area 3.

use signorini_tolerances::scene::{DIGITS, MEASURE};
use std::path::Path;

use super::says_what_is_missing;
use crate::mesh::{Mesh, read};

const KINDS: [&str; 2] = ["triangles", "mixed"];
const VARIANTS: [&str; 4] = ["2.2-ascii", "2.2-binary", "4.1-ascii", "4.1-binary"];

fn path(kind: &str, variant: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fixtures/gmsh");
    folder.join(format!("{kind}-{variant}.msh"))
}

fn cell(mesh: &Mesh, cell: u32) -> &[u32] {
    let cell = cell as usize;
    match mesh.triangles.get(cell) {
        Some(triangle) => triangle,
        None => &mesh.quads[cell - mesh.triangles.len()],
    }
}

/// The signed area by Gauss's formula.
fn area(mesh: &Mesh, corners: &[u32]) -> f64 {
    let point = |k: usize| mesh.vertices[corners[k % corners.len()] as usize];
    let wedge = |k| point(k)[0] * point(k + 1)[1] - point(k)[1] * point(k + 1)[0];
    (0..corners.len()).map(wedge).sum::<f64>() / 2.0
}

fn length(mesh: &Mesh, edges: &[[u32; 2]]) -> f64 {
    let ends = |edge: &[u32; 2]| edge.map(|vertex| mesh.vertices[vertex as usize]);
    edges.iter().map(ends).map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1])).sum()
}

#[test]
fn areas_lengths_and_names() {
    for (kind, variant) in KINDS.iter().flat_map(|kind| VARIANTS.map(|variant| (kind, variant))) {
        let mesh = read(&path(kind, variant)).unwrap();
        let cells = (mesh.triangles.len() + mesh.quads.len()) as u32;
        assert_eq!(mesh.quads.is_empty(), *kind == "triangles");
        assert!((0..cells).all(|c| area(&mesh, cell(&mesh, c)) > 0.0));
        let surfaces: Vec<_> = mesh
            .surfaces
            .iter()
            .map(|s| (&*s.name, s.cells.iter().map(|&c| area(&mesh, cell(&mesh, c))).sum::<f64>()))
            .collect();
        let curves: Vec<_> =
            mesh.curves.iter().map(|c| (&*c.name, length(&mesh, &c.edges))).collect();
        let close = |found: &[(&str, f64)], expected: &[(&str, f64)]| {
            assert_eq!(found.len(), expected.len(), "{kind} {variant}");
            for (found, expected) in found.iter().zip(expected) {
                assert_eq!(found.0, expected.0);
                MEASURE.check(format_args!("{kind} {variant} {found:?}"), found.1 - expected.1);
            }
        };
        close(&surfaces, &[("domain", 3.0), ("sand", 1.0)]);
        close(&curves, &[("contact zone", 3.0), ("dirichlet \"ü\"", 1.0), ("7", 1.0)]);
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

#[test]
fn every_truncation_is_an_error() {
    for (kind, variant) in KINDS.iter().flat_map(|kind| VARIANTS.map(|variant| (kind, variant))) {
        let file = std::fs::read(path(kind, variant)).unwrap();
        for length in 0..file.trim_ascii_end().len() {
            says_what_is_missing(&file, length);
        }
    }
}

//! Files that are read, with the mesh written out by hand.

use super::encode::{CODINGS, Coding, Model};
use super::mesh;
use crate::mesh::{Curve, Mesh, Surface};

/// A clockwise quad and a triangle, sparse node tags in no order, an unused node, a point, groups
/// that share cells, edges and numbers.
pub(super) fn model() -> Model {
    let nodes = [
        (10, [0.0, 0.0]),
        (7, [1.0, 0.0]),
        (5, [9.0, 9.0]),
        (1_000_000_000, [1.0, 1.0]),
        (4, [0.0, 1.0]),
        (99, [2.0, 0.5]),
    ];
    Model {
        names: vec![(0, 1, "a point"), (1, 1, "contact zone"), (2, 1, "dirichlet \"ü\"")],
        nodes: nodes.map(|(tag, [x, y])| (tag, [x, y, 0.5])).to_vec(),
        elements: vec![
            (1, 15, vec![1], vec![10]),
            (2, 1, vec![1, 8], vec![7, 10]),
            (3, 1, vec![1], vec![4, 10]),
            (4, 1, vec![], vec![5, 10]),
            (5, 3, vec![1, 3], vec![10, 4, 1_000_000_000, 7]),
            (6, 2, vec![1], vec![7, 99, 1_000_000_000]),
        ],
    }
}

fn expected() -> Mesh {
    let surface = |name: &str, cells: &[u32]| Surface { name: name.into(), cells: cells.into() };
    let curve = |name: &str, edges: &[_]| Curve { name: name.into(), edges: edges.into() };
    Mesh {
        vertices: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.5]],
        triangles: vec![[1, 4, 2]],
        quads: vec![[0, 1, 2, 3]],
        surfaces: vec![surface("dirichlet \"ü\"", &[0, 1]), surface("3", &[1])],
        curves: vec![curve("contact zone", &[[0, 1], [0, 3]]), curve("8", &[[0, 1]])],
    }
}

#[test]
fn both_formats_in_every_encoding() {
    for coding in CODINGS {
        assert_eq!(mesh(&model().v22(coding)), expected(), "2.2 {coding:?}");
        assert_eq!(mesh(&model().v41(coding)), expected(), "4.1 {coding:?}");
    }
}

fn ascii22() -> String {
    String::from_utf8(model().v22(Coding::Ascii)).unwrap()
}

fn ascii41() -> String {
    String::from_utf8(model().v41(Coding::Ascii)).unwrap()
}

/// The mark that Notepad and its like put before a text; who saves a binary file so has changed nothing else.
#[test]
fn a_byte_order_mark_is_passed_over() {
    for coding in CODINGS {
        for file in [model().v22(coding), model().v41(coding)] {
            assert_eq!(mesh(&[b"\xef\xbb\xbf", &file[..]].concat()), expected(), "{coding:?}");
        }
    }
    let wrong = ascii22().replace("7 1 0 0.5", "7 1 zero 0.5");
    let said = super::error(format!("\u{feff}{wrong}").as_bytes());
    assert_eq!(said, "13: expected a coordinate, found `zero`");
}

/// 2.1 is 2.2; 2.0 too, but that its names have no dimension.
#[test]
fn older_formats() {
    for coding in CODINGS {
        let with = |version: &str| {
            let file = model().v22(coding);
            let old = b"2.2";
            let at = file.windows(old.len()).position(|part| part == old).expect("a version");
            [&file[..at], version.as_bytes(), &file[at + old.len()..]].concat()
        };
        assert_eq!(mesh(&with("2.1")), expected(), "{coding:?}");
        for version in ["2", "2.0"] {
            assert_eq!(mesh(&with(version)), expected(), "{version} {coding:?}");
        }
    }
    let bare = Model { names: vec![], ..model() };
    let text = String::from_utf8(bare.v22(Coding::Ascii)).unwrap().replace("2.2 0 8", "2 0 8");
    let named = |names: &str| {
        let section = format!("$PhysicalNames\n{names}$EndPhysicalNames");
        text.replace("$PhysicalNames\n0\n$EndPhysicalNames", &section)
    };
    let mesh = mesh(named("2\n8 \"wall\"\n3 \"left half\"\n").as_bytes());
    assert_eq!(names(mesh), ["1", "left half", "1", "wall"]);
    let said = super::error(named("2\n8 \"wall\"\n8 \"half\"\n").as_bytes());
    assert!(said.contains("physical group 8 of dimension 0 is named twice"), "{said}");
    let said = super::error(named("1\n8 \"wall\"\n").replace("2 0 8", "2.1 0 8").as_bytes());
    assert!(said.contains("expected a physical name: dimension, tag"), "{said}");
}

#[test]
fn tags_above_31_bits() {
    let text = ascii22().replace("1000000000", "4000000007").replace("\n99 ", "\n9000000000 ");
    assert_eq!(mesh(text.replace("7 99 ", "7 9000000000 ").as_bytes()), expected());
    let text = ascii41().replace("1000000000", "18000000000000000007");
    assert_eq!(mesh(text.as_bytes()), expected());
}

#[test]
fn line_ends_and_blanks_do_not_matter() {
    for text in [ascii22(), ascii41()] {
        assert_eq!(mesh(text.replace('\n', "\r\n").as_bytes()), expected());
        assert_eq!(mesh(text.replace('\n', " \t\n\n").as_bytes()), expected());
        assert_eq!(mesh(text.trim_end().as_bytes()), expected());
        assert_eq!(mesh((text + "\n \r\n").as_bytes()), expected());
    }
}

#[test]
fn sections_in_another_order_and_unknown_ones() {
    for text in [ascii22(), ascii41()] {
        let (head, tail) = text.split_at(text.find("$PhysicalNames").unwrap());
        let mut sections: Vec<String> = Vec::new();
        for line in tail.split_inclusive('\n') {
            match sections.last_mut() {
                Some(open) if !line.starts_with('$') || line.starts_with("$End") => *open += line,
                _ => sections.push(line.to_owned()),
            }
        }
        assert!(sections.len() >= 3);
        sections.reverse();
        let unknown = "$Comments\n$Nodes, of course\n$EndComments\n$Periodic\n0\n$EndPeriodic\n";
        let text = format!("$A\n$EndA\n{head}{}{unknown}", sections.join(unknown));
        assert_eq!(mesh(text.as_bytes()), expected());
    }
}

/// The names of surfaces, then of curves.
fn names(mesh: Mesh) -> Vec<String> {
    let surfaces = mesh.surfaces.into_iter().map(|surface| surface.name);
    surfaces.chain(mesh.curves.into_iter().map(|curve| curve.name)).collect()
}

#[test]
fn without_names_groups_go_by_number() {
    let unnamed = Model { names: Vec::new(), ..model() };
    assert_eq!(names(mesh(&unnamed.v22(Coding::Ascii))), ["1", "3", "1", "8"]);
    assert_eq!(names(mesh(&unnamed.v41(Coding::Big))), ["1", "3", "1", "8"]);
}

#[test]
fn without_entities_format_41_has_no_groups() {
    let text = ascii41();
    let (start, end) = (text.find("$Entities").unwrap(), text.find("$Nodes").unwrap());
    let bare = mesh(format!("{}{}", &text[..start], &text[end..]).as_bytes());
    assert_eq!(bare, Mesh { surfaces: vec![], curves: vec![], ..expected() });
}

#[test]
fn a_line_listed_twice_and_a_line_inside_are_fine() {
    let mut model = model();
    model.elements.push((9, 1, vec![1], vec![10, 7]));
    model.elements.push((10, 1, vec![6], vec![1_000_000_000, 7]));
    let mesh = mesh(&model.v22(Coding::Little));
    assert_eq!(mesh.curves[0], expected().curves[0]);
    assert_eq!((&*mesh.curves[1].name, &mesh.curves[1].edges), ("6", &vec![[1, 2]]));
}

#[test]
fn two_vertices_in_one_place_are_a_crack() {
    let mut model = model();
    model.nodes.push((100, [1.0, 0.0, 0.5]));
    model.elements[5].3[0] = 100;
    assert_eq!(mesh(&model.v41(Coding::Ascii)).vertices.len(), 6);
}

#[test]
fn noise_in_z_is_no_other_plane() {
    let mut model = model();
    model.nodes[0].1[2] += 1e-12;
    model.nodes[2].1[2] = 70.0; // unused
    assert_eq!(mesh(&model.v22(Coding::Big)), expected());
}

/// The plate and the fin of [`model`] with a curve along `nodes`, whatever a scene makes of it.
fn with_drain(nodes: &[[i32; 2]]) -> Vec<Mesh> {
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
        let meshes = with_drain(nodes);
        for mesh in &meshes {
            let drain = mesh.curves.iter().find(|curve| curve.name == "drain").expect("the drain");
            assert_eq!(drain.edges.len(), nodes.len());
            assert_eq!(mesh, &meshes[0]);
        }
    }
}

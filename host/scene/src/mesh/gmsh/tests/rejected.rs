//! Files that are refused, with the message a user reads.

use std::path::Path;

use super::encode::{CODINGS, Coding, Model};
use super::error;
use super::valid::model;

/// The message about a model that was spoilt, without the place in the file, which each encoding
/// must give.
fn refusal(spoil: impl Fn(&mut Model)) -> String {
    let mut model = model();
    spoil(&mut model);
    let messages: Vec<_> = CODINGS
        .iter()
        .flat_map(|&coding| [(coding, model.v22(coding)), (coding, model.v41(coding))])
        .map(|(coding, bytes)| {
            let text = error(&bytes);
            let text = if coding == Coding::Ascii { &text } else { &text["byte ".len()..] };
            let (place, message) = text.split_once(": ").expect("a line or a byte");
            assert!(place.parse::<u32>().is_ok_and(|place| place > 1), "{text}");
            message.to_owned()
        })
        .collect();
    assert!(messages.iter().all(|message| *message == messages[0]), "{messages:#?}");
    messages[0].clone()
}

#[test]
fn elements_of_other_kinds() {
    let kind =
        |code, nodes: i32| refusal(|m| m.elements[5] = (6, code, vec![1], (1..=nodes).collect()));
    let expected = "expected a 3-node triangle, a 4-node quad, a 2-node line or a point";
    let second = "element 6 is a triangle of second order (type 9)";
    assert_eq!(kind(9, 6), format!("{second}, {expected}"));
    assert_eq!(kind(4, 4), format!("element 6 is a tetrahedron (type 4), {expected}"));
    assert_eq!(kind(250, 3), format!("element 6 is of an unknown kind (type 250), {expected}"));
}

#[test]
fn cells_out_of_shape() {
    let quad = |nodes: [[f64; 2]; 4]| {
        refusal(|m| {
            let places = [10, 7, 1_000_000_000, 4];
            m.elements[4].3 = places.to_vec();
            for (tag, [x, y]) in places.into_iter().zip(nodes) {
                let node = m.nodes.iter_mut().find(|node| node.0 == tag).unwrap();
                node.1 = [x, y, 0.5];
            }
        })
    };
    let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert_eq!(quad([a, b, d, c]), "quad 5 crosses itself");
    let straight = "quad 5 has an angle of 180° at node 7";
    assert_eq!(quad([a, [0.5, 0.0], b, d]), straight);
    let reflex = "quad 5 is not convex: it has an angle of more than 180° at node 1000000000";
    assert_eq!(quad([a, b, [0.2, 0.2], d]), reflex);
    let degenerate = "quad 5 is degenerate: it has no area, or two corners in one place";
    assert_eq!(quad([a, a, c, d]), degenerate);
}

/// Something done to a model.
type Spoil = fn(&mut Model);

/// A change of the model, and the message about it.
#[rustfmt::skip] // A table.
const SPOILT: &[(Spoil, &str)] = &[
    (|m| m.nodes[5].1 = [1.0, 0.5, 0.5], "triangle 6 is degenerate: it has no area, or two corners in one place"),
    (|m| m.elements[5].3[2] = 99, "triangle 6 has the corner node 99, and that twice"),
    (|m| m.elements[5].3[2] = 98, "triangle 6 has the corner node 98, which is not in the file"),
    (|m| m.nodes[2].0 = 10, "node 10 is listed twice"),
    (|m| m.nodes[1].1[1] = f64::NAN, "node 7 has the coordinate NaN"),
    (|m| m.nodes[1].1[2] = f64::INFINITY, "node 7 has the coordinate inf"),
    (|m| m.nodes[5].1[2] = 0.6, "node 99 has z = 0.6, node 10 has z = 0.5, expected a mesh in a plane z = constant"),
    (|m| m.elements.push((7, 2, vec![1], vec![99, 7, 1_000_000_000])), "duplicate cell: triangle 7 repeats triangle 6"),
    (|m| m.elements.push((8, 2, vec![1], vec![10, 7, 99])),
        "triangle 8 and quad 5 overlap: both lie on the same side of the edge from node 10 to node 7"),
    (|m| m.elements.push((9, 2, vec![1], vec![7, 1_000_000_000, 4])),
        "triangle 6, triangle 9 and quad 5 share the edge from node 7 to node 1000000000, expected two at most"),
    (|m| m.elements[2].3 = vec![4, 7], "line 3, nodes 4 and 7, is no edge of a cell"),
    (|m| m.elements[2].3 = vec![4, 5], "line 3, nodes 4 and 5, is no edge of a cell"),
];

#[test]
fn models_that_are_spoilt_are_refused_by_their_culprit() {
    for (spoil, message) in SPOILT {
        assert_eq!(refusal(spoil), *message);
    }
    let ungrouped = refusal(|m| {
        m.elements[5].2.clear();
        m.elements.push((7, 2, vec![], vec![99, 1_000_000_000, 7]));
    });
    assert_eq!(ungrouped, "duplicate cell: triangle 7 repeats triangle 6");
}

/// The message about the ASCII file of format 2.2 after a replacement in its text.
fn edited(from: &str, to: &str) -> String {
    let text = String::from_utf8(model().v22(Coding::Ascii)).unwrap();
    assert!(text.contains(from));
    error(text.replacen(from, to, 1).as_bytes())
}

#[test]
fn texts_name_the_line() {
    #[rustfmt::skip] // A table.
    let cases = [
        ("2.2 0 8", "3 0 8", "2: format 3 is not read"),
        ("2.2 0 8", "2.2 2 8", "2: expected 0 (ASCII) or 1 (binary) after the version"),
        ("2.2 0 8", "2.2 0 4", "2: expected a version, 0 or 1, and 8"),
        ("1 1 \"contact zone\"", "1 1 contact", "7: expected a physical name: dimension, tag and the name in quotes"),
        ("1 1 \"c", "0 1 \"c", "7: physical group 1 of dimension 0 is named twice"),
        ("$Nodes\n6", "$Nodes\n7", "18: expected a node tag, found `$EndNodes`"),
        ("$Nodes\n6", "$Nodes\n5", "17: expected `$EndNodes`, found `99 2 0.5 0.5`"),
        ("$Nodes\n6", "$Nodes\n-6", "11: expected the number of nodes, found `-6`"),
        ("7 1 0 0.5", "4000000000000000000000 1 0 0.5", "13: a node tag is too large: `4000000000000000000000`"),
        ("7 1 0 0.5", "-7 1 0 0.5", "13: expected a node tag, found `-7`"),
        ("7 1 0 0.5", "7 1 0", "13: expected a coordinate, found nothing"),
        ("7 1 0 0.5", "7 1 0 0.5 3", "13: expected the end of the line, found `3`"),
        ("7 1 0 0.5", "7 1 1e999 0.5", "13: node 7 has the coordinate inf"),
        ("7 1 0 0.5", "7 1 zero 0.5", "13: expected a coordinate, found `zero`"),
        ("6 2 2 1 1 7 99", "6 2 2 1 1 99", "28: expected a node tag, found nothing"),
        ("6 2 2 1 1 7 99", "6 2 99 1 1 7 99", "28: expected a tag of the element, found nothing"),
        ("6 2 2 1 1 7", "6 2 2 3000000000 1 7", "28: a tag of the element is too large: `3000000000`"),
        ("$EndElements", "$EndNodes", "29: expected `$EndElements`, found `$EndNodes`"),
        ("$EndElements\n", "$EndElements\njunk\n", "30: expected the beginning of a section, like `$Nodes`, found `junk`"),
        ("$EndElements\n", "$EndElements\n$Odd\n", "30: the section `Odd` is never closed"),
        ("$PhysicalNames", "$MeshFormat", "4: a second section $MeshFormat"),
    ];
    for (from, to, message) in cases {
        assert_eq!(edited(from, to), message);
    }
}

#[test]
fn sections_that_are_missing_or_come_twice() {
    let without = |name: &str| edited(&format!("${name}\n"), "$Odd\n").contains("never closed");
    assert!(["Nodes", "Elements", "PhysicalNames"].iter().all(|name| without(name)));
    let text = String::from_utf8(model().v41(Coding::Ascii)).unwrap();
    let (head, rest) = text.split_at(text.find("$Nodes").unwrap());
    let (nodes, elements) = rest.split_at(rest.find("$Elements").unwrap());
    let refused = |parts: &[&str]| error(parts.concat().as_bytes());
    assert_eq!(refused(&[head, elements]), "expected a section $Nodes, found none");
    assert_eq!(refused(&[head, nodes]), "expected a section $Elements, found none");
    assert!(refused(&[head, nodes, nodes, elements]).ends_with("a second section $Nodes"));
    assert!(refused(&[nodes]).starts_with("the file is of no known kind, expected a Gmsh mesh"));
    let partitioned = refused(&[head, "$PartitionedEntities\n0\n$EndPartitionedEntities\n"]);
    assert!(partitioned.ends_with("the mesh is partitioned, expected it in one piece"));
}

#[test]
fn format_41_must_agree_with_itself() {
    let text = String::from_utf8(model().v41(Coding::Ascii)).unwrap();
    let edited = |from: &str, to: &str| {
        assert!(text.contains(from));
        let message = error(text.replacen(from, to, 1).as_bytes());
        message.split_once(": ").unwrap().1.to_owned()
    };
    let unlisted = "triangle 6 is in entity 60 of dimension 2, which is not listed";
    for (from, to, message) in [
        ("2 6 1 9", "2 5 1 9", "5 nodes are announced, the blocks hold 6"),
        ("2 6 2 1 \n", "1 6 2 1 \n", "element 6, a triangle, in an entity of dimension 1"),
        ("2 6 2 1 \n", "2 60 2 1 \n", unlisted),
        ("2 1 1 3", "2 1 2 3", "dimension 2, parametric 2: no such nodes"),
    ] {
        assert_eq!(edited(from, to), message);
    }
}

#[test]
fn two_groups_of_one_name_and_a_mesh_of_lines_only() {
    let mut named = model();
    named.names.push((1, 8, "contact zone"));
    assert_eq!(error(&named.v22(Coding::Ascii)), "two physical curves are called `contact zone`");
    let mut lines = model();
    lines.elements.truncate(3);
    assert_eq!(error(&lines.v41(Coding::Little)), "the mesh has no triangle and no quad");
}

#[test]
fn what_is_no_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    for path in [folder.to_owned(), folder.join("absent.msh")] {
        let refused = crate::mesh::read(&path).unwrap_err();
        assert_eq!(refused.exit_status(), 2);
        assert!(refused.to_string().starts_with(&path.display().to_string()));
    }
}

/// Files that are taken for a mesh, and a part of the message.
#[rustfmt::skip]
const OTHERS: &[(&[u8], &str)] = &[
    (b"$NOD\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$ENDNOD\n$ELM\n1\n1 2 0 1 3 1 2 3\n$ENDELM\n", "a Gmsh mesh of format 1"),
    (b"<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">", "a VTK file"),
    (b"<VTKFile type=\"UnstructuredGrid\">", "a VTK file"),
    (b"<?xml version=\"1.0\"?>\n<X3D>", "an XML file"),
    (b"# vtk DataFile Version 3.0\n", "a VTK file"),
    (b"solid part\n facet normal 0 0 1\n", "an STL surface"),
    (&[0; 84], "an STL surface"),
    (b"// a plate\nh = 0.1;\nPoint(1) = {0, 0, 0, h};\n", "a Gmsh geometry"),
    (b"\x89HDF\r\n\x1a\n", "an HDF5 file (MED"),
    (b"\x1f\x8b\x08\x00", "compressed by gzip"),
    (b"PK\x03\x04", "a ZIP archive"),
    (b"\xff\xfe$\x00M\x00e\x00", "a text in UTF-16"),
    (b"", "empty"),
    (b" \n\n", "empty"),
    (b"\xff\x00garbage", "of no known kind"),
    (b"MeshVersionFormatted 2\n", "a Medit mesh"),
    (b"*Heading\n Gmsh\n*NODE\n", "an Abaqus mesh"),
    (b"$ Created by Gmsh\nGRID,1\n", "a Nastran mesh"),
    (b"title = \"bar\"\nmesh = \"bar.msh\"\n\n[material.default]\n", "a scene"),
];

#[test]
fn other_files_are_named_as_what_they_are() {
    for (bytes, what) in OTHERS {
        let message = error(bytes);
        assert!(message.starts_with(&format!("the file is {what}")), "{message}");
        assert!(message.ends_with("expected a Gmsh mesh (MSH 2.0 to 2.2, or 4.1)"), "{message}");
    }
    // A comment of Gmsh's may speak of anything.
    let text = String::from_utf8(model().v22(Coding::Ascii)).unwrap();
    let comment = format!("$Comments\nPoint(1) = {{}};\n$EndComments\n{text}");
    assert!(crate::mesh::parse(comment.as_bytes()).is_ok());
}

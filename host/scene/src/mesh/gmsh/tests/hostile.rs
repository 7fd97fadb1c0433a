//! Damaged and malicious files: an error at once, never a panic, no memory beyond the file's size.

use std::time::{Duration, Instant};

use super::encode::{CODINGS, Coding};
use super::error;
use super::valid::model;
use crate::mesh::parse;
use crate::mesh::tests::Draw;

fn files() -> Vec<Vec<u8>> {
    CODINGS.iter().flat_map(|&coding| [model().v22(coding), model().v41(coding)]).collect()
}

/// The error of a file that is cut off says what is missing.
#[test]
fn every_truncation_is_an_error() {
    for file in files().into_iter().chain(super::real::files()) {
        for length in 0..file.trim_ascii_end().len() {
            let said = error(&file[..length]);
            let words = ["expected", "is never closed", "at most can follow"];
            let missing = words.iter().any(|words| said.contains(words));
            assert!(missing, "cut at {length} of {}: {said}", file.len());
        }
    }
}

#[test]
fn no_damage_makes_it_panic() {
    let mut draw = Draw(0);
    let mut random = |below: usize| draw.below(below);
    for file in files() {
        for _ in 0..4_000 {
            let mut damaged = file.clone();
            for _ in 0..=random(3) {
                let at = random(damaged.len());
                damaged[at] = match random(3) {
                    0 => damaged[at] ^ (1 << random(8)),
                    1 => b"0123456789 \n-+.e$\"\0\xff"[random(20)],
                    _ => file[random(file.len())],
                };
            }
            if let Ok(mesh) = parse(&damaged) {
                assert!(mesh.vertices.iter().flatten().all(|x| x.is_finite()));
            }
        }
    }
}

#[test]
fn counts_beyond_the_file() {
    let text = String::from_utf8(model().v41(Coding::Ascii)).unwrap();
    for huge in ["4611686018427387904", "18446744073709551615", "1000000"] {
        for (from, what) in [
            ("$PhysicalNames\n3", "names"),
            ("$Entities\n1", "entities"),
            ("$Nodes\n2", "blocks"),
            ("$Nodes\n2 6", "nodes"),
            ("1 1 1 3", "nodes in a block"),
            ("$Elements\n6", "blocks"),
            ("$Elements\n6 6", "elements"),
            ("2 6 2 1", "elements in a block"),
        ] {
            let to = format!("{} {huge}", from.rsplit_once([' ', '\n']).unwrap().0);
            let to = if from.contains(' ') { to } else { to.replace(' ', "\n") };
            let message = error(text.replacen(from, &to, 1).as_bytes());
            assert!(message.contains(&format!("{what}: {huge} are announced")), "{message}");
        }
    }
}

#[test]
fn binary_counts_beyond_the_file() {
    let mut file = model().v41(Coding::Little);
    let nodes = file.windows(7).position(|bytes| bytes == b"$Nodes\n").unwrap() + 7;
    file[nodes + 8..nodes + 16].copy_from_slice(&(1_u64 << 62).to_le_bytes());
    assert!(error(&file).contains("4611686018427387904 are announced"));
    let mut file = model().v22(Coding::Big);
    let elements = file.windows(12).position(|bytes| bytes == b"$Elements\n8\n").unwrap() + 12;
    file[elements + 8..elements + 12].copy_from_slice(&i32::MAX.to_be_bytes());
    assert!(error(&file).contains("expected"));
}

#[test]
fn many_elements_in_many_groups_are_refused() {
    // A strip of triangles in one entity of format 4.1.
    let strip = |cells: usize, groups: usize| {
        let tags: String = (1..=groups).map(|tag| format!("{tag} ")).collect();
        let mut text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n".to_owned();
        let nodes = cells + 2;
        text += &format!("7 0 0 0 1 1 1 {groups} {tags}0\n$EndEntities\n");
        text += &format!("$Nodes\n1 {nodes} 1 {nodes}\n2 7 0 {nodes}\n");
        (1..=nodes).for_each(|tag| text += &format!("{tag}\n"));
        (0..nodes).for_each(|at| text += &format!("{at} {} 0\n", at % 2));
        text += &format!("$EndNodes\n$Elements\n1 {cells} 1 {cells}\n2 7 2 {cells}\n");
        (1..=cells).for_each(|at| text += &format!("{at} {at} {} {}\n", at + 1, at + 2));
        text + "$EndElements\n"
    };
    assert_eq!(super::mesh(strip(300, 5).as_bytes()).surfaces.len(), 5);
    let message = error(strip(300, 300).as_bytes());
    assert!(message.contains("physical groups together"), "{message}");
}

#[test]
fn what_is_no_mesh() {
    let in_comment = "$A\n$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$EndA\n";
    assert_eq!(error(in_comment.as_bytes()), "expected a Gmsh mesh, found no `$MeshFormat`");
    assert!(error(&[b'a'; 100_000]).len() < 200);
    assert!(error(&[b"$", &[b'a'; 100_000][..]].concat()).len() < 200);
}

#[test]
fn time_is_linear_in_hostile_files() {
    let start = Instant::now();
    let head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    let fan: u32 = 200_000;
    let mut text = format!("{head}$Nodes\n{}\n1 0 0 0\n", fan + 1);
    for k in 0..fan {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / f64::from(fan)).sin_cos();
        text += &format!("{} {cos} {sin} 0\n", 1_000 * u64::from(k) + 2_000);
    }
    text += &format!("$EndNodes\n$Elements\n{fan}\n");
    for k in 0..fan {
        let node = |k: u32| 1_000 * (k % fan) + 2_000;
        text += &format!("{} 2 1 1 1 {} {}\n", k + 1, node(k), node(k + 1));
    }
    text += "$EndElements\n";
    assert_eq!(super::mesh(text.as_bytes()).triangles.len(), fan as usize);
    let sections = "$A\n$EndA\n".repeat(200_000);
    assert!(error(sections.as_bytes()).contains("of no known kind"));
    let markers = format!("{head}$A\n{}", "$EndB\n".repeat(200_000));
    assert!(error(markers.as_bytes()).contains("is never closed"));
    assert!(start.elapsed() < Duration::from_secs(20));
}

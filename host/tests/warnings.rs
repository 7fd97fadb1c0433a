//! What is no error but may not be meant: once on standard error, and in the summary.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Exit status and standard error of `signorini`.
fn signorini(arguments: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_signorini")).args(arguments).output();
    let output = output.expect("the binary runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!said.contains("panicked"), "{said}");
    (output.status.code().unwrap_or(-1), said)
}

const SCENE: &str = r#"mesh = "plate.msh"
[material.default]
conductivity = "1"
[boundary.sides]
kind = "dirichlet"
value = "1"
[boundary.bottom]
kind = "contact"
[boundary.default]
kind = "neumann"
flux = "0"
[setting]
scalar = "f64"
"#;

/// (0, 2) × (0, 1) in 2n × n squares; the line x = 1 is the curve `drain`, or torn where nodes are not `merged`.
fn mesh(n: usize, merged: bool) -> String {
    let width = 2 * n + 2;
    // Column n + 1 has the nodes that the right half has of its own on x = 1.
    let node = |column: usize, row: usize| row * width + column + 1;
    let right = if merged { n } else { n + 1 };
    let mut elements = Vec::new();
    for i in (0..n).chain(n + 1..width - 1) {
        let from = if i == n + 1 { right } else { i };
        elements.push(format!("1 2 2 2 {} {}", node(from, 0), node(i + 1, 0)));
        for j in 0..n {
            let corners = [node(from, j), node(i + 1, j), node(i + 1, j + 1), node(from, j + 1)];
            elements.push(format!("3 2 9 9 {}", corners.map(|node| node.to_string()).join(" ")));
        }
    }
    for j in 0..n {
        for column in [0, width - 1] {
            elements.push(format!("1 2 1 1 {} {}", node(column, j), node(column, j + 1)));
        }
        elements.push(format!("1 2 3 3 {} {}", node(n, j), node(n, j + 1)));
    }
    let names = "3\n1 1 \"sides\"\n1 2 \"bottom\"\n1 3 \"drain\"\n";
    let mut text =
        format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{names}$EndPhysicalNames\n");
    text += &format!("$Nodes\n{}\n", width * (n + 1));
    for (row, column) in (0..=n).flat_map(|row| (0..width).map(move |column| (row, column))) {
        let x = (if column > n { column - 1 } else { column }) as f64 / n as f64;
        text += &format!("{} {x} {} 0\n", node(column, row), row as f64 / n as f64);
    }
    text += &format!("$EndNodes\n$Elements\n{}\n", elements.len());
    for (at, element) in elements.iter().enumerate() {
        text += &format!("{} {element}\n", at + 1);
    }
    text + "$EndElements\n"
}

fn folder(scene: &str, merged: bool) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("plate.msh"), mesh(4, merged)).expect("a mesh");
    let path = folder.path().join("plate.toml");
    std::fs::write(&path, scene).expect("a scene");
    (folder, path)
}

fn written(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// The warnings in the summary of a solve, and its standard error.
fn solved(scene: &str, merged: bool) -> (Vec<String>, String) {
    let (folder, path) = folder(scene, merged);
    let out = folder.path().join("out");
    let (status, said) = signorini(&["solve", written(&path), "--out", written(&out)]);
    assert_eq!(status, 0, "{said}");
    let summary = std::fs::read_to_string(out.join("summary.json")).expect("a summary");
    let summary: Value = serde_json::from_str(&summary).expect("JSON");
    let list = summary["warnings"].as_array().expect("a list");
    (list.iter().map(|text| text.as_str().expect("a sentence").to_owned()).collect(), said)
}

#[test]
fn a_slit_is_said_by_solve_and_stands_in_its_summary() {
    let (warnings, said) = solved(SCENE, false);
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].starts_with("8 boundary edges lie on others without being joined"));
    assert!(warnings[0].contains("all between (1, 0) and (1, 1)"), "{warnings:?}");
    assert_eq!(said, format!("warning: {}\n", warnings[0]));
    assert_eq!(solved(SCENE, true), (Vec::new(), String::new()));
}

#[test]
fn every_command_on_a_mesh_says_it_once() {
    let text = SCENE.replace("scalar = \"f64\"", "scalar = \"f64\"\nmodel = \"condensed\"");
    let (_plain, plain) = folder(SCENE, false);
    let (_open, open) = folder(&SCENE.replace("scalar = \"f64\"", ""), false);
    let (folder, condensed) = folder(&text, false);
    let file = |name: &str| folder.path().join(name);
    let [open, plain, condensed] = [&open, &plain, &condensed].map(|path| written(path));
    let (rust, header, out) = (file("a.rs"), file("a.h"), file("out"));
    for arguments in [
        &["tick", plain, "--ticks", "2", "--out", written(&out)][..],
        &["bake", condensed, "-o", written(&rust)],
        &["export", plain, "-o", written(&rust)],
        &["condense", open, "-o", written(&header)],
        &["trade", condensed, "--no-peers", "--out", written(&out)],
    ] {
        let (status, said) = signorini(arguments);
        assert_eq!(status, 0, "{arguments:?}: {said}");
        assert_eq!(
            said.matches("lie on others without being joined").count(),
            1,
            "{arguments:?}: {said}"
        );
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
    let drain = "[boundary.drain]\nkind = \"dirichlet\"\nvalue = \"0\"\n";
    for setting in ["", "refine = 1\n", "cells = \"triangles\"\n"] {
        let scene = SCENE.replace("[boundary.default]", &format!("{drain}[boundary.default]"));
        let (folder, path) = folder(&(scene + setting), true);
        let out = folder.path().join("out");
        let (status, said) = signorini(&["solve", written(&path), "--out", written(&out)]);
        assert_eq!(status, 2, "{said}");
        for part in
            ["plate.toml:9: boundary.drain: ", "inside the domain", "Crack", "remove the table"]
        {
            assert!(said.contains(part), "{part}: {said}");
        }
        assert!(!out.exists());
    }
}

//! The data of scenes that firmware tests are built with.

use std::path::{Path, PathBuf};
use std::process::Command;

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes").join(name)
}

/// What the program writes; what it says where it fails.
fn data(words: &[&str], scene: &Path, more: &[&str]) -> Result<String, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("data");
    let mut command = Command::new(env!("CARGO_BIN_EXE_scene_data"));
    command.arg(words[0]).arg(scene).args(&words[1..]).arg(&file).args(more);
    let ran = command.output().expect("the binary runs");
    let written = std::fs::read_to_string(file);
    assert_eq!(ran.status.success(), written.is_ok(), "nothing is left of a failure");
    written.map_err(|_| String::from_utf8_lossy(&ran.stderr).into_owned())
}

#[test]
fn a_model_is_a_static_of_the_kernel() {
    let model = data(&["model", "f32"], &scene("levee.toml"), &[]).expect("a model");
    let line = |of: &str| model.lines().any(|line| line.trim_start().starts_with(of));
    assert!(line("pub static MODEL: Model<'static, f32, u16> = Model {"));
    assert!(line("pub const UNKNOWNS: usize = 2329;"));
    assert!(line("counts: EdgeCounts { free: 2279, contact: 50, dirichlet: 20 },"));
    let has_one_side = !model.contains("4294967295") && model.contains("NONE]");
    assert!(has_one_side, "boundary edges have one side");
    let double = data(&["model", "f64"], &scene("levee.toml"), &[]).expect("a model");
    assert_ne!(double.replace("f64", "f32"), model);
}

#[test]
fn a_model_is_refused_whose_numbers_its_scalar_cannot_square() {
    let folder = tempfile::tempdir().expect("a folder");
    let levee = std::fs::read_to_string(scene("levee.toml")).expect("a scene");
    let mesh = scene("levee.msh").canonicalize().expect("a mesh");
    let levee = levee.replace("\"levee.msh\"", &format!("{mesh:?}"));
    let far = folder.path().join("far.toml");
    let written = |value: &str| {
        let text = levee.replace("value = \"-4.5\"", &format!("value = \"{value}\""));
        assert_ne!(text, levee);
        std::fs::write(&far, text).expect("a scene");
    };
    written("-1e20");
    let said = data(&["model", "f32"], &far, &[]).unwrap_err();
    assert!(said.contains("which f32 cannot square"), "{said}");
    assert!(data(&["model", "f64"], &far, &[]).is_ok());
    written("-1e300");
    assert!(data(&["model", "f32"], &far, &[]).is_err(), "f32 has no such number");
}

#[test]
fn the_dense_problem_is_a_c_header() {
    let text = data(&["contact"], &scene("strip.toml"), &[]).expect("a header");
    assert!(text.contains("#define N 64 ") && text.contains("#define M 2 "));
    let start = text.find("S[N * N] = {").expect("S") + "S[N * N] = {".len();
    let numbers = text[start..].split('}').next().expect("numbers").split(',');
    let numbers: Vec<f32> =
        numbers.map(|x| x.trim().trim_end_matches('f').parse().expect("a number")).collect();
    assert_eq!(numbers.len(), 64 * 64);
    assert!((0..64).all(|i| numbers[65 * i] == 1.0), "a unit diagonal");
    assert!((0..64 * 64).all(|at| numbers[at] == numbers[at % 64 * 64 + at / 64]), "symmetric");
    // Some of the strip's edges never change sides.
    let reduced = data(&["contact"], &scene("strip.toml"), &["--reduced"]).expect("a header");
    assert!(!reduced.contains("#define N 64 ") && reduced.contains("#define M 2 "));
}

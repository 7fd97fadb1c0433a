//! Inputs outside the ranges that a scene declares, as users and scripts meet them.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Its rain is 0 to 5, its river −1 to 0.5.
fn levee() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes/levee.toml")
}

fn run(verb: &str, scene: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    command.arg(verb).arg(scene).args(more).output().expect("the binary runs")
}

/// The message of a command that must refuse, and leave nothing behind.
fn refused(verb: &str, scene: &Path, more: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let to = if matches!(verb, "solve" | "tick") { "--out" } else { "--output" };
    let to = [more, &[to, out.to_str().expect("UTF-8")]].concat();
    let output = run(verb, scene, &to);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{verb} {more:?}: {message}");
    assert!(!message.contains("panicked") && !out.exists(), "{verb} {more:?}: {message}");
    message
}

#[test]
fn every_command_refuses_a_value_outside() {
    for verb in ["solve", "tick", "bake", "condense", "export"] {
        for (value, range) in [
            ("rain=5.0000001", "[0, 5]"),
            ("rain=-1e-300", "[0, 5]"),
            ("river=-1e300", "[-1, 0.5]"),
            ("river=0.6", "[-1, 0.5]"),
        ] {
            let message = refused(verb, &levee(), &["--input", value]);
            let (name, _) = value.split_once('=').expect("a value");
            for part in [name, range, "outside the range"] {
                assert!(message.contains(part), "{verb} {value}: {message}");
            }
        }
        for value in ["rain=nan", "rain=inf", "river=-inf"] {
            refused(verb, &levee(), &["--input", value]);
        }
    }
}

#[test]
fn both_ends_of_a_range_are_inside() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    for value in ["rain=0", "rain=5", "river=-1", "river=0.5"] {
        let output = run("solve", &levee(), &["--input", value, "--out", out]);
        assert_eq!(output.status.code(), Some(0), "{value}");
    }
}

#[test]
fn a_log_is_refused_with_the_line_of_the_value() {
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("inputs.csv");
    let path = log.to_str().expect("UTF-8");
    for (text, line) in [
        ("t,rain\n0,5\n1,5.001\n", 3),
        ("t,rain,river\n0,0,-1.0001\n", 2),
        ("t,river\n0,0\n1,0.5\n2,0.50001\n3,7\n", 4),
    ] {
        std::fs::write(&log, text).expect("a log");
        for more in [&["--log", path][..], &["--log", path, "--baked"]] {
            let message = refused("tick", &levee(), more);
            assert!(message.contains(&format!("inputs.csv:{line}:")), "{text:?}: {message}");
            assert!(message.contains("outside the range"), "{text:?}: {message}");
        }
    }
}

/// A scene file with one key changed.
fn scene(range: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(levee()).expect("a scene");
    assert_eq!(text.matches("range = [0.0, 5.0]").count(), 1);
    let file = folder.path().join("levee.toml");
    let mesh = levee().with_file_name("levee.msh");
    let text = text.replace("range = [0.0, 5.0]", range);
    let text = text.replace("\"levee.msh\"", &format!("{mesh:?}"));
    std::fs::write(&file, text).expect("a scene");
    (folder, file)
}

#[test]
fn wrong_ranges_are_refused_with_file_line_and_key() {
    let whole = std::fs::read_to_string(levee()).expect("a scene");
    let line = 1 + whole.lines().position(|line| line.starts_with("range")).expect("a range");
    // A default outside is the culprit itself, on the line above.
    for (range, line, key) in [
        ("range = [1.0, 5.0]", line - 1, "input.rain.default"),
        ("range = [5.0, 0.0]", line, "input.rain.range"),
        ("range = [0.0, nan]", line, "input.rain.range"),
        ("range = [0.0, inf]", line, "input.rain.range"),
        ("range = [-inf, inf]", line, "input.rain.range"),
        ("range = [0.0]", line, "input.rain.range"),
        ("range = 5.0", line, "input.rain.range"),
        ("range = [\"0\", \"5\"]", line, "input.rain.range"),
    ] {
        let (_folder, file) = scene(range);
        for verb in ["solve", "tick", "bake"] {
            let message = refused(verb, &file, &[]);
            let place = format!("levee.toml:{line}:");
            assert!(message.contains(&place), "{verb} {range}: {message}");
            assert!(message.contains(key), "{verb} {range}: {message}");
        }
    }
}

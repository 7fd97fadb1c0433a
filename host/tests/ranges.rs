//! Inputs outside the ranges that a scene declares, as users and scripts meet them.

use crate::command::{Folder, meshes, refused, says_of, text};

/// Its rain is 0 to 5, its river −1 to 0.5.
fn levee() -> String {
    meshes("scenes/levee.toml")
}

#[test]
fn every_command_refuses_a_value_outside() {
    for verb in ["solve", "tick", "bake"] {
        for (value, range) in [
            ("rain=5.0000001", "[0, 5]"),
            ("rain=-1e-300", "[0, 5]"),
            ("river=-1e300", "[-1, 0.5]"),
            ("river=0.6", "[-1, 0.5]"),
        ] {
            let (name, _) = value.split_once('=').expect("a value");
            let message = refused(verb, &levee(), &["--input", value]);
            says_of(&format!("{verb} {value}"), &message, &[name, range, "outside the range"]);
        }
        for value in ["rain=nan", "rain=inf", "river=-inf"] {
            refused(verb, &levee(), &["--input", value]);
        }
    }
}

#[test]
fn both_ends_of_a_range_are_inside_and_change_the_answer() {
    let folder = Folder::new();
    for ends in [["rain=0", "rain=5"], ["river=-1", "river=0.5"]] {
        let [low, high] = ends.map(|value| {
            let (run, summary) = folder.solve(&levee(), &["--input", value]);
            run.succeeds();
            summary["outputs"]["seepage"].as_f64().expect("a number")
        });
        assert!(low < high, "{ends:?}: {low} {high}");
    }
}

#[test]
fn a_log_is_refused_with_the_line_of_the_value() {
    let folder = Folder::new();
    for (text, line) in [
        ("t,rain\n0,5\n1,5.001\n", 3),
        ("t,rain,river\n0,0,-1.0001\n", 2),
        ("t,river\n0,0\n1,0.5\n2,0.50001\n3,7\n", 4),
    ] {
        let log = folder.write("inputs.csv", text);
        for more in [&["--log", &log][..], &["--log", &log, "--baked"]] {
            let place = format!("inputs.csv:{line}:");
            says_of(text, &refused("tick", &levee(), more), &[&place, "outside the range"]);
        }
    }
}

#[test]
fn wrong_ranges_are_refused_with_file_line_and_key() {
    let whole = text(levee());
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
        let folder = Folder::new();
        let changed = [("range = [0.0, 5.0]", range)];
        let file = folder.scene("levee.toml", "scenes/levee.toml", &changed);
        for verb in ["solve", "tick", "bake"] {
            let (case, place) = (format!("{verb} {range}"), format!("levee.toml:{line}:"));
            says_of(&case, &refused(verb, &file, &[]), &[&place, key]);
        }
    }
}

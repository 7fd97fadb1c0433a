//! `signorini extremes` as users and scripts meet it: its files, its outcomes, its messages.

use signorini_tolerances::command::GUARANTEE;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn extremes(only: &str, out: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    command.args(["extremes", "--only", only, "--out"]).arg(out);
    command.output().expect("the binary runs")
}

/// The cases that `only` names; nothing may be wrong with them.
fn cases(only: &str) -> Vec<Value> {
    let folder = tempfile::tempdir().expect("a folder");
    let output = extremes(only, folder.path());
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(0), "{told}{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "quiet in a pipe");
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect(name);
    let record: Value = serde_json::from_str(&read("extremes.json")).expect("JSON");
    let cases = record["cases"].as_array().expect("cases").clone();
    assert_eq!(read("extremes.csv").lines().count(), cases.len() + 1);
    let page = read("extremes.html");
    // A square a case, and four in the legend.
    assert_eq!(page.matches("class=\"outcome ").count(), cases.len() + 4);
    assert!(told.contains(&format!("{} cases: ", cases.len())), "{told}");
    cases
}

/// Outcomes by place, one letter a case: c, p(oor), t(yped), w(rong).
fn outcomes(cases: &[Value], scalar: &str) -> String {
    let of_scalar = cases.iter().filter(|case| case["scalar"] == scalar);
    let letter = |case: &Value| match case["outcome"].as_str() {
        Some("correct") => 'c',
        Some("certified-poor") => 'p',
        Some("typed-error") => 't',
        _ => 'w',
    };
    of_scalar.map(letter).collect()
}

#[test]
fn quads_that_collapse_keep_their_bound_until_they_are_refused() {
    let found = cases("collapsed");
    for scalar in ["f64", "f32"] {
        let outcomes = outcomes(&found, scalar);
        assert!(outcomes.starts_with("tt") && outcomes.ends_with("c"), "{scalar}: {outcomes}");
    }
    let refused = &found[0];
    assert!(
        refused["note"].as_str().is_some_and(|note| note.contains("crosses itself")),
        "{refused}"
    );
    assert!(refused["sweeps"].is_null() && refused["error_over_bound"].is_null());
}

#[test]
fn grazing_and_switching_contact_keep_their_bound() {
    for only in ["grazing", "switching edges"] {
        let found = cases(only);
        for case in &found {
            assert_eq!(case["outcome"], "correct", "{case}");
            let ratio = case["error_over_bound"].as_f64().expect("a ratio");
            assert!(ratio >= 0.3, "{case}");
            GUARANTEE.check_at_most(case, ratio, 1.0);
        }
    }
}

/// u_D has a layer of 6e−5 at the end of an edge of ⅛, which 32 points do not see.
#[test]
fn a_layer_at_the_end_of_an_edge_keeps_its_bound() {
    let found = cases("contrast 1e8, anisotropy 6.103515625e-5");
    assert_eq!(outcomes(&found, "f64"), "c");
    assert_eq!(outcomes(&found, "f32"), "p");
}

#[test]
fn an_unknown_case_is_wrong_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = extremes("no such case", folder.path());
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("--only no such case"), "{message}");
}

/// One scene of a seed is the same alone, with its files.
#[test]
fn a_random_scene_can_be_had_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
        command.args(["extremes", "--seed", "18", "--out"]).arg(folder.path()).args(more);
        let output = command.output().expect("the binary runs");
        let told = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(0), "{told}");
        assert!(output.stderr.is_empty(), "quiet in a pipe");
        let read = |name| std::fs::read_to_string(folder.path().join(name)).expect(name);
        let record: Value = serde_json::from_str(&read("random.json")).expect("JSON");
        // All but the seconds, which come last but two.
        let lines: Vec<_> = read("random.csv").lines().map(str::to_owned).collect();
        let kept = |line: &String| line.split(',').take(12).collect::<Vec<_>>().join(",");
        (record, lines.iter().map(kept).collect::<Vec<_>>())
    };
    let (record, all) = run(&["--random", "4"]);
    assert_eq!((&record["seed"], &record["cases"]), (&18.into(), &4.into()));
    assert_eq!(record["violations"], Value::Array(Vec::new()));
    let (record, alone) = run(&["--random", "1", "--case", "3"]);
    assert_eq!(record["cases"], 1);
    assert_eq!(alone[1], all[4]);
    for name in ["scene.toml", "mesh.msh"] {
        assert!(folder.path().join("case-3").join(name).is_file(), "{name}");
    }
}

/// Limits that nothing reaches change no digit, and such that hold everywhere leave a bound.
#[test]
fn limits_of_any_size_keep_their_bound() {
    let infinite = cases("infinite end");
    for scalar in ["f64", "f32"] {
        assert_eq!(outcomes(&infinite, scalar), "ctc", "{scalar}");
    }
    let far = cases("greatest flux: A, triangles");
    let ratio = |case: &Value| case["error_over_bound"].as_f64().expect("a ratio");
    for case in &far {
        assert_eq!(case["outcome"], "correct", "{case}");
        GUARANTEE.check_at_most(case, ratio(case), 1.0);
    }
    for case in &cases("span of the flux: L, triangles") {
        assert_eq!(case["outcome"], "correct", "{case}");
        GUARANTEE.check_at_most(case, ratio(case), 1.0);
    }
}

//! `signorini extremes` as users and scripts meet it: its files, its outcomes, its messages.

use signorini_tolerances::command::GUARANTEE;
use signorini_tolerances::is_whole;

use serde_json::Value;

use crate::command::{Folder, json, run, text};

/// The cases that `only` names; nothing may be wrong with them.
fn cases(only: &str) -> Vec<Value> {
    let folder = Folder::new();
    let told = run(&["extremes", "--only", only, "--out", &folder.word("")]).succeeds();
    assert_eq!(told.stderr, "", "quiet in a pipe");
    let record = json(folder.path("extremes.json"));
    let cases = record["cases"].as_array().expect("cases").clone();
    assert_eq!(text(folder.path("extremes.csv")).lines().count(), cases.len() + 1);
    let page = text(folder.path("extremes.html"));
    // A square a case, and four in the legend.
    assert_eq!(page.matches("class=\"outcome ").count(), cases.len() + 4);
    assert!(told.stdout.contains(&format!("{} cases: ", cases.len())), "{told:?}");
    cases
}

/// Error over bound of a case that is correct.
fn correct(case: &Value) -> f64 {
    assert_eq!(case["outcome"], "correct", "{case}");
    let ratio = case["error_over_bound"].as_f64().expect("a ratio");
    GUARANTEE.check_at_most(case, ratio, 1.0);
    ratio
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
    let note = refused["note"].as_str();
    assert!(note.is_some_and(|note| note.contains("crosses itself")), "{refused}");
    assert!(refused["sweeps"].is_null() && refused["error_over_bound"].is_null());
}

#[test]
fn grazing_and_switching_contact_keep_their_bound() {
    for only in ["grazing", "switching edges"] {
        for case in &cases(only) {
            assert!(correct(case) >= 0.3, "{case}");
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
    let folder = Folder::new();
    let words = ["extremes", "--only", "no such case", "--out", &folder.word("")];
    let message = run(&words).refuses();
    assert!(message.contains("--only no such case"), "{message}");
}

/// One scene of a seed is the same alone, with its files.
#[test]
fn a_random_scene_can_be_had_alone() {
    let folder = Folder::new();
    let drawn = |more: &[&str]| {
        let words = ["extremes", "--seed", "18", "--out", &folder.word("")];
        let told = run(&[&words, more].concat()).succeeds();
        assert_eq!(told.stderr, "", "quiet in a pipe");
        // All but the seconds, which come last but two.
        let kept = |line: &str| line.split(',').take(12).collect::<Vec<_>>().join(",");
        let lines: Vec<_> = text(folder.path("random.csv")).lines().map(kept).collect();
        (json(folder.path("random.json")), lines)
    };
    let (record, all) = drawn(&["--random", "4"]);
    assert_eq!((&record["seed"], &record["cases"]), (&18.into(), &4.into()));
    assert_eq!(record["violations"], Value::Array(Vec::new()));
    let (record, alone) = drawn(&["--random", "1", "--case", "3"]);
    assert_eq!(record["cases"], 1);
    assert_eq!(alone[1], all[4]);
    for name in ["scene.toml", "mesh.msh"] {
        assert!(folder.path("case-3").join(name).is_file(), "{name}");
    }
}

/// Limits that nothing reaches change no digit, and such that hold everywhere leave a bound.
#[test]
fn limits_of_any_size_keep_their_bound() {
    let infinite = cases("infinite end");
    for scalar in ["f64", "f32"] {
        assert_eq!(outcomes(&infinite, scalar), "ctc", "{scalar}");
    }
    // A case of the second takes two seconds.
    let studies = ["greatest flux: A, triangles", "span of the flux: L, triangles"];
    for only in &studies[..if is_whole() { 2 } else { 1 }] {
        for case in &cases(only) {
            correct(case);
        }
    }
}

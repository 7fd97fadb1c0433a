//! A record with one axis, one pair and all outcomes, and what its files say of it.

use super::*;
use crate::record_file::{csv, json};

/// Cases for tests: one axis, one pair, all outcomes.
pub fn fixture() -> Record {
    let row = |at: usize, axis: &str, value: f64, across: Option<f64>, scalar: &str| {
        let outcome = Outcome::ALL[at % 4];
        let solved = outcome != Outcome::TypedError;
        Row {
            axis: axis.to_owned(),
            value,
            axis2: across.map(|_| "load < 1".to_owned()),
            value2: across,
            scalar: scalar.to_owned(),
            outcome,
            error_over_bound: solved.then_some(0.5 + at as f64 / 64.0),
            sweeps: solved.then_some(10_u32.pow(at as u32 % 7)),
            unknowns: solved.then_some(100),
            status: solved.then(|| "converged".to_owned()),
            error: solved.then_some(0.1),
            bound: solved.then_some(0.2),
            reference_bound: solved.then_some(0.2),
            energy: solved.then_some(1.0),
            seconds: 0.25,
            note: if at.is_multiple_of(4) { String::new() } else { format!("note {at} & <more>") },
            ..Row::default()
        }
    };
    let mut cases = Vec::new();
    for (at, scalar) in ["f64", "f32"].into_iter().enumerate() {
        cases.extend(
            (0..4).map(|k| row(k + at, "contrast", 10_f64.powi(3 * k as i32), None, scalar)),
        );
    }
    for scalar in ["f64", "f32"] {
        cases.extend((0..6).map(|k| {
            row(k, "unit of length", [1e-15, 1.0][k % 2], Some([1e-30, 1.0, 1e30][k / 2]), scalar)
        }));
    }
    Record { definitions: definitions(), seconds: 12.0, cases }
}

#[test]
fn a_record_survives_its_file_and_a_broken_one_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("extremes.json");
    assert_eq!(Record::read(&path).unwrap(), None);
    std::fs::write(&path, json(&fixture())).unwrap();
    assert_eq!(Record::read(&path).unwrap(), Some(fixture()));
    std::fs::write(&path, "{").unwrap();
    let error = Record::read(&path).unwrap_err();
    assert_eq!(error.exit_status(), 1);
    let error = error.to_string();
    assert!(error.contains("extremes.json") && error.contains("again"), "{error}");
}

#[test]
fn the_contract_of_the_json() {
    let json: serde_json::Value = serde_json::from_str(&json(&fixture())).unwrap();
    let case = &json["cases"][1];
    assert_eq!((&case["axis"], &case["outcome"]), (&"contrast".into(), &"certified-poor".into()));
    assert!(case["axis2"].is_null() && case["value2"].is_null());
    assert!(case["value"].is_number() && case["sweeps"].is_number());
    assert!(case["error_over_bound"].is_number() && case["scalar"] == "f64");
}

#[test]
fn a_line_a_case() {
    let text = String::from_utf8(csv("extremes.csv", &fixture().cases).unwrap()).unwrap();
    assert_eq!(text.lines().count(), 1 + fixture().cases.len());
    assert!(text.starts_with("axis,value,axis2,value2,scalar,outcome,error_over_bound,sweeps"));
    assert!(text.contains(",typed-error,,,"));
}

#[test]
fn studies_keep_their_order() {
    let record = fixture();
    let studies: Vec<_> = record.studies().map(|cases| (heading(&cases[0]), cases.len())).collect();
    let names = ["contrast", "unit of length × load < 1"].map(str::to_owned);
    assert_eq!(studies, names.into_iter().zip([8, 12]).collect::<Vec<_>>());
    assert_eq!(Outcome::ALL.map(|outcome| record.count(outcome)).iter().sum::<usize>(), 20);
}

#[test]
fn a_line_a_study_and_scalar_and_one_for_each_that_is_wrong() {
    let text = text(&fixture());
    assert_eq!(text.lines().count(), 1 + 4 + 1 + fixture().count(Outcome::Wrong) + 1, "{text}");
    assert!(text.contains("unit of length × load < 1"));
    assert!(text.contains("wrong: contrast 1e9, f64: note 3"));
    assert!(
        text.ends_with("20 cases: 6 correct, 6 certified-poor, 4 typed-error, 4 wrong"),
        "{text}"
    );
}

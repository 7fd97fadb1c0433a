//! The page on robustness quotes the committed records of extremes, fuzzing and mutants.

use serde_json::Value;

use crate::command::{json, repository, text};

/// A file of the repository.
fn read(path: &str) -> String {
    text(repository(path))
}

/// Every phrase stands on the page, wherever its lines break.
fn the_page_says(phrases: &[String]) {
    let page = read("docs/robustness.md");
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let missing: Vec<_> = phrases.iter().filter(|phrase| !page.contains(*phrase)).collect();
    assert!(missing.is_empty(), "docs/robustness.md lacks {missing:?}");
}

/// The words of each line of a record that has `count` of them.
fn lines(record: &str, count: usize) -> Vec<Vec<&str>> {
    let lines = record.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
    lines.filter(|words| words.len() == count).collect()
}

fn number(word: &str) -> Option<u64> {
    word.parse().ok()
}

#[test]
fn the_page_quotes_the_record_of_the_extremes() {
    let record = json(repository("host/benches/extremes/extremes.json"));
    let cases = record["cases"].as_array().expect("cases");
    let count = |outcome: &str| cases.iter().filter(|case| case["outcome"] == outcome).count();
    let [correct, poor, refused, wrong] =
        ["correct", "certified-poor", "typed-error", "wrong"].map(count);
    let all = cases.len();
    assert_eq!(all, correct + poor + refused + wrong);
    the_page_says(&[
        format!("{all} cases in about"),
        format!(
            "Of {all} cases {correct} are correct, {poor} certified but poor, {refused} refused, {wrong} wrong."
        ),
    ]);
}

#[test]
fn the_page_quotes_the_record_of_random_scenes() {
    let record = json(repository("host/benches/extremes/random.json"));
    let count = |outcome: &str| record["outcomes"][outcome].as_u64().unwrap_or(0);
    let [correct, poor, refused, wrong] =
        ["correct", "certified-poor", "typed-error", "wrong"].map(count);
    let (all, seed) = (record["cases"].as_u64(), &record["seed"]);
    assert_eq!(all, Some(correct + poor + refused + wrong));
    assert_eq!(record["violations"], Value::Array(Vec::new()));
    the_page_says(&[format!(
        "Of {} scenes of seed {seed} {correct} are correct, {poor} certified but poor, {refused} refused, {wrong} wrong.",
        all.unwrap_or_default()
    )]);
}

#[test]
fn the_page_on_benchmarks_has_rows_of_the_record_of_promises() {
    let (page, record) = (read("docs/benchmarks.md"), read("host/benches/trade/promised.txt"));
    let (_, section) = page.split_once("## The firmware that an error takes").expect("a section");
    let (_, table) = section.split_once("```text\n").expect("a table");
    let (table, _) = table.split_once("```").expect("its end");
    let rows: Vec<&str> = table.lines().filter(|line| !line.is_empty()).collect();
    let kept: Vec<&str> = record.lines().collect();
    assert!(rows.len() > 15, "{rows:?}");
    let foreign: Vec<_> = rows.iter().filter(|row| !kept.contains(row)).collect();
    assert!(foreign.is_empty(), "not in the record: {foreign:?}");
}

#[test]
fn the_page_quotes_the_record_of_fuzzing() {
    let record = read("tests/fuzz/record.txt");
    // target, executions, edges, corpus, found, date
    let targets = lines(&record, 6)
        .into_iter()
        .filter_map(|words| Some(format!("{} {:.1}", words[0], number(words[1])? as f64 / 1e6)));
    let phrases: Vec<String> = targets.collect();
    assert_eq!(phrases.len(), 5, "{phrases:?}");
    the_page_says(&phrases);
}

#[test]
fn the_page_quotes_the_record_of_mutants() {
    let record = read("tests/mutants/record.txt");
    // path, content, mutants, caught, timeout, missed, unviable
    let files = lines(&record, 7).into_iter().filter_map(|words| {
        let [mutants, caught, timeout, _, unviable] = [2, 3, 4, 5, 6].map(|at| number(words[at]));
        Some((caught? + timeout?, mutants? - unviable?))
    });
    let (killed, viable) = files.fold((0, 0), |sum, file| (sum.0 + file.0, sum.1 + file.1));
    assert!(viable > 0 && 100 * killed >= 95 * viable, "{killed} of {viable}");
    the_page_says(&[format!("{killed} of {viable} viable mutants")]);
}

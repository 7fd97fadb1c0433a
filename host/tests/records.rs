//! Pages quote the committed records of extremes, trajectories, fuzzing and mutants.

use serde_json::Value;
use signorini_files::digits::rounded;

use crate::command::{json, repository, text};

/// Every phrase stands on the page, wherever its lines break.
fn page_says(page: &str, phrases: &[String]) {
    let text = text(repository(page));
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let missing: Vec<_> = phrases.iter().filter(|phrase| !text.contains(*phrase)).collect();
    assert!(missing.is_empty(), "{page} lacks {missing:?}");
}

fn the_page_says(phrases: &[String]) {
    page_says("docs/robustness.md", phrases);
}

/// What a record has by name.
fn by_name(path: &str) -> Vec<(String, Value)> {
    let Value::Object(all) = json(repository(path)) else { panic!("{path} is no record by name") };
    all.into_iter().collect()
}

/// How many of all cases have each outcome, in the page's words.
fn outcomes(all: u64, count: impl Fn(&str) -> u64) -> String {
    let counts = ["correct", "certified-poor", "typed-error", "wrong"].map(count);
    let [correct, poor, refused, wrong] = counts;
    assert_eq!(all, counts.iter().sum::<u64>());
    format!("{correct} are correct, {poor} certified but poor, {refused} refused, {wrong} wrong.")
}

#[test]
fn the_page_quotes_the_records_of_the_extremes_and_of_random_scenes() {
    let record = json(repository("host/benches/extremes/extremes.json"));
    let cases = record["cases"].as_array().expect("cases");
    let all = cases.len();
    let words = outcomes(all as u64, |outcome| {
        cases.iter().filter(|case| case["outcome"] == outcome).count() as u64
    });
    the_page_says(&[format!("{all} cases in about"), format!("Of {all} cases {words}")]);
    for file in ["random", "features"] {
        let record = json(repository(&format!("host/benches/extremes/{file}.json")));
        let (all, seed) = (record["cases"].as_u64().expect("a count"), &record["seed"]);
        let words = outcomes(all, |outcome| record["outcomes"][outcome].as_u64().unwrap_or(0));
        assert_eq!(record["violations"], Value::Array(Vec::new()));
        the_page_says(&[format!("Of {all} scenes of seed {seed} {words}")]);
    }
}

/// A row of the page's table for each feature.
#[test]
fn the_page_has_the_table_of_features() {
    let record = json(repository("host/benches/extremes/features.json"));
    let features = record["features"].as_object().expect("features");
    let rows: Vec<_> = features
        .iter()
        .map(|(name, of)| {
            let ratios = of["over_error"].as_array().expect("ratios").iter();
            let ratios: Vec<_> =
                ratios.map(|ratio| rounded(ratio.as_f64().expect("a number"), 3, 0.0)).collect();
            format!("| {name} | {} | {} | {} |", of["scenes"], of["with_bound"], ratios.join(" | "))
        })
        .collect();
    assert_eq!(rows.len(), 14);
    the_page_says(&rows);
}

/// What the judge could not say is no broken bound.
#[test]
fn the_page_on_time_quotes_the_record_of_trajectories() {
    let record = json(repository("host/benches/extremes/trajectories.json"));
    let of = |what: &str| record[what].as_u64().expect("a count");
    let violations = record["violations"].as_object().expect("violations by case");
    let is_unjudged = |what: &Value| what.as_str().is_some_and(|what| what.contains("no bound"));
    assert!(violations.values().all(is_unjudged), "{violations:?}");
    let spread = |name: &str| &record["spreads"][name];
    for kind in ["over time", "over time, condensed", "of a step"] {
        let most = spread(&format!("error over bound, {kind}"))[2].as_f64();
        assert!(most.is_some_and(|most| most < 1.0), "{kind}: {most:?}");
    }
    let median = |name: &str| spread(&format!("bound over error, {name}"))[1].as_f64();
    let medians = [
        "over time, steady start, to the end",
        "over time, stated start, to the end",
        "over time, steady start, cut off",
        "over time, stated start, cut off",
    ];
    let [a, b, c, d] = medians.map(|name| median(name).unwrap_or_else(|| panic!("{name}")));
    let most = |end: &str| -> f64 {
        let of = |start: &str| {
            spread(&format!("bound over error, over time, {start} start, {end}"))[2].as_f64()
        };
        ["steady", "stated"]
            .map(|start| of(start).expect("a largest"))
            .into_iter()
            .fold(0.0, f64::max)
    };
    let [x, y] = ["to the end", "cut off"].map(most);
    page_says(
        "docs/time.md",
        &[
            format!(
                "Of {} trajectories of seed {} {} have a bound over time, judged in {} ticks, and {} a condensed controller as well",
                of("cases"),
                record["seed"],
                of("with_window"),
                of("ticks"),
                of("condensed")
            ),
            format!(
                "{a:.1} and {b:.1} times that distance in the median, from a steady and a stated start, and {c:.1} and {d:.1} times where sweeps are cut off"
            ),
            format!("{x:.0} times, and {y:.0} times where sweeps are cut off"),
            format!("in {} of them", violations.len()),
        ],
    );
}

#[test]
fn the_page_on_benchmarks_has_rows_of_the_record_of_promises() {
    let [page, record] = ["docs/benchmarks.md", "host/benches/trade/promised.txt"]
        .map(|name| text(repository(name)));
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
    let targets = by_name("tests/fuzz/record.json").into_iter();
    let phrase = |(name, of): (String, Value)| {
        format!("{name} {:.1}", of["executions"].as_f64().expect("a count") / 1e6)
    };
    let phrases: Vec<String> = targets.map(phrase).collect();
    assert_eq!(phrases.len(), 5, "{phrases:?}");
    the_page_says(&phrases);
}

#[test]
fn the_page_quotes_the_record_of_mutants() {
    let files = by_name("tests/mutants/record.json");
    let count = |what: &str| -> u64 {
        files.iter().map(|(_, row)| row[what].as_u64().expect("a count")).sum()
    };
    let killed = count("caught") + count("timeout");
    let viable = killed + count("missed");
    assert!(viable > 0 && 100 * killed >= 95 * viable, "{killed} of {viable}");
    the_page_says(&[format!("{killed} of {viable} viable mutants")]);
}

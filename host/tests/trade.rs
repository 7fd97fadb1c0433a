//! `signorini trade` as users meet it: a study of a small scene, its files, its recommendation, its wishes, its
//! interruptions.

use signorini_tolerances::command::{KEPT, PROMISED};
use std::path::PathBuf;

use serde_json::Value;
use signorini_scene::mesh::gmsh::write;
use signorini_scene::mesh::structured::{Cells, grid};

use crate::command::{Folder, Run, json as read, repository, run, text, word};

/// A strip of 8 × 4 squares, cut, warmed from above, with an input.
const SCENE: &str = r#"
title = "a small strip"
mesh = "strip.msh"
material.default.conductivity = "1"
source.f = "-2"
boundary.contact = { kind = "contact", gap = "-0.2" }
boundary.dirichlet = { kind = "dirichlet", value = "0.1*x" }
input.load = { of = "source", field = "f", pattern = "1", default = 0.5 }
"#;

/// A folder with the scene in it.
struct Bench {
    folder: Folder,
    scene: String,
}

impl Bench {
    fn new() -> Self {
        let folder = Folder::new();
        folder.write("strip.msh", write::text(&grid(4, Cells::Triangles)));
        let scene = folder.write("strip.toml", SCENE);
        Self { folder, scene }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path(name)
    }

    /// `signorini trade` on the scene, into `out`.
    fn trade(&self, out: &str, more: &[&str]) -> Run {
        let out = self.folder.word(out);
        run(&[&["trade", &self.scene, "--no-peers", "--out", &out], more].concat())
    }

    fn record(&self, out: &str) -> Value {
        read(self.path(out).join("trade.json"))
    }
}

fn number(point: &Value, key: &str) -> f64 {
    let place = format!("/{}", key.replace('.', "/"));
    point.pointer(&place).and_then(Value::as_f64).unwrap_or_else(|| panic!("{key}: {point}"))
}

fn points(record: &Value) -> &[Value] {
    record["points"].as_array().expect("points")
}

/// One study serves all that is asked of its files: it takes some seconds.
#[test]
fn a_study_says_what_it_measured() {
    let bench = Bench::new();
    let stdout = bench.trade("out", &[]).succeeds().stdout;
    let record = bench.record("out");
    let all = points(&record);
    assert!(all.len() > 30 && all.len() <= 60, "{}", all.len());
    assert!(record["skipped"].as_u64().is_some_and(|skipped| skipped > 100));
    every_point_is_sound(all);
    the_front_is_the_front(all);
    the_recommendation_is_kept(&bench, &record);
    let said = record["recommendation"]["text"].as_str().unwrap();
    assert!(stdout.contains(said.split(':').next().unwrap()), "{stdout}");
    for file in ["trade.csv", "trade.svg", "recommended.toml"] {
        assert!(bench.path("out").join(file).is_file(), "{file}");
    }
    assert_eq!(text(bench.path("out/trade.csv")).lines().count(), all.len() + 1);
    let mut left = std::fs::read_dir(bench.path("out")).unwrap().flatten();
    let is_left = left.any(|at| at.file_name().to_string_lossy().starts_with("unfinished"));
    assert!(!is_left);
}

fn every_point_is_sound(all: &[Value]) {
    for point in all {
        assert!(number(point, "error.energy") > 0.0 && number(point, "cycles") > 0.0);
        assert!(point["instructions"].is_null() && point["ram_bytes"].is_null());
        assert_eq!(point["bound"].is_null(), point["certificate"] == false, "{point}");
        if !point["bound"].is_null() {
            // The reference is finer, not exact: its own error stands between the two.
            assert!(number(point, "bound") > 0.97 * number(point, "error.combined"), "{point}");
        }
    }
    let has = |key: &str, value: &str| all.iter().any(|point| point[key] == value);
    for (key, values) in [
        ("scalar", ["f32", "f64", "f32+f64"]),
        ("omega", ["auto", "tuned", "unit"]),
        ("start", ["warm", "cold", "warm"]),
        ("model", ["full", "condensed", "full"]),
        ("cells", ["triangles", "quads", "quads"]),
        ("math", ["libm", "micromath", "libm"]),
    ] {
        assert!(values.iter().all(|value| has(key, value)), "{key}");
    }
}

fn the_front_is_the_front(all: &[Value]) {
    for point in all {
        let better = |other: &&Value| {
            number(other, "cycles") < number(point, "cycles")
                && number(other, "error.energy") < number(point, "error.energy")
        };
        assert_eq!(point["pareto"] == true, !all.iter().any(|other| better(&other)), "{point}");
    }
}

/// The fragment, studied and solved alone, gives the error that was promised.
fn the_recommendation_is_kept(bench: &Bench, record: &Value) {
    let promised = &record["recommendation"]["point"];
    let place = |name: &str| bench.folder.word(name);
    let fragment = place("out/recommended.toml");
    run(&["trade", &fragment, "--out", &place("alone")]).succeeds();
    let alone = bench.record("alone");
    assert_eq!(points(&alone).len(), 1);
    let [found, asked] = [&alone["points"][0], promised].map(|point| number(point, "error.energy"));
    PROMISED.check_relative("energy", found, asked);
    run(&["solve", &fragment, "--out", &place("solved")]).succeeds();
    let summary = read(bench.path("solved/summary.json"));
    assert_eq!(summary["unknowns"], promised["unknowns"]);
    run(&["bake", &fragment, "-o", &place("module.rs")]).succeeds();
    let source = text(bench.path("module.rs"));
    let model = format!("pub const MODEL: &str = {};", promised["model"]);
    assert!(source.contains(&model), "{model}");
}

#[test]
fn wishes_pick_the_best_point_or_say_that_there_is_none() {
    let bench = Bench::new();
    for shard in ["1/2", "2/2"] {
        let stdout = bench.trade("out", &["--shard", shard]).succeeds().stdout;
        assert!(stdout.contains("without --shard"), "{stdout}");
    }
    assert!(!bench.path("out/trade.json").exists());
    // An interruption in the middle of a line.
    let journal = bench.path("out/unfinished-host/points-2-of-2.jsonl");
    let text = std::fs::read(&journal).unwrap();
    std::fs::write(&journal, &text[..text.len() - 7]).unwrap();
    bench.trade("out", &["--max-error", "30%"]).succeeds();
    let record = bench.record("out");
    let energy = number(&record, "energy");
    let chosen = &record["recommendation"]["point"];
    let good = points(&record).iter().filter(|point| number(point, "error.energy") <= 0.3 * energy);
    let least = good.map(|point| number(point, "cycles")).fold(f64::INFINITY, f64::min);
    assert_eq!(number(chosen, "cycles"), least);

    // One setting is enough to find that nothing meets a wish.
    let (fragment, none) = (bench.folder.word("out/recommended.toml"), bench.folder.word("none"));
    let stderr = run(&["trade", &fragment, "--max-error", "1e-30", "--out", &none]).refuses();
    assert!(stderr.contains("the most accurate"), "{stderr}");
    let record = bench.record("none");
    assert!(record["recommendation"]["point"].is_null());
    assert!(!bench.path("none/recommended.toml").exists());
}

#[test]
fn a_promised_error_has_its_firmware_in_the_folder_of_the_scene() {
    let bench = Bench::new();
    let stdout = bench.trade("promised", &["--promise", "60%,30%"]).succeeds().stdout;
    let table = text(bench.path("promised/promised.txt"));
    assert!(stdout.contains(&table), "{stdout}");
    let rows: Vec<Vec<&str>> = table.lines().map(|row| row.split_whitespace().collect()).collect();
    let unknowns = |row: &[&str]| row.iter().skip(1).find_map(|cell| cell.parse::<usize>().ok());
    let [coarse, fine] = ["60%", "30%"].map(|error| {
        let of = rows.iter().find(|row| row[0] == error).expect(error);
        unknowns(of).unwrap_or_else(|| panic!("{table}"))
    });
    assert!(coarse <= fine, "{table}");
}

#[test]
fn wrong_words_are_named() {
    let bench = Bench::new();
    for (more, part) in [
        (&["--promise", "5%", "--target", "m4f"][..], "--promise"),
        (&["--shard", "3/2"], "--shard"),
        (&["--max-error", "-1%"], "expected a number > 0"),
        (&["--budget-cycles", "0"], "--budget-cycles"),
        (&["--target", "m3"], "m3"),
    ] {
        let stderr = bench.trade("out", more).refuses();
        assert!(stderr.contains(part), "{part}: {stderr}");
    }
    let stderr = run(&["trade", &bench.scene, &bench.scene]).refuses();
    assert!(stderr.contains("two scenes of one name"), "{stderr}");
    let stderr = run(&["trade", "--no-peers"]).refuses();
    assert!(stderr.contains("--no-peers without a scene"), "{stderr}");
}

/// The studies of one target in the committed record, by their folders.
fn recorded(target: &str) -> Vec<(PathBuf, Value)> {
    let records = repository("host/benches/trade").join(target);
    let folders = std::fs::read_dir(records).expect("a record");
    let folders = folders.map(|entry| entry.expect("a folder").path());
    let mut all: Vec<_> =
        folders.map(|folder| (folder.clone(), read(folder.join("trade.json")))).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}

/// Cycles are of a build, and the record says of which.
#[test]
fn committed_records_name_the_registers_of_their_cycles() {
    let sizes = read(repository("host/benches/trade/sizes.json"));
    let studies = recorded("host").into_iter().chain(recorded("m4f")).map(|(_, record)| record);
    for record in studies.chain([sizes]) {
        assert!(record["registers"].as_str().is_some_and(|name| name.contains("x86-64")));
    }
}

/// `solve` on each committed recommendation, where the exact solution tells.
#[test]
fn committed_recommendations_keep_their_promise() {
    let out = Folder::new();
    let mut kept = 0;
    for (folder, record) in recorded("host").into_iter().chain(recorded("m4f")) {
        let fragment = folder.join("recommended.toml");
        if record["truth"] != "the exact solution" || !fragment.exists() {
            continue;
        }
        let (fragment, place) = (&word(&fragment), out.word(&kept.to_string()));
        run(&["solve", fragment, "--out", &place]).succeeds();
        let summary = read(out.path(&format!("{kept}/summary.json")));
        let found = number(&summary, "errors.energy");
        let promised = number(&record["recommendation"]["point"], "error.energy");
        // A patch is exact to rounding, and rounding is no promise.
        let size = promised + 2e-5 * number(&record, "energy");
        KEPT.check_over(fragment, found - promised, size);
        kept += 1;
    }
    assert!(kept >= 30, "{kept}");
}

#[test]
fn every_standard_scene_is_in_the_record() {
    let mut scenes = Vec::new();
    for folder in ["catalogue", "scenes"] {
        for entry in std::fs::read_dir(repository("meshes").join(folder)).expect("scenes") {
            let path = entry.expect("a file").path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                scenes.push(path.file_stem().unwrap().to_string_lossy().into_owned());
            }
        }
    }
    scenes.sort();
    for target in ["host", "m4f"] {
        let record = recorded(target);
        let names: Vec<_> =
            record.iter().map(|(_, record)| record["scene"].as_str().unwrap()).collect();
        assert_eq!(names, scenes, "{target}: run `signorini trade`");
        let text = format!("{record:?}");
        assert!(!text.contains(".toml:") && !text.contains("NaN"), "{target}");
    }
}

/// Cycles of a solver on a problem, where it took part.
fn cycles(baselines: &Value, solver: &str, problem: &str, start: &str) -> Option<f64> {
    let all = baselines.as_array().expect("baselines");
    let same = |b: &&Value| b["solver"] == solver && b["problem"] == problem && b["start"] == start;
    all.iter().find(same).map(|b| number(b, "cycles"))
}

/// The page on benchmarks.
fn page() -> String {
    text(repository("docs/benchmarks.md"))
}

/// Three digits, as the page on benchmarks has them.
fn short(cycles: Option<f64>) -> String {
    let Some(mega) = cycles.map(|cycles| 1e-6 * cycles) else { return "–".to_owned() };
    let digits = 2 - mega.log10().floor() as i32;
    format!("{mega:.*}", digits.max(0) as usize)
}

/// The tables of sizes are those of the record.
#[test]
fn the_page_quotes_the_record() {
    const SOLVERS: [&str; 6] = [
        "kernel PSOR f64",
        "kernel PSOR f64, tuned ω",
        "kernel PSOR f64, coarse to fine",
        "faer active set",
        "Clarabel",
        "OSQP",
    ];
    let sizes = read(repository("host/benches/trade/sizes.json"));
    let page = page();
    let lines: Vec<Vec<&str>> =
        page.lines().map(|line| line.split_whitespace().collect()).collect();
    let mut missing = Vec::new();
    for start in ["cold", "warm"] {
        for size in sizes["rows"].as_array().expect("rows") {
            let full = |solver: &&str| short(cycles(&size["baselines"], solver, "full", start));
            let mut line = vec![size["unknowns"].to_string()];
            line.extend(SOLVERS.iter().map(full));
            line.push(short(cycles(&size["baselines"], "kernel pivoting f64", "condensed", start)));
            if !lines.iter().any(|found| *found == line) {
                missing.push(format!("{start}: {}", line.join("  ")));
            }
        }
    }
    assert!(missing.is_empty(), "docs/benchmarks.md lacks\n{}", missing.join("\n"));
}

/// Scenes whose fluxes have limits: others take their dual problem or slacks, and the page has a table of its own for them.
const LIMITED: [&str; 1] = ["antiicing"];

/// The ratios of condensed warm ticks, on scenes with more than rounding to be wrong about.
#[test]
fn the_page_says_how_far_condensed_ticks_are_ahead() {
    let page = page();
    let warm = |record: &Value, solver: &str, problem: &str| {
        let all = record["baselines"].as_array().expect("baselines");
        let same = |b: &&Value| b["solver"] == solver && b["problem"] == problem;
        all.iter().filter(same).find(|b| b["start"] == "warm").cloned()
    };
    let is_near = |b: &Value| number(b, "algebraic_error") <= number(b, "target");
    let own = |record: Value| Some((warm(&record, "kernel pivoting f64", "condensed")?, record));
    let all: Vec<_> = recorded("host").into_iter().filter_map(|(_, record)| own(record)).collect();
    assert_eq!(all.len(), recorded("host").len());
    let is_limited =
        |(_, record): &(Value, Value)| LIMITED.contains(&record["scene"].as_str().expect("a name"));
    let (limited, all): (Vec<_>, Vec<_>) = all.into_iter().partition(is_limited);
    let (scenes, exact): (Vec<_>, Vec<_>) = all.into_iter().partition(|(own, _)| is_near(own));
    assert!(exact.iter().all(|(_, record)| record["scene"] == "patch-mixed"));
    let mut missing = Vec::new();
    let mut quote = |line: String| {
        if !page.contains(&line) {
            missing.push(line);
        }
    };
    for (solver, promised) in [
        ("Clarabel", 20.0),
        ("OSQP as it comes", 20.0),
        ("OSQP, polished", 20.0),
        ("OSQP", 20.0),
        ("OSQP, every iteration", 0.0),
    ] {
        let ratios = |key: &str| -> Vec<f64> {
            let ratio = |(own, record): &(Value, Value)| {
                let other = warm(record, solver, "condensed").expect(solver);
                assert!(is_near(&other) || solver == "OSQP as it comes", "{other}");
                number(&other, key) / number(own, key)
            };
            scenes.iter().map(ratio).collect()
        };
        let least = |ratios: &[f64]| ratios.iter().copied().fold(f64::INFINITY, f64::min);
        let (mut found, slowest) = (ratios("cycles"), least(&ratios("worst")));
        found.sort_by(f64::total_cmp);
        if solver == "OSQP, every iteration" {
            quote(format!(
                "on all other scenes it takes {:.0} times as long or more",
                found[1].floor()
            ));
        }
        if solver == "OSQP as it comes" {
            let far = |(_, record): &&(Value, Value)| {
                !is_near(&warm(record, solver, "condensed").unwrap())
            };
            let far = scenes.iter().filter(far).count();
            quote(format!("in {far} of {} scenes", scenes.len()));
        }
        for (own, record) in &exact {
            let other = warm(record, solver, "condensed").expect(solver);
            assert!(number(&other, "cycles") >= promised * number(own, "cycles"), "{other}");
        }
        for (own, record) in &limited {
            let other = warm(record, solver, "condensed").expect(solver);
            let ratio = |key: &str| number(&other, key) / number(own, key);
            let [median, slowest] = ["cycles", "worst"].map(ratio);
            quote(format!("{solver:<22}{median:>6.0}{slowest:>10.0}"));
        }
        let (least, most) = (least(&found), found.iter().copied().fold(0.0, f64::max));
        assert!(least >= promised, "{solver} takes {least} times as long at least");
        quote(format!("{solver:<22}{least:>6.0}{most:>8.0}{slowest:>10.0}"));
    }
    let all = |key: &str| -> Vec<f64> { scenes.iter().map(|(own, _)| number(own, key)).collect() };
    let most = |key: &str| all(key).into_iter().fold(0.0, f64::max);
    let least = all("cycles").into_iter().fold(f64::INFINITY, f64::min);
    let [least, median, slowest] = [least, most("cycles"), most("worst")].map(|c| 1e-3 * c);
    quote(format!("{least:.1} to {median:.1} thousand cycles"));
    quote(format!("{slowest:.0} thousand in the slowest tick"));
    for (own, _) in &limited {
        let [median, slowest] = ["cycles", "worst"].map(|key| 1e-3 * number(own, key));
        quote(format!(
            "{median:.1} thousand cycles in the median, {slowest:.1} in the slowest tick"
        ));
    }
    let full = scenes.iter().flat_map(|(_, record)| record["baselines"].as_array().unwrap());
    let full = full.filter(|b| b["problem"] == "full" && b["start"] == "warm" && is_near(b));
    let least = full.filter_map(|b| b["to_condensed"].as_f64()).fold(f64::INFINITY, f64::min);
    quote(format!("{} times as long at least", least.floor()));
    assert!(missing.is_empty(), "docs/benchmarks.md lacks\n{}", missing.join("\n"));
}

/// The costs of micromath in the kernel and in load data.
#[test]
fn the_page_says_what_micromath_costs() {
    let page = page();
    let range = |found: &[f64]| {
        let least = found.iter().copied().fold(f64::INFINITY, f64::min);
        (least, found.iter().copied().fold(f64::NEG_INFINITY, f64::max))
    };
    let mut more = Vec::new();
    for (_, record) in recorded("m4f") {
        let points = record["points"].as_array().expect("points");
        for point in points {
            let name = point["name"].as_str().expect("a name");
            let Some((before, after)) = name.split_once(", micromath") else { continue };
            let twin = points.iter().find(|point| point["name"] == format!("{before}{after}"));
            let twin = number(twin.expect(name), "instructions");
            more.push(100.0 * (number(point, "instructions") / twin - 1.0));
        }
    }
    let (fewest, most) = range(&more);
    let said = format!("from {:.1} % fewer instructions a tick to {most:.1} % more", -fewest);
    assert!(page.contains(&said), "{said}");
    let records = recorded("host");
    let all = records.iter().flat_map(|(_, record)| record["math"].as_array().expect("math"));
    let of_kernel = ["search for ω", "lengths of edges"];
    let in_load = |m: &&Value| !of_kernel.contains(&m["used_in"].as_str().unwrap());
    let in_loads: Vec<_> = all.filter(in_load).collect();
    let errors = |functions: [&str; 2]| {
        let of = |m: &&&Value| functions.contains(&m["function"].as_str().unwrap());
        let percent = |m: &&Value| 100.0 * number(m, "energy");
        range(&in_loads.iter().filter(of).map(percent).collect::<Vec<_>>())
    };
    let (least, most) = errors(["sin", "cos"]);
    let said = format!("for an error of {least:.2} to {most:.2} %");
    assert!(page.contains(&said), "{said}");
    let (least, most) = errors(["powf", "sqrt"]);
    let said = format!("its power and square root cost {least:.1} to {most:.0} %");
    assert!(page.contains(&said), "{said}");
}

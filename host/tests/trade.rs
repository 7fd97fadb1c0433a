//! `signorini trade` as users meet it: a study of a small scene, its files, its recommendation, its wishes, its
//! interruptions.

use signorini_tolerances::command::{KEPT, PROMISED};
use std::path::PathBuf;

use serde_json::Value;
use signorini_lab::checkout::scenes as scenes_of;
use signorini_problem::Problem;
use signorini_scene::mesh::gmsh::write;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;
use signorini_session::request::SolveRequest;
use signorini_solve::adaptive::mesh_of_scene;
use signorini_solve::norms::errors;

use crate::command::{Folder, Run, each_refused, json as read, repository, run, says, text};

/// A strip of 4 × 2 squares, cut, warmed from above, with an input.
const SCENE: &str = r#"
title = "a small strip"
mesh = "strip.msh"
material.default.conductivity = "1"
source.f = "-2"
boundary.contact = { kind = "contact", gap = "x - 0.2" }
boundary.dirichlet = { kind = "dirichlet", value = "1.1*x" }
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
        folder.write("strip.msh", write::text(&grid(2, Cells::Triangles)));
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
fn a_study_says_what_it_measured_and_picks_the_best_point() {
    let bench = Bench::new();
    in_two_parts(&bench);
    let stdout = bench.trade("out", &["--max-error", "10%"]).succeeds().stdout;
    let record = bench.record("out");
    let all = points(&record);
    assert!(all.len() > 30 && all.len() <= 60, "{}", all.len());
    assert!(record["skipped"].as_u64().is_some_and(|skipped| skipped > 100));
    every_point_is_sound(all);
    the_front_is_the_front(all);
    the_cheapest_of_the_good_is_chosen(&record);
    the_recommendation_is_kept(&bench, &record);
    no_point_meets_a_wish(&bench);
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

/// Measures all points, the last of them but for an interruption in the middle of a line.
fn in_two_parts(bench: &Bench) {
    for shard in ["1/2", "2/2"] {
        let stdout = bench.trade("out", &["--shard", shard]).succeeds().stdout;
        assert!(stdout.contains("without --shard"), "{stdout}");
    }
    assert!(!bench.path("out/trade.json").exists());
    let journal = bench.path("out/unfinished-host/points-2-of-2.jsonl");
    let text = std::fs::read(&journal).unwrap();
    std::fs::write(&journal, &text[..text.len() - 7]).unwrap();
}

fn the_cheapest_of_the_good_is_chosen(record: &Value) {
    let energy = number(record, "energy");
    let chosen = &record["recommendation"]["point"];
    let good = points(record).iter().filter(|point| number(point, "error.energy") <= 0.1 * energy);
    let least = good.map(|point| number(point, "cycles")).fold(f64::INFINITY, f64::min);
    assert_eq!(number(chosen, "cycles"), least);
}

/// One setting is enough to find that nothing meets a wish.
fn no_point_meets_a_wish(bench: &Bench) {
    let (fragment, none) = (bench.folder.word("out/recommended.toml"), bench.folder.word("none"));
    let stderr = run(&["trade", &fragment, "--max-error", "1e-30", "--out", &none]).refuses();
    assert!(stderr.contains("the most accurate"), "{stderr}");
    let record = bench.record("none");
    assert!(record["recommendation"]["point"].is_null());
    assert!(!bench.path("none/recommended.toml").exists());
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
    let rows: [(&[&str], &str); 5] = [
        (&["--promise", "5%", "--target", "m4f"], "--promise"),
        (&["--shard", "3/2"], "--shard"),
        (&["--max-error", "-1%"], "expected a number > 0"),
        (&["--budget-cycles", "0"], "--budget-cycles"),
        (&["--target", "m3"], "m3"),
    ];
    each_refused(&rows, |more| bench.trade("out", more).refuses());
    let twice = run(&["trade", &bench.scene, &bench.scene]).refuses();
    says(&twice, &["two scenes of one name"]);
    says(&run(&["trade", "--no-peers"]).refuses(), &["--no-peers without a scene"]);
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

/// Each committed recommendation solved, where the exact solution tells.
#[test]
fn committed_recommendations_keep_their_promise() {
    let mut kept = 0;
    for (folder, record) in recorded("host").into_iter().chain(recorded("m4f")) {
        let fragment = folder.join("recommended.toml");
        if record["truth"] != "the exact solution" || !fragment.exists() {
            continue;
        }
        let scene = Scene::read(&fragment).expect("a scene");
        let mesh = mesh_of_scene(&scene).expect("a mesh").mesh;
        let problem = Problem::new(&scene, mesh).expect("a problem");
        let solution = SolveRequest::default().solve(&problem).expect("a solution");
        let prescribed = scene.setting.is_some_and(|setting| setting.sweeps.is_some());
        assert!(solution.converged() || prescribed, "{}", fragment.display());
        let exact = scene.exact.as_ref().expect("an exact solution");
        let found = errors(exact, &problem, &solution.u, &solution.flux).expect("errors").energy;
        let promised = number(&record["recommendation"]["point"], "error.energy");
        // A patch is exact to rounding, and rounding is no promise.
        let size = promised + 2e-5 * number(&record, "energy");
        KEPT.check_over(fragment.display(), found - promised, size);
        kept += 1;
    }
    assert!(kept >= 30, "{kept}");
}

#[test]
fn every_standard_scene_is_in_the_record() {
    let mut scenes = Vec::new();
    for folder in ["catalogue", "scenes"] {
        let steady = scenes_of(&repository("meshes").join(folder)).expect("scenes");
        let stem = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
        scenes.extend(steady.iter().map(stem));
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

/// A solver on a problem, where it took part.
fn baseline<'r>(of: &'r Value, solver: &str, problem: &str, start: &str) -> Option<&'r Value> {
    let all = of["baselines"].as_array().expect("baselines");
    all.iter().find(|b| b["solver"] == solver && b["problem"] == problem && b["start"] == start)
}

/// A solver's warm ticks on the condensed problem of a scene.
fn warm<'r>(record: &'r Value, solver: &str) -> &'r Value {
    baseline(record, solver, "condensed", "warm").expect(solver)
}

/// The least and the greatest.
fn range(numbers: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let nothing = [f64::INFINITY, f64::NEG_INFINITY];
    numbers.into_iter().fold(nothing, |[least, most], x| [least.min(x), most.max(x)])
}

/// Asserts that the page on benchmarks has these words.
fn the_page_has(quotes: &[String]) {
    let page = text(repository("docs/benchmarks.md"));
    let missing: Vec<_> = quotes.iter().filter(|quote| !page.contains(*quote)).collect();
    assert!(missing.is_empty(), "docs/benchmarks.md lacks {missing:#?}");
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
    const SOLVERS: [(&str, &str); 7] = [
        ("kernel PSOR f64", "full"),
        ("kernel PSOR f64, tuned ω", "full"),
        ("kernel PSOR f64, coarse to fine", "full"),
        ("faer active set", "full"),
        ("Clarabel", "full"),
        ("OSQP", "full"),
        ("kernel pivoting f64", "condensed"),
    ];
    let sizes = read(repository("host/benches/trade/sizes.json"));
    let page = text(repository("docs/benchmarks.md"));
    let lines: Vec<Vec<&str>> =
        page.lines().map(|line| line.split_whitespace().collect()).collect();
    for start in ["cold", "warm"] {
        for size in sizes["rows"].as_array().expect("rows") {
            let cycles = |(solver, problem): &(&str, &str)| {
                let found = baseline(size, solver, problem, start);
                short(found.map(|found| number(found, "cycles")))
            };
            let mut line = vec![size["unknowns"].to_string()];
            line.extend(SOLVERS.iter().map(cycles));
            let is_there = lines.contains(&line.iter().map(|cell| &**cell).collect());
            assert!(is_there, "{start}: {line:?}");
        }
    }
}

/// Scenes whose fluxes have limits: others take their dual problem or slacks, and the page has a table of its own for them.
const LIMITED: [&str; 1] = ["antiicing"];

/// The ratios of condensed warm ticks, on scenes with more than rounding to be wrong about.
#[test]
fn the_page_says_how_far_condensed_ticks_are_ahead() {
    let records: Vec<Value> = recorded("host").into_iter().map(|(_, record)| record).collect();
    let is_near = |b: &Value| number(b, "algebraic_error") <= number(b, "target");
    let own = |record| (warm(record, "kernel pivoting f64"), record);
    let is_limited =
        |(_, record): &(_, &Value)| LIMITED.contains(&record["scene"].as_str().expect("a name"));
    let (limited, all): (Vec<_>, Vec<_>) = records.iter().map(own).partition(is_limited);
    let (scenes, exact): (Vec<_>, Vec<_>) = all.into_iter().partition(|(own, _)| is_near(own));
    assert!(exact.iter().all(|(_, record)| record["scene"] == "patch-mixed"));
    let mut quotes = Vec::new();
    for (solver, promised) in [
        ("Clarabel", 20.0),
        ("OSQP as it comes", 20.0),
        ("OSQP, polished", 20.0),
        ("OSQP", 20.0),
        ("OSQP, every iteration", 0.0),
    ] {
        let ratio = |(own, record): &(&Value, &Value), key: &str| {
            number(warm(record, solver), key) / number(own, key)
        };
        let is_far = |(_, record): &&(&Value, &Value)| !is_near(warm(record, solver));
        let far = scenes.iter().filter(is_far).count();
        match solver {
            "OSQP as it comes" => quotes.push(format!("in {far} of {} scenes", scenes.len())),
            _ => assert_eq!(far, 0, "{solver}"),
        }
        let mut found: Vec<f64> = scenes.iter().map(|of| ratio(of, "cycles")).collect();
        found.sort_by(f64::total_cmp);
        if solver == "OSQP, every iteration" {
            let second = found[1].floor();
            quotes.push(format!("on all other scenes it takes {second:.0} times as long or more"));
        }
        assert!(exact.iter().all(|of| ratio(of, "cycles") >= promised), "{solver}");
        for of in &limited {
            let [median, slowest] = ["cycles", "worst"].map(|key| ratio(of, key));
            quotes.push(format!("{solver:<22}{median:>6.0}{slowest:>10.0}"));
        }
        let [slowest, _] = range(scenes.iter().map(|of| ratio(of, "worst")));
        let [least, most] = range(found);
        assert!(least >= promised, "{solver} takes {least} times as long at least");
        quotes.push(format!("{solver:<22}{least:>6.0}{most:>8.0}{slowest:>10.0}"));
    }
    let all = |key: &str| range(scenes.iter().map(|(own, _)| 1e-3 * number(own, key)));
    let ([least, median], [_, slowest]) = (all("cycles"), all("worst"));
    quotes.push(format!("{least:.1} to {median:.1} thousand cycles"));
    quotes.push(format!("{slowest:.0} thousand in the slowest tick"));
    for (own, _) in &limited {
        let [median, slowest] = ["cycles", "worst"].map(|key| 1e-3 * number(own, key));
        quotes.push(format!(
            "{median:.1} thousand cycles in the median, {slowest:.1} in the slowest tick"
        ));
    }
    let full = scenes.iter().flat_map(|(_, record)| record["baselines"].as_array().unwrap());
    let full = full.filter(|b| b["problem"] == "full" && b["start"] == "warm" && is_near(b));
    let [least, _] = range(full.filter_map(|b| b["to_condensed"].as_f64()));
    quotes.push(format!("{} times as long at least", least.floor()));
    the_page_has(&quotes);
}

/// The costs of micromath in the kernel and in load data.
#[test]
fn the_page_says_what_micromath_costs() {
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
    let [fewest, most] = range(more);
    let ticks = format!("from {:.1} % fewer instructions a tick to {most:.1} % more", -fewest);
    let records = recorded("host");
    let all = records.iter().flat_map(|(_, record)| record["math"].as_array().expect("math"));
    let of_kernel = ["search for ω", "lengths of edges"];
    let in_load = |m: &&Value| !of_kernel.contains(&m["used_in"].as_str().unwrap());
    let in_loads: Vec<_> = all.filter(in_load).collect();
    let errors = |functions: [&str; 2]| {
        let of = |m: &&&Value| functions.contains(&m["function"].as_str().unwrap());
        range(in_loads.iter().filter(of).map(|m| 100.0 * number(m, "energy")))
    };
    let [least, most] = errors(["sin", "cos"]);
    let waves = format!("for an error of {least:.2} to {most:.2} %");
    let [least, most] = errors(["powf", "sqrt"]);
    let powers = format!("its power and square root cost {least:.1} to {most:.0} %");
    the_page_has(&[ticks, waves, powers]);
}

//! `signorini bake` and `condense` as users meet them: the module, the budgets, the explanation.

use std::path::Path;
use std::process::Command;

use crate::command::{Folder, Run, meshes, repository, run, says, text};

/// Bakes `scene` of the repository with `changes` made to its text; the source where there is one.
fn bake(scene: &str, changes: &[(&str, &str)], more: &[&str]) -> (Run, Option<String>) {
    let folder = Folder::new();
    let changed = folder.scene("scene.toml", scene, changes);
    let run = run(&[&["bake", &changed, "-o", &folder.word("scene.rs")], more].concat());
    (run, std::fs::read_to_string(folder.path("scene.rs")).ok())
}

const LEVEE: &str = "scenes/levee.toml";

/// The run that bakes a module of the levee, and the source.
#[track_caller]
fn baked(changes: &[(&str, &str)], more: &[&str]) -> (Run, String) {
    let (run, source) = bake(LEVEE, changes, more);
    (run.succeeds(), source.expect("a module"))
}

/// The message of a scene that is no module.
#[track_caller]
fn refused_of(scene: &str, changes: &[(&str, &str)], more: &[&str]) -> String {
    let (run, source) = bake(scene, changes, more);
    assert_eq!(source, None);
    run.refuses()
}

/// The message of a levee that is no module.
#[track_caller]
fn refused(changes: &[(&str, &str)], more: &[&str]) -> String {
    refused_of(LEVEE, changes, more)
}

#[test]
fn the_levee_is_condensed_and_its_module_says_so() {
    let parts = [
        "pub const MODEL: &str = \"condensed\";",
        "pub rain: Scalar,",
        "pub wet: Scalar,",
        "pub const CONTACT: usize = 7;",
        "pub const WORST_PROVEN: bool = true;",
        "pub const WORST_EXCHANGES: u32 = 10;",
        "pub const WORST_INSTRUCTIONS: u32 = ",
        "//! Kernel features: none.",
        "A flux is (A∇u)·n with the normal outward: positive where u rises",
        "scene hash",
    ];
    says(&baked(&[], &[]).1, &parts);
    says(&baked(&[], &["--full-edges"]).1, &["pub const CONTACT: usize = 50;"]);
}

#[test]
fn what_does_not_fit_is_an_error_with_the_shortfall() {
    let little = refused(&[("ram = 196608", "ram = 1200")], &["--condensed", "--full-edges"]);
    let parts = ["target.ram", "bytes are needed, 1200 declared", "contact edges would fit"];
    says(&little, &parts);
    let hopeless = refused(&[("flash = 1048576", "flash = 1000")], &[]);
    says(&hopeless, &["target.flash", "the code"]);
    let slow = refused(&[("tick = 0.001", "tick = 1e-5")], &[]);
    let median = "instructions in the median tick, at least 1.4 each";
    says(&slow, &["target.tick", "1680 declared", median]);
}

/// 67 200 and 50 400 cycles: with its bound the levee with all edges takes more, without it less than the first.
#[test]
fn the_bound_is_not_left_out_to_make_room() {
    for tick in ["tick = 0.0004", "tick = 0.0003"] {
        let said = refused(&[("tick = 0.001", tick)], &["--full-edges"]);
        says(&said, &["target.tick: ", " too many"]);
    }
    let tight = ("tick = 0.001", "tick = 0.0004");
    let all = ["--condensed", "--full-edges"];
    says(
        &bake(LEVEE, &[tight], &all).0.stderr,
        &["(certificate = false in [setting]) it would fit"],
    );
    let without = "[setting]\nmodel = \"condensed\"\ncertificate = false\n[target]";
    let source = baked(&[tight, ("[target]", without)], &all[1..]).1;
    says(&source, &["(certificate = false leaves it out)"]);
    // Room in flash for all but the bound.
    says(&refused(&[("flash = 1048576", "flash = 60000")], &all), &["target.flash"]);
}

#[test]
fn a_condensed_model_has_the_solver_that_is_asked_for() {
    let with = |lines: &str, more: &[&str]| {
        let setting = format!("[setting]\n{lines}\n[target]");
        // Sweeps on the levee take longer than its device has.
        let changes = [("[target]", setting.as_str()), ("tick = 0.001", "tick = 0.01")];
        bake(LEVEE, &changes, more)
    };
    let exact = with("solver = \"exact\"", &[]).1.expect("a module");
    says(&exact, &["MODEL: &str = \"condensed\"", "pub const WORST_EXCHANGES"]);
    for (lines, more) in [
        ("model = \"condensed\"\nsolver = \"sweeps\"", &[][..]),
        ("solver = \"sweeps\"", &["--condensed"]),
    ] {
        let (run, sweeps) = with(&format!("{lines}\ncertificate = false"), more);
        let sweeps = sweeps.unwrap_or_default();
        assert!(sweeps.contains("MODEL: &str = \"condensed\""), "{run:?}");
        assert!(!sweeps.contains("WORST_EXCHANGES") && sweeps.contains("pub const SWEEPS"));
    }
    for (solver, model) in [("exact", "full"), ("factor", "condensed")] {
        let (run, _) = with(&format!("solver = \"{solver}\""), &[&format!("--{model}")]);
        let message = format!("setting.solver: means nothing to the {model} model");
        says(&run.refuses(), &[&message]);
    }
}

#[test]
fn a_device_without_room_for_the_tableau_gets_sweeps() {
    let tight = [("ram = 196608", "ram = 6000"), ("tick = 0.001", "tick = 0.01")];
    let (_, source) = baked(&tight, &["--full-edges"]);
    assert!(!source.contains("TableauStorage") && source.contains("pub const SWEEPS"));
}

#[test]
fn an_output_that_stands_in_the_way_is_named() {
    let bound = [
        ("[output.wet]", "[output.error]\nkind = \"bound\"\n[output.wet]"),
        ("flash = 1048576", "flash = 45000"),
        ("tick = 0.001", "tick = 0.01"),
    ];
    let without = "without output.error and its error bound (certificate = false in [setting])";
    let said = refused(&bound, &["--condensed", "--full-edges"]);
    says(&said, &[&format!("{without} it would fit")]);
}

#[test]
fn a_bound_that_is_read_is_not_left_infinite_where_a_model_has_one() {
    // Where an input without a range decides which of two gaps is the larger one, only the full model has a bound.
    let lift = "[input.lift]\nof = \"crest\"\nfield = \"gap\"\npattern = \"1\"\n";
    let lifted = format!("flux = \"-5e-8\"\n{lift}");
    let jump = [
        ("flux = \"-5e-8\"\n", lifted.as_str()),
        ("tick = 0.001", "tick = 1.0"),
        ("[output.wet]", "[output.error]\nkind = \"bound\"\n[output.wet]"),
    ];
    let (full, condensed) = ("MODEL: &str = \"full\"", "MODEL: &str = \"condensed\"");
    let (run, source) = baked(&jump, &["--explain"]);
    says(&source, &[full]);
    says(&run.stdout, &["has no error bound"]);
    // Also where no output reads it.
    says(&baked(&jump[..2], &[]).1, &[full]);
    // A model that is asked for and has none says why.
    let (run, source) = baked(&jump, &["--condensed"]);
    let gaps = "the gaps of the contact boundaries that meet at";
    says(&source, &[&format!("without an error bound ({gaps}")]);
    says(&run.stderr, &[&format!("warning: there is no error bound: {gaps}")]);
    // Gaps that differ by what is known beforehand are no matter.
    let known = [("gap = \"-y\"\nflux", "gap = \"-y - 0.5\"\nflux"), jump[2]];
    let (_, source) = baked(&known, &[]);
    says(&source, &[condensed]);
    assert!(!source.contains("without an error bound"));
    let silent = [jump[0], ("[target]", "[setting]\ncertificate = false\n[target]")];
    let (run, source) = baked(&silent, &[]);
    says(&source, &[condensed]);
    assert!(!run.stderr.contains("error bound"), "{run:?}");
}

#[test]
fn a_key_for_the_full_model_alone_asks_for_it() {
    for key in ["solver = \"factor\"", "share = 0.1", "omega = 1.9", "start = \"cold\""] {
        let setting = format!("[setting]\n{key}\n[target]");
        let changes = [("[target]", setting.as_str())];
        says(&baked(&changes, &[]).1, &["MODEL: &str = \"full\""]);
        let name = key.split(' ').next().unwrap_or_default();
        let message = format!("setting.{name}: means nothing to the condensed model");
        says(&refused(&changes, &["--condensed"]), &[&message]);
    }
}

#[test]
fn hints_do_not_promise_meshes_that_cannot_be() {
    for (model, flash) in [("--condensed", "1000"), ("--full", "1000"), ("--full", "20000")] {
        let small = [("1048576", flash), ("tick = 0.001", "tick = 1.0")];
        says(&refused(&small, &[model]), &["no mesh is coarse enough"]);
    }
    says(&baked(&[("clock = 168e6", "")], &[]).0.stderr, &["target.tick is no limit"]);
}

#[test]
fn a_scene_is_not_written_over() {
    let folder = Folder::new();
    let files = ["scenes/levee.toml", "scenes/levee.msh"]
        .map(|name| folder.write(&name["scenes/".len()..], text(meshes(name))));
    let out = folder.word("levee.rs");
    let said = run(&["bake", &files[0], "-o", &out]).succeeds().stderr;
    says(&said, &[&format!("note: {out} is written: a condensed model in f32, about ")]);
    let said = run(&["bake", &files[0], "-o", &folder.word("")]).refuses();
    says(&said, &["-o ", "is a directory, expected a file", "name a file in it"]);
    for file in &files {
        let before = text(file);
        says(&run(&["bake", &files[0], "-o", file]).refuses(), &["-o "]);
        assert_eq!(before, text(file));
    }
}

#[test]
fn the_explanation_tells_each_feature() {
    let Run { stdout, .. } = baked(&[], &["--explain"]).0;
    let chosen =
        ["condensed, exact method", "chosen", "full", "[target]", "quads", "no quads", "tensors"];
    says(&stdout, &chosen);
    let sides = ["always open", "along the boundary", "\"seepage face\"", "(30, 0)"];
    says(&stdout, &[&sides[..], &["largest seen", "error bound seen"]].concat());
    let (_, ranges) = stdout.split_once("Ranges of the inputs").expect("a section");
    let (ranges, worst) = ranges.split_once("\nWorst case").expect("a section");
    let page = text(repository("docs/firmware.md"));
    for section in [format!("Ranges of the inputs{ranges}"), format!("Worst case{worst}")] {
        assert!(page.contains(&format!("```text\n{}\n```", section.trim_end())), "{section}");
    }
    let all = baked(&[], &["--explain", "--full-edges"]).0;
    says(&all.stdout, &["--full-edges keeps all of them"]);
    let Run { stdout, .. } = bake("scenes/slab.toml", &[], &["--explain", "--full"]).0;
    assert!(!stdout.contains("Ranges of the inputs"), "{stdout}");
    says(&stdout, &["no triangles", "Robin edges"]);
}

#[test]
fn scenes_that_no_model_represents_are_refused() {
    let moving = refused_of("catalogue/moving-tri.toml", &[], &[]);
    says(&moving, &["boundary.dirichlet.value", "[input"]);
    says(&refused_of("scenes/membrane.toml", &[], &["--full"]), &["--condensed"]);
    says(&refused(&[], &["--input", "snow=1"]), &["rain, river"]);
}

/// The line for a Cargo.toml that a module prints builds as it stands, in a package anywhere.
#[test]
fn the_dependency_line_builds_as_printed() {
    let (_, source) = baked(&[], &[]);
    let line = source.lines().find_map(|line| line.strip_prefix("//! signorini-device = "));
    let line = line.expect("a dependency line");
    let package = Folder::new();
    std::fs::create_dir(package.path("src")).expect("a folder");
    let head = "[package]\nname = \"firmware\"\nedition = \"2024\"\n\n[dependencies]\n";
    package.write("Cargo.toml", format!("{head}signorini-device = {line}\n"));
    package.write("src/levee.rs", &source);
    package.write(
        "src/main.rs",
        "mod levee;\nfn main() {\n    let _ = levee::Controller::new();\n}\n",
    );
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("dependency-line");
    let mut check = Command::new(env!("CARGO"));
    check.args(["check", "--quiet", "--offline", "--target-dir"]).arg(target);
    let checked = check.current_dir(package.path("")).output().expect("cargo");
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
}

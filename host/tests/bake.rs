//! `signorini bake` and `condense` as users meet them: the module, the budgets, the explanation.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Exit status, standard output and error of `signorini`.
fn signorini(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_signorini")).args(arguments).output();
    let output = output.expect("the binary runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let stderr = text(&output.stderr);
    assert!(!stderr.contains("panicked"), "{stderr}");
    (output.status.code().unwrap_or(-1), text(&output.stdout), stderr)
}

fn meshes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes")
}

/// Bakes `scene` of the repository with `changes` made to its text; the source where there is one.
fn bake(
    scene: &str,
    changes: &[(&str, &str)],
    more: &[&str],
) -> (i32, String, String, Option<String>) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = meshes().join(scene);
    let mut text = std::fs::read_to_string(&path).expect("the scene");
    let mesh = path.parent().expect("a folder").canonicalize().expect("the folder");
    text = text.replace("mesh = \"", &format!("mesh = \"{}/", mesh.display()));
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    let changed = folder.path().join("scene.toml");
    std::fs::write(&changed, text).expect("a scene");
    let out = folder.path().join("scene.rs");
    let (changed, place) = (changed.to_string_lossy(), out.to_string_lossy());
    let mut arguments = vec!["bake", &changed, "-o", &place];
    arguments.extend(more);
    let (status, stdout, stderr) = signorini(&arguments);
    (status, stdout, stderr, std::fs::read_to_string(out).ok())
}

#[test]
fn the_levee_is_condensed_and_its_module_says_so() {
    let (status, _, _, source) = bake("scenes/levee.toml", &[], &[]);
    let source = source.expect("a module");
    assert_eq!(status, 0);
    for part in [
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
    ] {
        assert!(source.contains(part), "{part}");
    }
    let (_, _, _, source) = bake("scenes/levee.toml", &[], &["--full-edges"]);
    assert!(source.expect("a module").contains("pub const CONTACT: usize = 50;"));
}

#[test]
fn what_does_not_fit_is_an_error_with_the_shortfall() {
    let little = [("ram = 196608", "ram = 1200")];
    let all = ["--condensed", "--full-edges"];
    let (status, _, stderr, source) = bake("scenes/levee.toml", &little, &all);
    assert_eq!(status, 2);
    assert!(source.is_none());
    for part in ["target.ram", "bytes are needed, 1200 declared", "contact edges would fit"] {
        assert!(stderr.contains(part), "{part}: {stderr}");
    }
    let hopeless = [("flash = 1048576", "flash = 1000")];
    let (status, _, stderr, _) = bake("scenes/levee.toml", &hopeless, &[]);
    assert_eq!(status, 2);
    assert!(stderr.contains("target.flash") && stderr.contains("the code"), "{stderr}");
    let slow = [("tick = 0.001", "tick = 1e-5")];
    let (status, _, stderr, _) = bake("scenes/levee.toml", &slow, &[]);
    assert_eq!(status, 2);
    for part in
        ["target.tick", "1680 declared", "instructions in the median tick, at least 1.4 each"]
    {
        assert!(stderr.contains(part), "{part}: {stderr}");
    }
}

/// 67 200 and 50 400 cycles: with its bound the levee with all edges takes more, without it less than the first.
#[test]
fn the_bound_is_not_left_out_to_make_room() {
    for tick in ["tick = 0.0004", "tick = 0.0003"] {
        let tight = [("tick = 0.001", tick)];
        let (status, _, stderr, source) = bake("scenes/levee.toml", &tight, &["--full-edges"]);
        assert_eq!((status, source), (2, None), "{tick}: {stderr}");
        assert!(stderr.contains("target.tick: ") && stderr.contains(" too many"), "{stderr}");
    }
    let tight = [("tick = 0.001", "tick = 0.0004")];
    let all = ["--condensed", "--full-edges"];
    let (_, _, stderr, _) = bake("scenes/levee.toml", &tight, &all);
    assert!(stderr.contains("(certificate = false in [setting]) it would fit"), "{stderr}");
    let asked =
        [tight[0], ("[target]", "[setting]\nmodel = \"condensed\"\ncertificate = false\n[target]")];
    let (status, _, stderr, source) = bake("scenes/levee.toml", &asked, &["--full-edges"]);
    let source = source.expect("a module");
    assert!(status == 0 && source.contains("(certificate = false leaves it out)"), "{stderr}");
    // Room in flash for all but the bound.
    let little = [("flash = 1048576", "flash = 60000")];
    let (status, _, stderr, source) = bake("scenes/levee.toml", &little, &all);
    assert_eq!((status, source), (2, None), "{stderr}");
    assert!(stderr.contains("target.flash"), "{stderr}");
}

#[test]
fn a_condensed_model_has_the_solver_that_is_asked_for() {
    let with = |lines: &str, more: &[&str]| {
        let setting = format!("[setting]\n{lines}\n[target]");
        // Sweeps on the levee take longer than its device has.
        let changes = [("[target]", setting.as_str()), ("tick = 0.001", "tick = 0.01")];
        let (status, _, stderr, source) = bake("scenes/levee.toml", &changes, more);
        (status, stderr, source.unwrap_or_default())
    };
    let exact = with("solver = \"exact\"", &[]).2;
    assert!(
        exact.contains("MODEL: &str = \"condensed\"")
            && exact.contains("pub const WORST_EXCHANGES")
    );
    for (lines, more) in [
        ("model = \"condensed\"\nsolver = \"sweeps\"", &[][..]),
        ("solver = \"sweeps\"", &["--condensed"]),
    ] {
        let (status, stderr, sweeps) = with(&format!("{lines}\ncertificate = false"), more);
        assert!(sweeps.contains("MODEL: &str = \"condensed\""), "{status} {stderr}");
        assert!(!sweeps.contains("WORST_EXCHANGES") && sweeps.contains("pub const SWEEPS"));
    }
    for (solver, model) in [("exact", "full"), ("factor", "condensed")] {
        let (status, stderr, _) = with(&format!("solver = \"{solver}\""), &[&format!("--{model}")]);
        let message = format!("setting.solver: means nothing to the {model} model");
        assert!(status == 2 && stderr.contains(&message), "{stderr}");
    }
}

#[test]
fn a_device_without_room_for_the_tableau_gets_sweeps() {
    let tight = [("ram = 196608", "ram = 6000"), ("tick = 0.001", "tick = 0.01")];
    let (status, _, _, source) = bake("scenes/levee.toml", &tight, &["--full-edges"]);
    let source = source.expect("a module");
    assert_eq!(status, 0);
    assert!(!source.contains("TableauStorage") && source.contains("pub const SWEEPS"));
}

#[test]
fn an_output_that_stands_in_the_way_is_named() {
    let bound = [
        ("[output.wet]", "[output.error]\nkind = \"bound\"\n[output.wet]"),
        ("flash = 1048576", "flash = 45000"),
        ("tick = 0.001", "tick = 0.01"),
    ];
    let all = ["--condensed", "--full-edges"];
    let (status, _, stderr, _) = bake("scenes/levee.toml", &bound, &all);
    assert_eq!(status, 2);
    let hint =
        "without output.error and its error bound (certificate = false in [setting]) it would fit";
    assert!(stderr.contains(hint), "{stderr}");
}

#[test]
fn a_bound_that_is_read_is_not_left_infinite_where_a_model_has_one() {
    // Where the gap jumps, only the full model has a bound.
    let jump = [
        ("gap = \"-y\"\nflux", "gap = \"-y - 0.5\"\nflux"),
        ("tick = 0.001", "tick = 1.0"),
        ("[output.wet]", "[output.error]\nkind = \"bound\"\n[output.wet]"),
    ];
    let (status, stdout, _, source) = bake("scenes/levee.toml", &jump, &["--explain"]);
    assert_eq!(status, 0);
    assert!(source.expect("a module").contains("MODEL: &str = \"full\""), "{stdout}");
    assert!(stdout.contains("has no error bound"), "{stdout}");
    // Also where no output reads it.
    let (_, _, _, source) = bake("scenes/levee.toml", &jump[..2], &[]);
    assert!(source.expect("a module").contains("MODEL: &str = \"full\""));
    // Who asks for a model that has none is told why.
    let (_, _, stderr, source) = bake("scenes/levee.toml", &jump, &["--condensed"]);
    assert!(source.expect("a module").contains("without an error bound (the gap has a jump"));
    assert!(stderr.contains("warning: there is no error bound: the gap has a jump"), "{stderr}");
    let silent = [jump[0], ("[target]", "[setting]\ncertificate = false\n[target]")];
    let (_, _, stderr, source) = bake("scenes/levee.toml", &silent, &[]);
    assert!(source.expect("a module").contains("MODEL: &str = \"condensed\""));
    assert!(!stderr.contains("error bound"), "{stderr}");
}

#[test]
fn a_key_for_the_full_model_alone_asks_for_it() {
    for key in ["solver = \"factor\"", "share = 0.1", "omega = 1.9", "start = \"cold\""] {
        let setting = format!("[setting]\n{key}\n[target]");
        let changes = [("[target]", setting.as_str())];
        let (_, _, stderr, source) = bake("scenes/levee.toml", &changes, &[]);
        assert!(source.expect("a module").contains("MODEL: &str = \"full\""), "{key}: {stderr}");
        let (status, _, stderr, source) = bake("scenes/levee.toml", &changes, &["--condensed"]);
        assert_eq!((status, source), (2, None), "{key}");
        let name = key.split(' ').next().unwrap_or_default();
        let message = format!("setting.{name}: means nothing to the condensed model");
        assert!(stderr.contains(&message), "{stderr}");
    }
}

#[test]
fn hints_do_not_promise_meshes_that_cannot_be() {
    for (model, target) in
        [("--condensed", "flash = 1000"), ("--full", "flash = 1000"), ("--full", "flash = 20000")]
    {
        let small = [("flash = 1048576", target), ("tick = 0.001", "tick = 1.0")];
        let (status, _, stderr, source) = bake("scenes/levee.toml", &small, &[model]);
        assert_eq!((status, source), (2, None));
        assert!(stderr.contains("no mesh is coarse enough"), "{stderr}");
    }
    let (status, _, stderr, _) = bake("scenes/levee.toml", &[("clock = 168e6", "")], &[]);
    assert_eq!(status, 0);
    assert!(stderr.contains("target.tick is no limit"), "{stderr}");
}

#[test]
fn a_scene_is_not_written_over() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = ["levee.toml", "levee.msh"].map(|name| {
        let copy = folder.path().join(name);
        std::fs::copy(meshes().join("scenes").join(name), &copy).expect("a copy");
        copy.to_string_lossy().into_owned()
    });
    for file in &files {
        let before = std::fs::read(file).expect("a file");
        let (status, _, stderr) = signorini(&["bake", &files[0], "-o", file]);
        assert_eq!(status, 2);
        assert!(stderr.contains("-o "), "{stderr}");
        assert_eq!(before, std::fs::read(file).expect("the same file"));
    }
}

#[test]
fn the_explanation_tells_each_feature() {
    let (status, stdout, _, _) = bake("scenes/levee.toml", &[], &["--explain"]);
    assert_eq!(status, 0);
    for part in
        ["condensed, exact method", "chosen", "full", "[target]", "quads", "no quads", "tensors"]
    {
        assert!(stdout.contains(part), "{part}: {stdout}");
    }
    for part in [
        "always open",
        "along the boundary",
        "\"seepage face\"",
        "(30, 0)",
        "largest seen",
        "error bound seen",
    ] {
        assert!(stdout.contains(part), "{part}: {stdout}");
    }
    let (_, ranges) = stdout.split_once("Ranges of the inputs").expect("a section");
    let (ranges, worst) = ranges.split_once("\nWorst case").expect("a section");
    let page = include_str!("../../docs/firmware.md");
    for section in [format!("Ranges of the inputs{ranges}"), format!("Worst case{worst}")] {
        assert!(page.contains(&format!("```text\n{}\n```", section.trim_end())), "{section}");
    }
    let (_, stdout, _, _) = bake("scenes/levee.toml", &[], &["--explain", "--full-edges"]);
    assert!(stdout.contains("--full-edges keeps all of them"), "{stdout}");
    let (_, stdout, _, _) = bake("scenes/slab.toml", &[], &["--explain", "--full"]);
    assert!(!stdout.contains("Ranges of the inputs"), "{stdout}");
    assert!(stdout.contains("no triangles") && stdout.contains("Robin edges"), "{stdout}");
}

#[test]
fn scenes_that_no_model_represents_are_refused() {
    let (status, _, stderr, source) = bake("catalogue/moving-tri.toml", &[], &[]);
    assert_eq!(status, 2);
    assert!(source.is_none());
    assert!(stderr.contains("boundary.dirichlet.value") && stderr.contains("[input"), "{stderr}");
    let (status, _, stderr, _) = bake("scenes/membrane.toml", &[], &["--full"]);
    assert_eq!(status, 2);
    assert!(stderr.contains("--condensed"), "{stderr}");
    let (status, _, stderr, _) = bake("scenes/levee.toml", &[], &["--input", "snow=1"]);
    assert_eq!(status, 2);
    assert!(stderr.contains("rain, river"), "{stderr}");
}

#[test]
fn the_dense_problem_is_a_c_header() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("problem.h");
    let scene = meshes().join("scenes/strip.toml");
    let (status, _, _) =
        signorini(&["condense", &scene.to_string_lossy(), "-o", &out.to_string_lossy()]);
    let text = std::fs::read_to_string(out).expect("a header");
    assert_eq!(status, 0);
    assert!(text.contains("#define N 64 ") && text.contains("#define M 2 "));
    let start = text.find("S[N * N] = {").expect("S") + "S[N * N] = {".len();
    let numbers = text[start..].split('}').next().expect("numbers").split(',');
    let numbers: Vec<f32> =
        numbers.map(|x| x.trim().trim_end_matches('f').parse().expect("a number")).collect();
    assert_eq!(numbers.len(), 64 * 64);
    assert!((0..64).all(|i| numbers[65 * i] == 1.0), "a unit diagonal");
    assert!((0..64 * 64).all(|at| numbers[at] == numbers[at % 64 * 64 + at / 64]), "symmetric");
}

/// What a module prints for a Cargo.toml builds as it stands, in a package anywhere.
#[test]
fn the_dependency_line_builds_as_printed() {
    let (status, _, _, source) = bake("scenes/levee.toml", &[], &[]);
    assert_eq!(status, 0);
    let source = source.expect("a module");
    let line = source.lines().find_map(|line| line.strip_prefix("//! signorini-kernel = "));
    let line = line.expect("a dependency line");
    let package = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = package.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, text).expect("a file");
    };
    let head = "[package]\nname = \"firmware\"\nedition = \"2024\"\n\n[dependencies]\n";
    write("Cargo.toml", &format!("{head}signorini-kernel = {line}\n"));
    write("src/levee.rs", &source);
    write("src/main.rs", "mod levee;\nfn main() {\n    let _ = levee::Controller::new();\n}\n");
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("dependency-line");
    let checked = Command::new(env!("CARGO"))
        .args(["check", "--quiet", "--offline", "--target-dir"])
        .arg(target)
        .current_dir(package.path())
        .output()
        .expect("cargo");
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
}

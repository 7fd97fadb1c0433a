//! The command as users and scripts meet it: files, exit status, messages.

use signorini_tolerances::command::{DIRECT, DIRECT_NARROW, PRINTED};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn signorini(arguments: &[&str]) -> Output {
    let command = Command::new(env!("CARGO_BIN_EXE_signorini")).args(arguments).output();
    command.expect("the binary runs")
}

fn meshes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes")
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Runs `solve` on a scene of the repository; returns exit status, folder and summary.
fn solve(scene: &str, more: &[&str]) -> (i32, tempfile::TempDir, Value) {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = meshes().join(scene);
    let out = folder.path().to_string_lossy().into_owned();
    let mut arguments = vec!["solve", scene.to_str().expect("a path in UTF-8"), "--out", &out];
    arguments.extend(more);
    let output = signorini(&arguments);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!stderr.contains("panicked"), "{stderr}");
    let summary = serde_json::from_str(&text(&folder.path().join("summary.json")));
    (output.status.code().unwrap_or(-1), folder, summary.expect("valid JSON"))
}

/// u_D has no value at x = 1/32, which is a vertex of the mesh refined once alone.
#[test]
fn what_a_finer_mesh_cannot_hold_costs_the_estimate_alone() {
    let scene = text(&meshes().join("catalogue/b-tri.toml"));
    let (before, exact) = scene.split_once("[exact]").expect("an exact solution");
    assert!(exact.contains("gradient"));
    let known = before.lines().find(|line| line.starts_with("value = ")).expect("u_D");
    let value = format!(
        "{}) + 0*ln(abs(x - 0.03125))\"",
        known.replace("= \"", "= \"(").trim_end_matches('"')
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.toml");
    let mesh = meshes().join("catalogue/square-tri-16.msh");
    let before =
        before.replace(known, &value).replace("square-tri-16.msh", mesh.to_str().expect("UTF-8"));
    let outputs = "[output.skin]\nkind = \"mean\"\nof = \"contact\"\n";
    std::fs::write(&path, before + outputs).expect("a scene");
    let (status, _, summary) = solve(path.to_str().expect("UTF-8"), &[]);
    assert_eq!(status, 0);
    let skin = &summary["output_bounds"]["skin"];
    assert!(skin["plus_minus"].is_f64() && skin["estimate"].is_null(), "{skin}");
}

#[test]
fn solve_writes_its_three_files() {
    let (status, folder, summary) = solve("catalogue/h-mixed.toml", &[]);
    assert_eq!(status, 0);
    let edges = text(&folder.path().join("edges.csv"));
    let header = "x0,y0,x1,y1,kind,u_mean,flux_normal,boundary,psi,q,limit,lambda,state,left,right";
    assert_eq!(edges.lines().next(), Some(header));
    let kinds = |kind: &str| edges.lines().filter(|line| line.contains(kind)).count();
    assert_eq!((kinds("contact"), kinds("dirichlet")), (32, 64));
    for key in [
        "title",
        "scalar",
        "solver",
        "status",
        "unknowns",
        "contact_edges",
        "contact_active",
        "sweeps",
        "converged",
        "algebraic_residual",
        "conservation_defect",
        "contact_force",
        "contact_length",
        "errors",
        "outputs",
        "seconds",
    ] {
        assert!(!summary[key].is_null(), "{key}");
    }
    assert_eq!(summary["unknowns"], 1264);
    let force = summary["contact_force"].as_f64().expect("a number");
    PRINTED.check("force", force - 0.950787);
    assert!(text(&folder.path().join("solution.vtu")).contains("UnstructuredGrid"));
    let contact = text(&folder.path().join("contact.vtu"));
    assert!(["lambda", "gap", "state", "boundary"].iter().all(|name| contact.contains(name)));
}

#[test]
fn both_scalars_and_both_solvers_agree() {
    for scene in ["scenes/levee.toml", "scenes/slab.toml", "scenes/membrane.toml"] {
        let force = |more: &[&str]| {
            let (status, _folder, summary) = solve(scene, more);
            assert_eq!(status, 0, "{scene} {more:?}");
            summary["contact_force"].as_f64().expect("a number")
        };
        let direct = force(&["--solver", "direct"]);
        DIRECT.check_relative(scene, force(&[]), direct);
        DIRECT_NARROW.check_relative(scene, force(&["--scalar", "f32"]), direct);
    }
}

/// Solves the levee with a `[setting]` of these lines; returns what is printed and the summary.
fn levee_in(setting: &str, more: &[&str]) -> (String, Value) {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, out) = (folder.path().join("levee.toml"), folder.path().join("out"));
    let levee = meshes().join("scenes/levee.toml").canonicalize().expect("the levee");
    std::fs::write(&file, format!("extends = {levee:?}\n[setting]\n{setting}\n")).expect("a file");
    let out = out.to_string_lossy().into_owned();
    let mut arguments = vec!["solve", file.to_str().expect("UTF-8"), "--out", &out];
    arguments.extend(more);
    let output = signorini(&arguments);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{setting}: {stderr}");
    let summary = serde_json::from_str(&text(&folder.path().join("out/summary.json")));
    (String::from_utf8_lossy(&output.stdout).into_owned(), summary.expect("valid JSON"))
}

#[test]
fn what_ran_is_said() {
    for (setting, more, asked, used, printed) in [
        ("", &[][..], "auto", "kernel sweeps", " sweeps, scaled residual"),
        ("refine = 1", &[], "auto", "kernel factor", "converged by a factor of "),
        ("refine = 1\nscalar = 'f32'", &[], "auto", "kernel factor", "by a factor of "),
        ("refine = 1", &["--max-sweeps", "9000"], "auto", "kernel sweeps", " sweeps, "),
        ("", &["--solver", "kernel"], "kernel", "kernel sweeps", " sweeps, "),
        ("", &["--solver", "direct"], "direct", "direct", " active-set steps, "),
        ("solver = 'factor'", &[], "auto", "kernel factor", "by a factor of "),
        (
            "model = 'condensed'\nscalar = 'f32'",
            &[],
            "auto",
            "condensed exact",
            "exchanges on the condensed",
        ),
    ] {
        let (said, summary) = levee_in(setting, more);
        assert_eq!(summary["solver"], asked, "{setting} {more:?}");
        assert_eq!(summary["solver_used"], used, "{setting} {more:?}");
        assert!(said.contains(printed), "{setting} {more:?}: {said}");
        assert_eq!(
            said.contains("sweeps, "),
            used == "kernel sweeps",
            "{setting} {more:?}: {said}"
        );
        assert_eq!(summary["sweeps"].as_u64() > Some(0), used == "kernel sweeps", "{setting}");
        let factored = matches!(used, "kernel factor" | "direct");
        assert_eq!(summary["factor"]["entries"].as_u64() > Some(2000), factored, "{setting}");
    }
}

/// Three states, each with the flux that belongs to it.
#[test]
fn edges_tell_the_side_of_the_gap() {
    let (status, folder, summary) = solve("limits/l-tri.toml", &[]);
    assert_eq!((status, summary["converged"].as_bool()), (0, Some(true)));
    let mut counts = [0; 3];
    let edges = text(&folder.path().join("edges.csv"));
    for line in edges.lines().filter(|line| line.split(',').nth(4) == Some("contact")) {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |at: usize| fields[at].parse::<f64>().expect("a number");
        let [u, flux, psi, q, limit, lambda] = [5, 6, 8, 9, 10, 11].map(number);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(fields[7] == "contact" && (q, limit) == (0.0, 1.5) && fields[14].is_empty());
        assert!(near(lambda, flux - q), "{line}");
        let at = ["open", "touching", "saturated"].iter().position(|state| *state == fields[12]);
        match at.expect("a state") {
            0 => assert!(u > psi && near(flux, q), "{line}"),
            1 => assert!(u == psi && flux > q && flux < limit, "{line}"),
            _ => assert!(u < psi && near(flux, limit), "{line}"),
        }
        counts[at.expect("a state")] += 1;
    }
    assert_eq!(counts, [7, 18, 7]);
}

#[test]
fn a_solve_that_is_cut_off_says_so_and_is_feasible() {
    let (status, folder, summary) = solve("catalogue/b-tri.toml", &["--max-sweeps", "3"]);
    assert_eq!(status, 3);
    assert_eq!(summary["status"], "out-of-sweeps");
    assert_eq!(summary["converged"], false);
    for line in text(&folder.path().join("edges.csv")).lines().filter(|l| l.contains("contact")) {
        let u: f64 = line.split(',').nth(5).expect("u_mean").parse().expect("a number");
        assert!(u >= 0.0, "{line}");
    }
}

#[test]
fn inputs_change_the_answer() {
    let head = |input: &str| {
        let (_, _folder, summary) = solve("scenes/levee.toml", &["--input", input]);
        summary["outputs"]["seepage"].as_f64().expect("a number")
    };
    assert!(head("river=0.5") > head("river=0"));
}

#[test]
fn export_writes_a_model() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("new/scene.rs");
    // Its river may rise to the sky.
    let scene = folder.path().join("levee.toml");
    let mesh = meshes().join("scenes/levee.msh");
    let limited = text(&meshes().join("scenes/levee.toml"));
    let limited = limited.replace("\"levee.msh\"", &format!("{mesh:?}"));
    std::fs::write(&scene, limited.replace("range = [-1.0, 0.5]\n", "")).expect("a scene");
    let arguments = |output: &Path, more: &[&'static str]| {
        let fixed = ["export".into(), scene.clone().into_os_string(), "-o".into(), output.into()];
        let all = fixed.into_iter().chain(more.iter().map(Into::into));
        Command::new(env!("CARGO_BIN_EXE_signorini")).args(all).output().expect("the binary runs")
    };
    assert_eq!(arguments(&file, &[]).status.code(), Some(0));
    let model = text(&file);
    let line = |of: &str| model.lines().any(|line| line.trim_start().starts_with(of));
    assert!(line("pub static MODEL: Model<'static, f32, u16> = Model {"));
    assert!(line("pub const UNKNOWNS: usize = 2329;"));
    assert!(line("counts: EdgeCounts { free: 2279, contact: 50, dirichlet: 20 },"));
    assert!(
        !model.contains("4294967295") && model.contains("NONE]"),
        "boundary edges have one side"
    );

    assert_eq!(arguments(&file, &["--input", "rain=2", "--scalar", "f64"]).status.code(), Some(0));
    assert_ne!(text(&file).replace("f64", "f32"), model);
    let wrong = arguments(&folder.path().join("none.rs"), &["--input", "snow=1"]);
    assert_eq!(wrong.status.code(), Some(2));
    let huge = arguments(&folder.path().join("none.rs"), &["--input", "river=-1e300"]);
    assert_eq!(huge.status.code(), Some(2), "f32 has no such number");
    let far = arguments(&folder.path().join("none.rs"), &["--input", "river=-1e20"]);
    assert_eq!(far.status.code(), Some(2), "f32 has no squares of it");
    let said = String::from_utf8_lossy(&far.stderr).into_owned();
    assert!(said.contains("u is near 1e20, which f32 cannot square"), "{said}");
    let wide = folder.path().join("wide.rs");
    let far = arguments(&wide, &["--input", "river=-1e20", "--scalar", "f64"]);
    assert_eq!(far.status.code(), Some(0));
    assert!(!folder.path().join("none.rs").exists(), "nothing is left of a failure");
    assert_eq!(arguments(&file.join("below/a/file.rs"), &[]).status.code(), Some(1));
}

#[test]
fn help_has_examples() {
    for command in [&["--help"][..], &["solve", "--help"], &["tick", "--help"]] {
        let output = signorini(command);
        assert!(String::from_utf8_lossy(&output.stdout).contains("Examples:"), "{command:?}");
    }
}

#[test]
fn help_lists_every_function_of_expressions() {
    let help = String::from_utf8_lossy(&signorini(&["solve", "--help"]).stdout).into_owned();
    let words: Vec<_> = help.split(|c: char| !c.is_ascii_alphanumeric()).collect();
    for name in
        "sin cos tan asin acos atan atan2 sinh cosh tanh exp ln sqrt abs min max sign pi".split(' ')
    {
        assert!(words.contains(&name), "{name}: {help}");
    }
}

const SCENE: &str = r#"mesh = "MESH"
[material.default]
conductivity = "1"
[source]
f = "0"
[boundary.dirichlet]
kind = "dirichlet"
value = "0"
[boundary.contact]
kind = "contact"
"#;

/// What to replace in a good scene, by what, and a part of the message.
#[rustfmt::skip]
const WRONG_SCENES: &[(&str, &str, &str)] = &[
    ("conductivity = \"1\"", "conductivity = \"-1\"", "material.default.conductivity"),
    ("conductivity = \"1\"", "conductivity = [\"1\", \"2\", \"1\"]", "not positive definite"),
    ("conductivity = \"1\"", "conductivity = \"0.5 - y\"", "not positive definite"),
    ("conductivity = \"1\"", "conductivity = \"ln(-1 - y)\"", "not finite"),
    ("conductivity = \"1\"", "conductvity = \"1\"", "material.default.conductvity"),
    ("conductivity = \"1\"", "conductivity = \"t\"", "material.default.conductivity"),
    ("[material.default]", "[material.nowhere]", "\"left\", \"right\""),
    ("[material.default]", "[material.left]", "material.right"),
    ("f = \"0\"", "f = \"2x\"", "source.f"),
    ("f = \"0\"", "f = \"sqrt(-1 - x^2)\"", "source.f"),
    ("f = \"0\"", "f = nan", "source.f"),
    ("f = \"0\"", "f = \"foo(x)\"", "foo"),
    ("f = \"0\"", "f = \"1e999\"", "source.f"),
    ("f = \"0\"", "f = \"\"", "source.f"),
    ("value = \"0\"", "value = \"1/x\"", "boundary.dirichlet.value"),
    ("value = \"0\"", "valeu = \"0\"", "boundary.dirichlet.valeu"),
    ("value = \"0\"", "value = \"-1\"", "below the gap"),
    ("kind = \"dirichlet\"", "kind = \"dirichlet\"\nflux = 0", "boundary.dirichlet.flux"),
    ("kind = \"dirichlet\"", "kind = \"fixed\"", "boundary.dirichlet.kind"),
    ("kind = \"dirichlet\"\nvalue = \"0\"", "kind = \"neumann\"\nflux = \"1\"", "no solution"),
    ("kind = \"dirichlet\"\nvalue = \"0\"", "kind = \"neumann\"\nflux = \"0\"", "no unique solution"),
    ("kind = \"dirichlet\"\nvalue = \"0\"", "kind = \"robin\"\ncoefficient = \"-1\"\nambient = 0", "coefficient"),
    ("kind = \"dirichlet\"\nvalue = \"0\"", "kind = \"robin\"\ncoefficient = \"y - 0.5\"\nambient = 0", "coefficient"),
    ("[boundary.dirichlet]", "[boundary.wall]", "\"contact\", \"dirichlet\""),
    ("[boundary.contact]\nkind = \"contact\"", "", "boundary.contact"),
    ("mesh = \"MESH\"", "mesh = \"missing.msh\"", "missing.msh"),
    ("mesh = \"MESH\"", "mesh = 3", "mesh"),
    ("mesh = \"MESH\"", "mesh = \"MESH\"\nsolver = \"fast\"", "solver"),
    ("mesh = \"MESH\"", "mesh = \"MESH", "a.toml:1: not TOML"),
    ("[source]", "[output.q]\nkind = \"probe\"\nat = [5, 5]\n[source]", "output.q"),
    ("[source]", "[output.q]\nkind = \"flux\"\nof = \"roof\"\n[source]", "output.q"),
    ("[source]", "[input.p]\nof = \"contact\"\nfield = \"value\"\n[source]", "input.p"),
    ("[source]", "[exact]\nu = \"x\"\ngradient = [\"1\"]\n[source]", "exact.gradient"),
    ("[source]", "[time]\nstep = 0\nend = 1\n[source]", "time.step"),
];

/// The same for the mesh.
#[rustfmt::skip]
const WRONG_MESHES: &[(&str, &str, &str)] = &[
    ("2.2 0 8", "3.0 0 8", "3.0"),
    ("2.2 0 8", "2.2 1 8", ""),
    ("$EndNodes", "$EndNode", ""),
    ("$Nodes\n561", "$Nodes\n4611686018427387904", ""),
    ("$Nodes\n561", "$Nodes\n-1", ""),
    ("$Elements\n1120", "$Elements\n99999999", ""),
    ("1 -1.0 0.0 0\n", "1 nan 0.0 0\n", "NaN"),
    ("1 -1.0 0.0 0\n", "1 -1.0 0.0 7\n", "plane"),
    ("1 -1.0 0.0 0\n", "2 -1.0 0.0 0\n", "node 2"),
    ("1 -1.0 0.0 0\n", "1 5.0 5.0 0\n", ""),
    ("97 2 2 1 1 1 2 35\n", "97 2 2 1 1 1 2 2\n", "97"),
    ("97 2 2 1 1 1 2 35\n", "97 2 2 1 1 1 2 9999\n", "9999"),
    ("97 2 2 1 1 1 2 35\n", "97 9 2 1 1 1 2 35 4 5 6\n", "97"),
    ("98 2 2 1 1 1 35 34\n", "98 2 2 1 1 1 2 35\n", "98"),
];

fn refused(scene: &str, mesh: &str, expected: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("a.msh"), mesh).expect("a file");
    std::fs::write(path("a.toml"), scene.replace("MESH", "a.msh")).expect("a file");
    let (scene_path, out) = (path("a.toml"), path("out"));
    let output = signorini(&[
        "solve",
        scene_path.to_str().expect("UTF-8"),
        "--out",
        out.to_str().expect("UTF-8"),
    ]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "expected {expected:?}: {message}");
    assert!(message.contains(expected), "expected {expected:?}: {message}");
    assert!(!message.contains("panicked") && message.len() < 4000, "{message}");
    assert!(!out.exists(), "something was written: {expected:?}");
}

fn good_mesh() -> String {
    text(&meshes().join("catalogue/square-tri-16.msh"))
}

#[test]
fn wrong_scenes_are_refused() {
    let mesh = good_mesh();
    for (part, by, expected) in WRONG_SCENES {
        assert!(SCENE.contains(part), "{part}");
        refused(&SCENE.replace(part, by), &mesh, expected);
    }
    let nested = format!("f = \"{}0{}\"", "(".repeat(200_000), ")".repeat(200_000));
    refused(&SCENE.replace("f = \"0\"", &nested), &mesh, "source.f");
    refused(&"[".repeat(200_000), &mesh, "");
    refused("", &mesh, "");
}

#[test]
fn wrong_meshes_are_refused() {
    let mesh = good_mesh();
    for (part, by, expected) in WRONG_MESHES {
        assert!(mesh.contains(part), "{part}");
        refused(SCENE, &mesh.replacen(part, by, 1), expected);
    }
    for length in [0, 10, 100, 5000, mesh.len() / 2, mesh.len() - 20] {
        refused(SCENE, &mesh[..length], "a.msh");
    }
}

#[test]
fn wrong_arguments_are_refused() {
    let scene = meshes().join("catalogue/a-tri.toml");
    let scene = scene.to_str().expect("UTF-8");
    for (arguments, expected) in [
        (&["solve", scene, "--tolerance", "nan"][..], "tolerance"),
        (&["solve", scene, "--tolerance", "-1"], "tolerance"),
        (&["solve", scene, "--max-sweeps", "0"], "max-sweeps"),
        (&["solve", scene, "--input", "rain=1"], "rain"),
        (&["solve", scene, "--scalar", "f16"], "f16"),
        (&["solve", scene, "--scalar", "f32", "--solver", "direct"], "direct"),
        (&["solve", scene, "--max-sweeps", "9", "--solver", "direct"], "max-sweeps"),
        (&["solve", scene, "--out", scene], "is a file"),
        (&["solve", "nowhere.toml"], "nowhere.toml"),
        (&["slove"], "slove"),
    ] {
        let output = signorini(arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(expected), "{arguments:?}: {message}");
    }
}

//! The command as users and scripts meet it: files, exit status, messages.

use signorini_tolerances::command::{DIRECT, DIRECT_NARROW, PRINTED};

use serde_json::Value;

use crate::command::{self, Folder, meshes, run, says, text};

/// The folder and the summary of a scene that is solved, with status 0.
#[track_caller]
fn solved(scene: &str, more: &[&str]) -> (Folder, Value) {
    let folder = Folder::new();
    let (run, summary) = folder.solve(scene, more);
    run.succeeds();
    (folder, summary)
}

/// u_D has no value at x = 1/32, which is a vertex of the mesh refined once alone.
#[test]
fn what_a_finer_mesh_cannot_hold_costs_the_estimate_alone() {
    let scene = text(meshes("catalogue/b-tri.toml"));
    let (_, exact) = scene.split_once("[exact]").expect("an exact solution");
    assert!(exact.contains("gradient"));
    let known = scene.lines().find(|line| line.starts_with("value = ")).expect("u_D");
    let bracketed = known.replace("= \"", "= \"(");
    let value = format!("{}) + 0*ln(abs(x - 0.03125))\"", bracketed.trim_end_matches('"'));
    let skin = "[output.skin]\nkind = \"mean\"\nof = \"contact\"\n";
    let folder = Folder::new();
    let exact = format!("[exact]{exact}");
    let changed = [(known, value.as_str()), (&exact, skin)];
    let (_, summary) = solved(&folder.scene("a.toml", "catalogue/b-tri.toml", &changed), &[]);
    let skin = &summary["output_bounds"]["skin"];
    assert!(skin["plus_minus"].is_f64() && skin["estimate"].is_null(), "{skin}");
}

#[test]
fn solve_writes_its_three_files() {
    let (folder, summary) = solved(&meshes("catalogue/h-mixed.toml"), &[]);
    let edges = text(folder.path("out/edges.csv"));
    let header = "x0,y0,x1,y1,kind,u_mean,flux_normal,boundary,psi,q,limit,lambda,state,left,right";
    assert_eq!(edges.lines().next(), Some(header));
    let kinds = |kind: &str| edges.lines().filter(|line| line.contains(kind)).count();
    assert_eq!((kinds("contact"), kinds("dirichlet")), (32, 64));
    let keys = "title scalar solver status unknowns contact_edges contact_active sweeps converged \
                algebraic_residual conservation_defect contact_force contact_length errors outputs seconds";
    for key in keys.split_whitespace() {
        assert!(!summary[key].is_null(), "{key}");
    }
    assert_eq!(summary["unknowns"], 1264);
    let force = summary["contact_force"].as_f64().expect("a number");
    PRINTED.check("force", force - 0.950787);
    assert!(text(folder.path("out/solution.vtu")).contains("UnstructuredGrid"));
    let contact = text(folder.path("out/contact.vtu"));
    assert!(["lambda", "gap", "state", "boundary"].iter().all(|name| contact.contains(name)));
}

#[test]
fn both_scalars_and_both_solvers_agree() {
    for scene in ["scenes/levee.toml", "scenes/slab.toml", "scenes/membrane.toml"] {
        let force = |more: &[&str]| {
            let (_, summary) = solved(&meshes(scene), more);
            summary["contact_force"].as_f64().expect("a number")
        };
        let direct = force(&["--solver", "direct"]);
        DIRECT.check_relative(scene, force(&[]), direct);
        DIRECT_NARROW.check_relative(scene, force(&["--scalar", "f32"]), direct);
    }
}

/// Solves the levee with a `[setting]` of these lines; returns what is printed and the summary.
fn levee_in(setting: &str, more: &[&str]) -> (String, Value) {
    let folder = Folder::new();
    let levee = meshes("scenes/levee.toml");
    let scene = folder.write("levee.toml", format!("extends = {levee:?}\n[setting]\n{setting}\n"));
    let (run, summary) = folder.solve(&scene, more);
    (run.succeeds().stdout, summary)
}

#[test]
fn what_ran_is_said() {
    let condensed = "model = 'condensed'\nscalar = 'f32'";
    for (setting, more, asked, used, printed) in [
        ("", &[][..], "auto", "kernel sweeps", " sweeps, scaled residual"),
        ("refine = 1", &[], "auto", "kernel factor", "converged by elimination, "),
        ("refine = 1\nscalar = 'f32'", &[], "auto", "kernel factor", "by elimination, "),
        ("refine = 1", &["--max-sweeps", "9000"], "auto", "kernel sweeps", " sweeps, "),
        ("", &["--solver", "kernel"], "kernel", "kernel sweeps", " sweeps, "),
        ("", &["--solver", "direct"], "direct", "direct", " active-set steps, "),
        ("", &["--solver", "multigrid"], "multigrid", "multigrid", " iterations on "),
        ("solver = 'factor'", &[], "auto", "kernel factor", "by elimination, "),
        (condensed, &[], "auto", "condensed exact", "exchanges on the condensed"),
    ] {
        let what = format!("{setting} {more:?}");
        let (said, summary) = levee_in(setting, more);
        assert_eq!((&summary["solver"], &summary["solver_used"]), (&asked.into(), &used.into()));
        assert!(said.contains(printed), "{what}: {said}");
        assert_eq!(said.contains("sweeps, "), used == "kernel sweeps", "{what}: {said}");
        assert_eq!(summary["sweeps"].as_u64() > Some(0), used == "kernel sweeps", "{what}");
        let factored = matches!(used, "kernel factor" | "direct");
        assert_eq!(summary["factor"]["entries"].as_u64() > Some(2000), factored, "{what}");
    }
}

/// What takes longest can be left out; the rest is the same.
#[test]
fn intervals_and_files_can_be_left_out() {
    let levee = meshes("scenes/levee.toml");
    let (folder, whole) = solved(&levee, &[]);
    for name in ["edges.csv", "solution.vtu", "contact.vtu"] {
        assert!(folder.path("out").join(name).exists(), "{name}");
    }
    let (folder, bare) = solved(&levee, &["--no-intervals", "--no-files"]);
    let files = std::fs::read_dir(folder.path("out")).expect("a folder");
    let names: Vec<_> = files.map(|file| file.expect("a file").file_name()).collect();
    assert_eq!(names, ["summary.json"]);
    assert!(!whole["output_bounds"].as_object().expect("an object").is_empty());
    assert!(bare["output_bounds"].as_object().expect("an object").is_empty());
    for key in ["outputs", "contact_force", "error_bound"] {
        assert_eq!(whole[key], bare[key], "{key}");
    }
    let (folder, _) = solved(&levee, &["--no-files", "--max-error", "20%"]);
    assert!(!folder.path("out/refined.msh").exists());
    let both = ["--intervals", "--no-intervals"];
    says(&command::refused("solve", &levee, &both), &["cannot be used with"]);
}

/// One file with the field, the contact, and each output as it is printed; never one that the scene is made of.
#[test]
fn a_solution_is_drawn() {
    let levee = meshes("scenes/levee.toml");
    let folder = Folder::new();
    let picture = folder.path("levee.svg").display().to_string();
    let (_, summary) = solved(&levee, &["--draw", &picture]);
    let svg = text(&picture);
    let words = [">in contact</text>", ">Dirichlet</text>", "λ = σ·n − q", "guaranteed", "wet"];
    says(&svg, &words);
    assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
    let outputs = summary["outputs"].as_object().expect("an object");
    outputs.keys().for_each(|name| says(&svg, &[name]));
    let over = command::refused("solve", &levee, &["--draw", &levee]);
    says(&over, &["the scene is made of this file"]);
}

/// Three states, each with the flux that belongs to it.
#[test]
fn edges_tell_the_side_of_the_gap() {
    let (folder, summary) = solved(&meshes("limits/l-tri.toml"), &[]);
    assert_eq!(summary["converged"], true);
    let mut counts = [0; 3];
    let edges = text(folder.path("out/edges.csv"));
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
    let folder = Folder::new();
    let (run, summary) = folder.solve(&meshes("catalogue/b-tri.toml"), &["--max-sweeps", "3"]);
    assert_eq!(run.status, 3);
    assert_eq!(summary["status"], "out-of-sweeps");
    assert_eq!(summary["converged"], false);
    for line in text(folder.path("out/edges.csv")).lines().filter(|l| l.contains("contact")) {
        let u: f64 = line.split(',').nth(5).expect("u_mean").parse().expect("a number");
        assert!(u >= 0.0, "{line}");
    }
}

#[test]
fn help_has_examples() {
    for command in [&["--help"][..], &["solve", "--help"], &["tick", "--help"]] {
        assert!(run(command).stdout.contains("Examples:"), "{command:?}");
    }
}

#[test]
fn help_lists_every_function_of_expressions() {
    let help = run(&["solve", "--help"]).stdout;
    let words: Vec<_> = help.split(|c: char| !c.is_ascii_alphanumeric()).collect();
    let all =
        "sin cos tan asin acos atan atan2 sinh cosh tanh exp erf erfc ln sqrt abs min max sign pi";
    all.split(' ').for_each(|name| assert!(words.contains(&name), "{name}: {help}"));
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

/// A part of a good scene, its replacement, and a part of the message.
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
    ("mesh = \"MESH\"", "mesh = \"missing.msh\"", "the path counts from the scene's folder"),
    ("mesh = \"MESH\"", "mesh = 3", "mesh"),
    ("mesh = \"MESH\"", "mesh = \"MESH\"\nsolver = \"fast\"", "solver"),
    ("mesh = \"MESH\"", "mesh = \"MESH", "a.toml:1: not TOML"),
    ("[source]", "[output.q]\nkind = \"probe\"\nat = [5, 5]\n[source]", "output.q"),
    ("[source]", "[output.q]\nkind = \"flux\"\nof = \"roof\"\n[source]", "output.q"),
    ("[source]", "[input.p]\nof = \"contact\"\nfield = \"value\"\n[source]", "input.p"),
    ("[source]", "[exact]\nu = \"x\"\ngradient = [\"1\"]\n[source]", "exact.gradient"),
    ("[source]", "[time]\nstep = 0\nend = 1\n[source]", "time.step"),
];

/// All faults look alike, the first one too.
#[test]
fn each_fault_is_a_report_of_its_own() {
    let changes = [("[material.sand]", "[material]"), ("kind = \"probe\"", "kind = \"prob\"")];
    let folder = Folder::new();
    let scene = folder.scene("levee.toml", "scenes/levee.toml", &changes);
    let said = run(&["check", &scene]).refuses();
    assert_eq!((said.matches("  × ").count(), said.matches("Error").count()), (3, 0), "{said}");
    says(&said, &["[material] has no keys of its own", "write [material.NAME]", "`prob`"]);
}

#[track_caller]
fn refused(scene: &str, mesh: &str, expected: &str) {
    let folder = Folder::new();
    folder.write("a.msh", mesh);
    let scene = folder.write("a.toml", scene.replace("MESH", "a.msh"));
    says(&command::refused("solve", &scene, &[]), &[expected]);
}

#[test]
fn wrong_scenes_and_meshes_are_refused() {
    let mesh = text(meshes("catalogue/square-tri-16.msh"));
    for (part, by, expected) in WRONG_SCENES {
        assert!(SCENE.contains(part), "{part}");
        refused(&SCENE.replace(part, by), &mesh, expected);
    }
    let nested = format!("f = \"{}0{}\"", "(".repeat(200_000), ")".repeat(200_000));
    refused(&SCENE.replace("f = \"0\"", &nested), &mesh, "source.f");
    refused(&"[".repeat(200_000), &mesh, "");
    refused("", &mesh, "");
    // ASCII under the name of binary; a node that cells fold over; an end that is missing.
    for (part, by) in [("2.2 0 8", "2.2 1 8"), ("1 -1.0 0.0 0\n", "1 5.0 5.0 0\n")] {
        assert!(mesh.contains(part), "{part}");
        refused(SCENE, &mesh.replacen(part, by, 1), "a.msh");
    }
    refused(SCENE, &mesh[..mesh.len() / 2], "a.msh");
}

#[test]
fn wrong_arguments_are_refused() {
    let scene = &*meshes("catalogue/a-tri.toml");
    let rows: [(&[&str], &str); 10] = [
        (&["solve", scene, "--tolerance", "nan"], "tolerance"),
        (&["solve", scene, "--tolerance", "-1"], "tolerance"),
        (&["solve", scene, "--max-sweeps", "0"], "max-sweeps"),
        (&["solve", scene, "--input", "rain=1"], "rain"),
        (&["solve", scene, "--scalar", "f16"], "f16"),
        (&["solve", scene, "--scalar", "f32", "--solver", "direct"], "direct"),
        (&["solve", scene, "--max-sweeps", "9", "--solver", "direct"], "max-sweeps"),
        (&["solve", scene, "--out", scene], "is a file"),
        (&["solve", "nowhere.toml"], "nowhere.toml"),
        (&["slove"], "slove"),
    ];
    command::each_refused(&rows, |arguments| run(arguments).refuses());
}

/// A case of a folder beside this file.
fn case(name: &str) -> String {
    format!("{}/tests/cases/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// u ≥ 0 beside u ≤ −10: no function of finite energy has both, so that refining such a scene would never end.
#[test]
fn contacts_that_exclude_each_other_are_wrong_input() {
    let message = command::refused("solve", &case("opposed-contacts.toml"), &[]);
    let expected = "boundary.bottom.gap: boundary.bottom asks for u ≥ 0 at (0, 0), where boundary.bottom2 asks for u ≤ -10";
    says(&message, &[expected, "opposed-contacts.toml:9:"]);
}

/// Gmsh puts a vertex where a gap has a kink 1.3e−12 beside it: no jump, and a bound as where it lies on the kink.
#[test]
fn a_kink_of_a_gap_right_beside_a_vertex_leaves_a_bound() {
    let (folder, mesh) = (Folder::new(), text(case("opposed-contacts.msh")));
    let bound = |y: &str| {
        let moved = mesh.replace("14 1 0.5 0", &format!("14 1 {y} 0"));
        let file = folder.write("a.msh", moved);
        let scene = format!(
            "mesh = {file:?}\nsource.f = -6\nmaterial.default.conductivity = 1\n\
             boundary.default = {{ kind = \"neumann\", flux = 0 }}\n\
             boundary.top = {{ kind = \"dirichlet\", value = 0 }}\n\
             boundary.right = {{ kind = \"contact\", gap = \"min(-y, -0.5)\" }}\n"
        );
        let (_, summary) = solved(&folder.write("a.toml", scene), &[]);
        assert_eq!(summary["error_bound_reason"], Value::Null, "{y}");
        assert!(summary["contact_active"].as_u64() > Some(0), "{summary}");
        summary["error_bound"]["total"].as_f64().expect("a bound")
    };
    let [on, below, above] = ["0.5", "0.499999999998744", "0.500000000001256"].map(bound);
    for beside in [below, above] {
        assert!((0.999..1.001).contains(&(beside / on)), "{beside} {on}");
    }
}

//! From a bare mesh to a scene that can be solved: `new`, `check`, `schema`, completions, the manual.

use serde_json::Value;

use crate::command::{Folder, meshes, repository, run, says, text};

/// What `check --json` prints of a scene, and the exit status.
fn checked(scene: &str) -> (i32, Value) {
    let run = run(&["check", scene, "--json"]);
    (run.status, serde_json::from_str(&run.stdout).expect("JSON"))
}

fn faults(found: &Value) -> Vec<String> {
    let faults = found["faults"].as_array().expect("a list");
    let told = |fault: &Value| fault["message"].as_str().expect("a message").to_owned();
    faults.iter().map(told).collect()
}

/// All meshes of the repository that can be read.
fn all_meshes() -> Vec<String> {
    let folders = ["meshes/scenes", "meshes/catalogue", "meshes/time", "tests/fixtures/gmsh"];
    let files = folders.iter().flat_map(|folder| {
        std::fs::read_dir(repository(folder))
            .expect("a folder")
            .map(|file| file.expect("a file").path())
    });
    let meshes = files.filter(|file| file.extension().is_some_and(|kind| kind == "msh"));
    meshes.map(|file| crate::command::word(&file)).collect()
}

#[test]
fn the_faults_of_a_new_scene_are_its_question_marks() {
    let (folder, mut written) = (Folder::new(), 0);
    for (at, mesh) in all_meshes().iter().enumerate() {
        let scene = folder.word(&format!("{at}.toml"));
        if run(&["new", mesh, "--out", &scene]).status != 0 {
            continue;
        }
        written += 1;
        let text = text(&scene);
        let open = text.lines().filter(|line| !line.starts_with('#') && line.contains("\"?\""));
        let (status, found) = checked(&scene);
        let faults = faults(&found);
        assert_eq!((status, faults.len()), (2, open.count()), "{mesh}: {faults:?}");
        assert!(faults.iter().all(|fault| fault.ends_with(": to be filled in")), "{faults:?}");
    }
    assert!(written > 10, "{written} meshes");
}

#[test]
fn a_new_scene_can_be_solved_once_it_is_filled_in() {
    let folder = Folder::new();
    let mesh = folder.write("bar.msh", std::fs::read(meshes("scenes/slab.msh")).expect("a mesh"));
    let said = run(&["new", &mesh]).succeeds().stdout;
    says(&said, &["bar.toml is written", "signorini.schema.json is written", "bar.toml' --draw '"]);
    let scene = folder.word("bar.toml");
    let first = text(&scene);
    assert!(
        first.starts_with("#:schema signorini.schema.json\n")
            && first.contains("mesh = \"bar.msh\"")
    );
    says(&first, &["[boundary.\"rib foot\"]", "length 0.02, 6 edges", "area 0.0008, 72 cells"]);
    // What each kind may have is said once for all boundaries.
    assert_eq!(first.matches("# contact: u ≥ gap").count(), 1, "{first}");

    for verb in ["solve", "tick", "trade"] {
        let message = run(&[verb, &scene]).refuses();
        assert_eq!(message.matches("to be filled in").count(), 7, "{verb}: {message}");
    }
    let filled = first.replace("conductivity = \"?\"", "conductivity = 2");
    let filled = filled.replacen("kind = \"?\"", "kind = \"contact\"", 1);
    let filled = filled.replace("kind = \"?\"", "kind = \"robin\"\ncoefficient = 3\nambient = -10");
    folder.write("bar.toml", &filled);
    let look = run(&["check", &scene, "--draw", &folder.word("bar.svg")]).succeeds().stdout;
    says(&look, &["0 triangles, 427 quads", "held by air, ends", "contact"]);
    says(&text(folder.path("bar.svg")), &["<svg", ">rib foot</text>", ">aluminium</text>"]);
    let png = run(&["check", &scene, "--draw", &folder.word("bar.png")]).refuses();
    says(&png, &["bar.png: expected a name that ends with .svg"]);
    assert_eq!(folder.solve(&scene, &[]).1["converged"], true);

    // Nothing that is there is lost.
    let message = run(&["new", &mesh]).refuses();
    says(&message, &["bar.toml", "is there already", "--out"]);
    assert_eq!(text(&scene), filled);
    let printed = run(&["new", &mesh, "--out", "-"]).succeeds().stdout;
    assert_eq!(printed.lines().count(), first.lines().count());
}

#[test]
fn check_tells_all_that_is_wrong() {
    let folder = Folder::new();
    let changes = [
        ("[boundary.river]", "[boundary.rivre]"),
        ("kind = \"probe\"", "kind = \"prob\""),
        ("[material.sand]", "[material.sand]\ncolour = 3"),
    ];
    let scene = folder.scene("levee.toml", "scenes/levee.toml", &changes);
    let (status, found) = checked(&scene);
    let faults = faults(&found);
    assert_eq!(status, 2);
    for part in [
        "material.sand.colour: unknown key",
        "no boundary `river`",
        "`prob` is not one of",
        "has no physical curve \"rivre\"",
        "boundary.river: missing; the boundary edge",
    ] {
        assert!(faults.iter().any(|fault| fault.contains(part)), "{part}: {faults:#?}");
    }
    assert_eq!(faults.len(), 5, "{faults:#?}");

    let data = [
        ("conductivity = [\"1e-4\"", "conductivity = [\"-1e-4\""),
        ("gap = \"-y\"", "gap = \"ln(-1 - y)\""),
    ];
    let (status, found) = checked(&folder.scene("levee.toml", "scenes/levee.toml", &data));
    let faults = self::faults(&found);
    assert!(status == 2 && faults.len() == 3, "{faults:#?}");
    says(&faults.concat(), &["is not positive definite", "gap"]);
    let (status, found) = checked(&meshes("scenes/levee.toml"));
    assert!(
        status == 0 && found["can_be_solved"] == true && found["parts"][0]["held_by"][0] == "river"
    );
    assert_eq!(checked(&folder.write("no.toml", "= 3")).0, 2);
}

#[test]
fn check_asks_what_a_solution_would_ask() {
    let folder = Folder::new();
    let levee = text(folder.scene("levee.toml", "scenes/levee.toml", &[]));
    let with = |more: &str| folder.write("levee.toml", levee.clone() + more);
    for (more, part) in [
        ("[output.far]\nkind = \"probe\"\nat = [-99, 0]\n", "lies outside"),
        ("[setting]\nmath = \"micromath\"\n", "setting.math"),
        ("[setting]\nmemory = 3\n", "capacity"),
        ("[exact]\nu = \"ln(x - 5)\"\ngradient = [0, 0]\n", "exact.u: not finite"),
    ] {
        let scene = with(more);
        let (status, found) = checked(&scene);
        let faults = faults(&found);
        assert!(status == 2 && faults.concat().contains(part), "{part}: {faults:#?}");
        folder.run("out", "solve", &scene, &[]).refuses();
    }
    // All question marks, wherever they stand.
    let more = "[input.p]\nof = \"?\"\nfield = \"?\"\nrange = [\"?\", \"?\"]\n[exact]\nu = 1\ngradient = [\"?\", \"?\"]\n";
    let open = faults(&checked(&with(more)).1);
    let told = open.iter().filter(|fault| fault.ends_with("to be filled in")).count();
    assert_eq!(told, 6, "{open:#?}");
    // What is produced inside is listed.
    let scene = with("[source]\nf = \"2e-9*x\"\n");
    says(&run(&["check", &scene]).succeeds().stdout, &["\n  source    f = 2e-9*x\n"]);
    assert_eq!(checked(&scene).1["source"], "2e-9*x");
    // What `tick` alone refuses is a warning.
    let named = run(&["check", &with("[output.status]\nkind = \"force\"\n")]).succeeds();
    says(&named.stderr, &["`signorini tick` refuses an output's name", "column"]);
}

#[test]
fn a_new_scene_finds_its_mesh_from_any_folder() {
    let folder = Folder::new();
    for name in ["a b", "other"] {
        std::fs::create_dir(folder.path(name)).expect("a folder");
    }
    let mesh =
        folder.write("a b/x y.msh", std::fs::read(meshes("scenes/slab.msh")).expect("a mesh"));
    let far = folder.word("a b/../other/far.toml");
    run(&["new", &mesh, "--out", &far]).succeeds();
    says(&text(&far), &["mesh = \"../a b/x y.msh\""]);
    assert_eq!(faults(&checked(&far).1).len(), 7);
    // Characters that Rust's own escapes would not show as TOML has them.
    let odd = String::from_utf8_lossy(&std::fs::read(&mesh).expect("a mesh"))
        .replace("\"ends\"", "\"en\u{a0}ds\"");
    let odd = folder.write("odd.msh", odd);
    says(&run(&["new", &folder.word("")]).refuses(), &["expected a mesh"]);
    run(&["new", &odd]).succeeds();
    assert_eq!(faults(&checked(&folder.word("odd.toml")).1).len(), 7);
}

#[test]
fn a_shell_a_manual_and_an_editor_know_the_commands() {
    let schema: Value = serde_json::from_str(&run(&["schema"]).succeeds().stdout).expect("JSON");
    assert!(schema["oneOf"][0]["properties"]["boundary"].is_object());
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let script = run(&["completions", shell]).succeeds().stdout;
        says(&script, &["solve", "max-error", "schema"]);
    }
    says(&run(&["man"]).succeeds().stdout, &[".TH signorini", "solve"]);
    says(&run(&["man", "solve"]).succeeds().stdout, &["max\\-error"]);
    says(&run(&["man", "solv"]).refuses(), &["there is no such command"]);
}

/// A start that is stated is looked at; where one is, a body that nothing holds at rest is only warned of.
#[test]
fn a_check_looks_at_the_start_of_steps() {
    let folder = Folder::new();
    let mesh = meshes("catalogue/square-tri-16.msh");
    let scene = |initial: &str| {
        let text = format!(
            "mesh = {mesh:?}\nmaterial.default = {{ conductivity = \"1\", capacity = 1 }}\nsource.f = \"1\"\n\
             boundary.contact = {{ kind = \"contact\" }}\nboundary.dirichlet = {{ kind = \"neumann\", flux = \"0\" }}\n\
             boundary.default = {{ kind = \"neumann\", flux = \"0\" }}\ntime.step = 1\n{initial}"
        );
        folder.write("body.toml", text)
    };
    let [without, stated, wrong] = ["", "time.initial = \"y\"", "time.initial = \"ln(y - 9)\""]
        .map(|initial| {
            let run = run(&["check", &scene(initial)]);
            (run.status, run.stderr)
        });
    assert_eq!([without.0, stated.0, wrong.0], [2, 0, 2], "{without:?} {stated:?} {wrong:?}");
    says(&without.1, &["no solution"]);
    says(&stated.1, &["warning: at rest there is no answer", "no solution"]);
    says(&wrong.1, &["body.toml:8: time.initial: ln(y - 9) is not finite"]);
    folder.run("out", "tick", &scene("time.initial = \"y\""), &["--ticks", "1"]).succeeds();
}

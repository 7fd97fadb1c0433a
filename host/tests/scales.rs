//! The same slab in two scales of temperature; what a print, a bound and an exact solution may say of each other.

use signorini_scene::mesh::gmsh::write;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::ZERO;

use crate::command::{Folder, Run, json, run, says};

/// A cold spot above a slab whose lower face is kept at `c` or above.
fn slab(c: &str, cold: &str) -> String {
    format!(
        "mesh = \"slab.msh\"
material.default.conductivity = 1
boundary.dirichlet = {{ kind = \"robin\", coefficient = 20, ambient = \"{c} - {cold}\" }}
boundary.contact = {{ kind = \"contact\", gap = {c}, flux = 0 }}
"
    )
}

const SPOT: &str = "10*exp(-((x-0.5)/0.2)^2)";

/// A folder with a mesh and the scene that is solved, and the run.
fn solved(scene: &str, more: &[&str]) -> (Folder, Run) {
    let folder = Folder::new();
    folder.write("slab.msh", write::text(&grid(8, Cells::Triangles)));
    let path = folder.write("slab.toml", scene);
    let run = run(&[&["solve", &path, "--out", &folder.word("out")], more].concat());
    (folder, run)
}

#[test]
fn celsius_and_kelvin_have_one_part_one_mesh_and_one_force() {
    for more in [&[][..], &["--max-error", "5%"]] {
        let [celsius, kelvin] = ["0", "273.15"].map(|c| {
            let (folder, run) = solved(&slab(c, SPOT), more);
            let said = run.succeeds().stdout;
            let line = said.lines().find(|line| line.contains("contact force"));
            let summary = json(folder.path("out/summary.json"));
            let part = summary["relative_error_bound"].as_f64().expect("a part");
            (part, summary["unknowns"].as_u64(), line.expect("a line").to_owned(), said)
        });
        ZERO.check_relative(format_args!("{more:?}"), kelvin.0, celsius.0);
        assert_eq!((kelvin.1, kelvin.2), (celsius.1, celsius.2), "{more:?}");
        let name = "% of the energy norm of s";
        assert!(celsius.3.contains(name) && kelvin.3.contains(name), "{}", celsius.3);
    }
}

#[test]
fn a_force_has_the_digits_of_its_own_interval() {
    let (folder, run) = solved(&slab("0", SPOT), &[]);
    let said = run.succeeds().stdout;
    let summary = json(folder.path("out/summary.json"));
    let force = summary["contact_force"].as_f64().expect("a force");
    let words = said.split("contact force ").nth(1).and_then(|rest| rest.split(',').next());
    let told: f64 = words.expect("a force").parse().expect("a number");
    assert!((told - force).abs() <= 0.06 && force > 1.0, "{told} for {force}: {said}");
}

#[test]
fn of_a_constant_no_part_is_asked_for() {
    for c in ["0", "273.15"] {
        let (folder, run) = solved(&slab(c, "0"), &["--max-error", "5%"]);
        let run = run.succeeds();
        let words = "the solution is constant up to rounding";
        assert!(run.stderr.contains(words) && run.stdout.contains(words), "{run:?}");
        let summary = json(folder.path("out/summary.json"));
        assert!(summary["relative_error_bound"].is_null() && summary["energy_norm"].is_number());
        assert!(summary["warnings"].to_string().contains(words), "{summary}");
    }
}

#[test]
fn an_error_above_its_bound_is_told() {
    let folder = Folder::new();
    let solve = |name: &str, changes: &[(&str, &str)]| {
        let scene = folder.scene("scene.toml", name, changes);
        let run = run(&["solve", &scene, "--out", &folder.word("out")]).succeeds();
        (run, json(folder.path("out/summary.json")))
    };
    let (run, summary) = solve("catalogue/a-tri.toml", &[]);
    let words = "Either [exact] is not the solution of these data, or the bound is wrong";
    assert!(!run.stderr.contains(words), "{run:?}");
    let quadrature = summary["errors"]["quadrature"].as_f64().expect("a number");
    assert!(quadrature < 1e-3 * summary["errors"]["combined"].as_f64().expect("an error"));
    let (run, summary) =
        solve("catalogue/a-tri.toml", &[("conductivity = \"1\"", "conductivity = \"2\"")]);
    assert!(run.stderr.contains(words), "{run:?}");
    assert!(summary["warnings"].to_string().contains(words), "{summary}");
}

#[test]
fn a_bound_of_no_use_says_what_makes_it_and_what_to_do() {
    let folder = Folder::new();
    let scene = folder.scene("scene.toml", "../tests/firmware/scenes/dam.toml", &[]);
    let solve = |more: &[&str]| {
        let run = run(&[&["solve", &scene, "--out", &folder.word("out")], more].concat());
        (run, json(folder.path("out/summary.json")))
    };
    let (run, summary) = solve(&[]);
    let part = summary["relative_error_bound"].as_f64().expect("a part");
    assert!(part > 0.3, "{part}");
    let told = "% of the energy norm: most of it is the gap between s and τ";
    for said in [run.stderr, summary["warnings"].to_string()] {
        says(&said, &[told, "material.", "% of its square", "`--max-error 5%`"]);
    }
    let (run, summary) = solve(&["--max-error", "25%"]);
    assert!(!run.succeeds().stderr.contains("most of it is"), "{summary}");
}

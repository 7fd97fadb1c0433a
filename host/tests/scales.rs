//! What a print, a bound and an exact solution may say of each other.

use serde_json::Value;
use signorini_scene::mesh::gmsh::write;
use signorini_scene::mesh::structured::{Cells, grid};

use crate::command::{Folder, Run, says};

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

/// The run of a scene that is solved on a mesh, and its summary.
fn solved(scene: &str, more: &[&str]) -> (Run, Value) {
    let folder = Folder::new();
    folder.write("slab.msh", write::text(&grid(8, Cells::Triangles)));
    let (run, summary) = folder.solve(&folder.write("slab.toml", scene), more);
    (run.succeeds(), summary)
}

#[test]
fn a_force_has_the_digits_of_its_own_interval() {
    let (Run { stdout: said, .. }, summary) = solved(&slab("0", SPOT), &[]);
    says(&said, &["% of the energy norm of s"]);
    let force = summary["contact_force"].as_f64().expect("a force");
    let words = said.split("contact force ").nth(1).and_then(|rest| rest.split(',').next());
    let told: f64 = words.expect("a force").parse().expect("a number");
    assert!((told - force).abs() <= 0.06 && force > 1.0, "{told} for {force}: {said}");
}

#[test]
fn of_a_constant_no_part_is_asked_for() {
    for c in ["0", "273.15"] {
        let (run, summary) = solved(&slab(c, "0"), &["--max-error", "5%"]);
        let words = "the solution is constant up to rounding";
        assert!(run.stderr.contains(words) && run.stdout.contains(words), "{run:?}");
        assert!(summary["relative_error_bound"].is_null() && summary["energy_norm"].is_number());
        assert!(summary["warnings"].to_string().contains(words), "{summary}");
    }
}

#[test]
fn an_error_above_its_bound_is_told() {
    let folder = Folder::new();
    let solve = |changes: &[(&str, &str)]| {
        let scene = folder.scene("scene.toml", "catalogue/a-tri.toml", changes);
        let (run, summary) = folder.solve(&scene, &[]);
        (run.succeeds(), summary)
    };
    let (run, summary) = solve(&[]);
    let words = "Either [exact] is not the solution of these data, or the bound is wrong";
    assert!(!run.stderr.contains(words), "{run:?}");
    let quadrature = summary["errors"]["quadrature"].as_f64().expect("a number");
    assert!(quadrature < 1e-3 * summary["errors"]["combined"].as_f64().expect("an error"));
    let (run, summary) = solve(&[("conductivity = \"1\"", "conductivity = \"2\"")]);
    assert!(run.stderr.contains(words), "{run:?}");
    assert!(summary["warnings"].to_string().contains(words), "{summary}");
}

#[test]
fn a_bound_of_no_use_says_what_makes_it_and_what_to_do() {
    let folder = Folder::new();
    let scene = folder.scene("scene.toml", "../tests/firmware/scenes/dam.toml", &[]);
    let (run, summary) = folder.solve(&scene, &[]);
    let part = summary["relative_error_bound"].as_f64().expect("a part");
    assert!(part > 0.3, "{part}");
    let told = "% of the energy norm: most of it is the gap between s and τ";
    for said in [run.stderr, summary["warnings"].to_string()] {
        says(&said, &[told, "material.", "% of its square", "`--max-error 5%`"]);
    }
    let (run, summary) = folder.solve(&scene, &["--max-error", "25%"]);
    assert!(!run.succeeds().stderr.contains("most of it is"), "{summary}");
}

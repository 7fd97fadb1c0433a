//! Sectors of vertices, data that exclude each other there, and inputs that make them do so.

use crate::Problem;
use crate::fixtures::{on_grid, scene};
use signorini_kernel::Error as KernelError;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Mesh};

const HEAD: &str = r#"mesh = "grid"
material.default.conductivity = "1"
boundary.default = { kind = "neumann", flux = "0" }
boundary.far = { kind = "dirichlet", value = "-5" }
"#;

/// u ≥ `one` on the curve `one`, u ≤ `other` on the other.
fn opposed(one: &str, other: &str) -> String {
    format!(
        "{HEAD}boundary.one = {{ kind = \"contact\", gap = \"{one}\" }}
boundary.other = {{ kind = \"contact\", gap = \"{other}\", flux = \"-inf\", limit = \"0\" }}\n"
    )
}

/// Curves by their names.
fn with_curves(vertices: Vec<[f64; 2]>, quads: Vec<[u32; 4]>, curves: &[(&str, [u32; 2])]) -> Mesh {
    let curve = |(name, [a, b]): &(&str, [u32; 2])| Curve {
        name: (*name).to_owned(),
        edges: vec![[*a.min(b), *a.max(b)]],
    };
    Mesh { vertices, quads, curves: curves.iter().map(curve).collect(), ..Mesh::default() }
}

/// Two squares that share the vertex (0, 0) alone.
fn pinch() -> Mesh {
    let upper = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let lower = [[-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0]];
    let quads = vec![[0, 1, 2, 3], [5, 6, 0, 4]];
    let curves = [("one", [0, 1]), ("other", [0, 4]), ("far", [2, 3]), ("bottom", [5, 6])];
    with_curves([&upper[..], &lower].concat(), quads, &curves)
}

/// Four squares around (0, 0), the left ones apart along y = 0.
fn slit() -> Mesh {
    let mut vertices: Vec<_> =
        (0..9).map(|at| [f64::from(at % 3) - 1.0, f64::from(at / 3) - 1.0]).collect();
    vertices.push([-1.0, 0.0]);
    let quads = vec![[0, 1, 4, 3], [1, 2, 5, 4], [9, 4, 7, 6], [4, 5, 8, 7]];
    with_curves(vertices, quads, &[("one", [3, 4]), ("other", [9, 4]), ("far", [2, 5])])
}

/// Three squares around the re-entrant corner (0, 0).
fn re_entrant() -> Mesh {
    let vertices = (0..9).map(|at| [f64::from(at % 3) - 1.0, f64::from(at / 3) - 1.0]).collect();
    let quads = vec![[1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];
    with_curves(vertices, quads, &[("one", [3, 4]), ("other", [1, 4]), ("far", [2, 5])])
}

fn posed(text: &str, mesh: Mesh) -> Result<Problem> {
    Problem::new(&scene(text)?, mesh)
}

/// The message of data that exclude each other.
fn refusal(text: &str, mesh: Mesh) -> String {
    let error = posed(text, mesh).expect_err(text);
    assert_eq!(error.exit_status(), 2);
    assert!(matches!(error.cause(), Some(KernelError::Excluded { .. })), "{error}");
    error.to_string()
}

#[test]
fn contacts_that_exclude_each_other_are_refused_in_one_sector() -> Result<()> {
    for mesh in [slit(), re_entrant()] {
        let said = refusal(&opposed("2", "-10 + x"), mesh.clone());
        let expected = "boundary.one.gap: boundary.one asks for u ≥ 2 at (0, 0), where boundary.other asks for u ≤ -10";
        assert!(said.contains(expected), "{said}");
        posed(&opposed("-10", "2 + y"), mesh)?;
    }
    // Each part of a pinch has a value of its own.
    let held =
        opposed("2", "-10") + "boundary.bottom = { kind = \"dirichlet\", value = \"-20\" }\n";
    let problem = posed(&held, pinch())?;
    assert_eq!(problem.mesh.vertices.len(), pinch().vertices.len() + 1);
    assert_eq!(problem.mesh.quads[0][0], 0);
    assert_eq!(problem.mesh.quads[1], [5, 6, 7, 4]);
    let other = problem.mesh.curves.iter().find(|curve| curve.name == "other").expect("a curve");
    assert_eq!(other.edges, [[4, 7]]);
    Ok(())
}

#[test]
fn finite_ends_and_laws_of_one_sense_exclude_nothing() -> Result<()> {
    let text = opposed("2", "-10");
    posed(&text.replace("flux = \"-inf\", limit = \"0\"", "flux = \"-1\", limit = \"0\""), slit())?;
    posed(&text.replace("flux = \"-inf\", limit = \"0\"", "flux = \"0\""), slit())?;
    Ok(())
}

/// A Dirichlet value beside two contact boundaries: each is looked at, whichever comes last.
#[test]
fn dirichlet_values_are_compared_with_every_contact_edge_beside() {
    for (one, other) in [("-6", "-7"), ("-4", "-7"), ("-6", "-4")] {
        let text = format!(
            "{HEAD}boundary.one = {{ kind = \"contact\", gap = \"{one}\" }}
boundary.other = {{ kind = \"contact\", gap = \"{other}\" }}\n"
        );
        let mut mesh = slit();
        // The Dirichlet edge lies between both.
        mesh.curves[0].edges = vec![[1, 2]];
        mesh.curves[1].edges = vec![[5, 8]];
        match [one, other].contains(&"-4") {
            true => {
                let said = refusal(&text, mesh);
                assert!(said.contains("u_D = -5 of boundary.far at (1, "), "{said}");
                assert!(said.contains("lies below the gap ψ = -4 of boundary."), "{said}");
            }
            false => assert!(posed(&text, mesh).is_ok()),
        }
    }
}

#[test]
fn what_rounding_explains_is_no_contradiction() -> Result<()> {
    // All data are rounding: their range explains nothing.
    let zero = opposed("sin(pi)", "0").replace("-5", "0");
    posed(&zero, re_entrant())?;
    // A vertex where Gmsh puts 1.999999999998744 for 2.
    let mut mesh = slit();
    mesh.vertices.iter_mut().for_each(|[_, y]| *y += 1.999999999998744);
    posed(&opposed("-y", "-2"), mesh.clone())?;
    let said = refusal(&opposed("-y + 1e-6", "-2"), mesh);
    assert!(said.contains("asks for u ≥ -1.99999"), "{said}");
    Ok(())
}

/// The gaps meet at 0; u ≤ `lift` on one side, u ≥ `level` on the other.
fn moved(ranges: [&str; 2]) -> String {
    let [lift, level] = ranges;
    opposed("0", "1")
        + &format!(
            "input.level = {{ of = \"one\", field = \"gap\", pattern = \"2 + x\"{level} }}
input.lift = {{ of = \"other\", field = \"gap\", pattern = \"1\"{lift} }}\n"
        )
}

#[test]
fn ranges_within_which_gaps_exclude_each_other_are_refused() -> Result<()> {
    // 2 level ≤ 1 + lift
    posed(&moved_within(["[-0.5, 3.0]", "[-7.0, 0.25]"]), slit())?;
    let said = refusal(&moved_within(["[-0.5, 3.0]", "[-7.0, 0.26]"]), slit());
    assert!(
        said.contains("with level = 0.26 and lift = -0.5 boundary.one asks for u ≥ 0.52"),
        "{said}"
    );
    assert!(said.contains("boundary.other asks for u ≤ 0.5"), "{said}");
    assert!(said.contains("test.toml:7: input.level.range"), "{said}");
    Ok(())
}

#[test]
fn inputs_without_a_range_are_left_to_the_tick() -> Result<()> {
    let mut problem = posed(&moved(["", ""]), slit())?;
    let rows = problem.exclusions();
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0].factors, [-1.0, 2.0, -1.0]);
    problem.set(&[(0, 0.5)], 0.0)?;
    let error = problem.set(&[(0, 0.6)], 0.0).expect_err("2 level > 1");
    assert!(matches!(error.cause(), Some(KernelError::Excluded { .. })), "{error}");
    // What is beyond rounding there is moved at most.
    let moved = problem.moved_at_most();
    assert_eq!(moved.into_values().collect::<Vec<_>>(), [rows[0].slack]);
    let ranged = moved_within(["[0.0, 1.0]", "[-1.0, 0.5]"]);
    let fixed = posed(&ranged, slit())?;
    assert_eq!((fixed.exclusions().len(), fixed.moved_at_most().len()), (0, 0));
    Ok(())
}

fn moved_within([lift, level]: [&str; 2]) -> String {
    moved([&format!(", range = {lift}"), &format!(", range = {level}")])
}

#[test]
fn gaps_that_move_in_time_are_refused_then() -> Result<()> {
    let mut problem = posed(&opposed("t", "1"), re_entrant())?;
    problem.set_time(1.0)?;
    let error = problem.set_time(1.5).expect_err("1.5 > 1");
    assert!(matches!(error.cause(), Some(KernelError::Excluded { .. })), "{error}");
    problem.set_time(0.5)
}

/// PARABOLA's grid has one sector at each corner.
#[test]
fn ordinary_scenes_have_nothing_to_look_at() -> Result<()> {
    let (_, problem) = on_grid(crate::fixtures::PARABOLA, grid(3, Cells::Triangles))?;
    assert!(problem.exclusions().is_empty() && problem.moved_at_most().is_empty());
    Ok(())
}

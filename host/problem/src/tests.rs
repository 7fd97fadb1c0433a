//! Curves inside the domain, slits, and tables that act nowhere.

use super::{Assembled, Problem};
use crate::fixtures::{self, scene};
use signorini_scene::error::Result;
use signorini_scene::mesh::adapted::adapted;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::mesh::{Curve, Mesh};
use signorini_scene::scene::units::Units;
use signorini_scene::setting::CellKind;

const SCENE: &str = r#"mesh = "grid"
material.default.conductivity = "1"
boundary.dirichlet = { kind = "dirichlet", value = "1" }
boundary.contact = { kind = "contact" }
boundary.default = { kind = "neumann", flux = "0" }
"#;

fn warnings(text: &str, mesh: Mesh) -> Result<Vec<String>> {
    Ok(Problem::new(&scene(text)?, mesh)?.warnings)
}

fn error(text: &str, mesh: Mesh) -> String {
    warnings(text, mesh).expect_err("an error").to_string()
}

fn with_curve(mesh: Mesh, name: &str, edges: Vec<[u32; 2]>) -> Mesh {
    let edges = edges.into_iter().map(|[a, b]| [a.min(b), a.max(b)]);
    let mut curve = Curve { name: name.to_owned(), edges: edges.collect() };
    curve.edges.sort_unstable();
    Mesh { curves: mesh.curves.into_iter().chain([curve]).collect(), ..mesh }
}

fn drain() -> String {
    format!("{SCENE}[boundary.drain]\nkind = \"dirichlet\"\nvalue = \"0\"\n")
}

/// The line x = 0 of the grid with 8 × 4 squares.
const MIDDLE: [[u32; 2]; 4] = [[4, 13], [13, 22], [22, 31], [31, 40]];

#[test]
fn a_condition_inside_is_refused_on_every_mesh_made_of_the_curve() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let mesh = with_curve(grid(4, cells), "drain", MIDDLE.to_vec());
        for (kind, refine) in
            [(None, 0), (None, 2), (Some(CellKind::Triangles), 1), (Some(CellKind::Quads), 1)]
        {
            let mesh = adapted(mesh.clone(), kind, refine)?;
            let count = 4 << refine;
            let said = error(&drain(), mesh.clone());
            let expected = format!(
                "boundary.drain: the physical curve \"drain\" lies inside the domain, where no condition acts: {count} of its {count} edges"
            );
            assert!(said.contains(&expected), "{said}");
            assert_eq!(warnings(SCENE, mesh)?, [""; 0]);
        }
    }
    Ok(())
}

#[test]
fn a_condition_inside_says_where_and_how_much_of_it() {
    let said = error(&drain(), with_curve(grid(2, Cells::Quads), "drain", vec![[2, 7]]));
    let expected = "test.toml:6: boundary.drain: the physical curve \"drain\" lies inside the domain, where no \
         condition acts: 1 of its 1 edges have cells on both sides, the first (0, 0)–(0, 0.5)";
    assert_eq!(said, expected);
    // One edge of it lies on the boundary, in a curve without a table.
    let text = fixtures::changed(&drain(), &[("boundary.contact = { kind = \"contact\" }\n", "")]);
    let mesh = with_curve(grid(2, Cells::Quads), "drain", vec![[1, 2], [2, 7]]);
    let partly = warnings(&text, mesh).expect_err("a part lies inside");
    assert_eq!(partly.exit_status(), 2);
    let said = partly.to_string();
    assert!(said.contains("lies partly inside the domain"), "{said}");
    assert!(said.contains("1 of its 2 edges"), "{said}");
}

#[test]
fn inputs_and_outputs_of_a_curve_inside_are_refused() {
    let mesh = with_curve(grid(4, Cells::Quads), "drain", MIDDLE.to_vec());
    for more in [
        "[output.q]\nkind = \"flux\"\nof = \"drain\"\n",
        "[input.q]\nof = \"drain\"\nfield = \"value\"\npattern = \"1\"\n",
    ] {
        assert!(error(&format!("{SCENE}{more}"), mesh.clone()).contains("no boundary `drain`"));
        assert!(error(&format!("{}{more}", drain()), mesh.clone()).contains("inside the domain"));
    }
}

/// `mesh` with nodes of its own for the cells right of x = 0, at the heights where it is `torn`; and
/// the edges of the tear, those of the left cells first.
fn torn(mut mesh: Mesh, torn: impl Fn(f64) -> bool) -> Mesh {
    let old = mesh.vertices.clone();
    let mut copies: Vec<u32> = (0..old.len() as u32).collect();
    for (vertex, &[x, y]) in old.iter().enumerate() {
        if x == 0.0 && torn(y) {
            copies[vertex] = mesh.vertices.len() as u32;
            mesh.vertices.push([x, y]);
        }
    }
    let is_right =
        |corners: &[u32]| corners.iter().map(|&at| old[at as usize][0]).sum::<f64>() > 0.0;
    let renew = |corners: &mut [u32]| {
        if is_right(corners) {
            corners.iter_mut().for_each(|corner| *corner = copies[*corner as usize]);
        }
    };
    mesh.triangles.iter_mut().for_each(|cell| renew(cell));
    mesh.quads.iter_mut().for_each(|cell| renew(cell));
    for curve in &mut mesh.curves {
        curve.edges.iter_mut().for_each(|edge| renew(edge));
        curve.edges.iter_mut().for_each(|edge| edge.sort_unstable());
        curve.edges.sort_unstable();
    }
    mesh
}

#[test]
fn nodes_that_were_not_merged_are_a_slit_and_said() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let whole = warnings(SCENE, torn(grid(4, cells), |_| true))?;
        assert_eq!(
            whole,
            ["8 boundary edges lie on others without being joined to them, the first \
            (0, 0)–(0, 0.25), all between (0, 0) and (0, 1): a slit that only [boundary.default] covers. Merge the \
            nodes there (in Gmsh `Coherence Mesh`); or, if the slit is meant, give it a physical curve and a table"]
        );
        // One node alone: both edges at it come apart.
        let node = warnings(SCENE, torn(grid(4, cells), |y| y == 0.5))?;
        assert!(node[0].starts_with("4 boundary edges"), "{node:?}");
        assert!(node[0].contains("all between (0, 0.25) and (0, 0.75)"), "{node:?}");
        let refined = adapted(torn(grid(4, cells), |_| true), None, 1)?;
        assert!(warnings(SCENE, refined)?[0].starts_with("16 boundary edges"));
        assert_eq!(warnings(SCENE, grid(4, cells))?, [""; 0]);
    }
    Ok(())
}

#[test]
fn a_slit_with_a_table_is_meant() -> Result<()> {
    let mesh = torn(grid(4, Cells::Quads), |y| y > 0.0);
    // The copies of vertices 13, 22, 31, 40 are 45 to 48; both sides end in 4.
    let right = [[4, 45], [45, 46], [46, 47], [47, 48]];
    let both = MIDDLE.into_iter().chain(right).collect();
    assert_eq!(warnings(&drain(), with_curve(mesh.clone(), "drain", both))?, [""; 0]);
    // A table for one side leaves the other to the default.
    let one = warnings(&drain(), with_curve(mesh.clone(), "drain", MIDDLE.to_vec()))?;
    assert!(one[0].starts_with("4 boundary edges"), "{one:?}");
    // A curve without a table says nothing.
    let other = warnings(SCENE, with_curve(mesh, "slit", MIDDLE.to_vec()))?;
    assert!(other[0].starts_with("8 boundary edges"), "{other:?}");
    Ok(())
}

#[test]
fn hanging_nodes_are_a_slit_too() -> Result<()> {
    // A square on two of half its size.
    let below = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let above = [[0.0, 1.0], [0.5, 1.0], [1.0, 1.0], [1.0, 1.5], [0.5, 1.5], [0.0, 1.5]];
    let quads = vec![[0, 1, 2, 3], [4, 5, 8, 9], [5, 6, 7, 8]];
    let mesh = Mesh { vertices: [&below[..], &above].concat(), quads, ..Mesh::default() };
    let sides = [[1, 2], [0, 3], [4, 9], [6, 7], [7, 8], [8, 9]];
    let mesh = with_curve(mesh, "dirichlet", sides.to_vec());
    let mesh = with_curve(mesh, "contact", vec![[0, 1]]);
    let said = warnings(SCENE, mesh)?;
    assert!(said[0].starts_with("3 boundary edges lie on others"), "{said:?}");
    assert!(said[0].contains("all between (0, 1) and (1, 1)"), "{said:?}");
    Ok(())
}

#[test]
fn a_default_that_acts_nowhere_is_said_where_it_is_more_than_nothing() -> Result<()> {
    let contact =
        SCENE.replace("kind = \"neumann\", flux = \"0\"", "kind = \"contact\", gap = \"2\"");
    let nowhere = "[boundary.default] (contact) acts nowhere: every boundary edge lies in a curve with a table of its own";
    assert_eq!(warnings(&contact, grid(2, Cells::Quads))?, [nowhere]);
    assert_eq!(warnings(SCENE, grid(2, Cells::Quads))?, [""; 0]);
    let controlled = format!(
        "{SCENE}[input.rain]\nof = \"default\"\nfield = \"flux\"\npattern = \"1\"\n[output.q]\nkind = \"flux\"\nof = \"default\"\n"
    );
    let said = warnings(&controlled, grid(2, Cells::Quads))?;
    let of = |key: &str| format!("[{key}] is about no edge: [boundary.default] covers none");
    assert_eq!(said, [of("input.rain"), of("output.q")]);
    Ok(())
}

#[test]
fn the_hint_says_no_more_than_it_has_to() {
    let hint = |text: &str, mesh| {
        let error = warnings(text, mesh).expect_err("an error");
        miette::Diagnostic::help(&error).expect("a hint").to_string()
    };
    let none = SCENE.split("boundary.default = ").next().unwrap_or_default();
    let bare =
        Mesh { curves: grid(2, Cells::Quads).curves, ..torn(grid(2, Cells::Quads), |y| y > 0.0) };
    assert_eq!(hint(none, bare), "add [boundary.default] for all that is left");
    let unbound = fixtures::changed(none, &[("boundary.contact = { kind = \"contact\" }\n", "")]);
    let expected = "add [boundary.contact], or [boundary.default] for all that is left";
    assert_eq!(hint(&unbound, grid(2, Cells::Quads)), expected);
    let bare = Mesh { surfaces: Vec::new(), ..grid(2, Cells::Quads) };
    let left = fixtures::changed(SCENE, &[("material.default", "material.left")]);
    let expected = "add [material.right], or [material.default] for all that is left";
    assert_eq!(hint(&left, grid(2, Cells::Quads)), expected);
    assert!(hint(&left, bare).starts_with("the mesh has no physical surface"));
}

#[test]
fn loads_out_of_balance_are_told_with_their_sums() -> Result<()> {
    let (given, contact) = ("kind = \"dirichlet\", value = \"1\"", "kind = \"contact\"");
    let flux = |flux: &str| format!("kind = \"neumann\", flux = \"{flux}\"");
    for (sides, bottom, words) in [
        (
            "0",
            contact,
            "balance by themselves (their sum is at most 1e-9 of the sum of their sizes",
        ),
        (
            "0",
            contact,
            "They sum to 0, not less than 0, with contact at its least flux: boundary.contact.flux 0",
        ),
        ("1", contact, "They sum to 4, not less than 0, with contact at its least flux"),
        ("0.5", &flux("-0.001"), "They sum to 1.998, not 0: "),
        ("0.5", &flux("-0.001"), "boundary.contact.flux -0.002"),
        (
            "-1",
            "kind = \"contact\", limit = 0.25",
            "They sum to -3.5, not more than 0, with contact at its limit",
        ),
    ] {
        let text = fixtures::changed(SCENE, &[(given, &flux(sides)), (contact, bottom)]);
        let problem = Problem::new(&scene(&text)?, grid(2, Cells::Quads))?;
        for problem in [problem.in_units(&Units { u: 0.25, ..Units::default() })?, problem] {
            let said = super::Parts::examine(&problem).expect_err(words).to_string();
            assert!(said.contains(words), "{words}: {said}");
        }
    }
    Ok(())
}

#[test]
fn a_part_that_nothing_holds_is_said() -> Result<()> {
    let neumann = "kind = \"neumann\", flux = \"0\"";
    let text = SCENE.replace("kind = \"contact\"", neumann);
    assert_eq!(warnings(&text, grid(2, Cells::Mixed))?, [""; 0]);
    let text = text.replace("kind = \"dirichlet\", value = \"1\"", neumann);
    let said = warnings(&text, grid(2, Cells::Mixed))?;
    assert_eq!(said.len(), 1);
    let nothing = "no Dirichlet, Robin or contact boundary holds the connected part";
    assert!(said[0].starts_with(nothing), "{said:?}");
    assert!(said[0].ends_with("): u is determined up to a constant there"), "{said:?}");
    // Torn apart there are two of them.
    let said = warnings(&text, torn(grid(2, Cells::Mixed), |_| true))?;
    assert!(said.len() == 2 && said[1].contains("nor 1 more: u is determined"), "{said:?}");
    Ok(())
}

#[test]
fn the_diagonal_has_the_bits_of_the_assembled_one() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let (_, problem) =
            fixtures::on_grid(fixtures::SMOOTH, fixtures::distorted(grid(4, cells)))?;
        let [diagonal, load] = problem.diagonal_and_load().expect("numbers that f64 holds");
        let assembled = Assembled::<f64>::new(&problem).expect("the same");
        let system = assembled.system().expect("the same");
        let expected: Vec<_> = system.matrix().iter().map(|row| row.diagonal()).collect();
        assert_eq!((diagonal, &load[..]), (expected, system.load()), "{cells:?}");
    }
    Ok(())
}

fn stored(left: &str, right: &str, step: f64) -> Result<Vec<String>> {
    let text = SCENE.replace("material.default.conductivity = \"1\"\n", "");
    let material = |name: &str, capacity: &str| {
        format!("[material.{name}]\nconductivity = 2\ncapacity = \"{capacity}\"\n")
    };
    let text = text + &material("left", left) + &material("right", right);
    warnings(&format!("{text}[time]\nstep = {step}\n"), grid(4, Cells::Triangles))
}

#[test]
fn what_may_not_be_meant_of_a_capacity_is_said() -> Result<()> {
    assert_eq!(stored("1", "2", 1.0)?, [""; 0]);
    // Not the same in both halves, but in every cell.
    assert_eq!(stored("1 + sign(x)", "2 + sign(y - 0.5)", 1.0)?, [""; 0]);
    let at_once =
        "[material.left] has a capacity, and [material.right] has none: u answers at once there";
    assert_eq!(stored("1", "0", 1.0)?, [at_once]);
    let varying = stored("1", "1 + x", 1.0)?;
    assert!(varying[0].starts_with("a capacity varies inside 32 of 64 cells"), "{varying:?}");
    // h = ¼ and c/α = ½ or 1: k h²/α is 1e4 at dt = 3.1e−6 where it is least.
    assert_eq!(stored("1", "2", 3.2e-6)?, [""; 0]);
    let short = stored("1", "2", 3.0e-6)?;
    let steps = "time.step = 0.000003: no less than 1.0e4 such steps";
    assert!(short.len() == 1 && short[0].starts_with(steps), "{short:?}");
    let rest = "2\"\n[output.rest]\nkind = \"content\"\nof = \"default\"\n[material.default]\nconductivity = 1\n\
                capacity = \"1";
    let idle = stored("1", rest, 1.0)?;
    assert_eq!(idle[0], "[output.rest] is about no cell that counts in [material.default]");
    Ok(())
}

//! Contact boundaries that meet with different gaps have a bound: above every error, near it at the solution.

use super::limits_bound::Certified;
use super::*;
use signorini_problem::fixtures::{SMOOTH, with_four_sides};
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::{Cells, grid};

/// The grid whose contact right of x = 0 has a name of its own.
fn parted(cells: Cells) -> Mesh {
    let mut mesh = with_four_sides(grid(8, cells));
    let right = |edge: &[u32; 2]| edge.iter().all(|&at| mesh.vertices[at as usize][0] >= 0.0);
    let (other, own) = mesh.curves[0].edges.iter().copied().partition(|edge| right(edge));
    mesh.curves[0].edges = own;
    mesh.curves.push(signorini_scene::mesh::Curve { name: "other".to_owned(), edges: other });
    mesh
}

/// SMOOTH, touching left of x = 0, and right of it between the gap and the base of its flux.
fn parted_scene(other: &str) -> String {
    format!("{SMOOTH}boundary.other = {{ kind = \"contact\", {other} }}\n")
}

/// Gaps of the right part that jump at x = 0, where u is off it, and how near the mesh's bound the condensed one has to be at the
/// solution: between u ≥ ψ and u ≤ ψ s has their mean for good, and above gaps that cross within the ranges it lies off both.
const OFF: [(&str, f64); 6] = [
    ("gap = \"x^3 - 1\", flux = \"-2.5*x^2\"", 1.1),
    ("gap = \"x^3 + 0.5\", flux = \"-2.5*x^2 - 1\", limit = \"-2.5*x^2\"", 1.1),
    ("gap = \"x^3 + 1\", flux = \"-inf\", limit = \"-2.5*x^2\"", 2.2),
    (
        "gap = \"x^3 - 1\", flux = \"-2.5*x^2\" }\ninput.lift = { of = \"other\", field = \"gap\", pattern = \"1 + x\"",
        0.0,
    ),
    (
        "gap = \"x^3 - 1\", flux = \"-2.5*x^2\" }\ninput.lift = { of = \"other\", field = \"gap\", pattern = \"1\", range = [-1.0, 0.5]",
        1.1,
    ),
    (
        "gap = \"x^3 - 1\", flux = \"-2.5*x^2\" }\ninput.lift = { of = \"other\", field = \"gap\", pattern = \"1\", range = [-1.0, 1.5]",
        1.25,
    ),
];

#[test]
fn gaps_that_differ_at_a_common_vertex_have_a_bound() -> Result<()> {
    for (other, near) in OFF {
        for cells in [Cells::Triangles, Cells::Quads] {
            let text = parted_scene(other);
            let problem = Problem::new(&signorini_problem::fixtures::scene(&text)?, parted(cells))?;
            let certified = Certified::of(problem)?;
            if near == 0.0 {
                let reason = certified.model.certificate.expect_err("an input without a range");
                assert!(
                    reason.contains("meet at (0, 0) differ by what an input without a range"),
                    "{reason}"
                );
                continue;
            }
            for (is_solution, x) in certified.trials() {
                let [bound, ..] = certified.at(other, &x)?;
                if is_solution {
                    let states = states(&x);
                    assert!(states[1] >= 8 && states[0] + states[2] >= 7, "{other}: {states:?}");
                    let (_, solution, _) = full_at(&certified.problem, &certified.model.defaults)?;
                    let of_mesh = solution.bound.expect("a bound").total;
                    assert!(bound < near * of_mesh, "{other}: {bound} {of_mesh}");
                }
            }
        }
    }
    Ok(())
}

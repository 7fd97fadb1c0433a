//! The condensed model and the full one give the same outputs.

use signorini_tolerances::solve::CONDENSED;
use std::path::Path;

use super::*;
use crate::{Measure, condense};
use signorini_problem::fixtures::distorted;
use signorini_scene::mesh;
use signorini_scene::mesh::structured::{Cells, grid};

/// Both at some inputs of size `amount` around the defaults; bounds are the business of other tests.
fn compare(problem: &Problem, amount: f64, rounds: usize) -> Result<Vec<f64>> {
    let condensate = condense(problem)?;
    assert_eq!(condensate.inputs, 1 + problem.scene.inputs.len());
    let mut lengths = Vec::new();
    for round in 0..rounds {
        let moved = condensate.defaults.iter().enumerate();
        let p: Vec<f64> = moved
            .map(|(at, p)| if at == 0 { 1.0 } else { p + amount * scatter(31 * round + at) })
            .collect();
        let (full, solution, expected) = full_at(problem, &p)?;
        let x = condensate.solve(&p).expect("a solution");
        let found = condensate.outputs(&p, &x);
        let scale = solution.largest_flux();
        for ((found, expected), measure) in found.iter().zip(&expected).zip(&condensate.outputs) {
            if *measure == Measure::Bound {
                continue;
            }
            let (found, expected) = (found.expect("a value"), expected.expect("a value"));
            if let Measure::Length { .. } = measure {
                lengths.push(found);
            }
            let size = expected.abs().max(scale);
            CONDENSED.check_over(format_args!("{measure:?}"), found - expected, size);
        }
        let residual = condensate.residual(&p, &x);
        for (at, (r, multiplier)) in residual.iter().zip(&condensate.multiplier).enumerate() {
            let of_contact = condensate.edges[at];
            let edge = full.topology.counts.free + of_contact;
            let opening = solution.u[edge] - full.loads.gap[of_contact];
            let found = condensate.opening[at] * x[at];
            CONDENSED.check_over("opening", found - opening, scale_of(&solution.u));
            let force = solution.flux[edge] - full.loads.contact_flux[of_contact];
            CONDENSED.check_over("force", r * multiplier - force, scale);
        }
    }
    Ok(lengths)
}

#[test]
fn inputs_of_all_fields_on_all_cells() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for mesh in [grid(5, cells), distorted(grid(4, cells))] {
            let (_, problem) = on_grid(ALL, mesh)?;
            let lengths = compare(&problem, 0.3, 6)?;
            assert!(lengths.iter().any(|length| (0.1..1.9).contains(length)), "{lengths:?}");
        }
    }
    Ok(())
}

#[test]
fn nonparametric_quads() -> Result<()> {
    let text = format!("{ALL}\n[setting]\nelement = \"nonparametric\"\n");
    let (_, problem) = on_grid(&text, distorted(grid(4, Cells::Quads)))?;
    compare(&problem, 0.3, 4).map(|_| ())
}

#[test]
fn a_varying_tensor_and_a_jump() -> Result<()> {
    let uniform = "material.default.conductivity = [\"2\", \"0.5\", \"1\"]";
    let halves = "material.left.conductivity = \"1000\"\n\
                  material.right.conductivity = [\"2+x\", \"0.5*y\", \"1\"]";
    let varying = changed(ALL, &[(uniform, halves)]);
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(&varying, grid(4, cells))?;
        compare(&problem, 0.3, 4)?;
    }
    Ok(())
}

/// A scene without what contact alone has: the input of its gap, its force and its length.
pub(super) fn without_contact(text: &str) -> String {
    let of_contact = ["input.depth", "output.force", "output.length"];
    let is_left = |line: &&str| of_contact.iter().all(|name| !line.starts_with(name));
    text.lines().filter(is_left).flat_map(|line| [line, "\n"]).collect()
}

#[test]
fn without_contact_the_model_is_linear() -> Result<()> {
    let contact = "kind = \"contact\", gap = \"0.35 - 0.4*x^2 + 0.1*x^3\"";
    let linear = without_contact(&changed(ALL, &[(contact, "kind = \"neumann\"")]));
    let (_, problem) = on_grid(&linear, grid(4, Cells::Mixed))?;
    let condensate = condense(&problem)?;
    assert_eq!(condensate.contact, 0);
    compare(&problem, 0.5, 3)?;
    let bound = condensate.bound(&condensate.defaults, &[]).expect("a bound");
    assert!((0.5..2.0).contains(&(bound / condensate.energy_unit)), "{bound}");
    Ok(())
}

/// max |u|
fn scale_of(u: &[f64]) -> f64 {
    u.iter().fold(0.0, |most: f64, u| most.max(u.abs()))
}

/// The scenes that come with the project, with inputs about as large as in use.
#[test]
fn the_standard_scenes() -> Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/scenes");
    for (name, amount) in
        [("levee", 0.4), ("slab", 5.0), ("strip", 0.2), ("membrane", 0.0), ("pit", 0.0)]
    {
        let scene = Scene::read(&folder.join(format!("{name}.toml")))?;
        let mesh = mesh::read(&scene.mesh.value)?;
        let problem = Problem::new(&scene, mesh)?;
        compare(&problem, amount, 2)?;
    }
    Ok(())
}

//! The condensed model and the full one give the same outputs.

use std::path::Path;

use super::*;
use crate::certify::fixtures::distorted;
use crate::condense::{Measure, condense};
use crate::mesh::gmsh;
use crate::mesh::structured::{Cells, grid};

/// Both at some inputs of size `amount` around the defaults; bounds are the business of other tests.
fn compare(scene: &Scene, problem: &Problem, amount: f64, rounds: usize) -> Result<()> {
    let condensate = condense(scene, problem)?;
    assert_eq!(condensate.inputs, 1 + scene.inputs.len());
    let mut lengths = Vec::new();
    for round in 0..rounds {
        let moved = condensate.defaults.iter().enumerate();
        let p: Vec<f64> = moved
            .map(|(at, p)| if at == 0 { 1.0 } else { p + amount * scatter(31 * round + at) })
            .collect();
        let (_, solution, expected) = full(scene, problem, &p)?;
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
            let slack = 1e-9 * expected.abs().max(scale);
            assert!((found - expected).abs() <= slack, "{found} {expected} of {measure:?}");
        }
        for (at, (x, d)) in x.iter().zip(&condensate.opening).enumerate() {
            let edge = problem.topology.counts.free + at;
            let multiplier = solution.flux[edge];
            assert!(multiplier.is_finite() && *x >= 0.0 && *d > 0.0);
        }
    }
    println!("n = {}, U = {:e}, lengths {lengths:?}", condensate.contact, condensate.energy_unit);
    Ok(())
}

#[test]
fn inputs_of_all_fields_on_all_cells() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for mesh in [grid(5, cells), distorted(grid(4, cells))] {
            let (scene, problem) = on_grid(ALL, mesh)?;
            compare(&scene, &problem, 0.3, 6)?;
        }
    }
    Ok(())
}

#[test]
fn a_varying_tensor_and_a_jump() -> Result<()> {
    let varying = ALL.replace(
        "[material.default]\nconductivity = [\"2\", \"0.5\", \"1\"]",
        "[material.left]\nconductivity = \"1000\"\n[material.right]\nconductivity = [\"2+x\", \"0.5*y\", \"1\"]",
    );
    assert_ne!(varying, ALL);
    for cells in [Cells::Triangles, Cells::Quads] {
        let (scene, problem) = on_grid(&varying, grid(4, cells))?;
        compare(&scene, &problem, 0.3, 4)?;
    }
    Ok(())
}

#[test]
fn without_contact_the_model_is_linear() -> Result<()> {
    let linear = ALL
        .replace("kind = \"contact\"\ngap = \"-0.05 + 0.1*x^3\"", "kind = \"neumann\"")
        .replace("[input.depth]\nof = \"contact\"\nfield = \"gap\"\npattern = \"(1 - x)*(0.2 + 0.1*x)*(1+x)\"\n", "")
        .replace("[output.force]\nkind = \"force\"\n", "")
        .replace("[output.length]\nkind = \"length\"\nof = \"contact\"\n", "");
    let (scene, problem) = on_grid(&linear, grid(4, Cells::Mixed))?;
    let condensate = condense(&scene, &problem)?;
    assert_eq!(condensate.contact, 0);
    compare(&scene, &problem, 0.5, 3)?;
    let bound = condensate.bound(&condensate.defaults, &[]).expect("a bound");
    assert!((0.5..2.0).contains(&(bound / condensate.energy_unit)), "{bound}");
    Ok(())
}

/// The scenes that come with the project, with inputs about as large as in use.
#[test]
fn the_standard_scenes() -> Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes");
    for (name, amount) in
        [("levee", 0.4), ("slab", 5.0), ("strip", 0.2), ("membrane", 0.0), ("pit", 0.0)]
    {
        let scene = Scene::read(&folder.join(format!("{name}.toml")))?;
        let mesh = gmsh::read(&scene.mesh.value)?;
        let problem = Problem::new(&scene, mesh)?;
        println!("{name}");
        compare(&scene, &problem, amount, 2)?;
    }
    Ok(())
}

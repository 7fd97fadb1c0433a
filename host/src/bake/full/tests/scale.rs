//! Scenes far from 1: the module's answers are those of the same scene near 1, in other units.

use signorini_kernel::rows;

use super::{BENT, Baked, Controller, fixtures, to_the_end};
use crate::error::Result;
use crate::mesh::structured::{Cells, grid};
use crate::problem::Problem;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::scene::units::Units;

/// BENT in other units, with the inputs as they were: their patterns take it all.
fn bent(units: Units) -> Result<(Scene, Problem)> {
    let (scene, problem) = fixtures::on_grid(BENT, grid(4, Cells::Mixed))?;
    let scene = units.inverse().scene(&scene);
    let problem = Problem::new(&scene, problem.mesh)?;
    Ok((scene, problem))
}

fn powers(u: i32, conductivity: i32) -> Units {
    Units { u: 2f64.powi(u), conductivity: 2f64.powi(conductivity) }
}

/// Flux, force, length, probe and bound.
fn tick<R: Scalar>(units: Units) -> Result<Vec<f64>> {
    let (scene, problem) = bent(units)?;
    let baked = Baked::<R>::new(&scene, &problem)?;
    let mut controller = Controller::<R, { rows::QUADS }>::new(&baked);
    let inputs = [0.3, 0.7, 0.1, 0.2, 0.3, 0.4].map(R::narrow);
    let (outputs, report) = controller.tick_within(&inputs, to_the_end()).expect("a tick");
    println!("{report:?}");
    Ok(outputs.iter().map(|output| output.wide()).collect())
}

#[test]
fn measure() -> Result<()> {
    for k in [0, -20, -30, -40, -50, -60, -70, -80, -90, -100, 40, 60, 80, 100] {
        let units = powers(0, k);
        match tick::<f32>(units) {
            Ok(out) => println!(
                "{k} {:?}",
                [
                    out[0] / units.flux(),
                    out[1] / units.flux(),
                    out[2],
                    out[3] / units.u,
                    out[4] / units.energy()
                ]
            ),
            Err(e) => println!("{k} {e}"),
        }
    }
    Ok(())
}

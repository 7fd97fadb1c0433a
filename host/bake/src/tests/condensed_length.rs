//! Lengths of contact that a condensed solve states.

use signorini_problem::fixtures::{EVERY_INPUT, changed, on_grid};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::fixtures::full_at;
use signorini_solve::outputs::outputs;
use signorini_tolerances::bake::LENGTH;

/// Where an input moves the gap, u is a sum of columns that meets it but for rounding.
#[test]
fn declared_lengths_of_a_condensed_solve() -> Result<()> {
    for scalar in ["f32", "f64"] {
        let setting = format!("[setting]\nmodel = \"condensed\"\nscalar = \"{scalar}\"\n");
        let depth = "pattern = \"(1 - x)*(0.2 + 0.1*x)*(1+x)\"";
        let text = changed(EVERY_INPUT, &[(depth, &format!("{depth}, default = 0.3"))]) + &setting;
        let (scene, problem) = on_grid(&text, grid(5, Cells::Mixed))?;
        let inputs: Vec<f64> = scene.inputs.iter().map(|input| input.default).collect();
        let p: Vec<f64> = std::iter::once(1.0).chain(inputs).collect();
        let (_, expected, _) = full_at(&problem, &p)?;
        let solution = signorini_session::solve(&problem)?;
        let length = outputs(&problem, &solution)?["length"];
        assert!((0.1..1.9).contains(&expected.contact_length), "{}", expected.contact_length);
        LENGTH.check(scalar, expected.contact_length - solution.contact_length);
        assert_eq!(length, Some(solution.contact_length), "{scalar}");
    }
    Ok(())
}

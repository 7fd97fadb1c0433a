//! Weights of a controller beside those on paper.

use super::super::known::Answers;
use super::super::weights::{Weighed, weights};
use signorini_certify::Evaluated;
use signorini_problem::Problem;
use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::OUTPUT_WEIGHTS;

/// A bar from x = −1 to 1 and of height 1 with A = 3, u given on the left, heat by a law of transfer with h = 2 on the right.
const BAR: &str = r#"
mesh = "grid"
material.default.conductivity = "3"
source.f = "0"
boundary.left = { kind = "dirichlet", value = "0" }
boundary.right = { kind = "robin", coefficient = "2", ambient = "1" }
boundary.dirichlet = { kind = "neumann", flux = "0" }
boundary.contact = { kind = "neumann", flux = "0" }
output.cold = { kind = "flux", of = "left" }
output.skin = { kind = "mean", of = "right" }
output.roof = { kind = "mean", of = "dirichlet" }
"#;

/// Weights of a model without answers that are known beforehand.
pub fn of_all(problem: &Problem, are_balanced: bool) -> Vec<Weighed> {
    let answers = Answers { open: &[], pressed: &[], columns: &[], total: 0.0, are_balanced };
    weights(problem, &answers)
}

/// z and ζ are known: z falls from 1 with the slope b, 3b = 2 (1 − 2b), and ‖A∇z‖² = 3 · 2 b² + 2 (1 − 2b)². ζ of the mean on the right
/// is 1 − 2z there, with ‖ζ‖² = 2 ζ²/3 + (1 − ζ)²/2 where ζ = 3z/2.
#[test]
fn weights_of_a_bar_are_those_of_its_resistances() -> Result<()> {
    for cells in [Cells::Triangles, Cells::Quads] {
        let (_, problem) = on_grid(BAR, grid(4, cells))?;
        let found = of_all(&problem, cells == Cells::Triangles);
        let slope: f64 = 2.0 / 7.0;
        let flux = (6.0 * slope * slope + 2.0 * (1.0 - 2.0 * slope).powi(2)).sqrt();
        let through: f64 = 3.0 / 7.0;
        let mean = (2.0 * through * through / 3.0 + (1.0 - through).powi(2) / 2.0).sqrt();
        let weight = |at: usize| found[at].clone().expect("weights").total;
        OUTPUT_WEIGHTS.check_relative("flux", weight(0), flux);
        OUTPUT_WEIGHTS.check_relative("mean", weight(1), mean);
        assert!(weight(2) > 0.0);
        if cells == Cells::Quads {
            // s of a condensed model does not keep the means of u_h between quads.
            let of_u = of_all(&problem, true)[1].clone().expect("weights").of_u;
            OUTPUT_WEIGHTS.check_relative("mean of u_h", of_u, mean);
        }
    }
    Ok(())
}

/// What is missed of the integrals of a source that jumps along a curve is part of what a controller says, in base and input alike.
#[test]
fn weights_have_what_is_missed_of_loads() -> Result<()> {
    let jump = "sign(x^2 + y^2 - 0.3)";
    let input =
        format!("input.heat = {{ of = \"source\", field = \"f\", pattern = \"{jump}\" }}\n");
    let base = BAR.replace("source.f = \"0\"", &format!("source.f = \"{jump}\""));
    let total = |text: &str| -> Result<(Problem, f64)> {
        let (_, problem) = on_grid(text, grid(4, Cells::Triangles))?;
        let total = of_all(&problem, true)[0].clone().expect("weights").total;
        Ok((problem, total))
    };
    let (_, plain) = total(BAR)?;
    for text in [base, format!("{BAR}{input}")] {
        let (problem, total) = total(&text)?;
        let term = problem.scene.inputs.len();
        let alone = problem.left_with(&[term])?;
        let (missed, oscillation) = (alone.loads.missed, Evaluated::of_term(&alone)?.oscillation);
        // z is at most 1, and so is the bound's share 2 osc.
        assert!(missed > 0.0 && (total - plain) * 2.0 * oscillation >= missed, "{missed} {total}");
        assert!(total < 1.1 * plain, "{total} {plain}");
    }
    Ok(())
}

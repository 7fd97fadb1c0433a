//! Inputs that take back nearly all of what the scene states: the bound still holds for what is left.

use signorini_problem::fixtures;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};

use super::{Baked, Controller, to_the_end};
use crate::Bakes;
use crate::narrow::narrow;

/// u = c (x + 1) on (−1, 1) × (0, 1), 2c on the right, with c in proportion to 1 + p: the law there, and the ratio.
const ALONG: [(&str, f64); 3] = [
    (
        "boundary.right = { kind = \"neumann\", flux = \"0.7\" }
         input.p = { of = \"right\", field = \"flux\", pattern = \"0.7\" }",
        0.7,
    ),
    (
        "boundary.right = { kind = \"robin\", coefficient = \"3\", ambient = \"0.7\" }
         input.p = { of = \"right\", field = \"ambient\", pattern = \"0.7\" }",
        2.1 / 7.0,
    ),
    (
        "boundary.right = { kind = \"robin\", coefficient = \"2 + y\", ambient = \"0.7*(1 + 2*(2 + y))/(2 + y)\" }
         input.p = { of = \"right\", field = \"ambient\", pattern = \"0.7*(1 + 2*(2 + y))/(2 + y)\" }",
        0.7,
    ),
];

fn along(law: &str) -> String {
    format!(
        "boundary.left = {{ kind = \"dirichlet\", value = \"0\" }}
         boundary.dirichlet = {{ kind = \"neumann\", flux = \"0\" }}
         boundary.contact = {{ kind = \"neumann\", flux = \"0\" }}
         {law}
         output.mean = {{ kind = \"mean\", of = \"right\" }}"
    )
}

/// u = c (1 − y), off its gap: c below.
const ACROSS: &str = "
    boundary.left = { kind = \"neumann\", flux = \"0\" }
    boundary.right = { kind = \"neumann\", flux = \"0\" }
    boundary.dirichlet = { kind = \"dirichlet\", value = \"0\" }
    boundary.contact = { kind = \"contact\", gap = \"-9\", flux = \"0.7\" }
    input.p = { of = \"contact\", field = \"flux\", pattern = \"0.7\" }
    output.mean = { kind = \"mean\", of = \"contact\" }";

/// How far u is off where its mean should be this, and how far it may be: ‖∇u‖ is the root of 2 times the slope.
fn off<R: Bakes>(
    text: &str,
    inputs: &[f64],
    slope: f64,
    mean: impl Fn(f64) -> f64,
) -> Result<[f64; 2]> {
    let text = format!("mesh = \"grid\"\nmaterial.default.conductivity = \"1\"\n{text}");
    let (_, problem) =
        fixtures::on_grid(&text, grid(if inputs.len() > 1 { 8 } else { 7 }, Cells::Triangles))?;
    let baked = Baked::<R>::new(&problem)?;
    let mut controller = Controller::<R>::new(&baked);
    let inputs: Vec<R> = narrow(inputs);
    let (outputs, report) = controller.tick_within(&inputs, to_the_end()).expect("a tick");
    let mean = mean(inputs[0].wide());
    let off = 2f64.sqrt() * slope * (outputs[0].wide() - mean).abs();
    Ok([off, report.verdict.certificate().expect("a bound").of_u.wide()])
}

#[test]
fn the_bound_holds_where_inputs_cancel_the_data() -> Result<()> {
    let scenes = ALONG.map(|(law, ratio)| (along(law), 2.0 * ratio, 0.5));
    for (text, ratio, slope) in scenes.into_iter().chain([(ACROSS.to_owned(), 0.7, 1.0)]) {
        let mean = |p: f64| ratio * (1.0 + p);
        let found = [
            off::<f32>(&text, &[-0.999], slope, mean)?,
            off::<f32>(&text, &[-0.99999], slope, mean)?,
            off::<f64>(&text, &[-1.0 + 1e-10], slope, mean)?,
        ];
        for [off, bound] in found {
            assert!(off <= bound, "{text}: off by {off:e}, bound {bound:e}");
        }
    }
    Ok(())
}

/// h = 1 + p, that is u_ext = 0.3: on edges of ⅛ h is exact, and ∫h u_ext is not.
#[test]
fn products_of_inputs_may_cancel() -> Result<()> {
    let text = along(
        "boundary.right = { kind = \"robin\", coefficient = \"1\", ambient = \"0\" }
         input.p = { of = \"right\", field = \"coefficient\", pattern = \"1\", range = [-0.99999, 0] }
         input.air = { of = \"right\", field = \"ambient\", pattern = \"0.3\" }",
    );
    for power in [10, 13, 16] {
        let p = -1.0 + 0.5f64.powi(power);
        let [off, bound] = off::<f32>(&text, &[p, 1.0], 0.5, |p| 0.6 / (1.0 / (1.0 + p) + 2.0))?;
        assert!(off <= bound, "{power}: off by {off:e}, bound {bound:e}");
    }
    Ok(())
}

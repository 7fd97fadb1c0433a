//! Inputs that take back nearly all of what the scene states: the bound still holds for what is left.

use signorini_kernel::rows::TRIANGLES;
use signorini_problem::fixtures;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};

use super::{Baked, Controller, to_the_end};

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

/// How far u is off where its mean is `ratio` (1 + p), and how far it may be: ‖∇u‖ is the root of 2 times the slope.
fn off<R: Scalar>(text: &str, ratio: f64, slope: f64, p: f64) -> Result<[f64; 2]> {
    let text = format!("mesh = \"grid\"\nmaterial.default.conductivity = \"1\"\n{text}");
    let (_, problem) = fixtures::on_grid(&text, grid(7, Cells::Triangles))?;
    let baked = Baked::<R>::new(&problem)?;
    let mut controller = Controller::<R, TRIANGLES>::new(&baked);
    let (outputs, report) = controller.tick_within(&[R::narrow(p)], to_the_end()).expect("a tick");
    let mean = ratio * (1.0 + R::narrow(p).wide());
    let off = 2f64.sqrt() * slope * (outputs[0].wide() - mean).abs();
    Ok([off, report.verdict.certificate().expect("a bound").of_u.wide()])
}

#[test]
fn the_bound_holds_where_inputs_cancel_the_data() -> Result<()> {
    let scenes = ALONG.map(|(law, ratio)| (along(law), 2.0 * ratio, 0.5));
    for (text, ratio, slope) in scenes.into_iter().chain([(ACROSS.to_owned(), 0.7, 1.0)]) {
        let found = [
            off::<f32>(&text, ratio, slope, -0.999)?,
            off::<f32>(&text, ratio, slope, -0.99999)?,
            off::<f64>(&text, ratio, slope, -1.0 + 1e-10)?,
        ];
        for [off, bound] in found {
            assert!(off <= bound, "{text}: off by {off:e}, bound {bound:e}");
        }
    }
    Ok(())
}

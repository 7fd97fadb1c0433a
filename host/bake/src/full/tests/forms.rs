//! Transfer coefficients that points do not see: the bound of a tick is that of a solve, whatever inputs do to u_ext.

use signorini_certify::ErrorBound;
use signorini_tolerances::bake::TICK;

use super::compiled::same_bits_of;
use super::{BENT, Baked, Controller, fixtures, ticks, to_the_end};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_solve::{Options, solve};

/// One edge of `left` has a strip that no point sees, and two inputs change u_ext.
fn strip() -> String {
    let strip = "1 + 1000*(0.5 + 0.5*sign(0.002 - abs(y - 0.07)))";
    let sun = "[input.sun]\nof = \"left\"\nfield = \"ambient\"\npattern = \"sin(3*y)\"\n";
    format!("{}{sun}", BENT.replace("\"2 + y\"", &format!("\"{strip}\"")))
}

#[test]
fn a_strip_has_the_bound_of_a_solve() -> Result<()> {
    let (_, problem) = fixtures::on_grid(&strip(), grid(4, Cells::Mixed))?;
    let steps: [&[f64]; 2] =
        [&[0.3, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0], &[-0.5, 1.3, 0.4, -1.0, 0.7, 0.5, -2.0]];
    ticks::<f64>(&problem, &steps, TICK)?;
    let baked = Baked::<f64>::new(&problem)?;
    assert_eq!((baked.data.forms.laws.len(), &baked.data.of_ambient[..]), (1, &[5, 6][..]));
    assert!(baked.features().contains(&"pieces"));
    for values in steps {
        let mut controller = Controller::<f64>::new(&baked);
        let (_, report) = controller.tick_within(values, to_the_end()).expect("a tick");
        let found = ErrorBound::new(report.verdict.certificate().expect("a bound")).open();
        let options = Options { averages: true, ..Options::default() };
        let expected =
            solve(&problem.with_inputs(values)?, &options)?.bound.expect("a bound").open();
        assert!(expected > 0.0);
        TICK.check_relative(format_args!("open {values:?}"), found, expected);
    }
    Ok(())
}

#[test]
fn the_text_has_the_same_bits() -> Result<()> {
    let (_, problem) = fixtures::on_grid(&strip(), grid(3, Cells::Triangles))?;
    same_bits_of::<f32>(&problem)?;
    let air = ["of = \"left\", field = \"ambient\"", "of = \"source\", field = \"f\""];
    let sun = air.map(|of| of.replace(", ", "\n"));
    let still = strip().replace(air[0], air[1]).replace(&sun[0], &sun[1]);
    let (_, problem) = fixtures::on_grid(&still, grid(3, Cells::Triangles))?;
    same_bits_of::<f64>(&problem)
}

#[test]
fn an_input_of_the_coefficient_leaves_no_bound_and_is_named() -> Result<()> {
    let wind = "[input.wind]\nof = \"left\"\nfield = \"coefficient\"\npattern = \"1\"\n";
    let text = format!("{}{wind}default = 0.5\nrange = [0, 3]\n", strip());
    let (_, problem) = fixtures::on_grid(&text, grid(3, Cells::Triangles))?;
    let baked = Baked::<f64>::new(&problem)?;
    let reason = baked.no_bound().expect("none").to_string();
    assert!(reason.contains("boundary.left") && reason.contains("input.wind"), "{reason}");
    Ok(())
}

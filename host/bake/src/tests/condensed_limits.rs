//! A condensed model with limits of the flux, tick after tick: against the direct solver on the mesh, and its bound against that
//! of the same numbers in f64.

use super::direct::{HEATER, directly};
use crate::Bakes;
use crate::condensed::{Baked, Controller, Work};
use crate::narrow::narrow;
use signorini_condense::{CondensedModel, condense};
use signorini_kernel::report::Ended;
use signorini_problem::Problem;
use signorini_problem::fixtures::{changed, on_grid};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::Tolerance;
use signorini_tolerances::bake::{
    LIMITED_BOUND, LIMITED_BOUND_NARROW, LIMITED_TICK, LIMITED_TICK_NARROW,
};

/// The heater with limits that vary along it, and a gap that is not constant on the right.
fn heater() -> String {
    let bent = ("gap = \"3\"", "gap = \"2 + y\"");
    let wanted = ("field = \"gap\", pattern = \"1\"", "field = \"gap\", pattern = \"(1 - x)/2\"");
    changed(HEATER, &[bent, wanted]) + "output.all = { kind = \"force\" }\n"
}

/// The gap is given in place of what it was; both ends of the flux below change.
fn with_supply() -> String {
    let supply = "field = \"limit\", pattern = \"3\", default = 1.0";
    let changes = [
        ("6 - 3*x^2", "0"),
        ("value = \"2 - x/4\"", "value = \"2\""),
        ("field = \"gap\", pattern = \"(1 - x)/2\"", supply),
    ];
    changed(&heater(), &changes)
}

/// Inputs, among them some for each state alone, and back again.
const STEPS: [[f64; 3]; 7] = [
    [-3.0, 0.0, 0.5],
    [-40.0, 0.0, 0.5],
    [4.0, 6.0, 0.5],
    [-3.0, 0.0, 3.0],
    [2.0, 0.5, 0.2],
    [-12.0, 2.0, 0.1],
    [-3.0, 0.0, 0.5],
];

const EXACT: Work = Work { pivots: Some(400), sweeps: 40 };
/// How far outputs of exact ticks, and bounds, may be off.
const ALLOWED: [Tolerance; 2] = [LIMITED_TICK, LIMITED_BOUND];
const ALLOWED_NARROW: [Tolerance; 2] = [LIMITED_TICK_NARROW, LIMITED_BOUND_NARROW];

fn ticks<R: Bakes>(
    problem: &Problem,
    model: &CondensedModel,
    work: Work,
    [of_outputs, of_bound]: [Tolerance; 2],
) -> Result<[bool; 3]> {
    let baked = Baked::<R>::new(model, work, true).expect("in range");
    assert!(baked.is_limited() && baked.without_bound().is_none());
    let mut controller = Controller::new(&baked);
    let mut seen = [false; 3];
    for values in STEPS {
        let inputs: Vec<R> = narrow(&values);
        let (found, report) = controller.tick(&inputs).expect("a tick");
        let x: Vec<f64> = controller.x().iter().map(|x| x.wide()).collect();
        for x in &x {
            seen[usize::from(*x < 0.0) + 2 * usize::from(*x > 0.0)] = true;
        }
        let p: Vec<f64> = std::iter::once(1.0).chain(inputs.iter().map(|p| p.wide())).collect();
        let bound = model.bound(&p, &x).expect("a bound");
        let certificate = report.verdict.certificate().expect("a bound");
        let (total, rounding) = (certificate.total.wide(), certificate.rounding.wide());
        // Rounding stands in the target's bound alone.
        of_bound.check_relative(format_args!("{values:?}"), total - rounding, bound);
        let bound_of_u = model.bound_of_u(&p, &x).expect("a bound");
        let more = certificate.of_u.wide() - bound_of_u;
        assert!((0.0..=3.0 * rounding).contains(&more), "{values:?}: {more:e} {rounding:e}");
        if work != EXACT {
            continue;
        }
        assert_eq!(report.ended, Ended::Exact);
        let (now, _, direct) = directly(problem, &values)?;
        for (output, found) in now.scene.outputs.iter().zip(&found) {
            let name = &output.name.value;
            let value = direct[name].expect("a value");
            let size = value.abs().max(2.0);
            let what = format!("{name} {values:?}");
            of_outputs.check_over(what, found.wide() - value, size);
        }
    }
    Ok(seen)
}

#[test]
fn exact_ticks_are_those_of_the_mesh() -> Result<()> {
    for text in [heater(), with_supply()] {
        for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
            let (_, problem) = on_grid(&text, grid(6, cells))?;
            let model = &condense(&problem)?;
            assert_eq!(ticks::<f64>(&problem, model, EXACT, ALLOWED)?, [true; 3]);
            assert_eq!(ticks::<f32>(&problem, model, EXACT, ALLOWED_NARROW)?, [true; 3]);
        }
    }
    Ok(())
}

/// Any answer has its bound, whatever ends the tick.
#[test]
fn ticks_that_are_cut_off_are_bounded_as_on_the_host() -> Result<()> {
    for text in [heater(), with_supply()] {
        let (_, problem) = on_grid(&text, grid(6, Cells::Mixed))?;
        let model = &condense(&problem)?;
        for (pivots, sweeps) in
            [(None, 0), (None, 1), (None, 3), (Some(1), 0), (Some(2), 1), (Some(5), 2)]
        {
            let work = Work { pivots, sweeps };
            ticks::<f64>(&problem, model, work, ALLOWED)?;
            ticks::<f32>(&problem, model, work, ALLOWED_NARROW)?;
        }
    }
    Ok(())
}

#[test]
fn a_limit_below_the_flux_is_refused_and_nothing_changes() -> Result<()> {
    let (_, problem) = on_grid(&with_supply(), grid(4, Cells::Triangles))?;
    let model = condense(&problem)?;
    let baked = Baked::<f32>::new(&model, EXACT, true).expect("in range");
    let mut controller = Controller::new(&baked);
    let before = controller.tick(&[-3.0, 0.0, 0.5]).expect("a tick");
    let x = controller.x().to_vec();
    let refused = controller.tick(&[-3.0, 0.0, -1.0]).expect_err("−3 is below −1");
    assert!(matches!(refused, signorini_kernel::Error::EmptyRange { input: 2 }), "{refused}");
    assert_eq!(controller.x(), x);
    let again = controller.tick(&[-3.0, 0.0, 0.5]).expect("a tick");
    for (again, before) in again.0.iter().zip(&before.0) {
        LIMITED_TICK_NARROW.check("after what was refused", f64::from(again - before));
    }
    Ok(())
}

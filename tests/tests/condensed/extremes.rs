//! Any number of contact edges, inputs at their worst, very many ticks.

use signorini_bake::Bakes;
use signorini_bake::condensed::{Baked, Controller, Work};
use signorini_kernel::Error;
use signorini_kernel::error::Array;
use signorini_kernel::report::Ended;
use signorini_scene::mesh::structured::Cells;
use signorini_scene::mesh::{Curve, Mesh};
use signorini_tests::random::Random;
use signorini_tolerances::twins::{AFTER_HUGE, AGAIN, WORN};

use super::scenes::{EXACT, Model};
use crate::mesh::regular;

/// Held at the top; lift > 0 opens everything, lift < 0 closes it, tilt opens one side.
const PLATE: &str = r#"
mesh = "none.msh"
material.default.conductivity = "1"
boundary.top = { kind = "dirichlet", value = "0" }
boundary.default = { kind = "neumann", flux = "0" }
input.lift = { of = "source", field = "f", pattern = "1" }
input.tilt = { of = "source", field = "f", pattern = "x + 0.1*sin(9*x)" }
output.force = { kind = "force" }
output.top = { kind = "flux", of = "top" }
output.length = { kind = "length" }
output.bound = { kind = "bound" }
"#;

/// Contact alone holds it against a push from above.
const FLOATING: &str = r#"
mesh = "none.msh"
material.default.conductivity = "1"
boundary.contact = { kind = "contact" }
boundary.top = { kind = "neumann", flux = "0" }
boundary.default = { kind = "neumann", flux = "0" }
input.push = { of = "top", field = "flux", pattern = "-(2 + x)", default = 1.0 }
input.tilt = { of = "top", field = "flux", pattern = "sin(3*x)" }
output.force = { kind = "force" }
output.length = { kind = "length" }
output.bound = { kind = "bound" }
"#;

/// A grid with `contact` edges of the bottom under that name, the first ones.
fn with_contact(contact: usize) -> Mesh {
    let mut mesh = regular(17, Cells::Mixed);
    let place = mesh.curves.iter().position(|curve| curve.name == "contact").expect("a bottom");
    let rest = mesh.curves[place].edges.split_off(contact);
    mesh.curves.push(Curve { name: "rest".to_owned(), edges: rest });
    mesh
}

fn plate(contact: usize) -> Model {
    let boundary = "[boundary.contact]\nkind = \"contact\"\n";
    let text = if contact > 0 { PLATE.to_owned() + boundary } else { PLATE.to_owned() };
    let what = format!("{contact} edges");
    Model::of_text(what, &text, with_contact(contact)).expect("a model")
}

const WORKS: [Work; 4] = [
    EXACT,
    Work { pivots: Some(1), sweeps: 2 },
    Work { pivots: Some(0), sweeps: 0 },
    Work { pivots: None, sweeps: 3 },
];

fn no_nan<R: Bakes>(outputs: &[R]) -> bool {
    // The last one is the bound, which may be infinite.
    let [values @ .., bound] = outputs else { return false };
    values.iter().all(|value| value.finite()) && *bound >= R::ZERO
}

fn any_number_of_edges<R: Bakes>() {
    for contact in [0, 1, 2, 7, 8, 9, 16, 33] {
        let model = plate(contact);
        for work in WORKS {
            let baked: Baked<R> = model.baked(work);
            let mut controller = Controller::new(&baked);
            for (lift, tilt) in [(0.0, 0.0), (1e3, 0.0), (-1e3, 0.0), (0.0, 1e-3), (-0.0, 30.0)] {
                let what = format!("{contact} {work:?} {lift} {tilt}");
                let p = [lift, tilt].map(R::narrow);
                let (outputs, report) = controller.tick(&p).expect("a tick");
                assert!(no_nan(&outputs) && report.certificate().is_some(), "{what}: {outputs:?}");
                if work == EXACT {
                    assert_eq!(report.ended, Ended::Exact, "{what}");
                    let touching = report.active as usize;
                    assert!(lift <= 0.0 || touching == 0, "{what}: {touching}");
                    assert!(lift >= 0.0 || touching == contact, "{what}: {touching}");
                }
                let before = (controller.x().to_vec(), outputs.clone());
                for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    // p_0 is the constant 1.
                    let refused = |j: usize| Some(Error::NotFinite { of: Array::Load, at: 1 + j });
                    let wrong = R::narrow(wrong);
                    assert_eq!(controller.tick(&[wrong, R::ZERO]).err(), refused(0));
                    assert_eq!(controller.tick(&[R::ZERO, wrong]).err(), refused(1));
                }
                assert_eq!(controller.x(), before.0, "{what}");
                if work == EXACT {
                    let (again, _) = controller.tick(&p).expect("a tick");
                    let epsilon = R::EPSILON.wide() / f64::EPSILON * (lift.abs() + tilt.abs());
                    for (again, before) in again.iter().zip(&before.1) {
                        AGAIN.check_over(&what, (*again - *before).wide(), epsilon);
                    }
                }
            }
        }
    }
}

#[test]
fn any_number_of_edges_lifted_or_pressed() {
    any_number_of_edges::<f32>();
    any_number_of_edges::<f64>();
}

/// An overflow is an error or a number, never NaN, and the next tick knows nothing of it.
#[test]
fn inputs_at_the_end_of_the_range() {
    for work in WORKS {
        let model = plate(9);
        let baked: Baked<f32> = model.baked(work);
        let (mut controller, mut fresh) = (Controller::new(&baked), Controller::new(&baked));
        for huge in [f32::MAX, -f32::MAX, 1e38, -1e38, 1e30, 1e20, -1e20, 1e-38, 1e-45] {
            for p in [[huge, huge], [huge, -huge], [0.0, huge], [huge, 0.0]] {
                if let Ok((outputs, _)) = controller.tick(&p) {
                    assert!(no_nan(&outputs), "{work:?} {p:?}: {outputs:?}");
                }
            }
        }
        for _ in 0..300 {
            controller.tick(&[1.0, 3.0]).expect("a tick");
            fresh.tick(&[1.0, 3.0]).expect("a tick");
        }
        for (x, fresh) in controller.x().iter().zip(fresh.x()) {
            AFTER_HUGE.check_over(format_args!("{work:?}"), x - fresh, 1.0 + fresh);
        }
    }
}

/// The error of f32 does not grow over many ticks.
#[test]
fn ten_thousand_ticks() {
    let model = plate(33);
    let (narrow, wide): (Baked<f32>, Baked<f64>) = (model.baked(EXACT), model.baked(EXACT));
    let (mut narrow, mut wide) = (Controller::new(&narrow), Controller::new(&wide));
    let random = &mut Random::new(3);
    let mut worst = [0.0_f64; 10];
    let mut unfinished = 0;
    for tick in 0..10_000_u32 {
        let lift = random.between(-3.0, 3.0) as f32;
        let tilt = if tick % 3 == 0 { 20.0 } else { random.between(-30.0, 30.0) as f32 };
        let (found, report) = narrow.tick(&[lift, tilt]).expect("a tick");
        let (expected, _) = wide.tick(&[f64::from(lift), f64::from(tilt)]).expect("a tick");
        unfinished += u32::from(report.ended != Ended::Exact);
        let size = f64::from(lift.abs() + tilt.abs());
        let off = (0..2).map(|at| (f64::from(found[at]) - expected[at]).abs() / size);
        let place = &mut worst[tick as usize / 1000];
        *place = off.fold(*place, f64::max);
    }
    worst.into_iter().for_each(|worst| WORN.check("a thousand ticks", worst));
    assert!(unfinished <= 10, "{unfinished}");
}

fn pulled_off<R: Bakes>() {
    let text = FLOATING;
    let model = Model::of_text("floating".to_owned(), text, with_contact(16)).expect("a model");
    for work in WORKS {
        let baked: Baked<R> = model.baked(work);
        let mut controller = Controller::new(&baked);
        for round in 0..50 {
            for (push, tilt) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 0.0), (-1e3, 5.0), (1.0, 2.0)] {
                let found = controller.tick(&[R::narrow(push), R::narrow(tilt)]);
                let what = format!("{work:?} {round} {push}: {found:?}");
                match found {
                    Ok((outputs, _)) => assert!(push > 0.0 && no_nan(&outputs), "{what}"),
                    Err(Error::NotUnique { .. }) => assert!(push == 0.0, "{what}"),
                    Err(error) => {
                        let is_off = matches!(error, Error::NoSolution { .. });
                        assert!(is_off && push < 0.0, "{what}");
                    }
                }
            }
        }
        if work == EXACT {
            let (outputs, report) = controller.tick(&[R::ONE, R::ZERO]).expect("a tick");
            assert!(report.certificate().is_some(), "{report:?} {outputs:?}");
        }
    }
}

#[test]
fn pulled_off_what_holds_it() {
    pulled_off::<f64>();
    pulled_off::<f32>();
}

//! Any number of contact edges, all open or all closed.

use signorini_bake::Bakes;
use signorini_bake::condensed::{Baked, Controller, Work};
use signorini_kernel::Error;
use signorini_kernel::error::Array;
use signorini_kernel::report::Ended;
use signorini_scene::mesh::structured::Cells;
use signorini_scene::mesh::{Curve, Mesh};
use signorini_tolerances::twins::AGAIN;

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

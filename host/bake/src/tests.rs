//! Generated text beside the controller on this machine: the same bits, tick after tick; and standard scenes. Below
//! it controllers beside solves of the same scenes.

mod condensed_bound;
mod condensed_length;
mod condensed_limits;
mod crossed_ends;
pub mod direct;
mod excluded;
mod limit_inputs;
mod means;
mod plus_minus;
mod promise;
pub mod transfer;
mod unsolvable;
mod warm_inputs;

use std::path::Path;

use crate::compiled::printed;
use crate::narrow::narrow;
use crate::{Bakes, condensed};
use signorini_condense::condense;
use signorini_kernel::Error;
use signorini_problem::Problem;
use signorini_problem::fixtures::changed;
use signorini_problem::scalar::Scalar;
use signorini_scene::mesh::adapted;
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;

/// A standard scene, changed by `change`.
pub fn standard(name: &str, change: impl FnOnce(&mut Scene)) -> Problem {
    of_file(&format!("scenes/{name}"), ("", &[]), change)
}

/// A scene below `meshes` with `more` at its end and other text here and there, changed by `change`.
pub fn of_file(
    name: &str,
    (more, changes): (&str, &[(&str, &str)]),
    change: impl FnOnce(&mut Scene),
) -> Problem {
    let path = format!("../../meshes/{name}.toml");
    let text = std::fs::read_to_string(&path).expect("a scene") + more;
    let scene = Scene::parse(&changed(&text, changes), Path::new(&path));
    let mut scene = scene.expect("a sound scene");
    change(&mut scene);
    let mesh = adapted::of_scene(&scene).expect("its mesh");
    Problem::new(&scene, mesh).expect("a sound problem")
}

/// The condensed model of a problem, whose exchanges come to an end.
pub fn exact<R: Bakes>(problem: &Problem) -> signorini_scene::error::Result<condensed::Baked<R>> {
    let work = condensed::Work { pivots: Some(1000), sweeps: 100 };
    Ok(condensed::Baked::new(&condense(problem)?, work, true).expect("in range"))
}

/// Units that are powers of 2.
pub fn powers(u: i32, conductivity: i32) -> Units {
    Units { u: 2f64.powi(u), conductivity: 2f64.powi(conductivity), zero: 0.0 }
}

/// A firmware that knows nothing of the model: all that every module offers, by the same names. It prints whether a
/// tick after a reset is the first again, whether there is a bound, and how a tick ends for which there is no time.
pub const FIRMWARE: &str = "
fn main() {
    use signorini_device::kernel::report::{Ended, Report};
    let mut controller = Box::new(Controller::new());
    let first: Answer = controller.tick(Inputs::DEFAULT).unwrap();
    let report: Report<Scalar> = first.report;
    let limits = Limits { sweeps: 3, ..LIMITS };
    let other = || Inputs::from_array(Inputs::DEFAULT.to_array().map(|value| 7.0 - value));
    let deadline = &mut Deadline { remaining: || 0, sweep: 1, certificate: 1 };
    let late = controller.tick_within(other(), limits, deadline).unwrap().report;
    let cut = controller.tick_within(other(), limits, &mut Deadline::never()).unwrap().report;
    controller.reset();
    let again = controller.tick_within(Inputs::DEFAULT, LIMITS, &mut Deadline::never()).unwrap();
    let whole = |report: &Report<Scalar>| report.sweeps <= 3 || report.ended != Ended::OutOfSweeps;
    let bounds = [report, late, cut].map(|report| report.certificate().is_some());
    println!(\"{} {:?} {:?} {}\", again == first, bounds, late.ended, whole(&cut));
}
";

/// Prints the default inputs, then of each line of a log the outputs of a tick. What is printed of a number is its
/// bits: the shortest text that reads back the same.
fn main(log: &[Vec<f64>]) -> String {
    let ticks = log.len();
    format!(
        "
fn main() {{
    static CONTROLLER: std::sync::Mutex<Controller> = std::sync::Mutex::new(Controller::new());
    let mut controller = CONTROLLER.lock().unwrap();
    println!(\"{{:?}}\", Inputs::DEFAULT.to_array());
    let log: [[f64; INPUTS]; {ticks}] = {log:?};
    for inputs in log {{
        let inputs = Inputs::from_array(inputs.map(|x| x as Scalar));
        println!(\"{{:?}}\", controller.tick(inputs).map(|answer| answer.outputs.to_array()));
    }}
}}
"
    )
}

/// Compares what a module prints of a log with what `tick` answers; the lines of the ticks.
pub fn same_bits<R: Scalar>(
    problem: &Problem,
    module: String,
    log: &[Vec<f64>],
    mut tick: impl FnMut(&[R]) -> Result<Vec<R>, Error>,
) -> Vec<String> {
    let defaults: Vec<_> = problem.scene.inputs.iter().map(|input| input.default).collect();
    let lines = log.iter().map(|inputs| format!("{:?}\n", tick(&narrow(inputs))));
    let lines: Vec<_> = lines.collect();
    let expected = format!("{:?}\n{}", narrow::<R>(&defaults), lines.concat());
    assert_eq!(printed(&(module + &main(log))), expected);
    lines
}

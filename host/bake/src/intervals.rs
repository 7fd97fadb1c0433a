//! What the error bound of a tick weighs in each output: numbers that the host finds once, and a module has as constants.

use std::fmt::Write as _;

use signorini_device::intervals::OutputWeights;

use crate::choice::{Choice, Origin};
use crate::text::{code, prose};
use signorini_intervals::weights::{Answers, Weighed, Weights, weights};
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_problem::scalar::Scalar;
use signorini_solve::{Options, solve};

/// By which part weights are rounded up: more than what a scalar rounds of them and of their products.
const ROOM: f64 = 1e-6;

/// Those of the outputs of a chosen model, in their order.
pub fn of_choice<R: Scalar>(problem: &Problem, choice: &Choice<R>) -> Vec<Weighed> {
    let origin = choice.condensed().map(|(_, origin)| origin);
    let open = origin.map(|origin| open(problem, origin)).unwrap_or_default();
    // Where an edge is open, the total tells how far z is best off its value.
    let total = match open.iter().any(Option::is_some) {
        true => solve(problem, &Options::default()).ok().and_then(|solution| solution.bound),
        false => None,
    };
    let total = total.map_or(0.0, |bound| bound.total);
    weights(problem, &Answers { open: &open, total, are_balanced: origin.is_some() })
}

/// How far s is above ψ on the contact edges whose reaction is 0 in every tick.
fn open(problem: &Problem, origin: &Origin) -> Vec<Option<[f64; 2]>> {
    let Some(reduced) = &origin.reduced else { return Vec::new() };
    let flags: Vec<f64> =
        reduced.open().into_iter().map(|open| f64::from(u8::from(open))).collect();
    let free = problem.topology.counts.free;
    // s has no bubble on a contact edge of a condensed model: it is linear there.
    let clear = |vertex: u32| origin.clear.get(&vertex).copied().unwrap_or(0.0);
    let flags = origin.whole.by_edge(&flags).into_iter().enumerate();
    flags.map(|(at, flag)| (flag == 1.0).then(|| problem.ends[free + at].map(clear))).collect()
}

/// In the scalar of a controller.
pub fn narrowed<R: Scalar>(weighed: &Weighed) -> OutputWeights<R> {
    let narrow = |x: f64| R::narrow(x * (1.0 + ROOM));
    weighed.as_ref().map_or(OutputWeights::NONE, |&Weights { total, square, algebraic, of_u }| {
        let [total, square, algebraic, of_u] = [total, square, algebraic, of_u].map(narrow);
        OutputWeights { total, square, algebraic, of_u }
    })
}

/// The weights as a constant of a module, and what reads it.
pub fn constants<R: Scalar>(problem: &Problem, weighed: &[Weighed]) -> String {
    let mut text = "
/// How much of the error bound may be in each output: see [`Answer::plus_minus`].
pub const OUTPUT_WEIGHTS: [signorini_device::intervals::OutputWeights<Scalar>; OUTPUTS] = ["
        .to_owned();
    for (output, weighed) in wanted(&problem.scene).iter().zip(weighed) {
        let why = weighed
            .as_ref()
            .err()
            .map_or_else(String::new, |why| format!(": none, {}", prose(why)));
        let _ = write!(
            text,
            "\n    // {}{why}\n    {},",
            code(&output.name.value),
            record(&narrowed::<R>(weighed))
        );
    }
    text + if weighed.is_empty() { "];\n" } else { "\n];\n" } + PLUS_MINUS
}

fn record<R: Scalar>(of: &OutputWeights<R>) -> String {
    match of.total == R::INFINITY {
        true => "signorini_device::intervals::OutputWeights::NONE".to_owned(),
        false => format!("signorini_device::intervals::{of:?}"),
    }
}

const PLUS_MINUS: &str = "
impl controller::Weighed<Scalar> for Outputs {
    #[inline(always)]
    fn plus_minus(report: &Report<Scalar>) -> Self {
        let weights = &OUTPUT_WEIGHTS;
        Outputs::from_array(signorini_device::intervals::plus_minus(weights, report))
    }
}
";

//! What the error bound of a tick weighs in each output: numbers that the host finds once, and a module has as constants.

use std::fmt::Write as _;

use signorini_device::intervals::{self as device, OutputWeights};

use crate::Bakes;
use crate::choice::{Choice, Origin};
use crate::condensed::unit_of_amplitudes;
use crate::text::{code, prose};
use signorini_certify::Column;
use signorini_certify::term::corners;
use signorini_intervals::known::Answers;
use signorini_intervals::midpoints::{Midpoint, of_controller};
use signorini_intervals::weights::{Weighed, Weights, weights};
use signorini_problem::functional::wanted;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Parts, Problem, State};
use signorini_scene::error::Result;
use signorini_scene::scene::{Field, Scene};
use signorini_solve::{Options, solve};

/// By which part weights are rounded up: more than what a scalar rounds of them and of their products.
const ROOM: f64 = 1e-6;

/// Roundings of its scalar that a controller's s and τ may be off, next to the total.
const ROUNDINGS: f64 = 512.0;

/// What a module knows of its outputs' intervals, in their order.
#[derive(Debug, Clone)]
pub struct OutputIntervals {
    /// Weights of its bound in each.
    pub weighed: Vec<Weighed>,
    /// What s and τ of a tick tell beside, in the columns of the model that is baked.
    pub midpoints: Vec<Option<Midpoint>>,
}

pub(crate) fn guaranteed<R: Bakes>(problem: &Problem, choice: &Choice<R>) -> OutputIntervals {
    let origin = choice.condensed().map(|(_, origin)| origin);
    if let Some(step) = problem.scene.step() {
        return of_steps(problem, step, origin.is_some());
    }
    let open = origin.map(|origin| open(problem, origin)).unwrap_or_default();
    let pressed = origin.map(pressed).unwrap_or_default();
    // Where there are none, weights say what is known.
    let columns =
        origin.map_or_else(Vec::new, |origin| columns(problem, origin).unwrap_or_default());
    // Where an edge is open, the total tells how far z is best off its value.
    let total = match open.iter().any(Option::is_some) || !columns.is_empty() {
        true => solve(problem, &Options::default()).ok().and_then(|solution| solution.bound),
        false => None,
    };
    let total = total.map_or(0.0, |bound| bound.total);
    let answers = Answers {
        open: &open,
        pressed: &pressed,
        columns: &columns,
        total,
        are_balanced: origin.is_some(),
    };
    let (weighed, midpoints) = of_controller(problem, &answers);
    let in_model = |of: Option<Midpoint>| of.zip(origin).map(|(of, origin)| baked(origin, of));
    let midpoints = midpoints.into_iter().map(in_model).collect();
    OutputIntervals { weighed, midpoints }
}

/// Intervals of steps of this length: what a tick tells of its own s and τ is not known of them.
fn of_steps(problem: &Problem, step: f64, are_balanced: bool) -> OutputIntervals {
    let answers = Answers { are_balanced, ..Answers::default() };
    let none = |why: String| vec![Err(why); wanted(&problem.scene).len()];
    let is_held = |parts: Parts| parts.counts.contact == 0 && parts.counts.floating == 0;
    let weighed = if !Parts::whatever_inputs(problem).is_ok_and(is_held) {
        // What cells that store nothing lack of balance may leave through contact edges, in τ alone.
        none("neither a given u nor a transfer law holds some part of the domain".to_owned())
    } else {
        let stepping = problem.stepping(step, State::zero(problem));
        stepping.map_or_else(|error| none(error.reason()), |of| weights(&of, &answers))
    };
    OutputIntervals { midpoints: vec![None; weighed.len()], weighed }
}

/// The columns of a model that has a bound, with its transfer coefficients at both ends of their range where an input changes them.
fn columns(problem: &Problem, origin: &Origin) -> Result<Vec<Vec<Column>>> {
    let of_corner = |scene: Scene| origin.recovery.columns(&problem.with_loads_of(scene)?);
    match origin.recovered().certificate {
        Ok(_) => corners(&problem.scene).map(of_corner).collect(),
        Err(_) => Ok(Vec::new()),
    }
}

/// In the columns of the model that is baked, whose unit of energy is not 1.
fn baked(origin: &Origin, of: Midpoint) -> Midpoint {
    let Origin { whole, reduced, modes, .. } = origin;
    let given = modes.as_ref().map_or(whole.inputs, |modes| modes.inputs);
    let of_amplitudes = modes.as_ref().map_or(1.0, unit_of_amplitudes);
    let unit = |j: usize| match j {
        j if j < given => 1.0,
        j if j < whole.inputs => of_amplitudes,
        _ => whole.energy_unit,
    };
    let columns = of.columns.map(|columns| {
        let columns = columns.into_iter().enumerate();
        let columns: Vec<_> = columns.map(|(j, of)| of.map(|x| x * unit(j))).collect();
        match reduced {
            Some(reduced) if !columns.is_empty() => reduced.combined(whole, &columns),
            _ => columns,
        }
    });
    Midpoint { columns, ..of }
}

/// What presses the contact edges that touch in every tick.
fn pressed(origin: &Origin) -> Vec<f64> {
    let Some(reduced) = &origin.reduced else { return Vec::new() };
    origin.whole.by_edge(&reduced.pressed(&origin.whole))
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

/// A midpoint in the scalar of a controller.
#[derive(Debug, Clone)]
pub struct NarrowMidpoint<R: Scalar> {
    columns: [Vec<[R; 2]>; 2],
    /// Its columns stand beside it.
    of: device::Midpoint<'static, R>,
}

impl<R: Scalar> NarrowMidpoint<R> {
    /// The midpoint of an output of `scene`; nothing where a number is beyond the scalar.
    pub fn new(scene: &Scene, of: &Midpoint) -> Option<Self> {
        let changed = scene.inputs.iter().position(|of| of.field.value == Field::Coefficient);
        let [least, greatest] = changed.map_or([0.0; 2], |at| scene.inputs[at].interval());
        let over_length = if greatest > least { 1.0 / (greatest - least) } else { 0.0 };
        // What rounding of factors, of products and of the share of a range may do.
        let of_range =
            if changed.is_some() { 4.0 * (1.0 + least.abs() * over_length) } else { 0.0 };
        let share = (2.0 + of_range) * R::EPSILON.wide();
        let column = |[factor, off]: &[f64; 2]| {
            let off = (off + share * factor.abs()) * (1.0 + ROOM) + R::TINY.wide();
            [R::narrow(*factor), R::narrow(off)]
        };
        let columns = of.columns.each_ref().map(|of| of.iter().map(column).collect::<Vec<_>>());
        let more = |x: f64| R::narrow(x * (1.0 + ROOM));
        let Midpoint { apart, part, sizes, loads, distance, least: law, .. } = *of;
        let own = device::Midpoint {
            columns: [&[]; 2],
            input: changed.map_or(0, |at| at + 1),
            range: [least, over_length].map(R::narrow),
            apart: more(apart),
            part: part.map(more),
            sizes: more(sizes),
            loads: more(loads + ROUNDINGS * R::EPSILON.wide() * sizes),
            distance: R::narrow(distance * (1.0 - ROOM)),
            least: if law.is_finite() { R::narrow(law) } else { R::NEG_INFINITY },
        };
        let numbers = columns.iter().flatten().flatten();
        let numbers = numbers.chain([&own.apart, &own.sizes, &own.loads]).chain(&own.part);
        let is_known = numbers.chain(&own.range).all(|number| number.finite());
        is_known.then_some(Self { columns, of: own })
    }

    /// As a controller has it.
    pub fn view(&self) -> device::Midpoint<'_, R> {
        device::Midpoint { columns: self.columns.each_ref().map(Vec::as_slice), ..self.of }
    }

    fn record(&self) -> String {
        let device::Midpoint { input, range, apart, part, sizes, loads, distance, least, .. } =
            self.of;
        let [first, second] = &self.columns;
        let least =
            if least.finite() { format!("{least:?}") } else { "Scalar::NEG_INFINITY".to_owned() };
        format!(
            "signorini_device::intervals::Midpoint {{ columns: [&{first:?}, &{second:?}], input: {input}, range: {range:?}, \
             apart: {apart:?}, part: {part:?}, sizes: {sizes:?}, loads: {loads:?}, distance: {distance:?}, least: {least} }}"
        )
    }
}

/// Weights and midpoints as constants of a module, and what reads them.
pub fn constants<R: Scalar>(problem: &Problem, of: &OutputIntervals) -> String {
    let outputs = wanted(&problem.scene);
    let mut text = "
/// How much of the error bound may be in each output: see [`Answer::plus_minus`].
pub const OUTPUT_WEIGHTS: [signorini_device::intervals::OutputWeights<Scalar>; OUTPUTS] = ["
        .to_owned();
    for (output, weighed) in outputs.iter().zip(&of.weighed) {
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
    let end = if outputs.is_empty() { "];\n" } else { "\n];\n" };
    text += end;
    text += "
/// Where each output lies by a tick's own numbers: see [`Controller::between`].
pub const OUTPUT_MIDPOINTS: [signorini_device::intervals::Midpoint<'static, Scalar>; OUTPUTS] = [";
    for (output, midpoint) in outputs.iter().zip(&of.midpoints) {
        let midpoint = midpoint_record::<R>(&problem.scene, midpoint.as_ref());
        let _ = write!(text, "\n    // {}\n    {midpoint},", code(&output.name.value));
    }
    text + end + READ
}

fn midpoint_record<R: Scalar>(scene: &Scene, of: Option<&Midpoint>) -> String {
    let narrow = of.and_then(|of| NarrowMidpoint::<R>::new(scene, of));
    let none = || "signorini_device::intervals::Midpoint::NONE".to_owned();
    narrow.map_or_else(none, |of| of.record())
}

fn record<R: Scalar>(of: &OutputWeights<R>) -> String {
    match of.total == R::INFINITY {
        true => "signorini_device::intervals::OutputWeights::NONE".to_owned(),
        false => format!("signorini_device::intervals::{of:?}"),
    }
}

const READ: &str = "
impl controller::Weighed<Scalar> for Outputs {
    #[inline(always)]
    fn plus_minus(report: &Report<Scalar>) -> Self {
        let weights = &OUTPUT_WEIGHTS;
        Outputs::from_array(signorini_device::intervals::plus_minus(weights, report))
    }
}

impl controller::Located<Scalar> for Outputs {
    fn between(&self, combination: &[Scalar], report: &Report<Scalar>) -> [Self; 2] {
        let known = (&OUTPUT_MIDPOINTS, &OUTPUT_WEIGHTS);
        let values = &self.to_array();
        let ends = signorini_device::intervals::between(known, values, combination, report);
        ends.map(Outputs::from_array)
    }
}
";

//! Whether the controller keeps a promised error: its own bound, in its scalar, for the inputs that the mesh was refined for.
//!
//! A mesh is refined by solves in f64. What a tick rounds, its setting leaves to sweeps, or a condensed model leaves out, comes on top.

use signorini_kernel::discrete::rows::{QUADS, TRIANGLES};

use crate::choice::{Choice, Model};
use crate::{condensed, full};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_solve::adaptive::{Allowed, Promise};
use signorini_solve::scalar::Scalar;

/// Updates of unknowns after which the ticks of a full model end.
const UPDATES: f64 = 1e9;

/// The input at which a tick's bound is largest, over what it may be.
#[derive(Debug, Clone, Copy)]
struct Worst<'a> {
    allowed: &'a Allowed,
    bound: f64,
}

impl Worst<'_> {
    fn ratio(&self) -> f64 {
        self.bound / self.allowed.bound
    }
}

/// Refuses a controller whose bound exceeds `promise` for any of the inputs that it was made for; a model without a bound has none
/// to keep.
///
/// # Errors
/// The bound that it has instead, with the inputs.
pub fn check<R: Scalar>(scene: &Scene, choice: &Choice<R>, promise: &Promise) -> Result<()> {
    let worst = match &choice.candidates[choice.chosen].model {
        Model::Condensed(baked) => of_condensed(baked, &promise.allowed),
        Model::Full(baked) if baked.has_quads() => of_full::<R, QUADS>(baked, &promise.allowed),
        Model::Full(baked) => of_full::<R, TRIANGLES>(baked, &promise.allowed),
    };
    let Some(worst) = worst.filter(|worst| worst.ratio() > 1.0) else { return Ok(()) };
    let values = scene.inputs.iter().zip(&worst.allowed.inputs);
    let with: String =
        values.map(|(input, value)| format!(", {} = {value}", input.name.value)).collect();
    let Worst { bound, allowed } = worst;
    let message = format!(
        "setting.error = {:?}{with}: the error bound of a tick in {} is {bound:.3e}, {:.3e} are allowed; that of the mesh of {} unknowns is \
         small enough, and rounding, unfinished sweeps or what the model leaves out add too much",
        promise.goal.to_string(),
        R::NAME,
        allowed.bound,
        promise.unknowns,
    );
    let hint = "take model = \"full\" or scalar = \"f64\" in [setting], or ask for a smaller error, whose mesh is finer";
    Err(InputError::new(message).file(scene.file()).hint(hint).into())
}

fn of_condensed<'a, R: Scalar>(
    baked: &condensed::Baked<R>,
    all: &'a [Allowed],
) -> Option<Worst<'a>> {
    let mut controller = condensed::Controller::new(baked);
    worst(all, |inputs| Some(controller.tick(inputs).ok()?.1.certificate()?.total.wide()))
}

fn of_full<'a, R: Scalar, const WIDTH: usize>(
    baked: &full::Baked<R>,
    all: &'a [Allowed],
) -> Option<Worst<'a>> {
    let mut controller = full::Controller::<R, WIDTH>::new(baked);
    let mut updates = 0.0;
    worst(all, |inputs| {
        if updates > UPDATES {
            return None;
        }
        let (_, report) = controller.tick(inputs).ok()?;
        updates += f64::from(report.sweeps) * baked.unknowns() as f64;
        Some(report.verdict.certificate()?.total.wide())
    })
}

/// The largest of the bounds that ticks with all of these inputs have, one after the other.
fn worst<R: Scalar>(
    all: &[Allowed],
    mut tick: impl FnMut(&[R]) -> Option<f64>,
) -> Option<Worst<'_>> {
    let of_tick = |allowed: &'_ Allowed| {
        let inputs: Vec<R> = allowed.inputs.iter().map(|&input| R::narrow(input)).collect();
        tick(&inputs)
    };
    let bounds: Vec<_> = all.iter().map(of_tick).collect();
    let found = all.iter().zip(bounds);
    let found = found.filter_map(|(allowed, bound)| Some(Worst { allowed, bound: bound? }));
    found.max_by(|a, b| a.ratio().total_cmp(&b.ratio()))
}

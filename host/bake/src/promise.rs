//! Whether the controller keeps a promised error: its own bound, in its scalar, for the inputs that the mesh was refined for.
//!
//! A mesh is refined by solves in f64. What a tick rounds, its setting leaves to sweeps, or a condensed model leaves out, comes on top.

use crate::choice::{Choice, Model, Wanted};
use crate::narrow::narrow;
use crate::{Bakes, condensed, full};
use signorini_kernel::Verdict;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::ModelKind;
use signorini_solve::adaptive::{Allowed, Promise};

/// Updates of unknowns after which the ticks of a full model end.
const UPDATES: f64 = 1e9;

/// A tick with some inputs, and its bound; infinite where it has none.
#[derive(Debug, Clone, Copy)]
struct Tick<'a> {
    allowed: &'a Allowed,
    bound: f64,
}

impl Tick<'_> {
    /// The bound over what it may be; 0 where it is 0.
    fn ratio(&self) -> f64 {
        if self.bound == 0.0 { 0.0 } else { self.bound / self.allowed.bound }
    }
}

pub(crate) fn keep<R: Bakes>(
    problem: &Problem,
    wanted: Wanted,
    promise: &Promise,
) -> Result<(Choice<R>, usize)> {
    let choice = Choice::<R>::new(problem, wanted)?;
    let error = match check(&problem.scene, &choice, promise) {
        Ok(ticked) => return Ok((choice, ticked)),
        Err(error) => error,
    };
    let is_asked_for =
        wanted.model.or(problem.scene.setting.and_then(|setting| setting.model_kind()));
    if is_asked_for.is_some() || choice.condensed().is_none() {
        return Err(error);
    }
    let full = Wanted { model: Some(ModelKind::Full), ..wanted };
    let Ok(mut full) = Choice::<R>::new(problem, full) else { return Err(error) };
    let Ok(ticked) = check(&problem.scene, &full, promise) else { return Err(error) };
    full.excluded.push(format!("condensed: {error}"));
    Ok((full, ticked))
}

/// Refuses a controller whose bound exceeds `promise` for any of the inputs that it was made for, or that has none there; without
/// `certificate` it promises nothing. How many inputs it was ticked with: those that a full model has the time for.
///
/// # Errors
/// The bound that it has instead, with the inputs.
pub fn check<R: Bakes>(scene: &Scene, choice: &Choice<R>, promise: &Promise) -> Result<usize> {
    // The mesh is that of the steady state, and bounds of steps are others.
    if scene.setting.is_some_and(|setting| !setting.certificate) || scene.stores() {
        return Ok(0);
    }
    let ticks = ticked(&choice.candidate().model, &promise.allowed);
    let worst = ticks.iter().max_by(|a, b| a.ratio().total_cmp(&b.ratio()));
    match worst.filter(|worst| worst.ratio() > 1.0) {
        None => Ok(ticks.len()),
        Some(worst) => Err(not_kept::<R>(scene, promise, worst).into()),
    }
}

fn not_kept<R: Scalar>(scene: &Scene, promise: &Promise, worst: &Tick) -> InputError {
    let Tick { bound, allowed } = worst;
    let values = scene.inputs.iter().zip(&allowed.inputs);
    let with: String =
        values.map(|(input, value)| format!(", {} = {value}", input.name.value)).collect();
    let has = match bound.is_finite() {
        true => format!("the error bound of a tick in {} is {bound:.3e}", R::NAME),
        false => format!("a tick in {} has no error bound", R::NAME),
    };
    let message = format!(
        "setting.error = {:?}{with}: {has}, {:.3e} are allowed; that of the mesh of {} unknowns is small enough, and rounding, \
         unfinished sweeps or what the model leaves out add too much",
        promise.goal.to_string(),
        allowed.bound,
        promise.unknowns,
    );
    let hint = "take model = \"full\" or scalar = \"f64\" in [setting], or ask for a smaller error, whose mesh is finer";
    InputError::new(message).file(scene.file()).hint(hint)
}

/// The ticks of a model with all of these inputs, one after the other.
fn ticked<'a, R: Bakes>(model: &Model<R>, all: &'a [Allowed]) -> Vec<Tick<'a>> {
    match model {
        Model::Condensed(baked) => {
            let mut controller = condensed::Controller::new(baked);
            ticks(all, |inputs| {
                let (_, report) = controller.tick(inputs).ok()?;
                Some((report.verdict, 0.0))
            })
        }
        Model::Full(baked) => {
            let mut controller = full::Controller::new(baked);
            ticks(all, |inputs| {
                let (_, report) = controller.tick(inputs).ok()?;
                Some((report.verdict, f64::from(report.sweeps) * baked.unknowns() as f64))
            })
        }
    }
}

/// Ticks with these inputs, each a verdict and updates of unknowns, as long as there are no more than [`UPDATES`] of them.
fn ticks<'a, R: Scalar>(
    all: &'a [Allowed],
    mut tick: impl FnMut(&[R]) -> Option<(Verdict<R>, f64)>,
) -> Vec<Tick<'a>> {
    let mut updates = 0.0;
    let each = all.iter().map_while(|allowed| {
        let ticked = tick(&narrow(&allowed.inputs));
        updates += ticked.as_ref().map_or(0.0, |(_, updates)| *updates);
        let total = ticked.as_ref().and_then(|(verdict, _)| Some(verdict.certificate()?.total));
        let bound = total.map_or(f64::INFINITY, R::wide);
        (updates <= UPDATES).then_some(Tick { allowed, bound })
    });
    each.collect()
}

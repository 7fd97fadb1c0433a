//! The controller that `bake` would write, on this machine.

use signorini_bake::choice::{Choice, Model, Wanted};
use signorini_bake::intervals::{NarrowMidpoint, OutputIntervals, narrowed};
use signorini_bake::{Bakes, setting};
use signorini_certify::ErrorBound;
use signorini_kernel::verdict::Certificate;
use signorini_problem::Problem;
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::setting::ModelKind;
use signorini_solve::ScalarKind;

use crate::condensed::Condensed;
use crate::full::with_full;
use crate::{Session, Then};

/// How far each output may be off where answers have such a bound.
type PlusMinus = Box<dyn Fn(&ErrorBound) -> Vec<f64>>;

/// Facts about a module beside its answers.
pub struct Module {
    /// Its model, solver and scalar in a few words.
    pub name: String,
    plus_minus: PlusMinus,
    /// Why outputs have no weights.
    reasons: Vec<Option<String>>,
}

impl Module {
    /// Where each output lies in the last tick of `session`, as `Controller::between` says it; where nothing is guaranteed, why.
    pub fn between(
        &self,
        session: &dyn Session,
        outputs: &[f64],
        bound: Option<&ErrorBound>,
    ) -> Vec<std::result::Result<[f64; 2], String>> {
        let mut known = session.between();
        known.resize(outputs.len(), None);
        let around = outputs.iter().zip(self.plus_minus(bound)).zip(known);
        let ends = |((value, by), known): ((&f64, std::result::Result<f64, String>), _)| match known
        {
            Some(ends) => Ok(ends),
            None => by.map(|by| [value - by, value + by]),
        };
        around.map(ends).collect()
    }

    /// How far each output may be off, as `Answer::plus_minus` says it; where nothing is guaranteed, why.
    pub fn plus_minus(&self, bound: Option<&ErrorBound>) -> Vec<std::result::Result<f64, String>> {
        let Some(bound) = bound else {
            return vec![Err("the tick has no error bound".to_owned()); self.reasons.len()];
        };
        let said = |(by, reason): (f64, &Option<String>)| match reason {
            Some(reason) => Err(reason.clone()),
            None if by.is_finite() => Ok(by),
            None => {
                Err("the tick was cut off so early that nothing is known of its fluxes".to_owned())
            }
        };
        (self.plus_minus)(bound).into_iter().zip(&self.reasons).map(said).collect()
    }
}

/// Calls `then` with a session of the module that `bake` writes for `problem`, and what is known of the module: model, solver and
/// scalar are chosen as there, `asked` being the scalar of the command line.
///
/// # Errors
/// Those of `bake`: no model that represents the scene or fits its target.
pub fn with_module<T>(
    problem: &Problem,
    asked: Option<ScalarKind>,
    then: impl FnOnce(&mut dyn Session, &Module) -> Result<T>,
) -> Result<T> {
    let (mut then, mut found) = (Some(then), None);
    lend_module(problem, asked, &mut |session, module| {
        found = then.take().map(|then| then(session, module)).transpose()?;
        Ok(())
    })?;
    found.ok_or_else(unlent)
}

/// A session without an answer.
pub(crate) fn unlent() -> Error {
    Error::Check("nobody asked the session".to_owned())
}

/// Lends the session of a module, once. Both scalars are compiled here, and not wherever one is asked for.
fn lend_module(
    problem: &Problem,
    asked: Option<ScalarKind>,
    then: &mut dyn FnMut(&mut dyn Session, &Module) -> Result<()>,
) -> Result<()> {
    match setting::scalar(&problem.scene, asked)? {
        ScalarKind::F32 => in_scalar::<f32>(problem, then),
        ScalarKind::F64 => in_scalar::<f64>(problem, then),
    }
}

fn in_scalar<R: Bakes>(
    problem: &Problem,
    then: &mut dyn FnMut(&mut dyn Session, &Module) -> Result<()>,
) -> Result<()> {
    let choice = Choice::<R>::new(problem, Wanted::default())?;
    let OutputIntervals { weighed, midpoints } = R::intervals(problem, &choice);
    let reasons = weighed.iter().map(|of| of.as_ref().err().cloned()).collect();
    let weights: Vec<_> = weighed.iter().map(narrowed::<R>).collect();
    let plus_minus = move |bound: &ErrorBound| {
        let certificate = Certificate {
            total: R::narrow(bound.total),
            algebraic: R::narrow(bound.algebraic),
            of_u: R::narrow(bound.of_u),
            ..Certificate::default()
        };
        weights.iter().map(|of| of.within(&certificate).wide()).collect()
    };
    let name = format!("{}, {}", choice.candidate().name, R::NAME);
    let module = Module { name, plus_minus: Box::new(plus_minus), reasons };
    let narrow =
        |of: &Option<_>| of.as_ref().and_then(|of| NarrowMidpoint::new(&problem.scene, of));
    let midpoints = midpoints.iter().map(narrow).collect();
    with_choice(problem, &choice, midpoints, &mut |session| then(session, &module))
}

/// Calls `then` with a session of the condensed model of `problem`.
///
/// # Errors
/// What keeps that model from existing.
pub(crate) fn with_condensed<R: Bakes>(problem: &Problem, then: Then) -> Result<()> {
    let choice = Choice::<R>::new(problem, Wanted::model(ModelKind::Condensed))?;
    with_choice(problem, &choice, Vec::new(), then)
}

fn with_choice<R: Bakes>(
    problem: &Problem,
    choice: &Choice<R>,
    midpoints: Vec<Option<NarrowMidpoint<R>>>,
    then: Then,
) -> Result<()> {
    if let Model::Full(baked) = &choice.candidate().model {
        return with_full(&problem.scene, baked, then);
    }
    let Some(model) = choice.condensed() else {
        let message = "setting.model: there is no condensed model of this scene";
        return Err(InputError::new(message).file(&problem.scene.path).into());
    };
    then(&mut Condensed::new(problem, model, midpoints))
}

//! The controller that `bake` would write, on this machine.

use signorini_kernel::verdict::Certificate;

use super::{Engine, condensed, full};
use crate::choice::{Choice, Model, Wanted};
use crate::intervals::{narrowed, of_choice};
use crate::setting;
use signorini_certify::ErrorBound;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_solve::ScalarKind;

/// How far each output may be off where answers have such a bound.
type PlusMinus = Box<dyn Fn(&ErrorBound) -> Vec<f64>>;

/// What is known of a module beside its answers.
pub struct Module {
    /// Its model, solver and scalar in a few words.
    pub name: String,
    plus_minus: PlusMinus,
    /// Why outputs have no weights.
    reasons: Vec<Option<String>>,
}

impl Module {
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

/// Lends the engine of the module that `bake` writes for `problem`, and what is known of the module: model, solver and scalar are
/// chosen as there, `asked` being the scalar of the command line.
///
/// # Errors
/// Those of `bake`: no model that represents the scene or fits its target.
pub fn baked<T>(
    problem: &Problem,
    asked: Option<ScalarKind>,
    then: impl FnOnce(&mut dyn Engine, &Module) -> Result<T>,
) -> Result<T> {
    match setting::scalar(&problem.scene, asked)? {
        ScalarKind::F32 => baked_in::<f32, T>(problem, then),
        ScalarKind::F64 => baked_in::<f64, T>(problem, then),
    }
}

fn baked_in<R: Scalar, T>(
    problem: &Problem,
    then: impl FnOnce(&mut dyn Engine, &Module) -> Result<T>,
) -> Result<T> {
    let choice = Choice::<R>::new(problem, Wanted::default())?;
    let candidate = choice.candidate();
    let weighed = of_choice(problem, &choice);
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
    let name = format!("{}, {}", candidate.name, R::NAME);
    let module = Module { name, plus_minus: Box::new(plus_minus), reasons };
    match &candidate.model {
        Model::Condensed(_) => condensed::lend(problem, &choice, |engine| then(engine, &module)),
        Model::Full(baked) => full::lend(&problem.scene, baked, |engine| then(engine, &module)),
    }
}

//! Which model: the smallest that represents the scene exactly and fits the device.
//!
//! ```text
//!   condensed, exact method │ condensed, sweeps alone │ full │ full, by a factor
//!   ── each with its needs (bytes from its arrays, instructions from counted parts and a trial) ──►
//!   the first that fits what `[target]` declares
//! ```
//! Of two that differ in their solver the quicker one comes first. Every model has its error bound, unless
//! `certificate = false` in `[setting]` leaves it out: condensed models without it are worked out to say what that would
//! save, and are no choice. A scene of which one model has no bound at all gets one that has; where none has, or none
//! that is asked for, [`Choice::unbounded`] says why.

mod advice;
mod candidates;
mod considered;
mod meshes;
mod origin;

use super::Bakes;
use super::budget::{Budget, Needs, Shortfall};
use super::range::{refuse_answers, refuse_lengths};
use super::trial::Trial;
use super::{condensed, full};
use advice::too_large;
use considered::{Considered, Task, best, negligible};
pub use origin::Origin;
use signorini_condense::CondensedModel;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Problem};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{ModelKind, Setting};
use signorini_solve::choose_for_inputs;

/// A model, ready to be written.
#[derive(Debug)]
pub enum Model<R: Scalar> {
    /// See [`condensed`].
    Condensed(Box<condensed::Baked<R>>),
    /// See [`full`].
    Full(Box<full::Baked<R>>),
}

/// A model with what it takes.
#[derive(Debug)]
pub struct Candidate<R: Scalar> {
    /// In a few words.
    pub name: String,
    /// The model.
    pub model: Model<R>,
    /// Its needs.
    pub needs: Needs,
    /// Its warm ticks.
    pub trial: Trial,
    /// Instructions of the median warm tick in which the transfer coefficient that an input changes stays what it was.
    pub staying: Option<f64>,
    /// Its shortfalls on the device.
    pub shortfalls: Vec<Shortfall>,
    /// Instructions of the worst tick that is proved of the exact method, where `[target]` has no time for it.
    pub too_long: Option<f64>,
    /// Whether it lacks the bound that is asked for: it is no choice then, but may be one without.
    pub lacks_bound: bool,
    /// Why this model of the scene can have no bound, where one is asked for: the last choice.
    pub unbounded: Option<String>,
}

impl<R: Scalar> Candidate<R> {
    /// Whether the device has room and time for it.
    pub fn fits(&self) -> bool {
        self.shortfalls.is_empty()
    }

    /// Whether its matrix is proved to be an M-matrix.
    fn is_monotone(&self) -> bool {
        matches!(&self.model, Model::Condensed(baked) if baked.is_monotone)
    }

    fn may_be_chosen(&self) -> bool {
        self.fits() && !self.lacks_bound
    }

    fn has_all(&self) -> bool {
        self.may_be_chosen() && self.unbounded.is_none()
    }
}

/// All that was considered, and which it is.
#[derive(Debug)]
pub struct Choice<R: Scalar> {
    /// In the order in which they were considered.
    pub candidates: Vec<Candidate<R>>,
    /// Position of the one chosen.
    pub chosen: usize,
    /// The device's memory and time.
    pub budget: Budget,
    /// Why a model was not considered.
    pub excluded: Vec<String>,
    /// The origin of condensed candidates.
    origin: Option<Origin>,
}

/// The model, scalar and method that are asked for.
#[derive(Debug, Clone, Copy, Default)]
pub struct Wanted {
    /// Only this model.
    pub model: Option<ModelKind>,
    /// The full model is worked out in any case.
    pub is_compared: bool,
    /// All contact edges are kept, those that never change sides too.
    pub has_all_edges: bool,
}

impl Wanted {
    /// This model, whatever the setting says.
    pub fn model(model: ModelKind) -> Self {
        Self { model: Some(model), ..Self::default() }
    }
}

/// The condensed model of a problem without the edges that never change sides; with all of them where none may be taken out.
///
/// # Errors
/// What keeps a condensed model from existing; loads that leave no solution to enclose.
pub fn reduced(problem: &Problem) -> Result<CondensedModel> {
    Approach::Condensation.check(problem)?;
    Ok(Origin::new(problem, Wanted::default(), negligible::<f64>())?.model().clone())
}

impl<R: Bakes> Choice<R> {
    /// Chooses for `problem`, as its setting asks where `wanted` does not.
    ///
    /// # Errors
    /// No model fits what the scene declares: by how much the smallest one does not. What keeps a model that
    /// was asked for from existing, or a key of the setting from meaning anything to it.
    pub fn new(problem: &Problem, wanted: Wanted) -> Result<Self> {
        R::choose(problem, wanted)
    }

    /// Why the model chosen has no bound, where one is asked for.
    pub fn unbounded(&self) -> Option<&str> {
        self.candidate().unbounded.as_deref()
    }

    /// The condensed model, where that is chosen, with what it was made of.
    pub fn condensed(&self) -> Option<(&condensed::Baked<R>, &Origin)> {
        let origin = self.origin.as_ref()?;
        match &self.candidate().model {
            Model::Condensed(baked) => Some((baked, origin)),
            Model::Full(_) => None,
        }
    }

    /// The model chosen.
    pub fn candidate(&self) -> &Candidate<R> {
        &self.candidates[self.chosen]
    }
}

pub(crate) fn choose<R: Bakes>(problem: &Problem, wanted: Wanted) -> Result<Choice<R>> {
    let scene = &problem.scene;
    let setting = scene.setting.unwrap_or_default();
    let asked = wanted.model.or(setting.model_kind());
    refuse_memory(scene, &setting)?;
    if let Some((model, key)) = asked.and_then(|model| Some((model, setting.foreign_to(model)?))) {
        return Err(foreign(scene, model, key).into());
    }
    let (budget, units) = (Budget::of(scene), choose_for_inputs(problem)?);
    refuse_answers::<R>(scene, &units)?;
    refuse_lengths::<R>(problem)?;
    let task = Task { problem, wanted, setting, asked, budget: &budget, units };
    let Considered { candidates, excluded, origin } = Considered::of(&task)?;
    match best(&candidates, scene.stores()) {
        Some(chosen) => Ok(Choice { candidates, chosen, budget, excluded, origin }),
        None => Err(too_large(scene, &candidates).into()),
    }
}

/// Refuses states of a scene that steps in no time.
fn refuse_memory(scene: &Scene, setting: &Setting) -> Result<()> {
    if scene.stores() || setting.memory.is_none() {
        return Ok(());
    }
    let message = "setting.memory: no material has a capacity, so that ticks are no steps in time";
    Err(InputError::new(message).file(&scene.path).hint("remove it").into())
}

/// The error that a key of the setting does not go with the model that the command asks for.
fn foreign(scene: &Scene, model: ModelKind, key: &str) -> InputError {
    let model = match model {
        ModelKind::Full => "full",
        ModelKind::Condensed => "condensed",
    };
    InputError::new(format!("setting.{key}: means nothing to the {model} model"))
        .file(&scene.path)
        .hint(format!("remove it, or do not ask for the {model} model"))
}

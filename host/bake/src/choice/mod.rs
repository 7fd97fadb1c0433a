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
mod meshes;
mod origin;

use super::Bakes;
use super::budget::{Budget, Needs, Shortfall};
use super::range::{refuse_answers, refuse_inputs, refuse_lengths, refuse_loads, refuse_squares};
use super::trial::Trial;
use super::{condensed, full};
use advice::too_large;
use candidates::{of_condensed, time};
use meshes::of_full;
pub use origin::Origin;
use signorini_condense::CondensedModel;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Lack, Problem, Property};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::{ModelKind, Setting};
use signorini_solve::choose_for_inputs;

/// Contact edges beyond which nothing is condensed: the work on this machine grows like n³.
const MOST_CONTACTS: usize = 1000;
/// Bytes of flash beyond which a condensed model is compared with the full one.
const LARGE: u64 = 1 << 20;

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

impl<R: Scalar> Choice<R> {
    /// Chooses for `problem`, as its setting asks where `wanted` does not.
    ///
    /// # Errors
    /// No model fits what the scene declares: by how much the smallest one does not. What keeps a model that
    /// was asked for from existing, or a key of the setting from meaning anything to it.
    pub fn new(problem: &Problem, wanted: Wanted) -> Result<Self>
    where
        R: Bakes,
    {
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

pub(crate) fn choose<R: Scalar>(problem: &Problem, wanted: Wanted) -> Result<Choice<R>> {
    let budget = Budget::of(&problem.scene);
    let setting = problem.scene.setting.unwrap_or_default();
    let (asked, compared) = (wanted.model.or(setting.model_kind()), wanted.is_compared);
    let forced = asked;
    let stores = problem.scene.stores();
    refuse_memory(&problem.scene, &setting)?;
    if let Some((model, key)) = forced.and_then(|model| Some((model, setting.foreign_to(model)?))) {
        return Err(foreign(&problem.scene, model, key).into());
    }
    let (mut candidates, mut excluded, mut origin) = (Vec::new(), Vec::new(), None);
    let units = choose_for_inputs(problem)?;
    refuse_answers::<R>(&problem.scene, &units)?;
    refuse_lengths::<R>(problem)?;
    // Condensation is in the scene's units, in f64.
    let unsuited = match forced {
        None => unsuited(problem, &units)?,
        Some(_) => None,
    };
    if let Some(why) = unsuited {
        excluded.push(format!("condensed: {why}"));
    } else if forced != Some(ModelKind::Full) {
        refuse_squares::<f64>(&problem.scene, &units)?;
        // What modes refuse, a pattern of two signs say, the full model can treat, and so it can many cells that store something.
        let may_be_full = Approach::condensing(problem) != Approach::Condensation;
        let origin_of = || match stores {
            true => Origin::stepped(problem, &setting),
            false => Origin::new(problem, wanted, negligible::<R>()),
        };
        match origin_of() {
            Ok(own) => {
                refuse_inputs::<R>(&problem.scene)?;
                refuse_loads::<R>(&problem.scene, own.model())?;
                match of_condensed(&problem.scene, &own, &budget) {
                    Ok(found) => (candidates, origin) = (found, Some(own)),
                    Err(error) if forced.is_some() => return Err(error),
                    Err(error) => excluded.push(format!("condensed: {error}")),
                }
            }
            Err(error) if forced.is_some() || !may_be_full => return Err(error),
            Err(error) => excluded.push(format!("condensed: {error}")),
        }
    }
    let fits = candidates.iter().any(Candidate::has_all);
    let large = candidates.iter().any(|candidate| candidate.needs.flash > LARGE);
    if forced == Some(ModelKind::Full)
        || (forced.is_none() && (compared || !fits || large || stores))
    {
        match of_full(problem, units, &budget, &mut excluded) {
            Ok(mut found) => {
                // A deadline cuts its sweeps off, and its bound tells what is left: who asks for it is warned of
                // the time, not refused.
                for candidate in found.iter_mut().filter(|_| forced.is_some()) {
                    candidate.shortfalls.retain(|short| short.key != "target.tick");
                }
                candidates.append(&mut found);
            }
            Err(error) if candidates.is_empty() => return Err(error),
            Err(error) => excluded.push(format!("full: {error}")),
        }
    }
    // Condensed models come first; a mesh that takes less than their dense blocks is preferred to them.
    let flash = |at: &usize| candidates[*at].needs.flash;
    let first = candidates.iter().position(Candidate::has_all);
    let is_full = |candidate: &Candidate<R>| matches!(candidate.model, Model::Full(_));
    let full = candidates.iter().position(|of| is_full(of) && of.has_all());
    let quicker = |(first, full): (usize, usize)| {
        time(&candidates[full].needs) < time(&candidates[first].needs)
    };
    let complete = match first.zip(full) {
        // At short steps the full model takes a few sweeps.
        Some(both) if stores && quicker(both) => full,
        Some((first, full)) if flash(&first) > LARGE && flash(&full) < flash(&first) => Some(full),
        _ => first,
    };
    // Without a bound only where no model has one: what is asked for and does not fit is not left out.
    let is_bounded = |of: &Candidate<R>| of.unbounded.is_none() && !of.lacks_bound;
    let last = || match candidates.iter().any(is_bounded) {
        true => None,
        false => candidates.iter().position(Candidate::may_be_chosen),
    };
    match complete.or_else(last) {
        Some(chosen) => Ok(Choice { candidates, chosen, budget, excluded, origin }),
        None => Err(too_large(&problem.scene, &candidates).into()),
    }
}

/// The share of a mode in the squares of answers that is nothing beside what a program in `R` rounds.
fn negligible<R: Scalar>() -> f64 {
    (8.0 * R::EPSILON.wide()).powi(2)
}

/// Refuses states of a scene that steps in no time.
fn refuse_memory(scene: &Scene, setting: &Setting) -> Result<()> {
    if scene.stores() || setting.memory.is_none() {
        return Ok(());
    }
    let message = "setting.memory: no material has a capacity, so that ticks are no steps in time";
    Err(InputError::new(message).file(&scene.path).hint("remove it").into())
}

/// Why no condensed model is worked out where nobody asks for one, if so.
fn unsuited(problem: &Problem, units: &Units) -> Result<Option<String>> {
    if let Err(error) = refuse_squares::<f64>(&problem.scene, units) {
        return Ok(Some(error.to_string()));
    }
    let (counts, lack) = (problem.topology.counts, Approach::condensing(problem).lack(problem)?);
    let is_large = |lack: &Lack| lack.property == Property::ManyContactEdges;
    if counts.contact > MOST_CONTACTS || lack.as_ref().is_some_and(is_large) {
        let (contact, edges) = (counts.contact, counts.edges());
        let most = format!("at most {MOST_CONTACTS}, and fewer on a large mesh");
        return Ok(Some(format!("{contact} contact edges among {edges}, {most}")));
    }
    // What the full model cannot treat either, condensation refuses: its words are of more help.
    let own = lack.filter(|lack| Approach::FullModel.treats(lack.property));
    Ok(own.map(|lack| lack.to_string()))
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

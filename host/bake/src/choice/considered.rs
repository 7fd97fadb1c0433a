//! The models that are worked out for a scene, and the best of them.

use super::candidates::{of_condensed, time};
use super::meshes::of_full;
use super::{Candidate, Model, Origin, Wanted};
use crate::Bakes;
use crate::budget::Budget;
use crate::range::{refuse_inputs, refuse_loads, refuse_squares};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Lack, Problem, Property};
use signorini_scene::error::Result;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::{ModelKind, Setting};

/// Contact edges beyond which nothing is condensed: the work on this machine grows like n³.
const MOST_CONTACTS: usize = 1000;
/// Bytes of flash beyond which a condensed model is compared with the full one.
const LARGE: u64 = 1 << 20;

/// The problem that a model is chosen for, and all that is asked of it.
pub(super) struct Task<'t> {
    pub problem: &'t Problem,
    pub wanted: Wanted,
    pub setting: Setting,
    /// The model that command line or setting ask for.
    pub asked: Option<ModelKind>,
    pub budget: &'t Budget,
    pub units: Units,
}

impl Task<'_> {
    /// Whether the full model is worked out beside these condensed ones.
    fn may_be_full<R: Scalar>(&self, condensed: &[Candidate<R>]) -> bool {
        let fits = condensed.iter().any(Candidate::has_all);
        let large = condensed.iter().any(|candidate| candidate.needs.flash > LARGE);
        let is_open = self.wanted.is_compared || !fits || large || self.problem.scene.stores();
        self.asked == Some(ModelKind::Full) || (self.asked.is_none() && is_open)
    }
}

/// Models that were worked out, and why others were not.
pub(super) struct Considered<R: Bakes> {
    pub candidates: Vec<Candidate<R>>,
    pub excluded: Vec<String>,
    pub origin: Option<Origin>,
}

impl<R: Bakes> Considered<R> {
    /// Works out what may be chosen: condensed models, and the full one where it is asked for or may be better.
    pub fn of(task: &Task) -> Result<Self> {
        let mut all = Self { candidates: Vec::new(), excluded: Vec::new(), origin: None };
        all.add_condensed(task)?;
        if task.may_be_full(&all.candidates) {
            all.add_full(task)?;
        }
        Ok(all)
    }

    /// Condensation is in the scene's units, in f64.
    fn add_condensed(&mut self, task: &Task) -> Result<()> {
        let Task { problem, asked, units, .. } = *task;
        let why = if asked.is_none() { unsuited(problem, &units)? } else { None };
        if let Some(why) = why {
            self.excluded.push(format!("condensed: {why}"));
            return Ok(());
        }
        if asked == Some(ModelKind::Full) {
            return Ok(());
        }
        refuse_squares::<f64>(&problem.scene, &units)?;
        // What modes refuse, a pattern of two signs say, the full model can treat, and so it can many cells that store something.
        let may_be_full = Approach::condensing(problem) != Approach::Condensation;
        let origin = match problem.scene.stores() {
            true => Origin::stepped(problem, &task.setting, task.wanted.has_all_edges),
            false => Origin::new(problem, task.wanted, negligible::<R>()),
        };
        match origin {
            Ok(origin) => self.add_condensed_from(task, origin),
            Err(error) if asked.is_some() || !may_be_full => Err(error),
            Err(error) => {
                self.excluded.push(format!("condensed: {error}"));
                Ok(())
            }
        }
    }

    fn add_condensed_from(&mut self, task: &Task, origin: Origin) -> Result<()> {
        let scene = &task.problem.scene;
        refuse_inputs::<R>(scene)?;
        refuse_loads::<R>(scene, origin.model())?;
        match of_condensed(scene, &origin, task.budget) {
            Ok(found) => (self.candidates, self.origin) = (found, Some(origin)),
            Err(error) if task.asked.is_some() => return Err(error),
            Err(error) => self.excluded.push(format!("condensed: {error}")),
        }
        Ok(())
    }

    fn add_full(&mut self, task: &Task) -> Result<()> {
        match of_full(task.problem, task.units, task.budget, &mut self.excluded) {
            Ok(mut found) => {
                // A deadline cuts its sweeps off, and its bound tells what is left: who asks for it is warned of
                // the time, not refused.
                for candidate in found.iter_mut().filter(|_| task.asked.is_some()) {
                    candidate.shortfalls.retain(|short| short.key != "target.tick");
                }
                self.candidates.append(&mut found);
            }
            Err(error) if self.candidates.is_empty() => return Err(error),
            Err(error) => self.excluded.push(format!("full: {error}")),
        }
        Ok(())
    }
}

/// The candidate that is taken, condensed models standing first: one that has all, a full one where it takes less than their dense blocks.
pub(super) fn best<R: Scalar>(candidates: &[Candidate<R>], stores: bool) -> Option<usize> {
    let flash = |at: usize| candidates[at].needs.flash;
    let first = candidates.iter().position(Candidate::has_all);
    let is_full = |candidate: &Candidate<R>| matches!(candidate.model, Model::Full(_));
    let full = candidates.iter().position(|of| is_full(of) && of.has_all());
    let quicker = |(first, full): (usize, usize)| {
        time(&candidates[full].needs) < time(&candidates[first].needs)
    };
    let complete = match first.zip(full) {
        // At short steps the full model takes a few sweeps.
        Some(both) if stores && quicker(both) => full,
        Some((first, full)) if flash(first) > LARGE && flash(full) < flash(first) => Some(full),
        _ => first,
    };
    // Without a bound only where no model has one: what is asked for and does not fit is not left out.
    let is_bounded = |of: &Candidate<R>| of.unbounded.is_none() && !of.lacks_bound;
    complete.or_else(|| match candidates.iter().any(is_bounded) {
        true => None,
        false => candidates.iter().position(Candidate::may_be_chosen),
    })
}

/// The share of a mode in the squares of answers that is nothing beside what a program in `R` rounds.
pub(super) fn negligible<R: Scalar>() -> f64 {
    (8.0 * R::EPSILON.wide()).powi(2)
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

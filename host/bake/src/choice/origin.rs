//! What condensed candidates are made of.

use std::collections::BTreeMap;

use super::Wanted;
use signorini_condense::ranges::follow::FollowedRanges;
use signorini_condense::ranges::reduced::Reduced;
use signorini_condense::ranges::released::released;
use signorini_condense::ranges::sides::Sides;
use signorini_condense::{CondensedModel, ModalModel, Recovery, modal, recoverable};
use signorini_problem::{Approach, Exclusion, Problem};
use signorini_reference::ReferenceError;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;

/// What condensed candidates were made of, with the way back to the mesh.
#[derive(Debug)]
pub struct Origin {
    /// With all contact edges; where `reduced` is there, its error bound may hold for that alone.
    pub whole: CondensedModel,
    /// From its answers to fields on the mesh.
    pub recovery: Recovery,
    /// The sides that its edges are on for all inputs within their ranges.
    pub sides: Sides,
    /// Without the edges that never change, where there are any and they may be taken out.
    pub reduced: Option<Reduced>,
    /// Vertices at which s is above ψ in every tick, and by how much at least.
    pub clear: BTreeMap<u32, f64>,
    /// Whether it was asked for that none is taken out.
    pub has_all_edges: bool,
    /// Where an input changes a transfer coefficient, the modes of that; `whole` is the model at its least value then.
    pub modes: Option<ModalModel>,
    /// What is proved of those for all values of the coefficient.
    pub followed: Option<FollowedRanges>,
    /// Conditions that inputs without a range have to meet.
    pub exclusions: Vec<Exclusion>,
}

impl Origin {
    /// Shares of modes up to `negligible` are left out.
    pub(super) fn new(problem: &Problem, wanted: Wanted, negligible: f64) -> Result<Self> {
        let (whole, recovery, modes) = match Approach::condensing(problem) {
            Approach::Modes => {
                let (modes, recovery) = modal(problem, negligible)?;
                (modes.model.clone(), recovery, Some(modes))
            }
            _ => {
                let (whole, recovery) = recoverable(problem)?;
                (whole, recovery, None)
            }
        };
        let failed = |error: ReferenceError| no_reference(&problem.scene, &error);
        let followed = match &modes {
            Some(modes) => FollowedRanges::new(modes).map_err(failed)?,
            None => None,
        };
        let sides = match &followed {
            Some(followed) => followed.sides.clone(),
            None => Sides::new(&whole).map_err(failed)?,
        };
        let may_be_reduced = !wanted.has_all_edges && modes.is_none();
        let mut reduced = may_be_reduced.then(|| Reduced::new(&whole, sides.clone())).flatten();
        let (mut whole, mut recovery, mut clear) = (whole, recovery, BTreeMap::new());
        if reduced.is_some()
            && let Some(of) = released(problem, &whole, &recovery, &sides)?
        {
            (whole, recovery, clear) = (of.model, of.recovery, of.clear);
            reduced = Reduced::new(&whole, sides.clone());
        }
        let has_all_edges = wanted.has_all_edges;
        let exclusions = problem.exclusions();
        Ok(Self {
            whole,
            recovery,
            sides,
            reduced,
            clear,
            has_all_edges,
            modes,
            followed,
            exclusions,
        })
    }

    /// The model that is baked.
    pub fn model(&self) -> &CondensedModel {
        self.reduced.as_ref().map_or(&self.whole, |reduced| &reduced.model)
    }

    /// The inputs of the whole model with these x: those of the scene, the constant first, and amplitudes where there are modes.
    pub fn inputs(&self, p: Vec<f64>, x: &[f64]) -> Vec<f64> {
        match &self.modes {
            Some(modes) => modes.amplitudes(p[modes.input], &p, x),
            None => p,
        }
    }

    /// x of the whole model, from that of the one that is baked.
    pub fn expand(&self, p: &[f64], x: Vec<f64>) -> Vec<f64> {
        match &self.reduced {
            Some(reduced) => reduced.expand(p, &x),
            None => x,
        }
    }
}

/// The error that loads leave no solution to enclose.
fn no_reference(scene: &Scene, error: &ReferenceError) -> InputError {
    InputError::new(format!("ranges: {error}"))
        .file(&scene.path)
        .hint("take smaller numbers for the ranges of the inputs")
}

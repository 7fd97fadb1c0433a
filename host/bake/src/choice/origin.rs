//! What condensed candidates are made of.

use std::collections::BTreeMap;

use super::Wanted;
use signorini_condense::ranges::follow::FollowedRanges;
use signorini_condense::ranges::lasting::{Unproved, lasting};
use signorini_condense::ranges::reduced::Reduced;
use signorini_condense::ranges::released::released;
use signorini_condense::ranges::sides::Sides;
use signorini_condense::{
    CondensedModel, ModalModel, Recovery, SteppedModel, modal, recoverable, settled, stepped,
};
use signorini_problem::{Approach, Exclusion, Problem};
use signorini_reference::ReferenceError;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::Setting;

/// Roundings by which a row may be off in exact steps.
const ROUNDINGS: f64 = 16.0;

/// What condensed candidates were made of, with the way back to the mesh.
#[derive(Debug)]
pub struct Origin {
    /// With all contact edges; where `reduced` is there, its error bound may hold for that alone.
    pub whole: CondensedModel,
    /// From its answers to fields on the mesh; of steps in time from those of their model.
    pub recovery: Recovery,
    /// The sides that its edges are on for all inputs within their ranges; where ticks are steps in time, in all exact ones on the mesh.
    pub sides: Sides,
    /// Why nothing is proved of sides in all steps.
    pub unproved: Option<Unproved>,
    /// Without the edges that never change, where there are any and they may be taken out.
    pub reduced: Option<Reduced>,
    /// Vertices at which s is above ψ in every tick, and by how much at least.
    pub clear: BTreeMap<u32, f64>,
    /// Whether it was asked for that none is taken out.
    pub has_all_edges: bool,
    /// Where an input changes a transfer coefficient, the modes of that; `whole` is the model at its least value then.
    pub modes: Option<ModalModel>,
    /// Where ticks are steps in time, what one hands on to the next, without edges that are proved to stay on their side; `whole` is the
    /// model of one step with all of them then.
    pub steps: Option<SteppedModel>,
    /// What is proved of those modes for all values of the coefficient.
    pub followed: Option<FollowedRanges>,
    /// Conditions that inputs without a range have to meet.
    pub exclusions: Vec<Exclusion>,
}

impl Origin {
    /// Of steps in time with the states that `setting` asks for, and all edges where that is wanted.
    pub(super) fn stepped(
        problem: &Problem,
        setting: &Setting,
        has_all_edges: bool,
    ) -> Result<Self> {
        let memory = setting.memory.map(|states| states as usize);
        let (of, recovery) = stepped(problem, memory)?;
        if let Some(why) = of.model.certificate.as_ref().err().filter(|_| setting.certificate) {
            let error = InputError::new(format!("there is no error bound: {why}"));
            let hint = "certificate = false in [setting] leaves the bound out";
            return Err(error.file(&problem.scene.path).hint(hint).into());
        }
        let failed = |error: ReferenceError| no_reference(&problem.scene, &error);
        let (sides, unproved) =
            match lasting(&of, &of.full, ROUNDINGS * f64::EPSILON).map_err(failed)? {
                Ok(sides) => (sides, None),
                Err(why) => (Sides::unproved(&of.model), Some(why)),
            };
        let whole = of.model.clone();
        let fewer = match has_all_edges {
            true => None,
            false => settled(problem, &of, &sides, memory)?,
        };
        let (of, recovery) = fewer.unwrap_or((of, recovery));
        let all = Self::of(problem, whole, recovery, sides);
        Ok(Self { unproved, has_all_edges, steps: Some(of), ..all })
    }

    /// With all contact edges.
    fn of(problem: &Problem, whole: CondensedModel, recovery: Recovery, sides: Sides) -> Self {
        Self {
            whole,
            recovery,
            sides,
            unproved: None,
            reduced: None,
            clear: BTreeMap::new(),
            has_all_edges: false,
            modes: None,
            steps: None,
            followed: None,
            exclusions: problem.exclusions(),
        }
    }

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
        let all = Self::of(problem, whole, recovery, sides);
        Ok(Self { reduced, clear, has_all_edges: wanted.has_all_edges, modes, followed, ..all })
    }

    /// The model that is baked.
    pub fn model(&self) -> &CondensedModel {
        self.reduced.as_ref().map_or_else(|| self.recovered(), |reduced| &reduced.model)
    }

    /// The model that `recovery` leads back from.
    pub fn recovered(&self) -> &CondensedModel {
        self.steps.as_ref().map_or(&self.whole, |steps| &steps.model)
    }

    /// The inputs of the whole model with these x: those of the scene, the constant first, and amplitudes where there are
    /// modes; of steps in time what the last tick has left is among them.
    pub fn inputs(&self, p: Vec<f64>, x: &[f64]) -> Vec<f64> {
        match (&self.modes, &self.steps) {
            (Some(modes), _) => modes.amplitudes(p[modes.input], &p, x),
            // Without its bound a controller hands no corrections on.
            (None, Some(_)) => {
                let mut p = p;
                p.resize(self.recovered().inputs, 0.0);
                p
            }
            (None, None) => p,
        }
    }

    /// Which contact edges touch with these x of the model that `recovery` leads back from.
    pub fn touching(&self, x: &[f64]) -> Vec<bool> {
        let mut touching = vec![true; self.whole.contact];
        let edges = self.recovered().edges.iter().zip(x);
        edges.for_each(|(&edge, &x)| touching[edge] = x == 0.0);
        let open = self.steps.iter().flat_map(|steps| &steps.settled.open);
        open.for_each(|&edge| touching[edge] = false);
        touching
    }

    /// What presses the contact edges that touch in every step, of these fluxes through all edges.
    pub fn pressing(&self, at: &Problem, flux: &[f64]) -> f64 {
        let touching = self.steps.iter().flat_map(|steps| &steps.settled.touching);
        let free = at.topology.counts.free;
        touching.map(|&edge| flux[free + edge] - at.loads.contact_flux[edge]).sum()
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

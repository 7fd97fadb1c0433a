//! The module of the model that was chosen, and what programs are told of it.

use signorini_image::chosen::{Chosen, WorstCase};

use crate::Bakes;
use crate::choice::{Choice, Model};
use crate::condensed;
use crate::full;
use crate::intervals;
use crate::module_api::ModuleApi;
use crate::ranges;
use crate::worst;
use signorini_intervals::described;
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_solve::decay::time_constants;

/// A module of firmware.
#[derive(Debug, Clone, PartialEq)]
pub struct Emitted {
    /// Its Rust source.
    pub source: String,
    /// Its kind.
    pub chosen: Chosen,
}

/// The module of the model that was chosen.
pub fn emit<R: Bakes>(problem: &Problem, choice: &Choice<R>) -> Emitted {
    R::emit(problem, choice)
}

pub(crate) fn module<R: Bakes>(problem: &Problem, choice: &Choice<R>) -> Emitted {
    let candidate = choice.candidate();
    let (model, features, worst_case, source) = match &candidate.model {
        Model::Condensed(baked) => {
            let source = condensed::source(&ModuleApi::new(problem), baked);
            ("condensed", baked.kernel_features(), baked.worst_case(), source)
        }
        Model::Full(baked) => ("full", baked.features(), WorstCase::default(), full::source(baked)),
    };
    let known = R::intervals(problem, choice);
    let ranges = choice.condensed().map(|(baked, origin)| ranges::found(baked, origin));
    let steps = choice.condensed().and_then(|(_, origin)| origin.steps.as_ref());
    let states = steps.map(|of| [of.fading.len(), of.modes]);
    // A mesh that is baked can be cut into triangles.
    let constants = time_constants(problem).ok().flatten();
    let chosen = Chosen {
        model: model.to_owned(),
        scalar: R::NAME.to_owned(),
        kernel_features: features.into_iter().map(str::to_owned).collect(),
        ram_bytes: candidate.needs.ram,
        flash_bytes: candidate.needs.flash,
        instructions: candidate.needs.instructions(),
        ranges: ranges.filter(|_| ranges::declared(&problem.scene)),
        worst_case,
        step: problem.scene.step(),
        memory: choice
            .condensed()
            .map_or(0, |(baked, _)| baked.steps.as_ref().map_or(0, |steps| steps.count() as u32)),
        time_constants: constants.map(|of| {
            [of.slowest, of.fastest].map(|constant| Some(constant).filter(|of| of.is_finite()))
        }),
        outputs: wanted(&problem.scene).iter().map(described).collect(),
        without_interval: known.weighed.iter().map(|of| of.as_ref().err().cloned()).collect(),
    };
    let source = source
        + &worst::constants(worst_case, states.is_some())
        + &ranges.map(|of| ranges::constants(of, states)).unwrap_or_default()
        + &intervals::constants::<R>(problem, &known);
    Emitted { source, chosen }
}

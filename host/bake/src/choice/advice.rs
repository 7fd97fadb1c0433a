//! What to do where no model fits.

use super::{Candidate, Model};
use crate::Bakes;
use crate::budget::Shortfall;
use crate::costs::Footprint;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::InputError;
use signorini_scene::scene::{Quantity, Scene};

/// That nothing fits: the candidate that misses by least, and what would fit.
pub(super) fn too_large<R: Bakes>(scene: &Scene, candidates: &[Candidate<R>]) -> InputError {
    let factor = |candidate: &Candidate<R>| {
        let factors = candidate.shortfalls.iter().map(|short| short.needed / short.declared);
        factors.fold(1.0, f64::max)
    };
    let complete = candidates.iter().filter(|candidate| !candidate.lacks_bound);
    let least = complete.min_by(|a, b| factor(a).total_cmp(&factor(b)));
    let Some(candidate) = least else { return InputError::new("no model").file(&scene.path) };
    let message: Vec<String> = candidate.shortfalls.iter().map(Shortfall::to_string).collect();
    let message =
        format!("{}: the smallest model ({}) does not fit", message.join("; "), candidate.name);
    // What fits now and was no choice lacks its bound, or has none.
    let hint = match candidates.iter().any(Candidate::fits) {
        true => format!("{}; or {}", without_bound(scene), nearest(candidate)),
        false => nearest(candidate),
    };
    InputError::new(message).file(&scene.path).hint(hint)
}

/// That the bound is what does not fit.
fn without_bound(scene: &Scene) -> String {
    let output = scene.outputs.iter().find(|output| output.quantity == Quantity::Bound);
    let output =
        output.map_or(String::new(), |output| format!("output.{} and ", output.name.value));
    format!("without {output}its error bound (certificate = false in [setting]) it would fit")
}

/// How many times a mesh is too large, from how needs grow: those of the code alone do not.
fn growth<R: Scalar>(candidate: &Candidate<R>, footprint: &Footprint) -> f64 {
    let growing = |short: &Shortfall| {
        let fixed = match short.key {
            "target.ram" => footprint.stack,
            "target.flash" => footprint.code,
            _ => 0,
        } as f64;
        (short.needed - fixed) / (short.declared - fixed)
    };
    candidate.shortfalls.iter().map(growing).fold(1.0, |most: f64, factor| match factor > 0.0 {
        true => most.max(factor),
        // The code alone is too large.
        false => f64::INFINITY,
    })
}

/// The nearest mesh that would fit.
fn nearest<R: Bakes>(candidate: &Candidate<R>) -> String {
    let hopeless = "no mesh is coarse enough: the code and its stack alone need more than that";
    match &candidate.model {
        // Bytes and instructions of dense blocks grow like n².
        Model::Condensed(baked) => {
            let factor = growth(candidate, &Footprint::measured(baked.kind()));
            let fitting = (baked.contact as f64 / factor.sqrt()).floor();
            if fitting < 1.0 {
                return hopeless.to_owned();
            }
            format!(
                "about {fitting} contact edges would fit instead of {}: coarsen the mesh along the contact \
                 boundary {:.1} times, or let a part of it be no contact; the mesh inside costs nothing",
                baked.contact,
                factor.sqrt()
            )
        }
        // Bytes grow like the number of unknowns, instructions like its power 1.5.
        Model::Full(baked) => {
            let factor = growth(candidate, &Footprint::measured(baked.code()));
            let mesh = match factor < baked.unknowns() as f64 {
                true => format!("a mesh with about {factor:.1} times fewer unknowns would fit"),
                false => hopeless.to_owned(),
            };
            format!("{mesh}; the condensed model (--condensed) needs no mesh on the target")
        }
    }
}

//! The variants of the condensed model, each with what it takes.

use super::work::{allowed, entries, fixed, within};
use super::{Candidate, Model, Origin};
use crate::budget::{Budget, Needs};
use crate::costs::Costs;
use crate::dense::Done;
use crate::setting::checked;
use crate::{condensed, trial};
use signorini_condense::CondensedModel;
use signorini_problem::inputs::InputSpace;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{Method, Setting};
use signorini_solve::unfit;

/// The variants of the condensed model: with the bound first, and of two the one that takes less time. Those that leave
/// out a bound that is asked for are no choice.
pub(super) fn of_condensed<R: Scalar>(
    scene: &Scene,
    origin: &Origin,
    budget: &Budget,
) -> Result<Vec<Candidate<R>>> {
    let condensate = origin.model();
    let setting = checked::<R>(scene)?;
    refuse_singular::<R>(scene, condensate)?;
    let has_bound = condensate.certificate.is_ok();
    let variants = match (setting.certificate, has_bound) {
        (false, _) => &[false][..],
        (true, true) => &[true, false],
        (true, false) => &[true],
    };
    let mut all = Vec::new();
    for &certified in variants {
        let mut pair = Vec::new();
        // Without contact there is nothing to solve.
        let methods = match setting.solver {
            _ if condensate.contact == 0 || setting.sweeps.is_some() => &[false][..],
            Some(Method::Sweeps) => &[false],
            Some(Method::Exact) => &[true],
            _ => &[true, false],
        };
        for &exact in methods {
            let mut candidate = condensed_as(scene, origin, budget, &setting, [exact, certified])?;
            candidate.lacks_bound = setting.certificate && !certified;
            if setting.certificate {
                candidate.unbounded = condensate.certificate.as_ref().err().cloned();
            }
            pair.push(candidate);
        }
        // Sweeps come back from loads without a solution by small steps, where contact alone holds a part. Nor do they have
        // an end that is proved, where exchanges have.
        if condensate.held_by_contact.is_empty() && !pair.iter().any(Candidate::is_monotone) {
            pair.sort_by(|a, b| time(&a.needs).total_cmp(&time(&b.needs)));
        }
        all.extend(pair);
    }
    Ok(all)
}

/// A matrix that the scalar type cannot tell from a singular one has no use there.
fn refuse_singular<R: Scalar>(scene: &Scene, condensate: &CondensedModel) -> Result<()> {
    /// Part of an answer that rounding of the matrix may take.
    const MOST: f64 = 1e-2;
    // The square of the bound's stability is 1/λ_min of the scaled matrix, or near to it.
    let reach = match &condensate.certificate {
        Ok(form) => form.stability.powi(2),
        Err(_) => condensate.inverse_norm(),
    };
    if reach * R::EPSILON.wide() <= MOST {
        return Ok(());
    }
    let message = format!(
        "the condensed problem is nearly singular (1/λ_min = {reach:.0e}): in {} it would be another one",
        R::NAME
    );
    let hint = "bake it with --scalar f64, or hold the domain more firmly: a larger transfer coefficient, a \
                dirichlet boundary";
    Err(InputError::new(message).file(&scene.path).hint(hint).into())
}

pub(super) fn time(needs: &Needs) -> f64 {
    needs.instructions().unwrap_or(f64::INFINITY)
}

fn condensed_as<R: Scalar>(
    scene: &Scene,
    origin: &Origin,
    budget: &Budget,
    setting: &Setting,
    [exact, certified]: [bool; 2],
) -> Result<Candidate<R>> {
    let condensate = origin.model();
    let unfit = unfit::<R>(scene);
    let all = allowed(setting, condensate, exact);
    let baked = match &origin.modes {
        Some(modes) => condensed::Baked::<R>::modal(modes, all, certified),
        None => condensed::Baked::<R>::new(condensate, all, certified),
    };
    let baked = baked.map_err(unfit)?;
    let mut baked = baked.with_setting(setting);
    let costs = Costs::measured();
    let price = baked.price(entries(condensate, baked.modes.as_ref()), exact);
    let spaces = condensate.defaults.iter().zip(&condensate.ranges).take(baked.inputs).skip(1);
    let spaces: Vec<_> = spaces.map(|(&default, &range)| InputSpace { default, range }).collect();
    let of_tick = |done: &Done| price.of::<R>(&costs, done);
    let (trial, instructions) = trial::of_condensed(&baked, &spaces, of_tick);
    let staying = origin.modes.as_ref().and_then(|modes| {
        let mut spaces = spaces.clone();
        spaces[modes.input - 1].range = [spaces[modes.input - 1].default; 2];
        trial::of_condensed(&baked, &spaces, of_tick).1[0]
    });
    let fixed = fixed::<R>(&costs, condensate, exact, certified)
        .zip(price.follows::<R>(&costs))
        .map(|(fixed, follows)| fixed + follows);
    let time = fixed.zip(budget.instructions()).filter(|_| setting.sweeps.is_none());
    let worst = baked.worst_exchanges().and_then(|most| price.worst::<R>(&costs, most));
    let is_late = |count: Option<f64>| {
        count.zip(budget.instructions()).is_some_and(|(count, most)| count > most)
    };
    // What every tick tried has time for.
    let tried = (!is_late(instructions[1])).then_some(trial);
    match baked.worst_exchanges() {
        Some(_) if !is_late(worst) || tried.is_some() => {
            baked.worst_instructions = worst.map(|count| count.ceil() as u64);
        }
        _ => {
            // Cut off where time is up: no end is proved.
            baked.work = within::<R>(&costs, condensate.contact, all, tried, time);
            baked.sweeps.most = baked.work.sweeps;
        }
    }
    let sizes = condensed::sizes(&baked);
    let needs = Needs::with_code(baked.kind(), sizes, instructions);
    let solver = match (condensate.contact, exact) {
        (0, _) => "linear",
        (_, true) => "exact method",
        (_, false) => "sweeps alone",
    };
    let modes = if baked.modes.is_some() { " by modes" } else { "" };
    let bound = if baked.without_bound().is_none() { "" } else { ", no error bound" };
    Ok(Candidate {
        name: format!("condensed{modes}, {solver}{bound}"),
        shortfalls: budget.shortfalls(&needs),
        model: Model::Condensed(Box::new(baked)),
        needs,
        trial,
        staying,
        too_long: worst.filter(|_| is_late(worst)),
        lacks_bound: false,
        unbounded: None,
    })
}

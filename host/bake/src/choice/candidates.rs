//! The variants of the condensed model, each with what it takes, and how many exchanges and sweeps there is time for.

use signorini_contact::dense::blocks::padded;

use super::{Candidate, Model, Origin};
use crate::Bakes;
use crate::budget::{Budget, Needs};
use crate::condensed::{self, Modes, Work};
use crate::costs::Costs;
use crate::dense::{AN_ENTRY, Done};
use crate::narrow::exclusions;
use crate::setting::checked;
use crate::trial::{self, Trial};
use signorini_condense::CondensedModel;
use signorini_problem::functional::windows;
use signorini_problem::inputs::InputSpace;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{Method, Setting};
use signorini_solve::unfit;

/// Sweeps that follow where the exchanges of a tick do not suffice.
const FALLBACK: u32 = 20;
/// Most sweeps of a model without the exact method.
const MOST_SWEEPS: u32 = 1000;

/// The variants of the condensed model: with the bound first, and of two the one that takes less time. Those that leave
/// out a bound that is asked for are no choice.
pub(super) fn of_condensed<R: Bakes>(
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
fn refuse_singular<R: Bakes>(scene: &Scene, condensate: &CondensedModel) -> Result<()> {
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

fn condensed_as<R: Bakes>(
    scene: &Scene,
    origin: &Origin,
    budget: &Budget,
    setting: &Setting,
    [exact, certified]: [bool; 2],
) -> Result<Candidate<R>> {
    let (condensate, costs) = (origin.model(), Costs::measured());
    let all = allowed(setting, condensate, exact);
    let mut baked = narrowed::<R>(scene, origin, all, certified)?.with_setting(setting);
    let of_states =
        baked.steps.as_ref().map_or(0, |of| of.count() * (condensate.contact + baked.inputs));
    let price = baked.price(entries(condensate, baked.modes.as_ref()) + of_states, exact);
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
        // Cut off where time is up: no end is proved.
        _ => baked = baked.with_work(within::<R>(&costs, condensate.contact, all, tried, time)),
    }
    let needs = Needs::with_code(baked.kind(), condensed::sizes(&baked), instructions);
    Ok(Candidate {
        name: name(&baked, exact),
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

/// The model in the scalar of the target.
fn narrowed<R: Bakes>(
    scene: &Scene,
    origin: &Origin,
    all: Work,
    certified: bool,
) -> Result<condensed::Baked<R>> {
    let baked = match (&origin.modes, &origin.steps) {
        (Some(modes), _) => condensed::Baked::<R>::modal(modes, all, certified),
        (None, Some(steps)) => condensed::Baked::<R>::stepped(steps, all, certified),
        (None, None) => condensed::Baked::<R>::new(origin.model(), all, certified),
    };
    let mut baked = baked.map_err(unfit::<R>(scene))?;
    baked.exclusions = exclusions(&origin.exclusions);
    baked.windows = windows(scene);
    Ok(baked)
}

/// A condensed model in a few words.
fn name<R: Bakes>(baked: &condensed::Baked<R>, exact: bool) -> String {
    let solver = match (baked.contact, exact) {
        (0, _) => "linear",
        (_, true) => "exact method",
        (_, false) => "sweeps alone",
    };
    let modes = match (&baked.modes, &baked.steps) {
        (Some(_), _) => " by modes".to_owned(),
        (None, Some(steps)) => format!(" with {} states", steps.count()),
        (None, None) => String::new(),
    };
    let bound = if baked.without_bound().is_none() { "" } else { ", no error bound" };
    format!("condensed{modes}, {solver}{bound}")
}

/// Instructions of a tick in which no edge changes sides, as if every group of eight edges had an open one:
/// then a product costs what a sweep does, and all columns of the bound's factor count, not half of them.
fn fixed<R: Scalar>(
    costs: &Costs,
    condensate: &CondensedModel,
    exact: bool,
    certified: bool,
) -> Option<f64> {
    let of = |stage: &str| costs.of_dense::<R>(stage, condensate.contact);
    let (sweep, product) = (of("sweep")?, of("product, half of x zero")?);
    let solve = if exact { of("exact, no edge changes")? + 2.0 * (sweep - product) } else { sweep };
    let bound = match certified && condensate.certificate.is_ok() {
        true => 2.0 * of("norm of the bound, half of x zero")?,
        false => 0.0,
    };
    Some(AN_ENTRY * entries::<R>(condensate, None) as f64 + solve + bound)
}

/// Entries of loads and outputs, and of what amplitudes of modes are made of: for the load, and once x is known.
fn entries<R>(condensate: &CondensedModel, modes: Option<&Modes<R>>) -> usize {
    let CondensedModel { contact, inputs, outputs, .. } = condensate;
    let n = padded(*contact);
    // The largest amplitudes, with which outputs are refused, take another column.
    let of_modes = modes.map_or(0, |modes| modes.count * 2 * (n + inputs - modes.count));
    n * inputs + outputs.len() * (n + inputs) + of_modes
}

/// What a tick may do where nothing limits its time: the sweeps of the setting, where it has a number; exchanges as
/// many as the proved worst case has at least, twice as many where edges have three sides.
fn allowed(setting: &Setting, model: &CondensedModel, exact: bool) -> Work {
    let of_edge = if model.is_limited() { 4 } else { 2 };
    match exact {
        true => Work { pivots: Some((of_edge * model.contact as u32).max(1)), sweeps: FALLBACK },
        false => Work { pivots: None, sweeps: setting.sweeps.unwrap_or(MOST_SWEEPS) },
    }
}

/// What a tick may do in the time declared: as much as the ticks of a trial did, where all of them had time; one step
/// at least, for what fits no better comes to its end in later ticks. `time`: the instructions of a tick without
/// changes, and those that there are.
fn within<R: Scalar>(
    costs: &Costs,
    contact: usize,
    all: Work,
    tried: Option<Trial>,
    time: Option<(f64, f64)>,
) -> Work {
    let steps = costs.of_dense::<R>("exchange", contact).zip(costs.of_dense::<R>("sweep", contact));
    let (Some((fixed, budget)), Some((pivot, sweep)), true) = (time, steps, contact > 0) else {
        return all;
    };
    let times = |instructions: f64, each: f64| (instructions / each).clamp(0.0, 1e6) as u32;
    let tried = tried.unwrap_or_default();
    let Some(most) = all.pivots else {
        let sweeps = times(budget - fixed, sweep).max(tried.sweeps[1]).clamp(1, all.sweeps);
        return Work { pivots: None, sweeps };
    };
    let sweeps = times(0.25 * (budget - fixed), sweep).clamp(1, all.sweeps);
    let affordable = times(budget - fixed - f64::from(sweeps) * sweep, pivot);
    Work { pivots: Some(affordable.max(tried.pivots[1]).clamp(1, most)), sweeps }
}

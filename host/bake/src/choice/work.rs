//! What a condensed tick costs without changes, and how many exchanges and sweeps that leaves time for.

use signorini_contact::dense::blocks::padded;

use crate::condensed::{Modes, Work};
use crate::costs::Costs;
use crate::trial::Trial;
use signorini_condense::CondensedModel;
use signorini_problem::scalar::Scalar;
use signorini_scene::setting::Setting;

/// Sweeps that follow where the exchanges of a tick do not suffice.
const FALLBACK: u32 = 20;
/// Most sweeps of a model without the exact method.
const MOST_SWEEPS: u32 = 1000;
/// Instructions an entry of a load or an output: two loads, a multiply-add, half of a loop.
const AN_ENTRY: f64 = 4.0;

/// Instructions of a tick in which no edge changes sides, as if every group of eight edges had an open one:
/// then a product costs what a sweep does, and all columns of the bound's factor count, not half of them.
pub(super) fn fixed<R: Scalar>(
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
pub(super) fn entries<R>(condensate: &CondensedModel, modes: Option<&Modes<R>>) -> usize {
    let CondensedModel { contact, inputs, outputs, .. } = condensate;
    let n = padded(*contact);
    // The largest amplitudes, with which outputs are refused, take another column.
    let of_modes = modes.map_or(0, |modes| modes.count * 2 * (n + inputs - modes.count));
    n * inputs + outputs.len() * (n + inputs) + of_modes
}

/// What a tick may do where nothing limits its time: the sweeps of the setting, where it has a number; exchanges as many as
/// the proved worst case has at least, twice as many where edges have three sides.
pub(super) fn allowed(setting: &Setting, model: &CondensedModel, exact: bool) -> Work {
    let of_edge = if model.is_limited() { 4 } else { 2 };
    match exact {
        true => Work { pivots: Some((of_edge * model.contact as u32).max(1)), sweeps: FALLBACK },
        false => Work { pivots: None, sweeps: setting.sweeps.unwrap_or(MOST_SWEEPS) },
    }
}

/// What a tick may do in the time declared: as much as the ticks of a trial did, where all of them had time; one step at
/// least, for what fits no better comes to its end in later ticks. `time`: the instructions of a tick without changes, and
/// those that there are.
pub(super) fn within<R: Scalar>(
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

//! Lines that `signorini tick` prints of its ticks.

use std::path::Path;

use signorini_files::digits::rounded;
use signorini_files::stated::around;
use signorini_problem::Problem;
use signorini_problem::progress::say;
use signorini_scene::scene::{Output, Quantity, Scene};
use signorini_session::tick::TickRecord;
use signorini_solve::Ending;

/// Digits of an output.
const DIGITS: usize = 4;

pub(super) fn report(problem: &Problem, model: &str, ticks: &[TickRecord], out: &Path) {
    let [first, .., last] = [ticks.first(), ticks.last()].map(|tick| tick.map_or(0.0, |t| t.time));
    let unknowns = problem.topology.counts.unknowns();
    say(format_args!("{}", problem.scene.title));
    say(format_args!("  {unknowns} unknowns, {} ticks from t = {first} to {last}", ticks.len()));
    say(format_args!("  model: {model}"));
    let mut sweeps: Vec<u32> = ticks.iter().map(|tick| tick.sweeps).collect();
    let cold = sweeps.first().copied().unwrap_or(0);
    sweeps.sort_unstable();
    let (median, most) = (sweeps[sweeps.len() / 2], sweeps[sweeps.len() - 1]);
    say(format_args!(
        "  sweeps a tick: {cold} at the first, {median} in the median, {most} at most"
    ));
    say(format_args!("  {}", endings(ticks)));
    output_lines(&problem.scene, ticks).iter().for_each(|line| say(format_args!("  {line}")));
    say(format_args!("  written to {}", out.display()));
}

/// Each output in the last tick that has it, with its interval, of an evolution where there is one, and from where to where it went.
fn output_lines(scene: &Scene, ticks: &[TickRecord]) -> Vec<String> {
    let line = |(at, output): (usize, &Output)| {
        let values = ticks.iter().filter_map(|tick| Some((tick, (*tick.outputs.get(at)?)?)));
        let (last, value) = values.clone().next_back()?;
        let [least, most] = [f64::min, f64::max]
            .map(|of| values.clone().map(|(_, value)| value).fold(value, of))
            .map(|value| rounded(value, DIGITS, 0.0));
        let unit = output.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
        let step = last.intervals.get(at).and_then(|of| of.as_ref().ok().copied());
        let known = if scene.stores() { last.over_time.get(at).copied().flatten() } else { step };
        let known = known.map_or_else(String::new, |[least, most]| {
            let middle = least + 0.5 * (most - least);
            let half = (most - middle).max(middle - least);
            let half = if half > 0.0 { half.next_up() } else { 0.0 };
            format!("; {} is guaranteed", around(middle, half))
        });
        Some(format!(
            "{} {}{unit} at t = {}{known}; {least} to {most} in all ticks that have it",
            output.name.value,
            rounded(value, DIGITS, 0.0),
            last.time
        ))
    };
    scene.outputs.iter().enumerate().filter_map(line).collect()
}

/// Why outputs have no interval, those of one reason together, the first of each; lengths never have one.
pub(super) fn without_interval(scene: &Scene, ticks: &[TickRecord]) -> Vec<String> {
    let has_none = |of: &Output| {
        matches!(of.quantity, Quantity::Length | Quantity::Saturated | Quantity::Window)
    };
    let outputs = scene.outputs.iter().enumerate().filter(|(_, of)| !has_none(of));
    let mut all = Vec::<(String, usize, Vec<&str>)>::new();
    for (at, output) in outputs {
        // Where the evolution has one, nothing is missed that a step alone would have.
        if ticks.iter().any(|tick| tick.over_time.get(at).is_some_and(Option::is_some)) {
            continue;
        }
        let reasons = ticks.iter().filter_map(|tick| tick.intervals.get(at)?.as_ref().err());
        let (Some(first), count) = (reasons.clone().next(), reasons.count()) else { continue };
        match all.iter_mut().find(|(reason, of, _)| reason == first && *of == count) {
            Some((.., names)) => names.push(&output.name.value),
            None => all.push((first.clone(), count, vec![&output.name.value])),
        }
    }
    let line = |(reason, count, names): (String, usize, Vec<&str>)| {
        let (names, all) = (names.join(", "), ticks.len());
        format!("no interval of {names} in {count} of {all} ticks: {reason}")
    };
    all.into_iter().map(line).collect()
}

/// That errors against [exact] are above their bounds by more than quadrature and rounding explain.
pub(super) fn contradiction(ticks: &[TickRecord]) -> Option<String> {
    /// Parts of a bound, and roundings, that may be due to the rule that measures errors.
    const ALLOWED: [f64; 2] = [1.05, 100.0];
    let above = |tick: &&TickRecord| {
        let Some(bound) = &tick.bound else { return false };
        let is_above =
            |error: f64, most: f64| error > ALLOWED[0] * most + ALLOWED[1] * bound.rounding;
        let steady = tick.combined.is_some_and(|error| is_above(error, bound.total));
        let window = tick.window_error.zip(tick.window);
        steady || window.is_some_and(|(error, [energy, _])| is_above(error, energy))
    };
    let (first, count) = (ticks.iter().find(above)?, ticks.iter().filter(above).count());
    Some(format!(
        "in {count} of {} ticks, the first at t = {}, the error against [exact] is above its bound. Either [exact] is not the \
         solution of these data, inputs and start, or the bound is wrong",
        ticks.len(),
        first.time
    ))
}

/// That steps of a controller have lost their bound over time; steps in the desk's own ticks say why they have none.
pub(super) fn without_window(scene: &Scene, ticks: &[TickRecord]) -> Option<String> {
    let is_asked = scene.setting.is_none_or(|setting| setting.certificate);
    // A stated start has none: weights fade into a past that is not there.
    let without = |tick: &&TickRecord| {
        let is_answer = tick.status != Ending::Start && tick.contact_force.is_some();
        is_asked && is_answer && tick.window.is_none()
    };
    let first = ticks.iter().find(without).filter(|_| scene.stores())?;
    let count = ticks.iter().filter(without).count();
    Some(format!(
        "no bound over time in {count} of {} ticks, the first at t = {}: a step has no bound there, or nothing tells how the past fades. It does not come back",
        ticks.len(),
        first.time
    ))
}

/// How many ticks ended in which way, in the order of their first.
fn endings(ticks: &[TickRecord]) -> String {
    let mut counts: Vec<(Ending, usize)> = Vec::new();
    for tick in ticks {
        match counts.iter_mut().find(|(status, _)| *status == tick.status) {
            Some((_, count)) => *count += 1,
            None => counts.push((tick.status, 1)),
        }
    }
    let parts = counts.iter().map(|(status, count)| format!("{count} {}", status.name()));
    parts.collect::<Vec<_>>().join(", ")
}

//! Ticks at t = 0, step, 2·step, … from `[time]` of the scene.

use super::ScheduledTick;
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::{Scene, Time};
use signorini_solve::step_of;

/// Most ticks of one run: each is kept until all are written.
pub const MOST: u32 = 1_000_000;

/// How far `end` may lie below the last tick, in steps: what rounding leaves of end/step.
const ROUNDING: f64 = 1e-9;

/// The moments of the scene, or `count` of them, after the one at the time `last` where there is one; without `[time]` the step is 1.
///
/// # Errors
/// Neither `[time]` nor a count; more than [`MOST`] ticks; an end that `last` has reached.
pub fn moments_after(
    scene: &Scene,
    count: Option<u32>,
    last: Option<f64>,
) -> Result<Vec<ScheduledTick>> {
    let (step, end) =
        scene.time.as_ref().map_or((1.0, None), |Time { step, end, .. }| (*step, *end));
    let (base, number) = last.map_or((0.0, 0), |last| last_tick(last, step));
    // A step in time ends at its moment, and the start is none.
    let first = number + u32::from(scene.stores() || last.is_some());
    let early = |end: f64| {
        let (what, hint) = match last {
            Some(last) => (format!("next tick, the last was at {last}"), "give --ticks N"),
            None => (
                format!("end of the first step, {step}"),
                "take a shorter --step, or give --ticks N",
            ),
        };
        let message = format!("time.end: {end} comes before the {what}");
        InputError::new(message).file(&scene.path).hint(hint)
    };
    let count = match (count, end) {
        (Some(count), _) => count,
        (None, Some(end)) if end < step => return Err(early(end).into()),
        (None, Some(end)) => match up_to(scene, [step, end - base], first)? {
            0 => return Err(early(end).into()),
            count => count,
        },
        (None, None) => {
            let (what, hint) = match scene.time {
                Some(_) => (
                    "time.end: missing; it says when the last tick is",
                    "give it, or --ticks N or --log FILE",
                ),
                None if scene.stores() => (
                    "time: missing; it says how long a step is, and when the last one ends",
                    "add [time] with step and end to the scene, or give --step DT with --ticks N or --log FILE",
                ),
                None => (
                    "time: missing; it says when the ticks are",
                    "add [time] with step and end to the scene, or give --ticks N or --log FILE",
                ),
            };
            let error = InputError::new(what);
            return Err(error.file(&scene.path).hint(hint).into());
        }
    };
    Ok((first..first + count)
        .map(|tick| ScheduledTick { time: base + time_of(tick, step), inputs: Vec::new() })
        .collect())
}

/// Refuses moments of steps in time that do not follow each other, and the one at `last`, by the scene's step, which the matrix is
/// made for.
///
/// # Errors
/// The first that does not, with its time; no step.
pub fn check_steps(scene: &Scene, last: Option<f64>, moments: &[ScheduledTick]) -> Result<()> {
    if !scene.stores() {
        return Ok(());
    }
    let step = step_of(scene)?;
    let follows = |pair: &[f64]| {
        let slack = 1e-6 * step + 4.0 * f64::EPSILON * pair[1].abs();
        (pair[1] - pair[0] - step).abs() <= slack
    };
    let times: Vec<f64> =
        last.into_iter().chain(moments.iter().map(|moment| moment.time)).collect();
    let Some(pair) = times.windows(2).find(|pair| !follows(pair)) else { return Ok(()) };
    let [before, time] = [pair[0], pair[1]];
    let message =
        format!("t: {time} comes {} after {before}, expected the step {step}", time - before);
    let hint = "a material has a capacity: ticks follow each other by time.step, or by --step";
    Err(Error::from(InputError::new(message).hint(hint)).at_time(time))
}

/// Ticks from the one with the number `first` to `end`, both among them.
fn up_to(scene: &Scene, [step, end]: [f64; 2], first: u32) -> Result<u32> {
    let ticks = (end / step + ROUNDING).floor() + 1.0 - f64::from(first);
    if ticks <= f64::from(MOST) {
        return Ok(ticks as u32);
    }
    let message = format!("time: {end:?} s in steps of {step:?} s are more than {MOST} ticks");
    Err(InputError::new(message).file(&scene.path).hint("give fewer with --ticks N").into())
}

/// Where times count from after a tick at `last`, and its number there: from 0 where it is a tick of the schedule, and from itself
/// where a log had it.
fn last_tick(last: f64, step: f64) -> (f64, u32) {
    let number = (last / step).round();
    let is_one = (0.0..=f64::from(u32::MAX - MOST)).contains(&number);
    match is_one && time_of(number as u32, step) == last {
        true => (0.0, number as u32),
        false => (last, 0),
    }
}

/// Tick · step; where the step is 1/m, tick/m, which rounds once and reads 0.3 and not
/// 0.30000000000000004.
fn time_of(tick: u32, step: f64) -> f64 {
    let rate = step.recip().round();
    if rate * step == 1.0 { f64::from(tick) / rate } else { f64::from(tick) * step }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps in time end at their moments, so that the start is none; an end before the first step is no schedule.
    #[test]
    fn steps_in_time_begin_after_the_start() {
        let of = |capacity: f64, step: f64| {
            let text = format!(
                "mesh = \"m\"\n[material.default]\nconductivity = 1\ncapacity = {capacity}\n\
                 [boundary.default]\nkind = \"contact\"\n[time]\nstep = 0.5\nend = 1\n"
            );
            let mut scene = Scene::parse(&text, std::path::Path::new("s.toml")).unwrap();
            scene.time.as_mut().unwrap().step = step;
            moments_after(&scene, None, None)
                .map(|all| all.iter().map(|of| of.time).collect::<Vec<_>>())
        };
        assert_eq!(of(0.0, 0.5).unwrap(), [0.0, 0.5, 1.0]);
        assert_eq!(of(2.0, 0.5).unwrap(), [0.5, 1.0]);
        assert!(of(2.0, 3.0).unwrap_err().to_string().contains("time.end: 1 comes before"));
        let many = of(2.0, 1e-320).unwrap_err().to_string();
        assert!(many.contains("1.0 s in steps of 1e-320 s are more than 1000000 ticks"), "{many}");
    }

    /// Ticks after a saved one are those of a schedule without a break; after one of a log they count from it.
    #[test]
    fn a_schedule_goes_on_after_its_last_tick() {
        let text = "mesh = \"m\"\n[material.default]\nconductivity = 1\n\
                    [boundary.default]\nkind = \"contact\"\n[time]\nstep = 0.1\nend = 1\n";
        let scene = Scene::parse(text, std::path::Path::new("s.toml")).unwrap();
        let of = |count: Option<u32>, last: Option<f64>| {
            let all = moments_after(&scene, count, last)?;
            Ok::<_, Error>(all.iter().map(|of| of.time).collect::<Vec<_>>())
        };
        let whole = of(None, None).unwrap();
        assert_eq!(whole.len(), 11);
        for last in 0..10 {
            assert_eq!(of(None, Some(whole[last])).unwrap(), whole[last + 1..]);
        }
        assert_eq!(of(Some(2), Some(1.0)).unwrap(), [1.1, 1.2]);
        assert_eq!(of(Some(2), Some(-0.25)).unwrap(), [-0.25 + 0.1, -0.25 + 0.2]);
        assert_eq!(of(None, Some(0.75)).unwrap(), [0.75 + 0.1, 0.75 + 0.2]);
        let said = of(None, Some(1.0)).unwrap_err().to_string();
        assert!(said.contains("time.end: 1 comes before the next tick"), "{said}");
    }

    #[test]
    fn times_are_as_one_would_write_them() {
        assert_eq!([1, 2, 3].map(|tick| time_of(tick, 0.1)), [0.1, 0.2, 0.3]);
        assert_eq!(time_of(3, 2.5), 7.5);
        assert_eq!(time_of(7, f64::MIN_POSITIVE), 7.0 * f64::MIN_POSITIVE);
    }
}

//! Ticks at t = 0, step, 2·step, … from `[time]` of the scene.

use super::ScheduledTick;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::{Scene, Time};

/// Most ticks of one run: each is kept until all are written.
pub const MOST: u32 = 1_000_000;

/// How far `end` may lie below the last tick, in steps: what rounding leaves of end/step.
const ROUNDING: f64 = 1e-9;

/// The moments of the scene, or `count` of them; without `[time]` the step is 1.
///
/// # Errors
/// Neither `[time]` nor a count; more than [`MOST`] ticks.
pub fn moments(scene: &Scene, count: Option<u32>) -> Result<Vec<ScheduledTick>> {
    let (step, end) =
        scene.time.as_ref().map_or((1.0, None), |Time { step, end, .. }| (*step, *end));
    // A step in time ends at its moment, and the start is none.
    let first = u32::from(scene.stores());
    let count = match (count, end) {
        (Some(count), _) => count,
        (None, Some(end)) if end < step => {
            let message = format!("time.end: {end} comes before the end of the first step, {step}");
            let error = InputError::new(message).file(&scene.path);
            return Err(error.hint("take a shorter --step, or give --ticks N").into());
        }
        (None, Some(end)) => up_to_end(scene, [step, end])? - first,
        (None, None) => {
            let hint = "add [time] with step and end to the scene, or give --ticks N or --log FILE";
            let error = InputError::new("time: missing; it says when the ticks are");
            return Err(error.file(&scene.path).hint(hint).into());
        }
    };
    Ok((first..first + count)
        .map(|tick| ScheduledTick { time: time_of(tick, step), inputs: Vec::new() })
        .collect())
}

/// Ticks from t = 0 to `end`, both among them.
fn up_to_end(scene: &Scene, [step, end]: [f64; 2]) -> Result<u32> {
    let ticks = (end / step + ROUNDING).floor() + 1.0;
    if ticks <= f64::from(MOST) {
        return Ok(ticks as u32);
    }
    let message = format!("time: {end} s in steps of {step} s are more than {MOST} ticks");
    Err(InputError::new(message).file(&scene.path).hint("give fewer with --ticks N").into())
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
            moments(&scene, None).map(|all| all.iter().map(|of| of.time).collect::<Vec<_>>())
        };
        assert_eq!(of(0.0, 0.5).unwrap(), [0.0, 0.5, 1.0]);
        assert_eq!(of(2.0, 0.5).unwrap(), [0.5, 1.0]);
        assert!(of(2.0, 3.0).unwrap_err().to_string().contains("time.end: 1 comes before"));
    }

    #[test]
    fn times_are_as_one_would_write_them() {
        assert_eq!([1, 2, 3].map(|tick| time_of(tick, 0.1)), [0.1, 0.2, 0.3]);
        assert_eq!(time_of(3, 2.5), 7.5);
        assert_eq!(time_of(7, f64::MIN_POSITIVE), 7.0 * f64::MIN_POSITIVE);
    }
}

//! The ticks as the report draws them: one diagram a quantity, all over the same time.

use signorini_draw::{Band, Chart, Curve, Strip};
use signorini_scene::scene::{Quantity, Scene};
use signorini_session::tick::TickRecord;

/// Collects the picture of `ticks`, with the budget of sweeps where there was one.
pub fn picture(scene: &Scene, ticks: &[TickRecord], budget: Option<u32>) -> Chart {
    let curve = |label: &str, pick: &dyn Fn(&TickRecord) -> Option<f64>| Curve {
        label: label.to_owned(),
        values: ticks.iter().map(pick).collect(),
        ..Curve::default()
    };
    let strip = |curve: Curve| Strip { curves: vec![curve], ..Strip::default() };
    let mut strips = vec![
        strip(curve("contact force ∫(σ·n − q)", &|tick| tick.contact_force)),
        strip(curve("contact length", &|tick| tick.contact_length)),
    ];
    strips.extend(scene.outputs.iter().enumerate().map(|(at, output)| {
        let unit = output.unit.as_ref().map_or_else(String::new, |unit| format!(" [{unit}]"));
        let label = format!("{}{unit}", output.name.value);
        let values = curve(&label, &|tick| tick.outputs.get(at).copied().flatten());
        let anew = |tick: &TickRecord| Some(*tick.intervals.get(at)?.as_ref().ok()?);
        let evolved = |tick: &TickRecord| tick.over_time.get(at).copied().flatten();
        let is_over_time = ticks.iter().any(|tick| evolved(tick).is_some());
        let ends: Vec<_> = match is_over_time {
            true => ticks.iter().map(evolved).collect(),
            false => ticks.iter().map(anew).collect(),
        };
        // The interval of a probe is around another number than the curve: the mean over its cell.
        let is_drawn =
            !matches!(output.quantity, Quantity::Probe { .. }) && ends.iter().any(Option::is_some);
        let of = match (scene.stores(), is_over_time) {
            (false, _) => "",
            (true, false) => " of this step",
            (true, true) => " over time",
        };
        let label = format!("the exact value{of} lies within");
        let band = is_drawn.then_some(Band { label, ends });
        Strip { band, ..strip(values) }
    }));
    let total = |tick: &TickRecord| tick.bound.map(|bound| bound.total);
    let curves = match scene.stores() {
        false => vec![curve("error bound", &total), curve("true error", &|tick| tick.combined)],
        true => vec![
            curve("bound of a step", &total),
            curve("bound over time", &|tick| tick.window.map(|[energy, _]| energy)),
            curve("error over time", &|tick| tick.window_error),
        ],
    };
    strips.push(Strip { curves, logarithmic: true, ..Strip::default() });
    let sweeps = curve("sweeps a tick", &|tick| Some(f64::from(tick.sweeps)));
    let limit = budget.map(|sweeps| (format!("budget: {sweeps} sweeps"), f64::from(sweeps)));
    strips.push(Strip { curves: vec![sweeps], limit, ..Strip::default() });
    Chart {
        title: scene.title.clone(),
        across: "t".to_owned(),
        at: ticks.iter().map(|tick| tick.time).collect(),
        strips,
    }
}

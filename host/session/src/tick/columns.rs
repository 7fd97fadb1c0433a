//! `ticks.csv` and `output_bounds.csv`: one line a tick.

use std::collections::BTreeSet;

use super::TickRecord;
use super::window_error::has_window_error;
use signorini_scene::error::Result;
use signorini_scene::scene::{Output, Quantity, Scene};

/// Refuses outputs whose name would stand twice above the columns of a table.
///
/// # Errors
/// The first such output.
pub fn check_names(scene: &Scene) -> Result<()> {
    let header = header(scene);
    let mut bounds = BTreeSet::new();
    for output in &scene.outputs {
        let name = &output.name;
        let columns = header.iter().filter(|of| **of == name.value).count();
        let mut of_bounds = BTreeSet::from(bounded_names(scene, output)).into_iter();
        let table = match () {
            () if columns > 1 => "ticks.csv",
            () if of_bounds.any(|name| !bounds.insert(name)) => "output_bounds.csv",
            () => continue,
        };
        let message = format!("{table} has a column of this name");
        return Err(scene.error(name, message).hint("give the output another name").into());
    }
    Ok(())
}

/// The columns of `ticks.csv`.
fn header(scene: &Scene) -> Vec<&str> {
    let fixed = ["t", "status", "sweeps", "contact_force", "contact_length", "error_bound"];
    let combined = has_combined(scene).then_some("error_combined");
    let outputs = scene.outputs.iter().map(|output| output.name.value.as_str());
    let window = ["window_energy", "window_seconds"].into_iter().filter(|_| scene.stores());
    let error = (scene.stores() && has_window_error(scene)).then_some("window_error");
    fixed.into_iter().chain(combined).chain(outputs).chain(window).chain(error).collect()
}

/// The exact solution is that of the evolution, and a bound that of a step.
fn has_combined(scene: &Scene) -> bool {
    scene.exact.is_some() && !scene.stores()
}

/// What stands above the intervals of an output over time, and above those of each tick by itself.
fn bounded_names(scene: &Scene, output: &Output) -> [String; 2] {
    let of_step = if scene.stores() { "_step" } else { "" };
    let cell = if matches!(output.quantity, Quantity::Probe { .. }) { "_cell" } else { "" };
    let name = &output.name.value;
    [name.clone(), format!("{name}{cell}{of_step}")]
}

/// The text of `ticks.csv`:
/// `t,status,sweeps,contact_force,contact_length,error_bound[,error_combined]` and a column for each
/// declared output, and of steps in time `window_energy,window_seconds[,window_error]`; the combined error only where the scene knows its exact solution and no material stores u. A value that
/// does not exist is an empty field.
pub fn ticks_csv(scene: &Scene, ticks: &[TickRecord]) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let names = header(scene);
    writer.write_record(&names)?;
    for tick in ticks {
        let mut fields =
            vec![digits(tick.time), tick.status.name().to_owned(), tick.sweeps.to_string()];
        let bound = tick.bound.map(|bound| bound.total);
        let combined = has_combined(scene).then_some(tick.combined);
        let numbers = [tick.contact_force, tick.contact_length, bound].into_iter().chain(combined);
        let numbers = numbers.chain(tick.outputs.iter().copied());
        let [energy, seconds] = tick.window.map_or([None; 2], |window| window.map(Some));
        let numbers = numbers.chain([energy, seconds, tick.window_error]);
        let left = names.len() - fields.len();
        fields.extend(numbers.take(left).map(|number| number.map_or(String::new(), digits)));
        writer.write_record(fields)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

/// The text of `output_bounds.csv`: `t`, and `NAME_least` and `NAME_most` of each output whose exact value is known to lie between;
/// of a probe `NAME_cell_least` and `NAME_cell_most`, around the mean over its cell. Of steps in time these are `NAME_step_…`, about
/// the step alone, and those without are about the evolution.
pub fn bounds_csv(scene: &Scene, ticks: &[TickRecord]) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let columns = bounded(scene, ticks);
    let names =
        columns.iter().flat_map(|(name, _)| ["least", "most"].map(|end| format!("{name}_{end}")));
    writer.write_record(std::iter::once("t".to_owned()).chain(names))?;
    for (row, tick) in ticks.iter().enumerate() {
        let ends = columns.iter().flat_map(|(_, intervals)| match intervals[row] {
            Some(ends) => ends.map(digits),
            None => [String::new(), String::new()],
        });
        writer.write_record(std::iter::once(digits(tick.time)).chain(ends))?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

/// A name and the interval of each tick, for all that is bounded in some tick.
fn bounded(scene: &Scene, ticks: &[TickRecord]) -> Vec<(String, Vec<Option<[f64; 2]>>)> {
    let columns = scene.outputs.iter().enumerate().flat_map(|(at, output)| {
        let over_time = ticks.iter().map(|tick| tick.over_time.get(at).copied().flatten());
        let anew = ticks.iter().map(|tick| tick.intervals.get(at)?.as_ref().ok().copied());
        let [evolution, step] = bounded_names(scene, output);
        [(evolution, over_time.collect::<Vec<_>>()), (step, anew.collect())]
    });
    columns.filter(|(_, intervals)| intervals.iter().any(Option::is_some)).collect()
}

/// The shortest text that reads back as the same number; −0 is 0.
fn digits(x: f64) -> String {
    format!("{:?}", x + 0.0)
}

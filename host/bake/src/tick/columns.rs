//! `ticks.csv`: one line a tick.

use super::TickRecord;
use signorini_scene::scene::Scene;

/// The text of `ticks.csv`:
/// `t,status,sweeps,contact_force,contact_length,error_bound[,error_combined]`, a column for each
/// declared output, and `NAME_least` and `NAME_most` for each whose exact value is known to lie between; the combined error
/// only where the scene knows its exact solution. A value that does not exist is an empty field.
pub fn ticks_csv(scene: &Scene, ticks: &[TickRecord]) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let fixed = ["t", "status", "sweeps", "contact_force", "contact_length", "error_bound"];
    let combined = scene.exact.iter().map(|_| "error_combined");
    let outputs = scene.outputs.iter().map(|output| output.name.value.as_str());
    let bounded = |at: &usize| ticks.iter().any(|tick| tick.intervals[*at].is_some());
    let bounded: Vec<usize> = (0..scene.outputs.len()).filter(bounded).collect();
    let named = |&at: &usize| {
        let name = &scene.outputs[at].name.value;
        [format!("{name}_least"), format!("{name}_most")]
    };
    let ends: Vec<String> = bounded.iter().flat_map(named).collect();
    let ends_of_interval = ends.iter().map(String::as_str);
    let header = fixed.into_iter().chain(combined).chain(outputs).chain(ends_of_interval);
    writer.write_record(header)?;
    for tick in ticks {
        let mut fields = vec![digits(tick.time), tick.status.to_owned(), tick.sweeps.to_string()];
        let bound = tick.bound.map(|bound| bound.total);
        let combined = scene.exact.iter().map(|_| tick.combined);
        let numbers = [tick.contact_force, tick.contact_length, bound].into_iter().chain(combined);
        let ends = bounded.iter().flat_map(|&at| match tick.intervals[at] {
            Some(ends) => ends.map(Some),
            None => [None; 2],
        });
        let numbers = numbers.chain(tick.outputs.iter().copied()).chain(ends);
        fields.extend(numbers.map(|number| number.map_or(String::new(), digits)));
        writer.write_record(fields)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

/// The shortest text that reads back as the same number; −0 is 0.
fn digits(x: f64) -> String {
    format!("{:?}", x + 0.0)
}

//! A field log: when a device ticked and what its inputs were, as CSV.
//!
//! ```text
//!   t,rain,river
//!   0,0,0
//!   0.01,2,0.5
//! ```
//! The first column is the time, which increases; the others are inputs of the scene.

use std::path::Path;

use csv::{Reader, ReaderBuilder, StringRecord, Trim};

use super::ScheduledTick;
use super::schedule::{self, MOST};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::Scene;

const SHAPE: &str = "a log is a CSV file: a line t,NAME,… with inputs of the scene, then numbers";

/// Reads the log at `path`, of ticks that go on after the one at the time `last`, where there is one.
///
/// # Errors
/// A file that cannot be read or holds no tick, a column that is no input or comes twice, a value
/// that is no finite number or outside its input's range, a time that does not increase; each with its line.
pub fn read_after(path: &Path, scene: &Scene, last: Option<f64>) -> Result<Vec<ScheduledTick>> {
    let wrong = |error: csv::Error| refused(path, &error);
    let mut reader = ReaderBuilder::new().trim(Trim::All).from_path(path).map_err(wrong)?;
    let columns = columns(&mut reader, path, scene)?;
    let mut moments: Vec<ScheduledTick> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(wrong)?;
        let line = record.position().map_or(0, |position| position.line() as usize);
        let at_line = |message: String| InputError::new(message).file(path).line(line);
        let moment =
            moment(&record, &columns, scene).map_err(|message| at_line(message).hint(SHAPE))?;
        if let Some(last) = moments.last().filter(|last| last.time >= moment.time) {
            let message = format!("t: {} does not come after {}", moment.time, last.time);
            return Err(at_line(message).hint("lines are ordered by time, each once").into());
        }
        if moments.len() as u32 == MOST {
            return Err(at_line(format!("more than {MOST} ticks")).hint("split the log").into());
        }
        moments.push(moment);
    }
    schedule::check_steps(scene, last, &moments).map_err(|error| blamed(path, error))?;
    if moments.is_empty() {
        return Err(InputError::new("no tick in the log").file(path).line(1).hint(SHAPE).into());
    }
    Ok(moments)
}

/// Reports an error at time t as an error of the line of the log whose inputs made it so.
#[must_use]
pub fn blamed(path: &Path, error: Error) -> Error {
    let Error::Input(error) = error else { return error };
    match error.time().and_then(|time| line_of(path, time)) {
        Some(line) => error.moved(path, line).into(),
        None => Error::Input(error),
    }
}

/// The line of a log that was read before with this time.
fn line_of(path: &Path, time: f64) -> Option<usize> {
    let mut reader = ReaderBuilder::new().trim(Trim::All).from_path(path).ok()?;
    let mut records = reader.records().filter_map(std::result::Result::ok);
    let is_then = |record: &StringRecord| record.get(0).and_then(|t| t.parse().ok()) == Some(time);
    let record = records.find(is_then)?;
    record.position().map(|position| position.line() as usize)
}

/// A column behind the first: its name and the input.
type Column = (String, usize);

fn columns(reader: &mut Reader<std::fs::File>, path: &Path, scene: &Scene) -> Result<Vec<Column>> {
    let header = reader.headers().map_err(|error| refused(path, &error))?;
    let error = |message: String| InputError::new(message).file(path).line(1);
    if header.get(0) != Some("t") {
        let found = header.get(0).unwrap_or_default();
        let message = format!("the first column is `{found}`, expected `t`");
        return Err(error(message).hint(SHAPE).into());
    }
    let mut columns: Vec<Column> = Vec::new();
    for name in header.iter().skip(1) {
        let Some(input) = scene.find_input(name) else {
            let message = format!("column `{name}`: no such input in the scene");
            return Err(error(message).hint(scene.known_inputs()).into());
        };
        if columns.iter().any(|&(_, other)| other == input) {
            return Err(error(format!("column `{name}` comes twice")).hint("keep one").into());
        }
        columns.push((name.to_owned(), input));
    }
    Ok(columns)
}

fn moment(
    record: &StringRecord,
    columns: &[Column],
    scene: &Scene,
) -> std::result::Result<ScheduledTick, String> {
    let mut fields = record.iter();
    let time = number("t", fields.next().unwrap_or_default())?;
    let inputs = columns.iter().zip(fields);
    let inputs = inputs.map(|((name, input), field)| {
        let value = number(name, field)?;
        match scene.inputs[*input].refusal(value) {
            Some(refusal) => Err(format!("{name}: {refusal}")),
            None => Ok((*input, value)),
        }
    });
    Ok(ScheduledTick { time, inputs: inputs.collect::<std::result::Result<_, String>>()? })
}

fn number(column: &str, field: &str) -> std::result::Result<f64, String> {
    match field.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!("{column}: `{field}` is not finite")),
        Err(_) => Err(format!("{column}: `{field}` is not a number")),
    }
}

/// Reports an error of the CSV reader in one sentence with file and line.
fn refused(path: &Path, error: &csv::Error) -> InputError {
    let message = match error.kind() {
        csv::ErrorKind::Io(cause) => cause.to_string(),
        csv::ErrorKind::Utf8 { .. } => "not UTF-8 text".to_owned(),
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} fields, expected {expected_len} as in the first line")
        }
        _ => error.to_string(),
    };
    let refused = InputError::new(message).file(path).hint(SHAPE);
    match error.position() {
        Some(position) => refused.line(position.line() as usize),
        None => refused,
    }
}

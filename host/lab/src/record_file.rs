//! Records as files: JSON with a line for each item, and back; CSV with a column for each field.

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use signorini_scene::{Error, Result};

/// The record at `path`; none where there is no file.
///
/// # Errors
/// A file that is no record of `what`, with its name and the command that writes it.
pub fn read<T: DeserializeOwned>(path: &Path, what: &str, command: &str) -> Result<Option<T>> {
    if !path.is_file() {
        return Ok(None);
    }
    let text = std::fs::read_to_string(path).map_err(Error::io(path))?;
    serde_json::from_str(&text).map(Some).map_err(|cause| {
        let name = path.display();
        Error::Check(format!("{name}: no record of {what}: {cause}; run `{command}` again"))
    })
}

/// An object as JSON, a line for each item of its arrays.
pub fn json<T: Serialize>(record: &T) -> String {
    let Ok(Value::Object(keys)) = serde_json::to_value(record) else { return String::new() };
    let value = |value: &Value| match value {
        Value::Array(items) if !items.is_empty() => {
            let lines: Vec<_> = items.iter().map(|item| format!("    {item}")).collect();
            format!("[\n{}\n  ]", lines.join(",\n"))
        }
        other => other.to_string(),
    };
    let lines: Vec<_> = keys.iter().map(|(key, of)| format!("  {key:?}: {}", value(of))).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// An object as JSON, indented.
pub fn indented(record: &impl Serialize) -> String {
    serde_json::to_string_pretty(record).unwrap_or_default() + "\n"
}

/// The text of the CSV file `name`, a line for each row; an empty field for what does not exist.
pub fn csv(name: &str, rows: &[impl Serialize]) -> Result<Vec<u8>> {
    let failed = |error: String| Error::Check(format!("{name}: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).map_err(|error| failed(error.to_string()))?;
    }
    writer.into_inner().map_err(|error| failed(error.to_string()))
}

/// The word that stands for one of several kinds in records and scenes.
pub fn word(kind: &impl Serialize) -> String {
    match serde_json::to_value(kind) {
        Ok(Value::String(word)) => word,
        _ => String::new(),
    }
}

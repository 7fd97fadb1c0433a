//! Records in git: text, compared or with `--bless` written anew, and typed records as JSON.

use serde::Serialize;
use serde::de::DeserializeOwned;
use signorini_image::cargo::root;
use signorini_image::files;

/// The text of a file below the root.
pub fn read(path: &str) -> Result<String, String> {
    files::text(&root().join(path))
}

/// `Ok` where the file at `path` holds `text`.
pub fn snapshot(path: &str, text: &str, bless: bool) -> Result<(), String> {
    if bless {
        return write(path, text);
    }
    let recorded = read(path)?;
    // Git may have given the lines other ends.
    let pairs = recorded.lines().map(Some).chain([None]).zip(text.lines().map(Some).chain([None]));
    match pairs.enumerate().find(|(_, (old, new))| old != new) {
        None => Ok(()),
        Some((at, (old, new))) => Err(format!(
            "{path}, line {}: recorded `{}`, now `{}`; --bless where that is meant",
            at + 1,
            old.unwrap_or_default(),
            new.unwrap_or_default()
        )),
    }
}

/// Writes the record.
pub fn write(path: &str, text: &str) -> Result<(), String> {
    files::write(&root().join(path), text)?;
    println!("written: {path}");
    Ok(())
}

/// The typed record in a file; the empty one where there is no file.
pub fn record<T: Default + DeserializeOwned>(path: &str) -> Result<T, String> {
    if !root().join(path).is_file() {
        return Ok(T::default());
    }
    serde_json::from_str(&read(path)?).map_err(|error| format!("{path}: {error}"))
}

/// Writes a typed record.
pub fn write_record(path: &str, record: &impl Serialize) -> Result<(), String> {
    let text = serde_json::to_string_pretty(record).map_err(|error| format!("{path}: {error}"))?;
    write(path, &(text + "\n"))
}

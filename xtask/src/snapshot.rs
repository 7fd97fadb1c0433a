//! Text that is recorded in git: compared, or with `--bless` written anew.

use std::fs;

use signorini_image::cargo::root;

/// The text of a file below the root.
pub fn read(path: &str) -> Result<String, String> {
    fs::read_to_string(root().join(path)).map_err(|error| format!("{path}: {error}"))
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
    let file = root().join(path);
    fs::create_dir_all(file.parent().unwrap_or(root())).map_err(|error| error.to_string())?;
    fs::write(&file, text).map_err(|error| format!("{path}: {error}"))?;
    println!("written: {path}");
    Ok(())
}

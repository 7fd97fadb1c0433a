//! The files that a study leaves in its folder.

use std::path::Path;

use serde::Serialize;

use super::csv::trade_csv;
use super::fragment;
use super::picture::picture;
use super::record::Trade;
use signorini_draw::pareto_file;
use signorini_files::atomic::write_atomically;
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::Scene;

/// The setting to take, as a fragment of the scene.
pub const FRAGMENT: &str = "recommended.toml";

/// Writes `trade.json`, `trade.csv`, `trade.svg` and, where there is a recommendation, `recommended.toml`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(folder: &Path, scene: &Scene, trade: &Trade) -> Result<()> {
    let csv = trade_csv(trade).map_err(|error| Error::Check(error.to_string()))?;
    write_atomically(&folder.join("trade.json"), json(trade).as_bytes())?;
    write_atomically(&folder.join("trade.csv"), &csv)?;
    write_atomically(&folder.join("trade.svg"), pareto_file(&picture(trade)).as_bytes())?;
    let file = folder.join(FRAGMENT);
    match &trade.recommendation.point {
        Some(point) => fragment::write(&file, scene, &point.setting, &trade.recommendation.text),
        None => match std::fs::remove_file(&file) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(Error::io(&file)(error))
            }
            _ => Ok(()),
        },
    }
}

/// The object, a line for every point.
pub fn json<T: Serialize>(record: &T) -> String {
    let Ok(serde_json::Value::Object(keys)) = serde_json::to_value(record) else {
        return String::new();
    };
    let value = |value: &serde_json::Value| match value {
        serde_json::Value::Array(items) if !items.is_empty() => {
            let lines: Vec<_> = items.iter().map(|item| format!("    {item}")).collect();
            format!("[\n{}\n  ]", lines.join(",\n"))
        }
        other => other.to_string(),
    };
    let lines: Vec<_> = keys.iter().map(|(key, of)| format!("  {key:?}: {}", value(of))).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

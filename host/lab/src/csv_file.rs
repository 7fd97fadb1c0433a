//! Records as CSV: a column for each field, an empty field for what does not exist.

use serde::Serialize;
use signorini_scene::error::{Error, Result};

/// The text of the file `name`, a line for each row.
///
/// # Errors
/// Never for plain data.
pub fn csv_file(name: &str, rows: &[impl Serialize]) -> Result<Vec<u8>> {
    let failed = |error: String| Error::Check(format!("{name}: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).map_err(|error| failed(error.to_string()))?;
    }
    writer.into_inner().map_err(|error| failed(error.to_string()))
}

//! The files that a study leaves in its folder: `trade.json`, `trade.csv` (a line a point, the columns those of the
//! JSON, flattened), `trade.svg`, and the setting to take, for `solve`, `bake` and `cargo xtask firmware`.

use std::path::Path;

use serde::Serialize;
use serde_json::Value;

use super::picture::picture;
use super::record::{Point, Trade};
use crate::record_file::json;
use signorini_draw::pareto_file;
use signorini_files::atomic::write_atomically;
use signorini_scene::{Error, Result, Scene, Setting};

/// The setting to take, as a fragment of the scene.
pub const FRAGMENT: &str = "recommended.toml";

/// Writes `trade.json`, `trade.csv`, `trade.svg` and, where there is a recommendation, `recommended.toml`.
pub fn write(folder: &Path, scene: &Scene, trade: &Trade) -> Result<()> {
    let csv = trade_csv(trade).map_err(|error| Error::Check(error.to_string()))?;
    write_atomically(&folder.join("trade.json"), json(trade).as_bytes())?;
    write_atomically(&folder.join("trade.csv"), &csv)?;
    write_atomically(&folder.join("trade.svg"), pareto_file(&picture(trade)).as_bytes())?;
    let file = folder.join(FRAGMENT);
    if let Some(point) = &trade.recommendation.point {
        let text = fragment(folder, scene, &point.setting, &trade.recommendation.text)?;
        return write_atomically(&file, text.as_bytes());
    }
    match std::fs::remove_file(&file) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Error::io(&file)(error)),
        _ => Ok(()),
    }
}

/// Where each column stands in a point's JSON; its name is this path with `_` between the words. Columns
/// are added at the end, so that readers by position go on working.
const COLUMNS: &str = "name scalar math cells level unknowns stop sweeps start omega model certificate \
    error/energy error/combined error/l2 error/flux error/force error/length bound bound_of_u \
    cycles cycles_spread cycles_per_unknown instructions ram_bytes flash_bytes pareto \
    setting/refine setting/cells setting/scalar setting/math setting/model setting/start setting/omega \
    setting/sweeps setting/share setting/certificate setting/solver setting/error";

/// The text of `trade.csv`: `scene,target,` and a column for each field of a point (`error_energy`,
/// `setting_refine`, …). A value that does not exist is an empty field.
fn trade_csv(trade: &Trade) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let names = COLUMNS.split(' ').map(|path| path.replace('/', "_"));
    let fixed = ["scene", "target"].map(str::to_owned);
    writer.write_record(fixed.into_iter().chain(names))?;
    for point in &trade.points {
        let fixed = [trade.scene.clone(), trade.target.to_string()];
        writer.write_record(fixed.into_iter().chain(fields(point)))?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

fn fields(point: &Point) -> impl Iterator<Item = String> {
    // Plain data without a map: it always has a JSON.
    let json = serde_json::to_value(point).unwrap_or_default();
    COLUMNS.split(' ').map(move |path| match json.pointer(&format!("/{path}")) {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string(),
    })
}

#[derive(Serialize)]
struct Fragment<'a> {
    extends: String,
    setting: &'a Setting,
}

/// The fragment of `scene` with `setting` for a file in `folder`; `why` stands above it.
fn fragment(folder: &Path, scene: &Scene, setting: &Setting, why: &str) -> Result<String> {
    let whole = |path: &Path| path.canonicalize().map_err(Error::io(path));
    // No name at all is the folder at hand.
    let (scene, folder) = (whole(&scene.path)?, whole(&Path::new(".").join(folder))?);
    let way = pathdiff::diff_paths(&scene, &folder).unwrap_or(scene);
    let fragment = Fragment { extends: way.to_string_lossy().replace('\\', "/"), setting };
    let text = toml::to_string(&fragment).map_err(|error| Error::Check(error.to_string()))?;
    let comment: String = why.lines().map(|line| format!("# {line}\n")).collect();
    Ok(comment + &text)
}

#[cfg(test)]
mod tests {
    use super::super::tests::trade;
    use super::*;

    /// The paths to everything that is no object.
    fn leaves(at: &str, value: &Value) -> Vec<String> {
        let Value::Object(fields) = value else { return vec![at.to_owned()] };
        fields.iter().flat_map(|(name, value)| leaves(&format!("{at}/{name}"), value)).collect()
    }

    #[test]
    fn every_field_of_a_point_has_a_column() {
        let mut point = trade("levee", 4).points.remove(0);
        point.setting = serde_json::from_str(
            r#"{"cells": "quads", "scalar": "f32", "model": "full", "solver": "sweeps", "sweeps": 1,
                "share": 0.1, "error": "5%"}"#,
        )
        .unwrap();
        let mut found = leaves("", &serde_json::to_value(&point).unwrap());
        let mut columns: Vec<_> = COLUMNS.split(' ').map(|path| format!("/{path}")).collect();
        found.sort();
        columns.sort();
        assert_eq!(found, columns);
    }

    #[test]
    fn a_line_a_point_and_empty_fields_for_what_is_missing() {
        let mut trade = trade("levee", 5);
        trade.points[1].bound = None;
        trade.points[1].name = "a, \"b\"".to_owned();
        let text = trade_csv(&trade).unwrap();
        let mut reader = csv::Reader::from_reader(text.as_slice());
        let header = reader.headers().unwrap().clone();
        let column = |name: &str| header.iter().position(|found| found == name).unwrap();
        let rows: Vec<_> = reader.records().map(std::result::Result::unwrap).collect();
        assert_eq!((rows.len(), header.len()), (5, COLUMNS.split(' ').count() + 2));
        assert_eq!([&rows[1][0], &rows[1][1], &rows[1][2]], ["levee", "host", "a, \"b\""]);
        assert_eq!(&rows[1][column("bound")], "");
        let error: f64 = rows[2][column("error_energy")].parse().unwrap();
        assert_eq!(error, trade.points[2].error.energy);
        assert_eq!(&rows[0][column("setting_refine")], "0");
    }
}

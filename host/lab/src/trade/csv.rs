//! `trade.csv`: one line a point, the columns those of `trade.json`, flattened.

use ::csv::{Result, Writer};
use serde_json::Value;

use super::record::{Point, Trade};

/// Where each column stands in a point's JSON; its name is this path with `_` between the words. Columns
/// are added at the end, so that readers by position go on working.
const COLUMNS: [&str; 39] = [
    "/name",
    "/scalar",
    "/math",
    "/cells",
    "/level",
    "/unknowns",
    "/stop",
    "/sweeps",
    "/start",
    "/omega",
    "/model",
    "/certificate",
    "/error/energy",
    "/error/combined",
    "/error/l2",
    "/error/flux",
    "/error/force",
    "/error/length",
    "/bound",
    "/bound_of_u",
    "/cycles",
    "/cycles_spread",
    "/cycles_per_unknown",
    "/instructions",
    "/ram_bytes",
    "/flash_bytes",
    "/pareto",
    "/setting/refine",
    "/setting/cells",
    "/setting/scalar",
    "/setting/math",
    "/setting/model",
    "/setting/start",
    "/setting/omega",
    "/setting/sweeps",
    "/setting/share",
    "/setting/certificate",
    "/setting/solver",
    "/setting/error",
];

/// The text of `trade.csv`: `scene,target,` and a column for each field of a point (`error_energy`,
/// `setting_refine`, …). A value that does not exist is an empty field.
pub fn trade_csv(trade: &Trade) -> Result<Vec<u8>> {
    let mut writer = Writer::from_writer(Vec::new());
    let names = COLUMNS.iter().map(|path| path.trim_start_matches('/').replace('/', "_"));
    let fixed = ["scene", "target"].map(str::to_owned);
    writer.write_record(fixed.into_iter().chain(names))?;
    for point in &trade.points {
        let fixed = [trade.scene.clone(), trade.target.clone()];
        writer.write_record(fixed.into_iter().chain(fields(point)))?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

fn fields(point: &Point) -> impl Iterator<Item = String> {
    // Plain data without a map: it always has a JSON.
    let json = serde_json::to_value(point).unwrap_or_default();
    COLUMNS.into_iter().map(move |path| match json.pointer(path) {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::trade;
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
        let mut columns = COLUMNS.map(str::to_owned).to_vec();
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
        let mut reader = ::csv::Reader::from_reader(text.as_slice());
        let header = reader.headers().unwrap().clone();
        let column = |name: &str| header.iter().position(|found| found == name).unwrap();
        let rows: Vec<_> = reader.records().map(std::result::Result::unwrap).collect();
        assert_eq!((rows.len(), header.len()), (5, COLUMNS.len() + 2));
        assert_eq!([&rows[1][0], &rows[1][1], &rows[1][2]], ["levee", "host", "a, \"b\""]);
        assert_eq!(&rows[1][column("bound")], "");
        let error: f64 = rows[2][column("error_energy")].parse().unwrap();
        assert_eq!(error, trade.points[2].error.energy);
        assert_eq!(&rows[0][column("setting_refine")], "0");
    }
}

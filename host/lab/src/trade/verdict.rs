//! The knobs that pay over all scenes: how often each value of a knob stands on a Pareto front.
//!
//! A value is judged only where there was a choice: in studies that measured another value of the same
//! knob as well. One that was measured so, and is on no front, never pays.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::digits::grouped;
use super::record::{Point, Trade};
use super::target::Target;
use signorini_draw::{Column, Table, plain};

/// A name and how to read it off a point.
type Knob = (&'static str, fn(&Point) -> String);

/// The knobs that can be turned. The certificate is no such knob: it adds to the cost and buys the bound, no
/// accuracy; [`certificate`] says how much.
const KNOBS: [Knob; 8] = [
    ("scalar", |point| point.scalar.clone()),
    ("math", |point| point.math.clone()),
    ("cells", |point| point.cells.clone()),
    ("level", |point| {
        point.setting.error.map_or(point.level.to_string(), |error| format!("to {error}"))
    }),
    ("stop", stop),
    ("start", |point| point.start.clone()),
    ("omega", |point| point.omega.clone()),
    ("model", |point| point.model.clone()),
];

/// Numbers of sweeps are a scene's own: they count as one value.
fn stop(point: &Point) -> String {
    if point.stop.ends_with(" sweeps") { "fixed sweeps".to_owned() } else { point.stop.clone() }
}

/// One value of a knob.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct KnobValue {
    /// Of which target's studies.
    pub target: Target,
    /// The knob: `scalar`, `level`, …
    pub knob: &'static str,
    pub value: String,
    /// Studies in which it could be chosen.
    pub studies: usize,
    pub points: usize,
    pub on_front: usize,
}

/// Every value of every knob that was a choice somewhere, target by target, in the order of the knobs.
pub fn knob_values<'t>(trades: impl IntoIterator<Item = &'t Trade>) -> Vec<KnobValue> {
    let mut found: BTreeMap<(Target, usize, String), [usize; 3]> = BTreeMap::new();
    for trade in trades {
        for (at, (_, read)) in KNOBS.iter().enumerate() {
            let values: BTreeSet<String> = trade.points.iter().map(read).collect();
            for value in values.iter().filter(|_| values.len() > 1) {
                let points = || trade.points.iter().filter(|point| read(point) == *value);
                let on_front = points().filter(|point| point.pareto).count();
                let key = (trade.target, at, value.clone());
                let sums = found.entry(key).or_default();
                *sums = [sums[0] + 1, sums[1] + points().count(), sums[2] + on_front];
            }
        }
    }
    let value = |(key, sums): ((Target, usize, String), [usize; 3])| {
        let ((target, at, value), [studies, points, on_front]) = (key, sums);
        let (knob, _) = KNOBS[at];
        KnobValue { target, knob, value, studies, points, on_front }
    };
    found.into_iter().map(value).collect()
}

/// A row for each value on a target: how many settings with it were measured, and how many of them nothing beats.
pub fn table(values: &[KnobValue], target: Target) -> Table {
    let columns = [
        Column::words("choice", |value: &&KnobValue| value.knob.to_owned()),
        Column::words("value", |value: &&KnobValue| value.value.clone()),
        Column::number("scenes", |value: &&KnobValue| grouped(value.studies as u64)),
        Column::number("settings measured", |value: &&KnobValue| grouped(value.points as u64)),
        Column::number("beaten by none", |value: &&KnobValue| grouped(value.on_front as u64)),
        Column::number("part of them", |value: &&KnobValue| {
            format!("{:.0} %", 100.0 * value.on_front as f64 / value.points as f64)
        }),
    ];
    Table::new(&columns, values.iter().filter(|value| value.target == target))
}

/// The cost of the certificate: the median of cycles with it over cycles without, of points that differ in
/// nothing else.
pub fn certificate<'t>(trades: impl IntoIterator<Item = &'t Trade>) -> Option<String> {
    let mut ratios: Vec<f64> = trades.into_iter().flat_map(certificate_ratios).collect();
    ratios.retain(|ratio| ratio.is_finite());
    ratios.sort_by(f64::total_cmp);
    let median = ratios.get(ratios.len() / 2)?;
    let (percent, count) = (plain(100.0 * (median - 1.0)), ratios.len());
    Some(format!(
        "The certificate adds {percent} % to the cycles of a tick (median of {count}); it buys the bound, \
         no accuracy"
    ))
}

fn certificate_ratios(trade: &Trade) -> Vec<f64> {
    let knobs =
        |point: &Point| KNOBS.map(|(_, read)| read(point)).into_iter().chain([point.stop.clone()]);
    let (with, without): (Vec<_>, Vec<_>) =
        trade.points.iter().partition(|point| point.certificate);
    let other = |point: &&Point| {
        let bare = without.iter().find(|bare| knobs(bare).eq(knobs(point)))?;
        Some(point.cycles / bare.cycles)
    };
    with.iter().filter_map(other).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::point;
    use super::*;

    fn trade(target: &str, points: &[(&str, &str, bool)]) -> Trade {
        let points = points.iter().enumerate().map(|(at, &(scalar, stop, pareto))| {
            let (scalar, stop) = (scalar.to_owned(), stop.to_owned());
            Point { scalar, stop, pareto, ..point(at) }
        });
        let points = points.map(|p| Point {
            math: String::new(),
            cells: String::new(),
            level: 0,
            start: String::new(),
            model: String::new(),
            ..p
        });
        Trade { points: points.collect(), ..super::super::tests::trade(target, 0) }
    }

    #[test]
    fn what_nothing_beats_is_counted() {
        let trades = [
            trade("a", &[("f32", "exact", true), ("f64", "exact", false), ("f64", "exact", false)]),
            trade("b", &[("f32", "exact", false), ("f64", "exact", false), ("f32", "exact", true)]),
        ];
        let values = knob_values(&trades);
        let [single, double] = &table(&values, Target::Host).rows[..] else { panic!() };
        assert_eq!(single.cells, ["scalar", "f32", "2", "3", "2", "67 %"]);
        assert_eq!(double.cells, ["scalar", "f64", "2", "3", "0", "0 %"]);
    }

    #[test]
    fn a_value_without_an_alternative_is_not_judged() {
        let trades = [
            trade("a", &[("f64", "exact", false), ("f64", "12 sweeps", true)]),
            trade("b", &[("f32", "40 sweeps", true), ("f64", "7 sweeps", false)]),
        ];
        let values = knob_values(&trades);
        let counted: Vec<_> = (values.iter())
            .map(|value| (value.knob, &*value.value, value.studies, value.points, value.on_front))
            .collect();
        assert_eq!(
            counted,
            [
                ("scalar", "f32", 1, 1, 1),
                ("scalar", "f64", 1, 1, 0),
                ("stop", "exact", 1, 1, 0),
                ("stop", "fixed sweeps", 1, 1, 1)
            ]
        );
        assert!(knob_values(&[]).is_empty());
    }

    #[test]
    fn targets_are_judged_apart() {
        let host = trade("a", &[("f32", "exact", true), ("f64", "exact", false)]);
        let mut board = trade("a", &[("f32", "exact", false), ("f64", "exact", true)]);
        board.target = Target::M4f;
        let values = knob_values([&host, &board]);
        for (target, wins) in [(Target::Host, ["100 %", "0 %"]), (Target::M4f, ["0 %", "100 %"])] {
            let found = table(&values, target);
            assert_eq!([0, 1].map(|at: usize| &*found.rows[at].cells[5]), wins);
        }
    }

    #[test]
    fn the_certificate_costs_what_pairs_say() {
        let mut trade = trade("a", &[("f32", "exact", true); 2]);
        trade.points[0].certificate = true;
        trade.points[0].cycles = 150.0;
        trade.points[1].certificate = false;
        trade.points[1].cycles = 100.0;
        assert!(certificate([&trade]).unwrap().contains("adds 50.0 %"));
        trade.points[1].scalar = "f64".to_owned();
        assert_eq!(certificate([&trade]), None);
    }
}

//! `signorini extremes --random N --in-time`: scenes that store u, driven by logs, each judged by a finer play of the same data.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::Path;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::mesh::Kind;
use super::posed::Hold;
use super::step::Judged;
use super::trajectory::Trajectory;
use super::window::{JudgedTrajectory, judged};
use crate::extremes::judge::INTEGRATED;
use crate::extremes::kept::{Findings, Kept};
use crate::extremes::watch::watched;
use crate::record_file::{csv, indented};
use signorini_files::atomic::write_atomically;
use signorini_scene::error::Result;
use signorini_scene::mesh::gmsh::write as msh;
use signorini_solve::ScalarKind;

/// A trajectory without an answer by then hangs.
const LIMIT: Duration = Duration::from_secs(1800);

/// A line of `trajectories.csv`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
struct Row {
    case: u32,
    hold: Hold,
    cells: Kind,
    scalar: ScalarKind,
    /// Whether it starts from a steady state.
    was_steady: bool,
    limit: Option<u32>,
    /// λ dt
    rate: Option<f64>,
    /// Ticks whose bound over time was judged.
    ticks: usize,
    /// The largest part of a bound over time that the finer answer proves to be error.
    error_over_window: Option<f64>,
    /// The bound over time over the error, at its largest of all ticks and at the last one.
    window_over_error: Option<f64>,
    /// See `window_over_error`.
    at_last: Option<f64>,
    /// `error_over_window` of the full controller.
    full_error_over_window: Option<f64>,
    /// `error_over_step` of the full controller.
    full_error_over_step: Option<f64>,
    /// `error_over_window` of the condensed controller.
    condensed_error_over_window: Option<f64>,
    /// `error_over_step` of the condensed controller.
    condensed_error_over_step: Option<f64>,
    /// `at_last` of the condensed controller.
    condensed_at_last: Option<f64>,
    /// The part of the last step's bound that the finer answer proves to be error.
    error_over_step: Option<f64>,
    /// The bound of the last step over its error.
    step_over_error: Option<f64>,
    /// Why the last tick has no bound, or what went wrong.
    note: String,
    broken: String,
}

/// The findings of a run, as `trajectories.json` holds them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
struct Record {
    seed: u64,
    cases: usize,
    /// How many of them have a bound over time, and in how many ticks in all.
    with_window: usize,
    /// See `with_window`.
    ticks: usize,
    /// How many of them were played by a full controller as well, with a bound that was judged.
    full: usize,
    /// How many of them were played by a condensed controller as well, with such a bound.
    condensed: usize,
    /// How many steps have a bound and were judged.
    steps: usize,
    /// Least, median and largest of what is judged, by its kind.
    spreads: BTreeMap<String, [f64; 3]>,
    /// What stands in the way of a bound, and how often.
    without: BTreeMap<String, usize>,
    /// Cases that break a bound or fail, with their numbers.
    violations: BTreeMap<u32, String>,
}

/// Draws these trajectories of a seed and runs in two threads those that are not yet `kept`; calls `done` after each.
pub fn run(
    seed: u64,
    cases: RangeInclusive<u32>,
    kept: &Kept,
    done: impl Fn() + Sync,
) -> Result<Findings> {
    let key = |number| format!("trajectory {number} of {seed}");
    let rows = kept.rows(cases, key, |number| row(seed, number), done)?;
    let record = Record::new(seed, &rows);
    let files = vec![
        ("trajectories.json", indented(&record).into_bytes()),
        ("trajectories.csv", csv("trajectories.csv", &rows)?),
    ];
    let wrong = record.violations.keys().copied().collect();
    Ok(Findings { files, text: record.text(), wrong })
}

/// Writes scene, mesh and log of a trajectory into `folder`: `signorini tick scene.toml --log log.csv` plays it.
pub fn write(seed: u64, number: u32, folder: &Path) -> Result<()> {
    let case = Trajectory::draw(seed, number);
    let names: String = (0..case.on_line.len()).map(|at| format!(",p{at}")).collect();
    let lines = case.log.iter().zip(1..).map(|(values, tick)| {
        let values: String = values.iter().map(|value| format!(",{value:?}")).collect();
        format!("{:?}{values}\n", f64::from(tick) * case.step)
    });
    let log = format!("t{names}\n") + &lines.collect::<String>();
    write_atomically(&folder.join("scene.toml"), case.scene_text(1).as_bytes())?;
    write_atomically(&folder.join("log.csv"), log.as_bytes())?;
    write_atomically(&folder.join("mesh.msh"), msh::text(&case.mesh).as_bytes())
}

fn row(seed: u64, number: u32) -> Row {
    let case = Trajectory::draw(seed, number);
    let Trajectory { hold, kind: cells, scalar, sweeps: limit, .. } = case;
    let was_steady = case.initial.is_none();
    let row = Row { case: number, hold, cells, scalar, was_steady, limit, ..Row::default() };
    match watched(LIMIT, move || judged(&case)) {
        Ok(Ok(found)) => row.with(&found),
        Ok(Err(error)) => Row { broken: format!("refused: {}", error.reason()), ..row },
        Err(_) => Row { broken: "no answer".to_owned(), ..row },
    }
}

impl Row {
    fn with(self, found: &JudgedTrajectory) -> Self {
        let finite = |ratio: f64| ratio.is_finite().then_some(ratio);
        let largest = |all: &[Judged], of: fn(&Judged) -> f64| {
            all.iter().map(of).filter(|ratio| !ratio.is_nan()).reduce(f64::max).and_then(finite)
        };
        let last = |all: &[Judged]| all.last().and_then(|of| finite(of.bound_over_error()));
        let of_step = |step: Option<Judged>| finite(step?.error_over_bound());
        let [own, full, condensed] = &found.plays;
        let row = Self {
            rate: found.rate,
            ticks: own.windows.len(),
            error_over_window: largest(&own.windows, Judged::error_over_bound),
            window_over_error: largest(&own.windows, Judged::bound_over_error),
            at_last: last(&own.windows),
            full_error_over_window: largest(&full.windows, Judged::error_over_bound),
            full_error_over_step: of_step(full.step),
            condensed_error_over_window: largest(&condensed.windows, Judged::error_over_bound),
            condensed_error_over_step: of_step(condensed.step),
            condensed_at_last: last(&condensed.windows),
            error_over_step: of_step(own.step),
            step_over_error: own.step.and_then(|of| finite(of.bound_over_error())),
            note: found.no_bound.clone().unwrap_or_default(),
            ..self
        };
        let most = 1.0 + INTEGRATED;
        let above = |ratio: Option<f64>| ratio.is_some_and(|ratio| ratio > most);
        let broken = [
            (above(row.error_over_window), "the bound over time"),
            (above(row.full_error_over_window), "the bound over time of the full controller"),
            (above(row.full_error_over_step), "the bound of a step of the full controller"),
            (above(row.condensed_error_over_window), "the bound over time of the condensed model"),
            (above(row.condensed_error_over_step), "the bound of a step of the condensed model"),
            (above(row.error_over_step), "the bound of a step"),
        ];
        let broken = broken.into_iter().filter(|(is, _)| *is).map(|(_, what)| what);
        Self { broken: broken.collect::<Vec<_>>().join(", "), ..row }
    }
}

impl Record {
    fn new(seed: u64, rows: &[Row]) -> Self {
        let mut record = Self { seed, cases: rows.len(), ..Self::default() };
        let mut all: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for row in rows {
            record.with_window += usize::from(row.ticks > 0);
            record.ticks += row.ticks;
            let full = row.full_error_over_window.or(row.full_error_over_step);
            record.full += usize::from(full.is_some());
            record.condensed += usize::from(row.condensed_error_over_window.is_some());
            record.steps += usize::from(row.step_over_error.is_some());
            for (name, ratio) in row.ratios() {
                all.entry(name).or_default().push(ratio);
            }
            if !row.note.is_empty() {
                *record.without.entry(row.note.clone()).or_default() += 1;
            }
            if !row.broken.is_empty() {
                record.violations.insert(row.case, row.broken.clone());
            }
        }
        let spread = |mut all: Vec<f64>| {
            all.sort_by(f64::total_cmp);
            [all[0], all[all.len() / 2], all[all.len() - 1]]
        };
        record.spreads = all.into_iter().map(|(name, all)| (name, spread(all))).collect();
        record
    }

    fn text(&self) -> String {
        let Self { cases, with_window, ticks, full, condensed, steps, .. } = self;
        let mut lines = vec![format!(
            "{cases} random trajectories: {with_window} have a bound over time, judged in {ticks} ticks; {full} have a full controller, \
             {condensed} a condensed one; {steps} steps judged"
        )];
        for (name, [least, median, most]) in &self.spreads {
            lines.push(format!("  {name}: {least:.3} to {most:.3}, median {median:.3}"));
        }
        for (reason, count) in &self.without {
            lines.push(format!("  no bound in {count}: {reason}"));
        }
        for (case, what) in &self.violations {
            lines.push(format!("  broken, case {case}: {what}"));
        }
        lines.join("\n")
    }
}

impl Row {
    /// What is judged, by its kind.
    fn ratios(&self) -> Vec<(String, f64)> {
        let start = if self.was_steady { "steady" } else { "stated" };
        let end = if self.limit.is_some() { "cut off" } else { "to the end" };
        let all = [
            ("error over bound, over time".to_owned(), self.error_over_window),
            (
                "error over bound, over time, full controller".to_owned(),
                self.full_error_over_window,
            ),
            ("error over bound, of a step, full controller".to_owned(), self.full_error_over_step),
            ("error over bound, over time, condensed".to_owned(), self.condensed_error_over_window),
            ("error over bound, of a step, condensed".to_owned(), self.condensed_error_over_step),
            ("error over bound, of a step".to_owned(), self.error_over_step),
            (format!("bound over error, over time, {start} start, {end}"), self.at_last),
            (
                format!("bound over error, over time, condensed, {start} start"),
                self.condensed_at_last,
            ),
            (format!("bound over error, of a step, {end}"), self.step_over_error),
        ];
        all.into_iter().filter_map(|(name, ratio)| Some((name, ratio?))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::window::posed;
    use super::*;
    use signorini_problem::threads::on_two_threads;
    use signorini_tolerances::cases;

    /// The first of those that `signorini extremes --random N --seed 5 --in-time` draws, and the next of them that can be condensed.
    #[test]
    fn random_trajectories_keep_their_bounds() {
        let all = cases(100) as u32;
        let may_be = |number: &u32| posed(&Trajectory::draw(5, *number)).unwrap().is_some();
        let further = (all..).filter(may_be).take(all as usize / 5);
        let numbers: Vec<u32> = (0..all).chain(further).collect();
        let found = on_two_threads(&numbers, |&number| Ok(row(5, number)), || ()).unwrap();
        let record = Record::new(5, &found);
        println!("{}", record.text());
        assert!(record.violations.is_empty(), "{:?}", record.violations);
        let least = found.len() / 4;
        assert!(record.with_window > 2 * least && record.steps >= least / 2, "{record:?}");
        assert!(record.condensed >= least && record.full >= 2 * least, "{record:?}");
    }
}

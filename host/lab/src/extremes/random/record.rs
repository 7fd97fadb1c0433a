//! The findings of a run of random scenes, as `random.json` holds them: counts, the largest ratios, all that is broken.
//! A row has those of one case.

use std::collections::BTreeMap;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use super::attempt::Attempt;
use super::case::{Effort, RandomCase, Way, Yardstick};
use super::feature::Feature;
use super::measure::Measured;
use super::mesh::Kind;
use super::posed::Hold;
use super::verdict::Broken;
use crate::extremes::judge::{Outcome, counts, ratio};
use crate::record_file::word;
use signorini_solve::ScalarKind;

/// A run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Record {
    pub seed: u64,
    pub cases: usize,
    pub seconds: f64,
    /// How many cases ended in which way.
    pub outcomes: BTreeMap<String, usize>,
    /// These counts by what was drawn.
    pub classes: BTreeMap<String, BTreeMap<String, usize>>,
    /// The largest ratios and the cases that they belong to.
    pub worst: BTreeMap<String, Worst>,
    #[serde(default)]
    pub features: BTreeMap<String, Spread>,
    pub violations: Vec<Violation>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    pub ratio: f64,
    pub case: u32,
}

/// The bounds of all scenes with one feature.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Spread {
    pub scenes: usize,
    pub with_bound: usize,
    /// The bound over the distance to the truth, where there is one to measure by: at 50, 90, 99 and 100 % of them.
    pub over_error: Vec<f64>,
    pub measured: usize,
}

impl Spread {
    fn of(rows: &[&Row]) -> Self {
        let mut all: Vec<f64> = rows.iter().filter_map(|row| row.bound_over_error).collect();
        all.sort_by(f64::total_cmp);
        let last = all.len().saturating_sub(1) as f64;
        let at = |share: f64| all.get((share * last).round() as usize).copied();
        Self {
            scenes: rows.len(),
            with_bound: rows.iter().filter(|row| row.has_bound).count(),
            measured: all.len(),
            over_error: [0.5, 0.9, 0.99, 1.0].into_iter().filter_map(at).collect(),
        }
    }
}

/// A promise that was broken: `signorini extremes --random 1 --seed SEED --case CASE` shows it again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Violation {
    pub case: u32,
    pub class: String,
    pub what: String,
    pub words: String,
}

impl Record {
    pub fn new(seed: u64, seconds: f64, rows: &[Row]) -> Self {
        let mut record = Self { seed, cases: rows.len(), seconds, ..Self::default() };
        for row in rows {
            record.add(row);
        }
        for feature in Feature::value_variants() {
            let own: Vec<_> = rows.iter().filter(|row| row.feature == Some(*feature)).collect();
            if !own.is_empty() {
                record.features.insert(word(feature), Spread::of(&own));
            }
        }
        record
    }

    fn add(&mut self, row: &Row) {
        let outcome = word(&row.outcome);
        *self.outcomes.entry(outcome.clone()).or_default() += 1;
        for class in row.classes() {
            *self.classes.entry(class).or_default().entry(outcome.clone()).or_default() += 1;
        }
        for (name, ratio) in row.ratios() {
            let worst = Worst { ratio, case: row.case };
            let known = self.worst.entry(name.to_owned()).or_insert(worst);
            if ratio > known.ratio {
                *known = worst;
            }
        }
        let class = row.classes().join(", ");
        let violation = |what: &str, words: &str| Violation {
            case: row.case,
            class: class.clone(),
            what: what.to_owned(),
            words: words.to_owned(),
        };
        let broken = row.broken.iter().map(|of| violation(of.what, &of.words));
        self.violations.extend(broken);
        if row.broken.is_empty() && row.outcome == Outcome::Wrong {
            self.violations.push(violation("outcome", &row.note));
        }
    }

    pub fn text(&self) -> String {
        let count = |of: Outcome| self.outcomes.get(&word(&of)).copied().unwrap_or(0);
        let mut lines = vec![format!("{} random scenes: {}", self.cases, counts(count))];
        for (name, worst) in &self.worst {
            lines.push(format!("  largest {name}: {:.6} (case {})", worst.ratio, worst.case));
        }
        for (name, Spread { scenes, with_bound, over_error, measured }) in &self.features {
            let ratios: Vec<_> = over_error.iter().map(|ratio| format!("{ratio:.3}")).collect();
            let ratios = ratios.join(", ");
            lines.push(format!(
                "  {name}: {with_bound} of {scenes} have a bound, {measured} measured; over the error {ratios}"
            ));
        }
        for Violation { case, class, what, words } in &self.violations {
            lines.push(format!("  broken, case {case} ({class}): {what}: {words}"));
        }
        lines.join("\n")
    }
}

/// A line of `random.csv`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Row {
    pub case: u32,
    pub feature: Option<Feature>,
    pub truth: Yardstick,
    pub hold: Hold,
    pub cells: Kind,
    pub scalar: ScalarKind,
    pub way: Way,
    pub limit: Option<u32>,
    pub outcome: Outcome,
    /// Edges not on D.
    pub unknowns: Option<usize>,
    pub status: Option<String>,
    pub sweeps: Option<u32>,
    /// The true distance of s and τ over the bounds; as far as it is known where it seems above them.
    pub error_over_bound: Option<f64>,
    /// The true distance of u_h over its bounds.
    pub of_u_over_bound: Option<f64>,
    /// |gap/identity − 1|
    pub identity_off: Option<f64>,
    /// The largest distance of an output from the middle of its interval, over its half-width.
    pub output_over_interval: Option<f64>,
    /// The bound over ‖A^½∇s‖.
    pub relative_bound: Option<f64>,
    pub has_bound: bool,
    /// That over the true distance of s and τ, or their distance from those of a finer solve.
    pub bound_over_error: Option<f64>,
    /// Wall-clock seconds of the answer, and with the truth.
    pub seconds: f64,
    /// See `seconds`.
    pub seconds_in_all: f64,
    pub note: String,
    #[serde(skip)]
    pub broken: Vec<Broken>,
}

impl Row {
    pub fn of(case: &RandomCase) -> Self {
        let Effort { scalar, way, sweeps: limit, .. } = case.effort;
        let RandomCase { number, feature, truth, hold, kind: cells, .. } = *case;
        Self { case: number, feature, truth, hold, cells, scalar, way, limit, ..Self::default() }
    }

    pub fn with(self, case: &RandomCase, attempt: &Attempt, measured: Option<&Measured>) -> Self {
        let of_f64 = case.effort.scalar == ScalarKind::F64;
        Self {
            unknowns: Some(attempt.problem.topology.counts.unknowns()),
            status: Some(attempt.answer.status.name().to_owned()),
            sweeps: Some(attempt.answer.sweeps),
            error_over_bound: measured
                .and_then(|of| ratio(of.least()[0], of.bound.total + of.total)),
            of_u_over_bound: measured.and_then(|of| ratio(of.least()[1], of.bound.of_u + of.total)),
            identity_off: (measured.filter(|_| of_f64).and_then(Measured::identity_off))
                .filter(|off| off.is_finite()),
            output_over_interval: measured
                .filter(|of| of.intervals.found > 0)
                .map(|of| of.intervals.worst),
            has_bound: attempt.answer.bound.is_some(),
            bound_over_error: measured.and_then(|of| ratio(of.bound.total, of.combined)),
            relative_bound: measured.and_then(|of| ratio(of.bound.total, of.energy)),
            ..self
        }
    }

    pub fn classes(&self) -> Vec<String> {
        let cut = if self.limit.is_some() { "with a limit" } else { "to the end" };
        let how = [word(&self.cells), word(&self.scalar), word(&self.way), cut.to_owned()];
        let what = self.feature.iter().map(word);
        what.chain([word(&self.truth), word(&self.hold)]).chain(how).collect()
    }

    /// The ratios whose largest is recorded.
    pub fn ratios(&self) -> Vec<(&'static str, f64)> {
        let [error, of_u, output] = match self.truth {
            Yardstick::Finer => [
                "error over bounds, by a finer solve",
                "error of u_h over bounds, by a finer solve",
                "output over intervals, by a finer solve",
            ],
            Yardstick::Catalogue | Yardstick::Made => [
                "error over bound, exact",
                "error of u_h over bound, exact",
                "output over interval, exact",
            ],
        };
        let all = [
            (error, self.error_over_bound),
            (of_u, self.of_u_over_bound),
            ("|gap/identity − 1|", self.identity_off),
            (output, self.output_over_interval),
        ];
        all.into_iter().filter_map(|(name, ratio)| Some((name, ratio?))).collect()
    }
}

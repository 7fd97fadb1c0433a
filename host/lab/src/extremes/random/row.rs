//! The findings of one random scene.

use serde::{Deserialize, Serialize};

use super::attempt::Attempt;
use super::case::{Effort, RandomCase, Way, Yardstick};
use super::feature::Feature;
use super::measure::Measured;
use super::mesh::Kind;
use super::posed::Hold;
use super::verdict::Broken;
use crate::extremes::judge::{Outcome, ratio};
use crate::record_file::word;
use signorini_solve::ScalarKind;

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
        let finer = self.truth == Yardstick::Finer;
        let of = |name, ratio: Option<f64>| ratio.map(|ratio| (name, ratio));
        let [error, of_u, output] = match finer {
            true => [
                "error over bounds, by a finer solve",
                "error of u_h over bounds, by a finer solve",
                "output over intervals, by a finer solve",
            ],
            false => [
                "error over bound, exact",
                "error of u_h over bound, exact",
                "output over interval, exact",
            ],
        };
        let all = [
            of(error, self.error_over_bound),
            of(of_u, self.of_u_over_bound),
            of("|gap/identity − 1|", self.identity_off),
            of(output, self.output_over_interval),
        ];
        all.into_iter().flatten().collect()
    }
}

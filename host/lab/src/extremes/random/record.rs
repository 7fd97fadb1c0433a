//! The findings of a run of random scenes, as `random.json` holds them: counts, the largest ratios, all that is broken.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::feature::Feature;
use super::row::Row;
use crate::extremes::judge::Outcome;
use crate::record_file::word;

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
        for feature in Feature::ALL {
            let own: Vec<_> = rows.iter().filter(|row| row.feature == Some(feature)).collect();
            if !own.is_empty() {
                record.features.insert(word(&feature), Spread::of(&own));
            }
        }
        record
    }

    fn add(&mut self, row: &Row) {
        let outcome = row.outcome.name().to_owned();
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
        let counts = Outcome::ALL.map(|outcome| {
            let name = outcome.name();
            format!("{} {name}", self.outcomes.get(name).copied().unwrap_or(0))
        });
        let mut lines = vec![format!("{} random scenes: {}", self.cases, counts.join(", "))];
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

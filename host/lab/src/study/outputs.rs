//! The declared outputs of a standard scene: what they are, what they may be off by, and a sentence of it.

use serde::Serialize;

use super::checks::Check;
use signorini_files::stated::{Stated, sentence};
use signorini_intervals::{Coverage, OutputBound, estimate, of_outputs};
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_scene::Result;
use signorini_solve::Solution;
use signorini_solve::outputs::outputs;

/// The declared outputs of a scene, as the report tells them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KnownOutputs {
    /// The first force or flux with what it is off by, and over which length.
    pub sentence: Option<String>,
    /// Each by name, as a reader is told it.
    pub told: Vec<(String, String)>,
    /// Half-widths over the true errors of the middles, where these are known and no rounding.
    pub over_error: Vec<f64>,
}

/// An error below this part of the value is rounding.
const ROUNDING: f64 = 1e-7;

impl KnownOutputs {
    /// The outputs of a solution, with a check for each exact value that is known.
    pub fn new(
        subject: &str,
        problem: &Problem,
        solution: &Solution,
    ) -> Result<(Self, Vec<Check>)> {
        let values = outputs(problem, solution)?;
        let mut intervals = of_outputs(problem, solution, Coverage::Usual);
        estimate(problem, &values, &mut intervals);
        let all = wanted(&problem.scene);
        let stated: Vec<Stated> =
            all.iter().map(|output| Stated::of(output, &values, &intervals)).collect();
        let told = stated.iter().map(|of| (of.output.name.value.clone(), of.words()));
        let (told, sentence) = (told.collect(), sentence(&stated));
        let (mut over_error, mut checks) = (Vec::new(), Vec::new());
        for found in intervals.values().flatten() {
            let OutputBound { center, plus_minus, exact: Some(exact), doubt, .. } = *found else {
                continue;
            };
            let off = (exact - center).abs();
            let claim = "the exact value of an output is in its interval: distance over half-width";
            checks.push(Check::at_most(subject, claim, (off - doubt).max(0.0) / plus_minus, 1.0));
            if off > ROUNDING * exact.abs() + doubt {
                over_error.push(plus_minus / off);
            }
        }
        Ok((Self { sentence, told, over_error }, checks))
    }
}

//! Intervals of outputs: whether they hold what the exact solution says, or meet those of a finer answer.

use signorini_scene::error::Result;
use signorini_scene::scene::{Condition, Located, Output, Quantity, Scene};
use signorini_solve::certify::cell::Cell;
use signorini_solve::intervals::{Answered, OutputBound, of_answer};
use signorini_solve::problem::Problem;
use signorini_solve::solve::Solution;

/// Outputs that one case is asked for.
const EACH: usize = 3;

/// What the intervals of a case came to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Intervals {
    /// How many there are.
    pub found: usize,
    /// The largest distance of the middle to what is known of the value, over the half-width; with a finer answer over both.
    pub worst: f64,
    /// Half-widths over the true errors of the middles, where these are known.
    pub over_error: Vec<f64>,
    /// The output of the worst.
    pub name: String,
}

impl Intervals {
    /// Those of `answer` beside the exact solution.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn by_exact(number: u32, problem: &Problem, answer: &Answered) -> Result<Self> {
        let problem = asked(problem, number, true);
        let mut all = Self::default();
        for (name, found) in of_answer(&problem, answer) {
            if let Ok(OutputBound { center, plus_minus, exact: Some(exact), doubt, .. }) = found {
                let off = ((exact - center).abs() - doubt).max(0.0);
                all.add(name, off, plus_minus);
                all.over_error.push(plus_minus / (exact - center).abs());
            }
        }
        Ok(all)
    }

    /// Those of `answer` beside those of a finer one.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn by_finer(
        number: u32,
        problem: &Problem,
        answer: &Answered,
        finer: (&Problem, &Solution),
    ) -> Result<Self> {
        let (problem, fine) = (asked(problem, number, false), asked(finer.0, number, false));
        let own = of_answer(&problem, answer);
        let its = of_answer(&fine, &finer.1.into());
        let mut all = Self::default();
        for (name, found) in own {
            if let (Ok(found), Some(Ok(fine))) = (found, its.get(&name)) {
                let apart = (found.center - fine.center).abs();
                all.add(name, apart, found.plus_minus + fine.plus_minus);
            }
        }
        Ok(all)
    }

    fn add(&mut self, name: String, off: f64, most: f64) {
        self.found += 1;
        let ratio = if off == 0.0 { 0.0 } else { off / most };
        if ratio >= self.worst || ratio.is_nan() {
            (self.worst, self.name) = (ratio, name);
        }
    }
}

/// The problem with some of the outputs that it may have; others for each number.
fn asked(problem: &Problem, number: u32, probes: bool) -> Problem {
    let scene = &problem.scene;
    let named = |value: String| Located { value, key: "output".to_owned(), span: 0..0 };
    let mut all = Vec::new();
    for boundary in &scene.boundaries {
        let name = &boundary.name.value;
        let mut add = |word: &str, quantity: Quantity| {
            let of = Some(named(name.clone()));
            all.push(Output { name: named(format!("{word} of {name}")), quantity, of, unit: None });
        };
        add("mean", Quantity::Mean);
        add("flux", Quantity::Flux);
        if matches!(boundary.condition, Condition::Contact { .. }) {
            add("force", Quantity::Force);
        }
    }
    all.push(Output {
        name: named("all".to_owned()),
        quantity: Quantity::Force,
        of: None,
        unit: None,
    });
    if probes {
        let at = Cell::of(problem, number as usize % problem.cells()).middle();
        let (name, quantity) = (named("probe".to_owned()), Quantity::Probe { at });
        all.push(Output { name, quantity, of: None, unit: None });
    }
    let first = number as usize % all.len();
    all.rotate_left(first);
    all.truncate(EACH);
    problem.restated(Scene { outputs: all, ..Scene::clone(scene) })
}

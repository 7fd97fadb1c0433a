//! What `signorini solve` tells of a solution: files, lines, warnings.

use std::iter;
use std::path::Path;

use super::levels;
use signorini_files::answer::Answer;
use signorini_files::digits::{percent_above, rounded, supported};
use signorini_files::stated::Stated;
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_problem::progress::{say, waiting, warn};
use signorini_scene::error::Result;
use signorini_solve::adaptive::Stop;
use signorini_solve::norms::Errors;
use signorini_solve::{Solution, SolverKind};

/// A solution and what is told of it.
pub(super) struct Told {
    answer: Answer,
    /// Why the last level is the last, where levels were asked for.
    pub stop: Option<Stop>,
}

impl Told {
    /// With warnings of what is seen in the solution alone; those of the problem are told already.
    pub fn new(
        problem: Problem,
        solution: Solution,
        energy_norm: Option<f64>,
        asked: SolverKind,
        stop: Option<Stop>,
    ) -> Result<Self> {
        let (known, why) = (problem.warnings.len(), stop.as_ref());
        let why = why.and_then(|stop| levels::why(stop, &solution));
        let answer = || Answer::new(problem, solution, energy_norm, asked, why);
        let answer = waiting("intervals of outputs", answer)?;
        warn(&answer.problem.warnings[known..]);
        Ok(Self { answer, stop })
    }

    /// Whether the solver came to its end.
    pub fn converged(&self) -> bool {
        self.answer.solution.converged()
    }

    /// Writes the files of a solve, and says what is in them.
    pub fn write(&self, out: &Path) -> Result<()> {
        let Answer { problem, solution, energy_norm, errors, .. } = &self.answer;
        self.answer.write(out)?;
        report(problem, solution, *errors, *energy_norm);
        output_lines(&self.answer).iter().for_each(|line| say(format_args!("{line}")));
        Ok(())
    }
}

/// What is told of the declared outputs.
fn output_lines(answer: &Answer) -> Vec<String> {
    let outputs = wanted(&answer.problem.scene);
    let stated = |output| Stated::of(output, &answer.outputs, &answer.intervals);
    let lines = outputs.iter().map(|output| format!("    {}", stated(output).line()));
    iter::once("  outputs:".to_owned()).chain(lines).collect()
}

fn report(
    problem: &Problem,
    solution: &Solution,
    errors: Option<Errors>,
    energy_norm: Option<f64>,
) {
    let counts = problem.topology.counts;
    say(format_args!(
        "  {} unknowns, {} of {} contact edges active",
        counts.unknowns(),
        solution.contact_active,
        counts.contact
    ));
    say(format_args!("  {}", solution.ending()));
    let digits = supported(solution.relative_bound(energy_norm));
    say(format_args!(
        "  contact force {}, contact length {}",
        rounded(solution.contact_force, digits, solution.largest_flux()),
        rounded(solution.contact_length, digits.max(3), 0.0)
    ));
    report_bound(solution, energy_norm);
    if let Some(errors) = errors {
        say(format_args!(
            "  true errors: |u − u_h|₁ {:.5e}, ‖u − u_h‖ {:.5e}, ‖σ − σ_h‖ {:.5e}, ‖A^½∇(u − u_h)‖ {:.5e}",
            errors.h1, errors.l2, errors.flux, errors.energy
        ));
    }
}

/// How wrong each of the two functions can be, or why nobody knows.
fn report_bound(solution: &Solution, energy_norm: Option<f64>) {
    let Some(bound) = solution.bound else {
        let reason = solution.no_bound.as_ref().map_or_else(String::new, ToString::to_string);
        return say(format_args!("  no error bound: {reason}"));
    };
    let part = |of: f64| match energy_norm {
        // Of a constant solution, whose gradient is rounding, a percentage says nothing.
        Some(norm) if norm > of => format!("{} % of ‖A^½∇s‖", percent_above(of / norm)),
        Some(norm) if norm > 0.0 => format!("no less than ‖A^½∇s‖ itself, {norm:.2e}"),
        _ => "‖A^½∇s‖ is 0".to_owned(),
    };
    say(format_args!("  error bounds in the energy norm, guaranteed:"));
    say(format_args!(
        "    continuous s (solution.vtu) with flux τ: {:.2e}, {}; unfinished iterations {:.0e} of it",
        bound.total,
        part(bound.total),
        bound.algebraic
    ));
    say(format_args!("    edge means u_h (edges.csv): {:.2e}, {}", bound.of_u, part(bound.of_u)));
}

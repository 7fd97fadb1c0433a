//! What `signorini solve` tells of a solution: files, lines, warnings.

use std::iter;
use std::path::Path;

use super::levels;
use signorini_draw::{ContactState, ScenePanel, solution_file};
use signorini_files::answer::{Answer, FileSeconds};
use signorini_files::contact::state;
use signorini_files::digits::{percent_above, rounded, supported};
use signorini_files::panel::panel;
use signorini_files::stated::Stated;
use signorini_intervals::Coverage;
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_problem::progress::{say, waiting, warn};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::{Output, Quantity};
use signorini_solve::adaptive::Stop;
use signorini_solve::{Solution, SolverKind};

/// From so many unknowns on it is told what files take.
const LARGE: usize = 100_000;

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
        intervals: Coverage,
        stop: Option<Stop>,
    ) -> Result<Self> {
        let (known, why) = (problem.warnings.len(), stop.as_ref());
        let why = why.and_then(|stop| levels::why(stop, &solution));
        let answer = || Answer::new(problem, solution, energy_norm, asked, intervals, why);
        let answer = waiting("outputs", answer)?;
        warn(&answer.problem.warnings[known..]);
        Ok(Self { answer, stop })
    }

    /// Whether the solver came to its end.
    pub fn converged(&self) -> bool {
        self.answer.solution.converged()
    }

    /// The error bound as a part of the solution, where it has one.
    pub fn relative_bound(&self) -> Option<f64> {
        self.answer.solution.relative_bound(self.answer.energy_norm)
    }

    /// Whether what the solver has left is no answer.
    pub fn broke_down(&self) -> bool {
        self.answer.solution.status.is_breakdown()
    }

    /// The solution as a picture, with a line for each output.
    pub fn picture(&self) -> Result<String> {
        let Answer { problem, solution, outputs, intervals, .. } = &self.answer;
        let fact = |output: &Output| {
            (output.name.value.clone(), Stated::of(output, outputs, intervals).words())
        };
        let facts = wanted(&problem.scene).iter().map(fact).collect();
        let panel = ScenePanel { facts, ..panel(problem, solution) };
        solution_file(&panel).ok_or_else(|| {
            let file = &problem.scene.mesh.value;
            InputError::new("the vertices span no area to draw").file(file).into()
        })
    }

    /// Writes the files of a solve, or the summary alone, and says what is in them.
    pub fn write(&self, out: &Path, has_files: bool) -> Result<()> {
        let taken = match has_files {
            true => Some(self.answer.write(out)?),
            false => self.answer.write_summary(out).map(|()| None)?,
        };
        report(&self.answer);
        output_lines(&self.answer).iter().for_each(|line| say(format_args!("{line}")));
        if let Some(FileSeconds { edges, all }) =
            taken.filter(|_| self.answer.problem.topology.counts.unknowns() >= LARGE)
        {
            let part = 100.0 * edges / all;
            say(format_args!("  files took {all:.1} s, edges.csv {part:.0} % of it"));
        }
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

/// How far the contact force of u_h may be from the exact one, where an output that is this force has an interval.
fn error_of_force(answer: &Answer) -> Option<f64> {
    let force = answer.solution.contact_force;
    let all = wanted(&answer.problem.scene);
    let is_force = |of: &&Output| {
        of.quantity == Quantity::Force && answer.outputs.get(&of.name.value) == Some(&Some(force))
    };
    let interval = |of: &Output| answer.intervals.get(&of.name.value)?.as_ref().ok();
    let found = all.iter().filter(is_force).find_map(interval)?;
    Some(found.plus_minus + (found.center - force).abs())
}

/// How many contact edges have their flux at its limit, and how far u is off their gap at most.
fn below_gap(problem: &Problem, solution: &Solution) -> (usize, f64) {
    let counts = problem.topology.counts;
    // Where u may only be below the gap, edges there are free, and at no limit.
    let is_limited = |&at: &usize| {
        state(problem, solution, at) == ContactState::Saturated
            && problem.loads.flux_range(at).ends()[0].is_finite()
    };
    let limited = (0..counts.contact).filter(is_limited);
    let depth = |at: usize| (solution.u[counts.free + at] - solution.gap(problem, at)).abs();
    limited.map(depth).fold((0, 0.0), |(edges, most), depth| (edges + 1, f64::max(most, depth)))
}

fn report(answer: &Answer) {
    let Answer { problem, solution, energy_norm, errors, .. } = answer;
    let counts = problem.topology.counts;
    let limited = match below_gap(problem, solution) {
        (0, _) => String::new(),
        (edges, depth) => {
            format!(
                "; {edges} at their limit, where u is up to {} off the gap",
                rounded(depth, 3, 0.0)
            )
        }
    };
    say(format_args!(
        "  {} unknowns, {} of {} contact edges active{limited}",
        counts.unknowns(),
        solution.contact_active,
        counts.contact
    ));
    say(format_args!("  {}", solution.ending()));
    let force = solution.contact_force;
    let digits = supported(force, error_of_force(answer));
    say(format_args!(
        "  contact force {}, contact length {}",
        rounded(force, digits, solution.largest_flux()),
        rounded(solution.contact_length, 3, 0.0)
    ));
    report_bound(solution, *energy_norm);
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
    let part = |of: f64| match energy_norm.filter(|norm| !norm.is_nan()) {
        _ if solution.is_constant(energy_norm) => {
            "the solution is constant up to rounding".to_owned()
        }
        Some(norm) if norm > of => {
            format!("{} % of the energy norm of s", percent_above(of / norm))
        }
        Some(norm) => format!("no less than the energy norm of s itself, {norm:.2e}"),
        None => "the energy norm of s is not known".to_owned(),
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

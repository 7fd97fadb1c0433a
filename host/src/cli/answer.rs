//! What `signorini solve` tells of a solution: files, lines, warnings.

use std::collections::BTreeMap;
use std::iter;
use std::path::Path;

use super::levels;
use super::picture::{Drawn, picture};
use signorini_scene::error::Result;
use signorini_solve::adaptive::Stop;
use signorini_solve::functional::wanted;
use signorini_solve::intervals::{self, Found};
use signorini_solve::norms::{Errors, of_solution};
use signorini_solve::output::atomic::write_atomically;
use signorini_solve::output::contact::contact;
use signorini_solve::output::digits::{percent_above, rounded, supported};
use signorini_solve::output::edges::edges_csv;
use signorini_solve::output::stated::Stated;
use signorini_solve::output::summary::Summary;
use signorini_solve::output::vtu::contact_vtu;
use signorini_solve::outputs::outputs;
use signorini_solve::problem::Problem;
use signorini_solve::progress::{say, waiting, warn};
use signorini_solve::solve::{FreeLevel, Solution, SolverKind, free_levels};
use signorini_solve::threads::on_two_threads;

/// A solution and what is told of it.
pub(super) struct Answer {
    problem: Problem,
    pub solution: Solution,
    energy_norm: Option<f64>,
    /// Why the last level is the last, where levels were asked for.
    pub stop: Option<Stop>,
}

impl Answer {
    /// With warnings of what is seen in the solution alone.
    pub fn new(
        mut problem: Problem,
        solution: Solution,
        energy_norm: Option<f64>,
        stop: Option<Stop>,
    ) -> Result<Self> {
        let levels = free_levels(&problem, &solution)?;
        let mut warnings: Vec<_> = levels.iter().map(FreeLevel::sentence).collect();
        warnings.extend(stop.as_ref().and_then(|stop| levels::why(stop, &solution)));
        warn(&warnings);
        problem.warnings.extend(warnings);
        Ok(Self { problem, solution, energy_norm, stop })
    }

    /// Writes the files of a solve, and says what is in them.
    pub fn write(&self, asked: SolverKind, out: &Path) -> Result<()> {
        let Self { problem, solution, energy_norm, .. } = self;
        let errors = of_solution(problem, solution)?;
        let declared = outputs(problem, solution)?;
        let intervals = waiting("intervals of outputs", || {
            let mut found = intervals::of_outputs(problem, solution);
            intervals::estimate(problem, &declared, &mut found);
            found
        });
        let lines = output_lines(problem, &declared, &intervals);
        let summary =
            Summary::new(problem, asked, solution, errors, *energy_norm, declared, &intervals);
        let edges = || edges_csv(problem, solution);
        let cells = || Ok(picture(problem, &Drawn::of(problem, solution)?).into_bytes());
        let contact = || Ok(contact_vtu(&contact(problem, solution)).into_bytes());
        type Bytes<'a> = &'a (dyn Fn() -> Result<Vec<u8>> + Sync);
        let files: [(&str, Bytes); 3] =
            [("edges.csv", &edges), ("solution.vtu", &cells), ("contact.vtu", &contact)];
        let write = |(name, bytes): &(&str, Bytes)| write_atomically(&out.join(name), &bytes()?);
        on_two_threads(&files, write, || ())?;
        // The last: whoever finds it finds the others.
        write_atomically(&out.join("summary.json"), summary.json().as_bytes())?;
        report(problem, solution, errors, *energy_norm);
        lines.iter().for_each(|line| say(format_args!("{line}")));
        Ok(())
    }
}

/// What is told of the declared outputs.
fn output_lines(
    problem: &Problem,
    values: &BTreeMap<String, Option<f64>>,
    intervals: &BTreeMap<String, Found>,
) -> Vec<String> {
    let outputs = wanted(&problem.scene);
    let stated = |output| Stated::of(output, values, intervals);
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
        Some(norm) if norm > 0.0 => format!("{} % of ‖A^½∇s‖", percent_above(of / norm)),
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

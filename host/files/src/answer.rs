//! A solution with all that is told of it: `edges.csv`, `solution.vtu`, `contact.vtu`, `summary.json`.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

use super::atomic::write_atomically;
use super::contact::contact;
use super::digits::percent_above;
use super::edges::edges_csv;
use super::fields::{Drawn, picture};
use super::vtu::contact_vtu;
use signorini_intervals::{Coverage, Found};
use signorini_problem::Problem;
use signorini_problem::threads::on_two_threads;
use signorini_scene::error::Result;
use signorini_solve::adaptive::{Dominant, Term};
use signorini_solve::norms::{Errors, of_solution};
use signorini_solve::outputs::outputs;
use signorini_solve::{FreeLevel, Solution, SolverKind, free_levels};

/// A bound above this part of the energy norm is warned of.
const LARGE: f64 = 0.3;
/// Roundings that a finished solve may leave.
const FINISHED: f64 = 1000.0;

/// Seconds that files took, each on one thread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FileSeconds {
    /// `edges.csv`, the longest.
    pub edges: f64,
    /// All files.
    pub all: f64,
}

/// A solution, and what follows from it.
#[derive(Debug, Clone)]
pub struct Answer {
    /// The problem that was solved.
    pub problem: Problem,
    /// Its solution.
    pub solution: Solution,
    /// (‖A^½∇s‖² + ∫_R h (s − u_ext)²)^½, where there is a bound.
    pub energy_norm: Option<f64>,
    /// The solver that was asked for.
    pub asked: SolverKind,
    /// True errors, where the scene has an exact solution.
    pub errors: Option<Errors>,
    /// The outputs by name.
    pub outputs: BTreeMap<String, Option<f64>>,
    /// Where each lies for the exact solution, or why nobody knows.
    pub intervals: BTreeMap<String, Found>,
}

impl Answer {
    /// Works out what follows from a solution, intervals where they are asked for; `more` is what there is to warn of beside what is
    /// seen in it.
    ///
    /// # Errors
    /// Data that are not finite where outputs or errors ask for them; a probe outside the mesh.
    pub fn new(
        mut problem: Problem,
        solution: Solution,
        energy_norm: Option<f64>,
        asked: SolverKind,
        intervals: Coverage,
        more: Option<String>,
    ) -> Result<Self> {
        let is_told = more.is_some();
        let levels = free_levels(&problem, &solution)?;
        problem.warnings.extend(levels.iter().map(FreeLevel::sentence).chain(more));
        problem.warnings.extend(solution.given_up.clone());
        let part = solution.relative_bound(energy_norm).filter(|part| *part > LARGE);
        if let (Some(part), false) = (part, is_told) {
            let dominant = Dominant::of(&problem, &solution)?;
            // Of a solution that is constant up to the solver's last digits there is nothing to be said.
            let is_finished = solution.algebraic_residual <= FINISHED * solution.scalar.epsilon();
            if dominant.term != Term::Algebraic || !is_finished {
                let size = match part < 1.0 {
                    true => format!("{} % of the energy norm", percent_above(part)),
                    false => "no less than the energy norm itself".to_owned(),
                };
                problem.warnings.push(dominant.warning(&problem, &solution, &size));
            }
        }
        let errors = of_solution(&problem, &solution)?;
        problem.warnings.extend(contradiction(&solution, errors.as_ref()));
        let outputs = outputs(&problem, &solution)?;
        let mut intervals = signorini_intervals::of_outputs(&problem, &solution, intervals);
        signorini_intervals::estimate(&problem, &outputs, &mut intervals);
        Ok(Self { problem, solution, energy_norm, asked, errors, outputs, intervals })
    }

    /// Writes the files into a folder, `summary.json` last: whoever finds it finds the others.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, out: &Path) -> Result<FileSeconds> {
        let Self { problem, solution, .. } = self;
        let edges = || edges_csv(problem, solution);
        let cells = || Ok(picture(problem, &Drawn::of(problem, solution)?).into_bytes());
        let contact = || Ok(contact_vtu(&contact(problem, solution)).into_bytes());
        type Bytes<'a> = &'a (dyn Fn() -> Result<Vec<u8>> + Sync);
        let files: [(&str, Bytes); 3] =
            [("edges.csv", &edges), ("solution.vtu", &cells), ("contact.vtu", &contact)];
        let write = |(name, bytes): &(&str, Bytes)| {
            let begin = Instant::now();
            write_atomically(&out.join(name), &bytes()?)?;
            Ok(begin.elapsed().as_secs_f64())
        };
        let seconds = on_two_threads(&files, write, || ())?;
        self.write_summary(out)?;
        Ok(FileSeconds { edges: seconds[0], all: seconds.iter().sum() })
    }

    /// Writes `summary.json` alone.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_summary(&self, out: &Path) -> Result<()> {
        write_atomically(&out.join("summary.json"), self.summary().json().as_bytes())
    }
}

/// That the measured error is above its bound by more than quadrature and rounding explain.
fn contradiction(solution: &Solution, errors: Option<&Errors>) -> Option<String> {
    let (bound, errors) = (solution.bound?, errors?);
    let (combined, quadrature) = (errors.combined?, errors.quadrature?);
    let explained = bound.total + quadrature + bound.rounding;
    (combined > explained).then(|| {
        format!(
            "the error against [exact], {combined:.3e}, is above the bound, {:.3e}, by more than quadrature and rounding explain. \
             Either [exact] is not the solution of these data, or the bound is wrong",
            bound.total
        )
    })
}

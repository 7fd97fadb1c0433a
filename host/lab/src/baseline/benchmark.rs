//! Everybody on the problems of one scene.

use std::iter::once_with;
use std::path::Path;
use std::time::Instant;

use signorini_kernel::rows::{QUADS, TRIANGLES};

use super::active_set::ActiveSet;
use super::cascade::Cascade;
use super::clarabel::Clarabel;
use super::condensed::condensed;
use super::conforming::Conforming;
use super::contest::Entrant;
use super::full::{Full, quadratic};
use super::load_case::LoadCase;
use super::osqp::{Manner, Osqp};
use super::pivots::Pivots;
use super::psor::Psor;
use super::quadratic::Quadratic;
use super::timed_solver::{Contest, InitialGuess, TimedSolver};
use crate::baseline::record::Baseline;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Parts, Problem};
use signorini_scene::error::Result;

pub(super) const PSOR: &str = "kernel PSOR f64";
pub(super) const CASCADE: &str = "kernel PSOR f64, coarse to fine";
pub(super) const PIVOTS: &str = "kernel pivoting f64";
pub(super) const FACTOR_KEPT: &str = "faer active set, factor kept";

/// A scene, its ticks, and who takes part.
pub(super) struct Benchmark<'a> {
    pub problem: &'a Problem,
    pub moments: &'a [LoadCase],
    /// The energy distance to the discrete solution that is small enough.
    pub target: f64,
    /// OSQP's program.
    pub osqp: Option<&'a Path>,
    /// Coarser grids of triangles that this one is a refinement of, the coarsest first.
    pub coarser: &'a [Problem],
}

impl Benchmark<'_> {
    /// Everybody, one after the other. Who fails is named in `notes`.
    pub fn hold(&self, notes: &mut Vec<String>) -> Result<Vec<Baseline>> {
        let parts = Parts::examine(self.problem)?;
        let (full, factor) = quadratic(self.problem, &parts, self.moments)?;
        let moments = &self.moments[..full.ticks.len()];
        let mut found = Vec::new();
        let mut take = |name: &str, result: Result<Vec<Baseline>>| match result {
            Ok(baselines) => found.extend(baselines),
            Err(error) => notes.push(format!("{name}: {error}")),
        };
        let contest = Contest { problem: "full", quadratic: &full, target: self.target };
        take(PSOR, self.sweeps::<f64>(&contest, &parts, moments));
        take("kernel PSOR f32", self.sweeps::<f32>(&contest, &parts, moments));
        take(CASCADE, self.cascade(&contest, moments));
        take("faer active set", contest.hold("faer active set", &mut ActiveSet::new(&full)));
        let kept = ActiveSet::with_factor(&full);
        take(FACTOR_KEPT, kept.and_then(|mut kept| contest.hold(FACTOR_KEPT, &mut kept)));
        for (name, entrant) in self.general(&full) {
            take(name, entrant.and_then(|mut entrant| contest.hold(name, &mut *entrant)));
        }
        let conforming = Conforming::over(self.problem, moments);
        let conforming = conforming.and_then(|p1| p1.compete(self.target));
        take("conforming P1", conforming);

        let begin = Instant::now();
        match condensed(self.problem, &full, &factor) {
            Ok((quadratic, condensate)) => {
                let seconds = begin.elapsed().as_secs_f64();
                let contest = Contest { problem: "condensed", quadratic: &quadratic, ..contest };
                let exact = Pivots::<f64>::new(&condensate, &quadratic.ticks);
                let in_f32 = Pivots::<f32>::new(&condensate, &quadratic.ticks);
                let mut entrants =
                    vec![(PIVOTS, boxed(exact)), ("kernel pivoting f32", boxed(in_f32))];
                entrants.extend(self.general(&quadratic));
                let found = contest.hold_in_turns(entrants);
                found.into_iter().for_each(|(name, found)| take(name, found));
                let n = quadratic.matrix.order();
                notes.push(format!(
                    "condensing to {n} unknowns takes {seconds:.3} s, once, outside of all counts"
                ));
            }
            Err(error) => notes.push(format!("condensed: {error}")),
        }
        compare(&mut found);
        Ok(found)
    }

    /// Solvers that know nothing but a matrix, each made when its turn comes.
    fn general<'q>(&self, quadratic: &'q Quadratic) -> impl Iterator<Item = Entrant<'q>> {
        let manners = [
            ("OSQP", Manner::Watched),
            ("OSQP, every iteration", Manner::Eager),
            ("OSQP, polished", Manner::Polished),
            ("OSQP as it comes", Manner::Defaults),
        ];
        let programs = self.osqp.into_iter().flat_map(move |program| {
            let osqp = move |manner| boxed(Osqp::new(program, quadratic, manner));
            manners.into_iter().map(move |(name, manner)| (name, osqp(manner)))
        });
        once_with(|| ("Clarabel", boxed(Clarabel::new(quadratic)))).chain(programs)
    }

    fn sweeps<R: Scalar>(
        &self,
        contest: &Contest,
        parts: &Parts,
        moments: &[LoadCase],
    ) -> Result<Vec<Baseline>> {
        let full = Full::<R>::new(self.problem, parts, moments)?;
        match self.problem.mesh.quads.is_empty() {
            true => sweep::<R, TRIANGLES>(contest, &full),
            false => sweep::<R, QUADS>(contest, &full),
        }
    }

    fn cascade(&self, contest: &Contest, moments: &[LoadCase]) -> Result<Vec<Baseline>> {
        if self.coarser.is_empty() {
            return Ok(Vec::new());
        }
        let problems = self.coarser.iter().chain([self.problem]);
        let full = |problem| Full::new(problem, &Parts::examine(problem)?, &moments[..1]);
        let grids: Vec<Full<f64>> = problems.clone().map(full).collect::<Result<_>>()?;
        let grids: Vec<_> = problems.zip(&grids).collect();
        contest.alone(CASCADE, &mut Cascade::new(&grids)?, &[InitialGuess::Cold])
    }
}

fn boxed<'c, C: TimedSolver + 'c>(contestant: Result<C>) -> Result<Box<dyn TimedSolver + 'c>> {
    contestant.map(|contestant| -> Box<dyn TimedSolver> { Box::new(contestant) })
}

fn sweep<R: Scalar, const WIDTH: usize>(
    contest: &Contest,
    full: &Full<R>,
) -> Result<Vec<Baseline>> {
    let name = format!("kernel PSOR {}", R::NAME);
    let mut adaptive = Psor::<R, WIDTH>::adaptive(full.system()?, &full.ticks);
    let mut found = contest.hold(&name, &mut adaptive)?;
    let mut tuned = Psor::<R, WIDTH>::tuned(full.system()?, &full.ticks)?;
    found.extend(contest.hold(&format!("{name}, tuned ω"), &mut tuned)?);
    Ok(found)
}

/// Fills in the ratios: to the kernel in f64 on the same problem, and to its condensed model.
fn compare(found: &mut [Baseline]) {
    let fastest = |problem: &str, start: &str| {
        let of_kernel = found.iter().filter(|b| b.problem == problem && b.start == start);
        let of_kernel = of_kernel
            .filter(|b| b.solver.starts_with("kernel") && b.solver.contains("f64"))
            .map(|b| b.cycles);
        of_kernel.min_by(f64::total_cmp)
    };
    let mut ratios = Vec::new();
    for baseline in found.iter() {
        let problem = if baseline.problem == "condensed" { "condensed" } else { "full" };
        let own = fastest(problem, &baseline.start).unwrap_or(baseline.cycles);
        ratios.push((baseline.cycles / own, fastest("condensed", &baseline.start)));
    }
    for (baseline, (ratio, condensed)) in found.iter_mut().zip(ratios) {
        baseline.ratio = ratio;
        baseline.to_condensed = condensed.map(|cycles| baseline.cycles / cycles);
    }
}

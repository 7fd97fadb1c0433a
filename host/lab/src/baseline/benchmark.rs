//! All solvers on the problems of one scene.

use std::iter::once_with;
use std::path::Path;
use std::time::Instant;

use signorini_kernel::rows::{QUADS, TRIANGLES};

use super::active_set::ActiveSet;
use super::cascade::Cascade;
use super::clarabel::Clarabel;
use super::condensed::condensed;
use super::contest::{Entrant, Outcome};
use super::osqp::{LIMIT, Manner, Osqp};
use super::pivots::Pivots;
use super::psor::{Full, Psor, quadratic};
use super::quadratic::Quadratic;
use super::series::{Baseline, Task};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Loads, Parts, Problem};
use signorini_scene::Result;

/// The share of the discretisation error that a solver may leave.
const SHARE: f64 = 0.01;
pub(super) const PSOR: &str = "kernel PSOR f64";
const MANNERS: [(&str, Manner); 4] = [
    ("OSQP", Manner::Watched),
    ("OSQP, every iteration", Manner::Eager),
    ("OSQP, polished", Manner::Polished),
    ("OSQP as it comes", Manner::Defaults),
];

/// A scene, its ticks, and what the solvers are asked for.
pub(super) struct Benchmark<'a> {
    pub problem: &'a Problem,
    pub moments: &'a [Loads],
    /// The energy distance to the discrete solution that is small enough.
    pub target: f64,
    pub osqp: Option<&'a Path>,
    /// Coarser grids of triangles that this one is a refinement of, the coarsest first.
    pub coarser: &'a [Problem],
}

impl<'a> Benchmark<'a> {
    /// Without OSQP and coarser grids, for this error of the discrete solution.
    pub fn new(problem: &'a Problem, moments: &'a [Loads], error: f64) -> Self {
        Self { problem, moments, target: SHARE * error, osqp: None, coarser: &[] }
    }

    /// All solvers, one after the other; those that fail are named in `notes`.
    pub fn hold(&self, notes: &mut Vec<String>) -> Result<Vec<Baseline>> {
        let parts = Parts::examine(self.problem)?;
        let (full, factor) = quadratic(self.problem, &parts, self.moments)?;
        let moments = &self.moments[..full.ticks.len()];
        let mut found = Vec::new();
        let mut take = |(name, result): Outcome| match result {
            Ok(baselines) => found.extend(baselines),
            Err(error) => notes.push(format!("{name}: {error}")),
        };
        let task = Task { problem: "full", quadratic: &full, target: self.target };
        self.sweeps::<f64>(&task, &parts, moments, &mut take);
        self.sweeps::<f32>(&task, &parts, moments, &mut take);
        self.cascade(&task)?.into_iter().for_each(&mut take);
        for (name, keeps) in [("faer active set", false), ("faer active set, factor kept", true)] {
            take(task.alone(Entrant::new(name, ActiveSet::new(&full, keeps))));
        }
        self.general(&full).map(|entrant| task.alone(entrant)).for_each(&mut take);

        let begin = Instant::now();
        match condensed(self.problem, &full, &factor) {
            Ok((quadratic, model)) => {
                let seconds = begin.elapsed().as_secs_f64();
                let task = Task { problem: "condensed", quadratic: &quadratic, ..task };
                let ticks = &quadratic.ticks;
                let mut entrants = vec![
                    Entrant::new("kernel pivoting f64", Pivots::<f64>::new(&model, ticks)),
                    Entrant::new("kernel pivoting f32", Pivots::<f32>::new(&model, ticks)),
                ];
                entrants.extend(self.general(&quadratic));
                task.in_turns(entrants).into_iter().for_each(take);
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
        let clarabel = once_with(move || Entrant::new("Clarabel", Clarabel::new(quadratic)));
        clarabel.chain(self.osqp.into_iter().flat_map(move |program| {
            MANNERS.into_iter().map(move |(name, manner)| {
                Entrant::new(name, Osqp::new(program, quadratic, manner, LIMIT))
            })
        }))
    }

    /// Sweeps with the ω that they find themselves, and with the best fixed one.
    fn sweeps<R: Scalar>(
        &self,
        task: &Task,
        parts: &Parts,
        moments: &[Loads],
        take: &mut impl FnMut(Outcome),
    ) {
        let name = format!("kernel PSOR {}", R::NAME);
        match Full::<R>::new(self.problem, parts, moments) {
            Ok(full) if self.problem.mesh.quads.is_empty() => {
                sweep::<R, TRIANGLES>(task, &full, &name, take);
            }
            Ok(full) => sweep::<R, QUADS>(task, &full, &name, take),
            Err(error) => take((name, Err(error))),
        }
    }

    /// Sweeps from coarse to fine, where there are coarser grids.
    fn cascade(&self, task: &Task) -> Result<Option<Outcome>> {
        if self.coarser.is_empty() {
            return Ok(None);
        }
        let problems = self.coarser.iter().chain([self.problem]);
        let grids: Vec<Full<f64>> = problems.clone().map(at_first).collect::<Result<_>>()?;
        let grids: Vec<_> = problems.zip(&grids).collect();
        let name = "kernel PSOR f64, coarse to fine";
        Ok(Some(task.alone(Entrant::new(name, Cascade::new(&grids)))))
    }
}

/// The problem as the first tick has it.
fn at_first(problem: &Problem) -> Result<Full<'_, f64>> {
    let loads = Loads::of(problem)?;
    Full::new(problem, &Parts::examine(problem)?, &[loads])
}

fn sweep<R: Scalar, const WIDTH: usize>(
    task: &Task,
    full: &Full<R>,
    name: &str,
    take: &mut impl FnMut(Outcome),
) {
    let adaptive = full.system().map(|system| Psor::<R, WIDTH>::adaptive(system, &full.ticks));
    take(task.alone(Entrant::new(name, adaptive)));
    let tuned = full.system().and_then(|system| Psor::<R, WIDTH>::tuned(system, &full.ticks));
    take(task.alone(Entrant::new(&format!("{name}, tuned ω"), tuned)));
}

/// Fills in the ratios: to the kernel in f64 on the same problem, and to its condensed model.
fn compare(found: &mut [Baseline]) {
    let all = found.to_vec();
    let fastest = |problem: &str, start: &str| {
        let of_kernel = all.iter().filter(|b| b.solver.starts_with("kernel"));
        let of_kernel = of_kernel.filter(|b| b.solver.contains("f64"));
        let own = of_kernel.filter(|b| b.problem == problem && b.start == start);
        own.map(|b| b.cycles).min_by(f64::total_cmp)
    };
    for Baseline { problem, start, cycles, ratio, to_condensed, .. } in found {
        *ratio = *cycles / fastest(problem, start).unwrap_or(*cycles);
        *to_condensed = fastest("condensed", start).map(|fastest| *cycles / fastest);
    }
}

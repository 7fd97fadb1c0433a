//! One contact problem solved: by the kernel in either scalar, or by the faer reference.

mod auto;
mod direct;
mod factored;
mod ldlt;
mod mixed;
mod options;
mod ran;
mod solution;
#[cfg(test)]
mod tests;
mod tuned;
mod units;

pub use auto::prefers_factor;
pub use factored::Factored;
pub use mixed::{Corrected, Mixed, mixed};
pub use options::{Options, ScalarKind, SolverKind};
pub use ran::Ran;
pub use solution::{Seconds, Solution, ended_name, status_name};
pub use tuned::{Trials, tuned_omega};
pub use units::{choose as choose_units, choose_for_inputs, times};

use std::time::Instant;

use signorini_kernel::boundary::Boundary;
use signorini_kernel::conjugate::ConjugateBuffers;
use signorini_kernel::edges::Edges;
use signorini_kernel::refinement::{self, RefinementBuffers};
use signorini_kernel::rows::{self, Row, Rows};
use signorini_kernel::signorini::System;
use signorini_kernel::solver::{Outcome, Settings, Status};
use signorini_kernel::{Error as KernelError, Libm, Real, contact, flux};

use crate::certify::{Certified, Data};
use crate::problem::{Assembled, Parts, Problem};
use crate::progress::stage;
use crate::scalar::Scalar;
pub use direct::Reduced;
pub use ldlt::{Exchanges, Ldlt};
use signorini_scene::error::{Error, InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
pub use solution::centre_floating;

/// Solves `problem`, which `scene` states on a mesh; where its numbers are far from 1, in units in which
/// they are not ([`Solution::units`]).
///
/// # Errors
/// No solution, numbers that the scalar type cannot hold, a singular matrix.
pub fn solve(problem: &Problem, options: &Options) -> Result<Solution> {
    let units = choose_units(problem)?;
    if units == Units::default() {
        return solve_in_its_units(problem, options);
    }
    let solution = solve_in_its_units(&problem.in_units(&units)?, options)?;
    Ok(Solution { units, ..times(&units, solution) })
}

fn solve_in_its_units(problem: &Problem, options: &Options) -> Result<Solution> {
    let parts = Parts::examine(problem)?;
    match (options.solver, options.scalar) {
        (SolverKind::Auto, ScalarKind::F64) => auto::in_f64(problem, &parts, options),
        (SolverKind::Auto, ScalarKind::F32) => auto::in_f32(problem, &parts, options),
        (SolverKind::Kernel, ScalarKind::F64) => by_kernel::<f64>(problem, &parts, options),
        (SolverKind::Kernel, ScalarKind::F32) => by_kernel::<f32>(problem, &parts, options),
        (SolverKind::Direct, ScalarKind::F64) => direct::directly(problem, &parts, options),
        (SolverKind::Direct, ScalarKind::F32) => {
            Err(InputError::new("--solver direct works in f64, --scalar f32 was asked for")
                .hint("leave out --scalar, or use --solver auto")
                .into())
        }
    }
}

/// The kernel's refusal, in the scene's words.
pub fn unfit<R: Scalar>(scene: &Scene) -> impl Fn(KernelError) -> Error + '_ {
    move |error| {
        InputError::new(format!("the scene does not fit {}: {error}", R::NAME))
            .file(&scene.path)
            .hint("scale the data so that they are neither tiny nor huge, or use --scalar f64")
            .into()
    }
}

fn overflow<R: Scalar>(scene: &Scene) -> Error {
    InputError::new(format!("not-finite: the solution overflows {}", R::NAME))
        .file(&scene.path)
        .hint("scale the data so that they are neither tiny nor huge, or use --scalar f64")
        .into()
}

fn by_kernel<R: Scalar>(problem: &Problem, parts: &Parts, options: &Options) -> Result<Solution> {
    let unfit = unfit::<R>(&problem.scene);
    let mut clock = Clock::start();
    let mut assembled = Assembled::<R>::new(problem).map_err(&unfit)?;
    assembled.set_parts(parts);
    let system = assembled.system().map_err(&unfit)?;
    let boundary = assembled.boundary().map_err(&unfit)?;
    let assembly = clock.lap();

    let mut u = assembled.start();
    let mut low = vec![R::ZERO; u.len()];
    let iterate = if problem.mesh.quads.is_empty() {
        iterate::<R, { rows::TRIANGLES }>
    } else {
        iterate::<R, { rows::QUADS }>
    };
    let found = iterate(&system, &boundary, assembled.edges(), options, &mut u, &mut low);
    let ((outcome, factored), scalar) = (found.map_err(&unfit)?, options.scalar);
    let ran = if factored.is_some() { Ran::Factor } else { Ran::Sweeps };
    let solved = Solved { outcome, ran, factored, u, low, scalar, assembly, clock };
    conclude(problem, parts, &assembled, solved)
}

/// An iterate, and the time up to its assembly.
struct Solved<R> {
    outcome: Outcome<R>,
    ran: Ran,
    factored: Option<Factored>,
    u: Vec<R>,
    /// The low part of u, or nothing.
    low: Vec<R>,
    scalar: ScalarKind,
    assembly: f64,
    /// Started after the assembly.
    clock: Clock,
}

/// Fluxes, certificate and what is read off.
fn conclude<R: Scalar>(
    problem: &Problem,
    parts: &Parts,
    assembled: &Assembled<R>,
    solved: Solved<R>,
) -> Result<Solution> {
    let unfit = unfit::<R>(&problem.scene);
    let Solved { outcome, ran, factored, u, low, scalar, assembly, mut clock } = solved;
    if outcome.status == Status::NotFinite {
        return Err(overflow::<R>(&problem.scene));
    }
    let solve = clock.lap();
    stage("fluxes and error bound");
    let fluxes = Fluxes::recover(assembled, &u, &low).map_err(&unfit)?;
    let flux = clock.lap();
    let data = Data::new(problem)?;
    let certified = Certified::new(problem, parts, assembled, &data, &u).map_err(&unfit)?;
    let seconds = Seconds { assembly, solve, flux, certificate: clock.lap() };
    let found = Found { outcome, ran, factored, u, fluxes, certified, seconds };
    Ok(finish(problem, parts, assembled, found, scalar))
}

/// Sweeps with rows of `WIDTH` entries and refines, and where that does not end takes the factor; `low`
/// becomes the low part of `u`.
fn iterate<R: Scalar, const WIDTH: usize>(
    system: &System<R, u32>,
    boundary: &Boundary<R, u32>,
    edges: &Edges<u32>,
    options: &Options,
    u: &mut [R],
    low: &mut [R],
) -> std::result::Result<(Outcome<R>, Option<Factored>), KernelError> {
    let settings = options.settings::<R>();
    let patience = Settings { max_sweeps: options.max_sweeps.min(refinement::PLAIN), ..settings };
    let sweep = |settings, u: &mut [R], low: &mut [R]| {
        sweep::<R, WIDTH>(system, boundary, edges, settings, options.rounds(), u, low)
    };
    stage(&format!("at most {} sweeps", patience.max_sweeps));
    let swept = sweep(patience, u, low)?;
    let ended = !matches!(swept.status, Status::OutOfSweeps | Status::Stalled);
    if ended || swept.sweeps >= options.max_sweeps {
        return Ok((swept, None));
    }
    if let Some((found, factored)) = factored::solve(system, boundary, &settings, u, low)? {
        return Ok((Outcome { sweeps: swept.sweeps, ..found }, Some(factored)));
    }
    let left = options.max_sweeps - swept.sweeps;
    stage(&format!("at most {left} more sweeps, as no factor solves it"));
    let mut found = sweep(Settings { max_sweeps: left, ..settings }, u, low)?;
    found.sweeps = found.sweeps.saturating_add(swept.sweeps);
    Ok((found, None))
}

fn sweep<R: Scalar, const WIDTH: usize>(
    system: &System<R, u32>,
    boundary: &Boundary<R, u32>,
    edges: &Edges<u32>,
    settings: Settings<R>,
    rounds: u32,
    u: &mut [R],
    low: &mut [R],
) -> std::result::Result<Outcome<R>, KernelError> {
    let counts = edges.counts();
    let mut rows = vec![Row::<R, u32, WIDTH>::EMPTY; counts.unknowns()];
    let buffers = RefinementBuffers {
        rows: Rows::new(edges, &mut rows)?,
        low,
        defect: &mut vec![R::ZERO; counts.unknowns()],
        lower: &mut vec![R::ZERO; counts.contact],
        conjugate: ConjugateBuffers {
            direction: &mut vec![R::ZERO; counts.edges()],
            residual: &mut vec![R::ZERO; counts.unknowns()],
        },
    };
    refinement::run::<R, u32, Libm, WIDTH>(system, boundary, settings, rounds, u, buffers)
}

struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Self(Instant::now())
    }

    fn lap(&mut self) -> f64 {
        let lap = self.0.elapsed().as_secs_f64();
        self.0 = Instant::now();
        lap
    }
}

struct Fluxes<R> {
    flux: Vec<R>,
    mismatch: f64,
    force: f64,
}

impl<R: Scalar> Fluxes<R> {
    fn recover(
        assembled: &Assembled<R>,
        u: &[R],
        low: &[R],
    ) -> std::result::Result<Self, KernelError> {
        let edges = assembled.edges();
        let mut flux = vec![R::ZERO; u.len()];
        let (stiffness, cells) = (assembled.stiffness(), assembled.cells());
        let found = flux::recover(edges, stiffness, cells, u, low, &mut flux)?;
        let (boundary, lower) = (assembled.boundary()?, assembled.lower());
        let force = contact::force(edges.counts(), &boundary, lower, u, &flux).wide();
        let mismatch = found.mismatch.wide() / found.largest.wide().max(f64::TINY);
        Ok(Self { flux, mismatch, force })
    }
}

struct Found<R> {
    outcome: Outcome<R>,
    ran: Ran,
    factored: Option<Factored>,
    u: Vec<R>,
    fluxes: Fluxes<R>,
    certified: Certified,
    seconds: Seconds,
}

fn finish<R: Scalar>(
    problem: &Problem,
    parts: &Parts,
    assembled: &Assembled<R>,
    found: Found<R>,
    scalar: ScalarKind,
) -> Solution {
    let Found { outcome, ran, factored, u, fluxes, certified, seconds } = found;
    let counts = problem.topology.counts;
    let lower = assembled.lower();
    let active = (0..counts.contact).filter(|&at| contact::is_active(counts, lower, &u, at));
    let active: Vec<usize> = active.collect();
    let mut solution = Solution {
        scalar,
        status: outcome.status,
        sweeps: outcome.sweeps,
        conjugate: outcome.conjugate,
        ran,
        factored,
        units: Units::default(),
        algebraic_residual: outcome.residual.scaled().wide(),
        omega: outcome.omega.wide(),
        u: u.iter().map(|x| x.wide()).collect(),
        flux: fluxes.flux.iter().map(|x| x.wide()).collect(),
        mismatch: fluxes.mismatch,
        contact_force: fluxes.force,
        contact_length: active.iter().fold(0.0, |sum, at| sum + problem.lengths[counts.free + at]),
        contact_active: active.len(),
        parts: parts.counts,
        bound: certified.bound,
        no_bound: certified.no_bound,
        certified: certified.answer,
        seconds,
    };
    if parts.counts.floating > 0 {
        let (u, vertices) = (&mut solution.u, &mut solution.certified.vertices);
        centre_floating(problem, parts, u, vertices);
    }
    solution
}

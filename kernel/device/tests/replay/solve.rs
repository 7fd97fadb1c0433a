//! Solves: how ω moves, where they end, and the help that slow ones get.

use signorini_kernel::conjugate;
use signorini_kernel::law::Law;
use signorini_kernel::refinement;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{QUADS, Row, Rows};
use signorini_kernel::solver::{Settings, Solver};
use signorini_kernel::{Error, Libm, psor};

use super::arrays::Arrays;
use super::journal::Journal;
use super::scene::Scalar;

pub fn run<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    for shifts in [false, true] {
        for (relaxation, max_sweeps) in [
            (Relaxation::Adaptive(R::ONE), 1500),
            (Relaxation::Adaptive(R::of(1.875)), 600),
            (Relaxation::for_unknowns(10 * arrays.load.len()), 300),
            (Relaxation::Fixed(R::of(1.5)), 400),
        ] {
            let settings = Settings { relaxation, max_sweeps, ..Settings::default() };
            journal.line("settings", relaxation);
            stepped(arrays, settings, shifts, journal)?;
        }
    }
    Ok(())
}

/// Every ω on the way, and the end.
fn stepped<R: Scalar>(
    arrays: &Arrays<R>,
    settings: Settings<R>,
    shifts: bool,
    journal: &mut Journal,
) -> Result<(), Error> {
    let (edges, system) = (arrays.edges()?, arrays.system(shifts)?);
    let mut memory = vec![Row::<R, u16, QUADS>::EMPTY; arrays.counts.unknowns()];
    let mut rows = Rows::new(&edges, &mut memory)?;
    let mut u = arrays.start.clone();
    let mut solver = Solver::new(settings)?;
    let mut ended = solver.start(&system, &mut rows, &mut u)?;
    let (mut moves, mut sweeps) = (Vec::new(), 0);
    while ended.is_none() {
        let before = rows.omega();
        ended = solver.step(&system, &mut rows, &mut u)?;
        sweeps += 1;
        if rows.omega() != before {
            moves.push((sweeps, rows.omega()));
        }
    }
    journal.digest("moves", &moves);
    journal.line("outcome", ended.map(|outcome| (outcome.status, outcome.sweeps, outcome.omega)));
    journal.digest("residual", ended.map(|outcome| outcome.residual));
    journal.digest("u", &u);
    Ok(())
}

pub fn help<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    let (edges, system) = (arrays.edges()?, arrays.system(false)?);
    let (unknowns, all) = (arrays.counts.unknowns(), arrays.counts.edges());
    let mut memory = vec![Row::<R, u16, QUADS>::EMPTY; unknowns];
    let (mut direction, mut residual) = (vec![R::ZERO; all], vec![R::ZERO; unknowns]);
    for (sweeps, goal, iterations) in
        [(0, 0.0, 20), (3, 1e-3, 500), (3, 1e-6, 500), (0, 0.0, 300), (20, 1e30, 9)]
    {
        let mut rows = Rows::new(&edges, &mut memory)?;
        rows.set(&system, R::ONE)?;
        let mut u = arrays.start.clone();
        for _ in 0..sweeps {
            psor::sweep(&rows, Law::above(&arrays.lower), &mut u)?;
        }
        let (goal, scratch) = (R::of(goal), [&mut direction[..], &mut residual]);
        let used = conjugate::run(&system, &mut rows, goal, iterations, &mut u, scratch)?;
        journal.line("iterations", used);
        journal.digest("u", &u);
        journal.digest("direction and residual", (&direction, &residual));
    }
    refined(arrays, 0.0, journal)?;
    refined(arrays, 1e-6, journal)
}

/// At most so many sweeps that no help is needed.
fn refined<R: Scalar>(
    arrays: &Arrays<R>,
    tolerance: f64,
    journal: &mut Journal,
) -> Result<(), Error> {
    let counts = arrays.counts;
    let mut memory = vec![Row::<R, u16, QUADS>::EMPTY; counts.unknowns()];
    let [mut low, mut scratch] =
        [counts.edges(), refinement::scratch(counts)].map(|length| vec![R::ONE; length]);
    let rows = Rows::new(&arrays.edges()?, &mut memory)?;
    let settings = Settings {
        accuracy: R::EPSILON,
        tolerance: R::of(tolerance),
        max_sweeps: 2000,
        ..Settings::default()
    };
    let (system, diagonal) = (arrays.system(true)?, arrays.diagonal()?);
    let mut u = arrays.start.clone();
    let (both, all) = ([&mut u[..], &mut low], &mut scratch);
    let outcome =
        refinement::run::<R, u16, Libm, QUADS>(&system, diagonal, settings, 4, both, rows, all)?;
    journal.line("refined", (outcome.status, outcome.sweeps, outcome.conjugate, outcome.omega));
    journal.digest("residual", outcome.residual);
    journal.digest("u", (&u, &low));
    Ok(())
}

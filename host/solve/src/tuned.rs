//! The best fixed ω of a problem: the one that needs the fewest sweeps from a cold start.
//!
//! Sweeps are counted until the algebraic error has fallen to a given share,
//! ```text
//!   ‖u − u*‖_K ≤ goal ‖u₀ − u*‖_K,     ‖v‖_K² = vᵀKv, u* from the direct solver
//! ```
//! As a function of t = ln(2 − ω) their number falls like e^(2t)…e^t towards its minimum and rises like e^−t
//! beyond: one valley, with small steps, since the error is looked at every few sweeps. It is walked down by
//! doubling or halving 2 − ω and then searched by golden sections; no trial goes on for longer than the best
//! one took.

use std::f64::consts::LN_2;

use signorini_kernel::Error as KernelError;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{self, Row, Rows};
use signorini_kernel::solver::{Settings, Solver};

use super::{Options, SolverKind, solve, unfit};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::{InputError, Result};
use signorini_scene::setting::Precision;

/// The smaller part of a golden section.
const GOLDEN: f64 = 0.381_966;

/// Most sweeps of a trial.
const MOST: u32 = 200_000;

/// Golden sections after the valley is found: they leave 3 % of 2 − ω open.
const SECTIONS: u32 = 8;

/// 2 − ω from its widest to where f32 still tells ω from 2.
const WIDEST: f64 = 1.0;
const NARROWEST: f64 = 1e-5;

/// The ω with the fewest sweeps until the error in energy is `goal` times what it was, in (0, 1), from a
/// cold start. Sweeps in f32 on residuals in f64 converge like those in f64.
///
/// # Errors
/// No solution; a goal that the scalar type cannot reach.
pub fn tuned_omega(problem: &Problem, precision: Precision, goal: f64) -> Result<f64> {
    match precision {
        Precision::F32 => Trials::<f32>::new(problem, goal)?.best(),
        Precision::F64 | Precision::Mixed => Trials::<f64>::new(problem, goal)?.best(),
    }
    .ok_or_else(|| {
        let message = format!("no ω brings the error down to {goal:e} of what it was");
        let hint = "ask for less, or sweep in f64";
        InputError::new(message).file(&problem.scene.path).hint(hint).into()
    })
}

/// Cold starts towards one solution.
#[derive(Debug)]
pub struct Trials<'p, R: Scalar> {
    assembled: Assembled<'p, R>,
    solution: Vec<f64>,
    goal: f64,
}

impl<'p, R: Scalar> Trials<'p, R> {
    /// Solves for u*; `goal` as for [`tuned_omega`].
    ///
    /// # Errors
    /// No solution, numbers that the scalar type cannot hold.
    pub fn new(problem: &'p Problem, goal: f64) -> Result<Self> {
        let solution = solve(problem, &Options::by(SolverKind::Direct))?.u;
        let mut assembled = Assembled::new(problem).map_err(unfit::<R>(&problem.scene))?;
        assembled.set_parts(&Parts::examine(problem)?);
        let mut trials = Self { assembled, solution, goal: 0.0 };
        let start = trials.assembled.start();
        trials.goal = goal * trials.error(&start).map_err(unfit::<R>(&problem.scene))?;
        Ok(trials)
    }

    /// Sweeps from a cold start to the goal; none where `most` are not enough.
    ///
    /// # Errors
    /// An ω outside (0, 2).
    pub fn sweeps(
        &self,
        relaxation: Relaxation<R>,
        most: u32,
    ) -> std::result::Result<Option<u32>, KernelError> {
        if self.assembled.edges().of_quads().is_empty() {
            self.count::<{ rows::TRIANGLES }>(relaxation, most)
        } else {
            self.count::<{ rows::QUADS }>(relaxation, most)
        }
    }

    fn count<const WIDTH: usize>(
        &self,
        relaxation: Relaxation<R>,
        most: u32,
    ) -> std::result::Result<Option<u32>, KernelError> {
        let system = self.assembled.system()?;
        let settings = Settings { relaxation, max_sweeps: most, ..Settings::default() };
        let mut memory = vec![Row::<R, u32, WIDTH>::EMPTY; system.counts().unknowns()];
        let mut rows = Rows::new(self.assembled.edges(), &mut memory)?;
        let mut solver = Solver::<R>::new(settings)?;
        let mut u = self.assembled.start();
        let mut ended = solver.start(&system, &mut rows, &mut u)?.is_some();
        let mut sweeps = 0;
        while self.error(&u)? > self.goal {
            // An ω near the best needs about 2/(2 − ω) sweeps a digit: one in 20 is close enough.
            let steps = 1 + (0.1 / (2.0 - rows.omega().wide())) as u32;
            for _ in 0..steps {
                if ended {
                    return Ok(None);
                }
                ended = solver.step(&system, &mut rows, &mut u)?.is_some();
                sweeps += 1;
            }
        }
        Ok(Some(sweeps))
    }

    /// ‖u − u*‖_K; u_D is the same in both, and K has rows for the other edges.
    fn error(&self, u: &[R]) -> std::result::Result<f64, KernelError> {
        let system = self.assembled.system()?;
        let unknowns = system.counts().unknowns();
        let differences = u.iter().zip(&self.solution).take(unknowns);
        let v: Vec<f64> = differences.map(|(u, of_solution)| u.wide() - of_solution).collect();
        let rows = system.matrix().iter().zip(&v);
        let square = rows.fold(0.0, |sum, (row, own)| {
            let entries = row.entries().filter(|&(column, _)| column < unknowns);
            sum + own * entries.map(|(column, value)| value.wide() * v[column]).sum::<f64>()
        });
        Ok(square.max(0.0).sqrt())
    }

    /// The bottom of the valley; none where the first trial does not reach the goal.
    pub fn best(&self) -> Option<f64> {
        let count = |t: f64, most: u32| {
            let omega = R::narrow(2.0 - t.exp());
            self.sweeps(Relaxation::Fixed(omega), most).ok().flatten().map(|sweeps| (t, sweeps))
        };
        let unknowns = self.assembled.edges().counts().unknowns();
        let (Relaxation::Fixed(near) | Relaxation::Adaptive(near)) =
            Relaxation::<f64>::for_unknowns(unknowns);
        let mut best = count((2.0 - near).ln(), MOST)?;
        for step in [-LN_2, LN_2] {
            let fewer = |best: (f64, u32)| {
                let t = best.0 + step;
                let inside = (NARROWEST..=WIDEST).contains(&t.exp());
                inside.then(|| count(t, best.1.saturating_sub(1))).flatten()
            };
            while let Some(better) = fewer(best) {
                best = better;
            }
        }
        let (mut low, mut high) = (best.0 - LN_2, (best.0 + LN_2).min(WIDEST.ln()));
        for _ in 0..SECTIONS {
            let (down, up) = (best.0 - low, high - best.0);
            let t = if down > up { best.0 - GOLDEN * down } else { best.0 + GOLDEN * up };
            let (worse, is_below) = match count(t, best.1.saturating_sub(1)) {
                Some(better) => {
                    let before = std::mem::replace(&mut best, better).0;
                    (before, before < t)
                }
                None => (t, t < best.0),
            };
            *if is_below { &mut low } else { &mut high } = worse;
        }
        Some(2.0 - best.0.exp())
    }
}

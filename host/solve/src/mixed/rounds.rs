//! Rounds of sweeps in f32, each followed by a correction in f64, until the residual in f64 is small.

use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::Rows;
use signorini_kernel::solver::{Outcome, Settings, Solver, Status};
use signorini_kernel::system::{Residual, System};

use super::correction::Correction;
use super::{Corrected, Refused};

/// Sweeps without a fall of the residual after which a solve has stalled.
const PATIENCE: u32 = 50_000;

/// Rounds without a fall near the limit of f64 after which that limit is reached.
const AT_LIMIT: u32 = 4;

pub(super) struct Rounds<'a> {
    pub wide: System<'a, f64, u32>,
    pub narrow: System<'a, f32, u32>,
    pub settings: Settings<f64>,
    pub correction: &'a mut Correction,
}

/// The smallest residual so far, and when that was.
#[derive(Clone, Copy)]
struct Best {
    largest: f64,
    sweeps: u32,
    corrections: u32,
}

impl Rounds<'_> {
    pub fn run<const WIDTH: usize>(
        self,
        mut rows: Rows<f32, u32, WIDTH>,
        u: &mut [f64],
    ) -> Refused<Corrected> {
        let Self { wide, narrow, settings, correction } = self;
        wide.make_feasible(u);
        let mut solver = Solver::<f32>::new(endless(settings.relaxation))?;
        let mut now = Corrected {
            outcome: Outcome {
                status: Status::OutOfSweeps,
                sweeps: 0,
                conjugate: 0,
                residual: wide.residual(u),
                omega: 1.0,
            },
            corrections: 0,
        };
        let first = now.outcome.residual.largest;
        let unit = now.outcome.residual.scale().log2().round().exp2();
        let mut best = Best { largest: f64::INFINITY, sweeps: 0, corrections: 0 };
        let mut length = first_length(settings.relaxation);
        loop {
            if let Some(status) = judge(&settings, &now, first, &mut best) {
                now.outcome.status = status;
                return Ok(now);
            }
            correction.pose(&wide, unit, u);
            let (system, v) = correction.posed(&narrow)?;
            if now.corrections == 0 {
                solver.start(&system, &mut rows, v)?;
            } else {
                let omega = rows.omega();
                rows.set(&system, omega)?;
            }
            let most = settings.max_sweeps - now.outcome.sweeps;
            let mut done = 0;
            while done < length.min(most) {
                done += 1;
                // Only the residual in f64 can tell the end.
                solver.step(&system, &mut rows, v)?;
            }
            correction.add_to(&wide, unit, u);
            let before = now.outcome.residual;
            now.outcome.sweeps += done;
            now.outcome.omega = f64::from(rows.omega());
            now.outcome.residual = wide.residual(u);
            now.corrections += 1;
            length = next_length(&settings, &now.outcome, &before, done);
        }
    }
}

/// Settings of a search that ends when it is told to.
fn endless(relaxation: Relaxation<f64>) -> Settings<f32> {
    let relaxation = match relaxation {
        Relaxation::Fixed(omega) => Relaxation::Fixed(omega as f32),
        Relaxation::Adaptive(omega) => Relaxation::Adaptive(omega as f32),
    };
    Settings { relaxation, max_sweeps: u32::MAX, ..Settings::default() }
}

fn judge(settings: &Settings<f64>, now: &Corrected, first: f64, best: &mut Best) -> Option<Status> {
    let Outcome { sweeps, residual, omega, .. } = now.outcome;
    if !(residual.largest.is_finite() && residual.range.is_finite()) {
        return Some(Status::NotFinite);
    }
    // An ω that is not the best tells less than the sweeps that it took.
    let tail = sweeps_ahead(&now.outcome, first) * residual.largest;
    let is_near = tail <= settings.accuracy * residual.scale().max(settings.scale);
    if residual.largest <= goal(settings, &residual, omega) && is_near {
        return Some(Status::Converged);
    }
    if residual.largest < 0.875 * best.largest {
        *best = Best { largest: residual.largest, sweeps, corrections: now.corrections };
    }
    let at_limit = residual.largest * (2.0 - omega) <= 4.0 * residual.rounding;
    if at_limit && now.corrections - best.corrections >= AT_LIMIT {
        return Some(Status::RoundingLimit);
    }
    if sweeps - best.sweeps > PATIENCE {
        return Some(Status::Stalled);
    }
    (sweeps >= settings.max_sweeps).then_some(Status::OutOfSweeps)
}

/// How much larger than the last step all those to come are, from how fast residuals have fallen since the `first`; 0 where
/// that tells nothing. A sweep moves by up to ω < 2 times a residual.
fn sweeps_ahead(now: &Outcome<f64>, first: f64) -> f64 {
    let fallen = (first / now.residual.largest).ln();
    if fallen > 0.0 { 2.0 * f64::from(now.sweeps) / fallen } else { 0.0 }
}

/// The largest step that is small enough.
fn goal(settings: &Settings<f64>, residual: &Residual<f64>, omega: f64) -> f64 {
    let accuracy = settings.accuracy / settings.amplification(omega);
    settings.tolerance.min(accuracy) * residual.scale().max(settings.scale)
}

fn first_length(relaxation: Relaxation<f64>) -> u32 {
    let (Relaxation::Fixed(omega) | Relaxation::Adaptive(omega)) = relaxation;
    longest(omega)
}

/// Sweeps that take three digits off at best.
fn longest(omega: f64) -> u32 {
    (8.0 / (2.0 - omega)).ceil() as u32
}

/// Number of sweeps after which the goal seems to be reached.
fn next_length(
    settings: &Settings<f64>,
    now: &Outcome<f64>,
    before: &Residual<f64>,
    done: u32,
) -> u32 {
    let longest = longest(now.omega);
    let gained = (before.largest / now.residual.largest).ln() / f64::from(done);
    let missing = (now.residual.largest / goal(settings, &now.residual, now.omega)).ln();
    let needed = missing / gained;
    if needed >= 1.0 { longest.min(needed.ceil() as u32) } else { longest }
}

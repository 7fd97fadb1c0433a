//! A scene over time: tick after tick, each started from the answer of the one before.
//!
//! ```text
//!   schedule or log ─► moments (t, inputs) ─► loads at t ─► player ─► Tick ─► ticks.csv, ticks.svg
//! ```
//! Mesh, numbering and A are set up once; between ticks only loads, gaps, boundary values and transfer coefficients change,
//! which is what happens on a device. The player is the kernel's own tick ([`held`]) wherever D or R holds
//! every part, and otherwise a warm solve ([`player`]). Where the numbers of the first moment are far from 1 they play
//! in other units, and all answers are in the scene's.

pub mod baked;
pub mod coarse;
pub mod columns;
pub mod held;
mod intervals;
pub mod log;
mod picture;
pub mod player;
pub mod schedule;

pub use picture::picture;

use signorini_device::tick::Limits;
use signorini_kernel::rows;
use signorini_kernel::solver::Settings;

use intervals::Intervals;
use player::{PlayedTick, Player};
use signorini_certify::ErrorBound;
use signorini_certify::exact::distance;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Parts, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::Precision;
use signorini_solve::outputs::{Reading, declared};
use signorini_solve::{Options, ScalarKind, choose_units};

/// When a tick happens, and what the inputs are then.
#[derive(Debug, Clone, PartialEq)]
pub struct ScheduledTick {
    /// t
    pub time: f64,
    /// Positions in `scene.inputs` with their values; inputs that are not listed keep theirs.
    pub inputs: Vec<(usize, f64)>,
}

impl ScheduledTick {
    /// Brings a problem to this moment.
    fn set(&self, problem: &mut Problem) -> Result<()> {
        problem.set(&self.inputs, self.time).map_err(|error| error.at_time(self.time))
    }
}

/// What a tick came to. Numbers that do not exist or are not finite are `None`.
#[derive(Debug, Clone)]
pub struct TickRecord {
    /// t
    pub time: f64,
    /// How its solve ended.
    pub status: &'static str,
    /// Sweeps spent.
    pub sweeps: u32,
    /// ∫_C (τ·n − q) ≥ 0, τ within the law of contact.
    pub contact_force: Option<f64>,
    /// Σ|E| over the active contact edges.
    pub contact_length: Option<f64>,
    /// The bound on the error.
    pub bound: Option<ErrorBound>,
    /// The error that it bounds, where the exact solution is known.
    pub combined: Option<f64>,
    /// The declared outputs, in the order of the scene.
    pub outputs: Vec<Option<f64>>,
    /// Where they lie for the exact solution, of a probe the mean over its cell, or why nobody knows; empty where nobody has asked.
    pub intervals: Vec<TickInterval>,
}

/// The ends of an interval, or why there is none.
pub type TickInterval = std::result::Result<[f64; 2], String>;

impl TickRecord {
    /// Whether the solve broke down; one that its budget cut off did not.
    pub fn failed(&self) -> bool {
        matches!(self.status, "stalled" | "not-finite")
    }

    /// From `units` to those that the scene had before.
    fn rescale(&mut self, scene: &Scene, units: &Units) {
        let times = |number: &mut Option<f64>, unit: f64| {
            *number = number.map(|x| x * unit).filter(|x| x.is_finite());
        };
        times(&mut self.contact_force, units.flux());
        times(&mut self.combined, units.energy());
        self.bound = self.bound.map(|bound| bound.times(units.energy()));
        for (output, of) in self.outputs.iter_mut().zip(&scene.outputs) {
            times(output, units.of_output(of.quantity));
        }
        for (interval, of) in self.intervals.iter_mut().zip(&scene.outputs) {
            let unit = units.of_output(of.quantity);
            if let Ok(ends) = interval {
                *ends = ends.map(|end| end * unit);
            }
        }
    }
}

/// The answer of a tick all over the mesh, in the scene's units. Empty where the tick was refused.
#[derive(Debug, Clone, Default)]
pub struct TickFields {
    /// Mean of u_h over each edge.
    pub u: Vec<f64>,
    /// ∫_E σ·n of each edge, along its direction.
    pub flux: Vec<f64>,
    /// The continuous s at each vertex.
    pub vertices: Vec<f64>,
}

impl TickFields {
    fn rescale(&mut self, units: &Units) {
        let times = |numbers: &mut [f64], unit: f64| numbers.iter_mut().for_each(|x| *x *= unit);
        times(&mut self.u, units.u);
        times(&mut self.flux, units.flux());
        times(&mut self.vertices, units.u);
    }
}

/// What a tick may take.
#[derive(Debug, Clone, Copy)]
pub struct Budget {
    /// Scalar type.
    pub scalar: ScalarKind,
    /// Most sweeps of one tick.
    pub sweeps: u32,
    /// The certified error that is small enough; 0: as far as sweeps buy anything.
    pub error: f64,
    /// Whether intervals of the outputs are worked out, each tick anew.
    pub intervals: bool,
}

impl Budget {
    /// That of a scene: in the scalar of its setting, as far as sweeps buy anything, with intervals.
    pub fn of(scene: &Scene) -> Self {
        let single = scene.setting.and_then(|setting| setting.scalar) == Some(Precision::F32);
        Self {
            scalar: if single { ScalarKind::F32 } else { ScalarKind::F64 },
            sweeps: Options::default().max_sweeps,
            error: 0.0,
            intervals: true,
        }
    }

    /// Whether nobody has asked for a number of sweeps.
    fn is_open(&self) -> bool {
        self.sweeps == Options::default().max_sweeps
    }

    fn settings<R: Scalar>(&self) -> Settings<R> {
        let options =
            Options { scalar: self.scalar, max_sweeps: self.sweeps, ..Options::default() };
        options.settings()
    }

    fn limits<R: Scalar>(&self) -> Limits<R> {
        Limits { error: R::narrow(self.error), sweeps: self.sweeps, ..Limits::default() }
    }
}

/// Solves `problem` at every moment; calls `done` after each, whose error ends the play. The first tick starts from the solution on
/// `coarse`, the problem on a coarser mesh, where there is one; without, on a large mesh with an open budget, from
/// that of a factor.
///
/// # Errors
/// Data that are not admissible at some time, with that time; numbers that the scalar type cannot
/// hold; a probe outside the mesh.
pub fn play(
    problem: &Problem,
    coarse: Option<&Problem>,
    moments: &[ScheduledTick],
    budget: &Budget,
    done: impl FnMut(&TickRecord, &TickFields) -> Result<()>,
) -> Result<Vec<TickRecord>> {
    match budget.scalar {
        ScalarKind::F64 => play_in::<f64>(problem, coarse, moments, budget, done),
        ScalarKind::F32 => play_in::<f32>(problem, coarse, moments, budget, done),
    }
}

fn play_in<R: Scalar>(
    problem: &Problem,
    coarse: Option<&Problem>,
    moments: &[ScheduledTick],
    budget: &Budget,
    mut done: impl FnMut(&TickRecord, &TickFields) -> Result<()>,
) -> Result<Vec<TickRecord>> {
    let mut problem = problem.clone();
    if let Some(first) = moments.first() {
        first.set(&mut problem)?;
    }
    let mut coarse = coarse.cloned();
    if let Some(coarse) = &mut coarse {
        coarse.scene = problem.scene.clone();
        coarse.set_time(problem.time)?;
    }
    let units = choose_units(&problem)?;
    if units != Units::default() {
        problem = problem.in_units(&units)?;
        coarse = coarse.map(|coarse| coarse.in_units(&units)).transpose()?;
    }
    let (problem, coarse) = (&problem, coarse.as_ref());
    let budget = &Budget { error: budget.error / units.energy(), ..*budget };
    let mut done = |tick: &mut TickRecord, fields: &mut TickFields| {
        tick.rescale(&problem.scene, &units);
        fields.rescale(&units);
        done(tick, fields)
    };
    let parts = Parts::whatever_inputs(problem)?;
    let mut all = |engine: &mut held::Engine| through(problem, moments, budget, engine, &mut done);
    if Approach::Tick.lack_with(problem, parts.counts).is_some() {
        let mut player = Player::<R>::new(problem, budget)?;
        all(&mut |problem| player.tick(problem))
    } else if problem.mesh.quads.is_empty() {
        held::with::<R, { rows::TRIANGLES }, _>(problem, &parts, coarse, budget, all)?
    } else {
        held::with::<R, { rows::QUADS }, _>(problem, &parts, coarse, budget, all)?
    }
}

/// Goes through the moments.
fn through(
    problem: &Problem,
    moments: &[ScheduledTick],
    budget: &Budget,
    engine: &mut held::Engine,
    done: &mut impl FnMut(&mut TickRecord, &mut TickFields) -> Result<()>,
) -> Result<Vec<TickRecord>> {
    let mut problem = problem.clone();
    let mut bounds = budget.intervals.then(|| Intervals::new(budget.scalar));
    let ticks = moments.iter().map(|moment| {
        moment.set(&mut problem)?;
        let answer = engine(&problem).map_err(|error| error.at_time(moment.time))?;
        let mut tick = read_off(&problem, budget.scalar, &answer)?;
        if let Some(bounds) = &mut bounds {
            tick.intervals = bounds.of(&problem, &answer)?;
        }
        let PlayedTick { u, flux, certified, .. } = answer;
        done(&mut tick, &mut TickFields { u, flux, vertices: certified.vertices })?;
        Ok(tick)
    });
    ticks.collect()
}

fn read_off(problem: &Problem, scalar: ScalarKind, answer: &PlayedTick) -> Result<TickRecord> {
    let PlayedTick { u, flux, .. } = answer;
    let bound = answer.bound.filter(|bound| bound.total.is_finite());
    let units = Units::default();
    let reading = Reading { scalar, u, flux, units, bound: bound.map(|bound| bound.total) };
    let finite = |value: f64| value.is_finite().then_some(value);
    let combined = match (&problem.scene.exact, bound) {
        (Some(exact), Some(_)) => {
            Some(distance(exact, problem, &answer.certified.admissible())?.combined)
        }
        _ => None,
    };
    Ok(TickRecord {
        time: problem.time,
        status: answer.status,
        sweeps: answer.sweeps,
        contact_force: finite(answer.contact_force),
        contact_length: finite(answer.contact_length),
        bound,
        combined: combined.and_then(finite),
        outputs: declared(problem, reading)?,
        intervals: Vec::new(),
    })
}

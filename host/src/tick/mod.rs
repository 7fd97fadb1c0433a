//! A scene over time: tick after tick, each started from the answer of the one before.
//!
//! ```text
//!   schedule or log ─► moments (t, inputs) ─► loads at t ─► player ─► Tick ─► ticks.csv, ticks.svg
//! ```
//! Mesh, numbering and A are set up once; between ticks only loads, gaps and boundary values change,
//! which is what happens on a device. All that solves is behind [`player`].

pub mod log;
mod picture;
pub mod player;
pub mod schedule;

pub use picture::picture;

use crate::error::Result;
use crate::outputs::{Reading, declared};
use crate::problem::Problem;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::solve::{Options, ScalarKind};
use player::{Answer, Bound, Player};

/// When a tick happens, and what the inputs are then.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// t
    pub time: f64,
    /// Positions in `scene.inputs` with their values; inputs that are not listed keep theirs.
    pub inputs: Vec<(usize, f64)>,
}

/// What a tick came to. Numbers that do not exist or are not finite are `None`.
#[derive(Debug, Clone)]
pub struct Tick {
    /// t
    pub time: f64,
    /// How its solve ended.
    pub status: &'static str,
    /// Sweeps spent.
    pub sweeps: u32,
    /// ∫_C (σ·n − q)
    pub contact_force: Option<f64>,
    /// Σ|E| over the active contact edges.
    pub contact_length: Option<f64>,
    /// The bound on the error.
    pub bound: Option<Bound>,
    /// The error that it bounds, where the exact solution is known.
    pub combined: Option<f64>,
    /// The declared outputs, in the order of the scene.
    pub outputs: Vec<Option<f64>>,
}

impl Tick {
    /// Whether the solve broke down; one that its budget cut off did not.
    pub fn failed(&self) -> bool {
        matches!(self.status, "stalled" | "not-finite")
    }
}

/// Solves `scene` at every moment; calls `done` after each.
///
/// # Errors
/// Data that are not admissible at some time, with that time; numbers that the scalar type cannot
/// hold; a probe outside the mesh.
pub fn play(
    scene: &Scene,
    problem: &Problem,
    moments: &[Moment],
    options: &Options,
    done: impl FnMut(&Tick),
) -> Result<Vec<Tick>> {
    match options.scalar {
        ScalarKind::F64 => play_in::<f64>(scene, problem, moments, options, done),
        ScalarKind::F32 => play_in::<f32>(scene, problem, moments, options, done),
    }
}

fn play_in<R: Scalar>(
    scene: &Scene,
    problem: &Problem,
    moments: &[Moment],
    options: &Options,
    mut done: impl FnMut(&Tick),
) -> Result<Vec<Tick>> {
    let mut player = Player::<R>::new(scene, problem, options)?;
    let (mut scene, mut problem) = (scene.clone(), problem.clone());
    let ticks = moments.iter().map(|moment| {
        for &(input, value) in &moment.inputs {
            scene.inputs[input].default = value;
        }
        let answer = problem
            .set_time(&scene, moment.time)
            .and_then(|()| player.tick(&problem))
            .map_err(|error| error.at_time(moment.time))?;
        let tick = read_off(&scene, &problem, options.scalar, answer)?;
        done(&tick);
        Ok(tick)
    });
    ticks.collect()
}

fn read_off(scene: &Scene, problem: &Problem, scalar: ScalarKind, answer: Answer) -> Result<Tick> {
    let Answer { u, flux, .. } = &answer;
    let bound = answer.bound.filter(|bound| bound.total.is_finite());
    let reading = Reading { scalar, u, flux, bound: bound.map(|bound| bound.total) };
    let finite = |value: f64| value.is_finite().then_some(value);
    Ok(Tick {
        time: problem.time,
        status: answer.status,
        sweeps: answer.sweeps,
        contact_force: finite(answer.contact_force),
        contact_length: finite(answer.contact_length),
        bound,
        combined: answer.combined.and_then(finite),
        outputs: declared(scene, problem, reading)?,
    })
}

//! A scene solved as its setting says: by the code that firmware runs, on this machine.
//!
//! ```text
//!   Scene with a setting + Problem ─┬─ condensed ─ bake::condensed::Controller ─┐
//!                                   ├─ full ────── bake::full::Controller ──────┼─► Answer
//!                                   └─ single ──── one solve at a time ─────────┘
//! ```
//! [`baked`] lends the controller that `bake` would choose, whichever that is.

mod baked;
mod condensed;
mod full;
mod single;
mod solution;

pub use baked::{Module, baked};
pub use solution::solve;

use std::fmt::Display;

use signorini_kernel::report::Ended;
use signorini_kernel::solver::Status;

use signorini_certify::{ErrorBound, NoBound};
use signorini_problem::{Approach, Problem, Property};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{MathKind, Method, ModelKind, Precision, Setting};
use signorini_solve::{Factored, Ran};

/// What a tick left, in f64.
#[derive(Debug, Clone)]
pub struct TickSolution {
    /// How it ended.
    pub status: Status,
    /// The same in the word of a tick's report.
    pub ended: &'static str,
    /// What solved it.
    pub ran: Ran,
    /// What a factor did, where one solved it.
    pub factored: Option<Factored>,
    /// The outputs of a controller, in the order of the scene, with its bits; of one solve at a time none.
    pub outputs: Vec<f64>,
    /// Sweeps; 0 for the exact method.
    pub sweeps: u32,
    /// The relaxation factor; 0 where there is none.
    pub omega: f64,
    /// The scaled complementarity residual.
    pub residual: f64,
    /// Mean of u_h over each edge.
    pub u: Vec<f64>,
    /// ∫_E σ·n of each edge, along its direction.
    pub flux: Vec<f64>,
    /// ∫_C (τ·n − q) ≥ 0, τ within the law of contact.
    pub force: f64,
    /// Which contact edges are active.
    pub active: Vec<bool>,
    /// The bound on its error, where there is one.
    pub bound: Option<ErrorBound>,
    /// Why there is no bound.
    pub no_bound: Option<NoBound>,
    /// What the bound is about; arrays are empty without one.
    pub certified: signorini_certify::CertifiedFields,
}

impl TickSolution {
    /// Σ|E| over the active contact edges.
    pub fn length(&self, problem: &Problem) -> f64 {
        let lengths = problem.lengths.iter().skip(problem.topology.counts.free);
        let active = self.active.iter().zip(lengths).filter(|(active, _)| **active);
        active.fold(0.0, |sum, (_, length)| sum + length)
    }
}

/// The status of a tick that ended so.
fn status(ended: Ended) -> Status {
    match ended {
        Ended::Exact | Ended::Accurate | Ended::Settled => Status::Converged,
        Ended::OutOfSweeps | Ended::OutOfTime => Status::OutOfSweeps,
        Ended::NotFinite => Status::NotFinite,
    }
}

/// A scene in one setting, tick after tick.
pub trait Engine {
    /// Answers for these inputs, in the order of the scene; returns the sweeps. This is what a study times.
    ///
    /// # Errors
    /// Inputs without an answer.
    fn tick(&mut self, inputs: &[f64]) -> Result<u32>;

    /// Forgets all ticks: the next one starts cold.
    fn restart(&mut self);

    /// The answer of the last tick, whose inputs were those of `problem`.
    ///
    /// # Errors
    /// Numbers that do not fit.
    fn answer(&self, problem: &Problem) -> Result<TickSolution>;
}

/// The setting of a scene with what is left open filled in: full, in f64.
pub fn completed(scene: &Scene) -> Setting {
    let setting = scene.setting.unwrap_or_default();
    Setting {
        scalar: setting.scalar.or(Some(Precision::F64)),
        model: setting.model_kind().or(Some(ModelKind::Full)),
        ..setting
    }
}

/// Lends the engine of `problem`, as its setting says.
///
/// # Errors
/// A setting that the scene does not allow for, numbers that the scalar cannot hold.
pub fn with<T>(problem: &Problem, then: impl FnOnce(&mut dyn Engine) -> Result<T>) -> Result<T> {
    let setting = completed(&problem.scene);
    let mixed = setting.scalar == Some(Precision::Mixed);
    let single = setting.scalar == Some(Precision::F32);
    let lack = Approach::Tick.lack(problem)?.map(|lack| lack.property);
    match (setting.model, lack) {
        (Some(ModelKind::Condensed), _) if mixed => {
            Err(no_mixed(&problem.scene, "a condensed model").into())
        }
        (Some(ModelKind::Condensed), _) if single => condensed::with::<f32, _>(problem, then),
        (Some(ModelKind::Condensed), _) => condensed::with::<f64, _>(problem, then),
        (_, Some(property)) => {
            refuse_tick_keys(&problem.scene, &setting, property)?;
            single::with(problem, then)
        }
        _ if mixed => single::with(problem, then),
        _ if single => full::with::<f32, _>(problem, then),
        _ => full::with::<f64, _>(problem, then),
    }
}

/// Refuses keys of the setting that mean the kernel's tick, where `property` leaves none.
fn refuse_tick_keys(scene: &Scene, setting: &Setting, property: Property) -> Result<()> {
    let refused = |key: &str, what: &str| {
        let message = format!("setting.{key}: {what} is not for {property}");
        InputError::new(message).file(&scene.path).hint("remove it, or take model = \"condensed\"")
    };
    if setting.scalar == Some(Precision::Mixed) {
        return Err(no_mixed(scene, property).into());
    }
    if setting.solver == Some(Method::Factor) {
        return Err(refused("solver", "a factor").into());
    }
    if setting.math == MathKind::Micromath {
        return Err(refused("math", "micromath").into());
    }
    Ok(())
}

fn no_mixed(scene: &Scene, what: impl Display) -> InputError {
    InputError::new(format!("setting.scalar: f32+f64 is not for {what}"))
        .file(&scene.path)
        .hint("take f32 or f64")
}

//! The full model: the mesh, swept as a baked module does.

use signorini_device::tick::Report;
use signorini_kernel::rows::{QUADS, TRIANGLES};
use signorini_kernel::solver::Status;

use super::{Engine, TickSolution, status};
use crate::full::{Baked, Controller};
use signorini_certify::admissible::Following;
use signorini_certify::{Data, ErrorBound, NoBound};
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_solve::{Factored, Ran, ended_name, unfit};

struct Full<'b, R: Scalar, const WIDTH: usize> {
    scene: &'b Scene,
    baked: &'b Baked<R>,
    controller: Controller<'b, R, WIDTH>,
    inputs: Vec<R>,
    outputs: Vec<R>,
    report: Option<Report<R>>,
}

/// Lends it.
pub(super) fn with<R: Scalar, T>(
    problem: &Problem,
    then: impl FnOnce(&mut dyn Engine) -> Result<T>,
) -> Result<T> {
    lend(&problem.scene, &Baked::<R>::new(problem)?, then)
}

/// Lends the engine of a baked model of a scene.
pub(super) fn lend<R: Scalar, T>(
    scene: &Scene,
    baked: &Baked<R>,
    then: impl FnOnce(&mut dyn Engine) -> Result<T>,
) -> Result<T> {
    if baked.has_quads() {
        then(&mut Full::<R, QUADS>::new(scene, baked))
    } else {
        then(&mut Full::<R, TRIANGLES>::new(scene, baked))
    }
}

impl<'b, R: Scalar, const WIDTH: usize> Full<'b, R, WIDTH> {
    fn new(scene: &'b Scene, baked: &'b Baked<R>) -> Self {
        let controller = Controller::new(baked);
        Self { scene, baked, controller, inputs: Vec::new(), outputs: Vec::new(), report: None }
    }
}

impl<R: Scalar, const WIDTH: usize> Engine for Full<'_, R, WIDTH> {
    fn tick(&mut self, inputs: &[f64]) -> Result<u32> {
        self.inputs.clear();
        self.inputs.extend(inputs.iter().map(|&x| R::narrow(x)));
        let answer = self.controller.tick(&self.inputs).map_err(unfit::<R>(self.scene))?;
        let (outputs, report) = answer;
        self.outputs = outputs;
        self.report = Some(report);
        Ok(report.sweeps)
    }

    fn restart(&mut self) {
        self.controller = Controller::new(self.baked);
    }

    fn answer(&self, problem: &Problem) -> Result<TickSolution> {
        let units = self.baked.units();
        let wide = |numbers: &[R], unit: f64| -> Vec<f64> {
            numbers.iter().map(|x| x.wide() * unit).collect()
        };
        let u = wide(self.controller.u(), units.u);
        let tau = wide(self.controller.tau(), units.flux());
        let counts = problem.topology.counts;
        let on_contact = self.controller.u().iter().skip(counts.free);
        let certificate = self.report.as_ref().and_then(|report| report.verdict.certificate());
        let solved = self.baked.entries().zip(self.controller.solved());
        let factored = solved.map(|(entries, solved)| Factored {
            entries,
            exchanges: solved.pivots,
            rounds: solved.rounds,
        });
        let certified = signorini_certify::CertifiedFields {
            vertices: wide(self.controller.vertices(), units.u),
            bubbles: match self.controller.bubbles() {
                [] => vec![0.0; u.len()],
                bubbles => wide(bubbles, units.u),
            },
            tau: tau.clone(),
            indicators: Vec::new(),
            following: Following::WhereNeeded,
        };
        Ok(TickSolution {
            status: self.report.map_or(Status::OutOfSweeps, |report| status(report.ended)),
            ended: self.report.map_or("out-of-sweeps", |report| ended_name(report.ended)),
            ran: if factored.is_some() { Ran::Factor } else { Ran::Sweeps },
            factored,
            outputs: self.outputs.iter().map(|x| x.wide()).collect(),
            sweeps: self.report.map_or(0, |report| report.sweeps),
            omega: self.report.map_or(0.0, |report| report.omega.wide()),
            residual: self.report.map_or(f64::INFINITY, |report| report.residual.wide())
                / range(&u),
            flux: tau,
            force: self.report.map_or(0.0, |report| report.force.wide()),
            active: on_contact.zip(self.controller.lower()).map(|(u, lower)| u == lower).collect(),
            bound: certificate.map(ErrorBound::new),
            no_bound: match &self.report {
                Some(report) => {
                    let data = Data::<f64>::new(problem)?;
                    let known = || data.no_bound().cloned();
                    NoBound::of_verdict(&report.verdict, problem, known)
                }
                None => None,
            },
            certified: if certificate.is_some() {
                certified
            } else {
                signorini_certify::CertifiedFields::default()
            },
            u,
        })
    }
}

fn range(u: &[f64]) -> f64 {
    let most = u.iter().fold(f64::NEG_INFINITY, |most, &u| most.max(u));
    let least = u.iter().fold(f64::INFINITY, |least, &u| least.min(u));
    (most - least).max(f64::MIN_POSITIVE)
}

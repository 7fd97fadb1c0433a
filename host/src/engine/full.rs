//! The full model: the mesh, swept as a baked module does.

use signorini_kernel::rows::{QUADS, TRIANGLES};
use signorini_kernel::solver::Status;
use signorini_kernel::tick::{Ended, Report};

use super::{Answer, Engine};
use crate::bake::full::{Baked, Controller};
use crate::certify::{self, ErrorBound};
use crate::error::Result;
use crate::problem::Problem;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::solve::unfit;

struct Full<'b, R: Scalar, const WIDTH: usize> {
    scene: &'b Scene,
    baked: &'b Baked<R>,
    controller: Controller<'b, R, WIDTH>,
    inputs: Vec<R>,
    report: Option<Report<R>>,
}

/// Lends it.
pub(super) fn with<R: Scalar, T>(
    scene: &Scene,
    problem: &Problem,
    then: impl FnOnce(&mut dyn Engine) -> Result<T>,
) -> Result<T> {
    let baked = Baked::<R>::new(scene, problem)?;
    if baked.has_quads() {
        then(&mut Full::<R, QUADS>::new(scene, &baked))
    } else {
        then(&mut Full::<R, TRIANGLES>::new(scene, &baked))
    }
}

impl<'b, R: Scalar, const WIDTH: usize> Full<'b, R, WIDTH> {
    fn new(scene: &'b Scene, baked: &'b Baked<R>) -> Self {
        let controller = Controller::new(baked);
        Self { scene, baked, controller, inputs: Vec::new(), report: None }
    }
}

impl<R: Scalar, const WIDTH: usize> Engine for Full<'_, R, WIDTH> {
    fn tick(&mut self, inputs: &[f64]) -> Result<u32> {
        self.inputs.clear();
        self.inputs.extend(inputs.iter().map(|&x| R::narrow(x)));
        let (_, report) = self.controller.tick(&self.inputs).map_err(unfit::<R>(self.scene))?;
        self.report = Some(report);
        Ok(report.sweeps)
    }

    fn restart(&mut self) {
        self.controller = Controller::new(self.baked);
    }

    fn answer(&self, problem: &Problem) -> Result<Answer> {
        let units = self.baked.units();
        let wide = |numbers: &[R], unit: f64| -> Vec<f64> {
            numbers.iter().map(|x| x.wide() * unit).collect()
        };
        let u = wide(self.controller.u(), units.u);
        let tau = wide(self.controller.tau(), units.flux());
        let counts = problem.topology.counts;
        let on_contact = self.controller.u().iter().skip(counts.free);
        let certificate = self.report.as_ref().and_then(|report| report.verdict.certificate());
        let certified = certify::Answer {
            vertices: wide(self.controller.vertices(), units.u),
            bubbles: match self.controller.bubbles() {
                [] => vec![0.0; u.len()],
                bubbles => wide(bubbles, units.u),
            },
            tau: tau.clone(),
            indicators: Vec::new(),
        };
        Ok(Answer {
            status: self.report.map_or(Status::OutOfSweeps, |report| status(report.ended)),
            sweeps: self.report.map_or(0, |report| report.sweeps),
            omega: self.report.map_or(0.0, |report| report.omega.wide()),
            residual: self.report.map_or(f64::INFINITY, |report| report.residual.wide())
                / range(&u),
            flux: tau,
            force: self.report.map_or(0.0, |report| report.force.wide()),
            active: on_contact.zip(self.controller.lower()).map(|(u, lower)| u == lower).collect(),
            bound: certificate.map(ErrorBound::new),
            certified: if certificate.is_some() { certified } else { certify::Answer::default() },
            u,
        })
    }
}

fn status(ended: Ended) -> Status {
    match ended {
        Ended::Accurate | Ended::Settled => Status::Converged,
        Ended::OutOfSweeps | Ended::OutOfTime => Status::OutOfSweeps,
        Ended::NotFinite => Status::NotFinite,
    }
}

fn range(u: &[f64]) -> f64 {
    let most = u.iter().fold(f64::NEG_INFINITY, |most, &u| most.max(u));
    let least = u.iter().fold(f64::INFINITY, |least, &u| least.min(u));
    (most - least).max(f64::MIN_POSITIVE)
}

//! The condensed model.

use signorini_kernel::report::{Ended, Report};
use signorini_kernel::solver::Status;

use super::{Engine, TickSolution, status};
use crate::choice::Origin;
use crate::choice::{Choice, Wanted};
use crate::condensed::{Baked, Controller};
use signorini_certify::{ErrorBound, NoBound};
use signorini_condense::CondensedModel;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::{InputError, Result};
use signorini_scene::setting::ModelKind;
use signorini_solve::{Ran, ended_name, unfit};

struct Condensed<'b, R: Scalar> {
    problem: &'b Problem,
    origin: &'b Origin,
    baked: &'b Baked<R>,
    controller: Controller<'b, R>,
    inputs: Vec<R>,
    outputs: Vec<R>,
    report: Option<Report<R>>,
}

/// Lends it.
pub(super) fn with<R: Scalar, T>(
    problem: &Problem,
    then: impl FnOnce(&mut dyn Engine) -> Result<T>,
) -> Result<T> {
    let choice = Choice::<R>::new(problem, Wanted::model(ModelKind::Condensed))?;
    lend(problem, &choice, then)
}

/// Lends the engine of the condensed model that was chosen for `problem`.
pub(super) fn lend<R: Scalar, T>(
    problem: &Problem,
    choice: &Choice<R>,
    then: impl FnOnce(&mut dyn Engine) -> Result<T>,
) -> Result<T> {
    let Some((baked, origin)) = choice.condensed() else {
        let message = "setting.model: there is no condensed model of this scene";
        return Err(InputError::new(message).file(&problem.scene.path).into());
    };
    then(&mut Condensed {
        problem,
        origin,
        baked,
        controller: Controller::new(baked),
        inputs: Vec::new(),
        outputs: Vec::new(),
        report: None,
    })
}

impl<R: Scalar> Engine for Condensed<'_, R> {
    fn tick(&mut self, inputs: &[f64]) -> Result<u32> {
        self.inputs.clear();
        self.inputs.extend(inputs.iter().map(|&x| R::narrow(x)));
        let answer = self.controller.tick(&self.inputs).map_err(unfit::<R>(&self.problem.scene))?;
        let (outputs, report) = answer;
        self.outputs = outputs;
        self.report = Some(report);
        Ok(report.sweeps)
    }

    fn restart(&mut self) {
        self.controller = Controller::new(self.baked);
    }

    fn answer(&self, problem: &Problem) -> Result<TickSolution> {
        let x: Vec<f64> = self.controller.x().iter().map(|x| x.wide()).collect();
        let p: Vec<f64> =
            std::iter::once(1.0).chain(self.inputs.iter().map(|p| p.wide())).collect();
        let Origin { whole, recovery, .. } = self.origin;
        let x = self.origin.expand(&p, x);
        let p = self.origin.inputs(p, &x);
        let (mut u, flux) = recovery.field(whole, &p, &x);
        let counts = problem.topology.counts;
        let active: Vec<_> = whole.by_edge(&x).into_iter().map(|x| x == 0.0).collect();
        // A sum of columns meets the gap but for rounding; whoever asks for contact compares the two.
        let contact = u[counts.free..].iter_mut().zip(&problem.loads.gap).zip(&active);
        for ((u, &gap), _) in contact.filter(|(_, active)| **active) {
            *u = gap;
        }
        let certificate = self.report.as_ref().and_then(|report| report.certificate());
        let certified = recovery.admissible(whole, problem, &p, &x);
        Ok(TickSolution {
            status: self.report.map_or(Status::OutOfSweeps, |report| status(report.ended)),
            ended: self.report.map_or("out-of-sweeps", |report| ended_name(report.ended)),
            ran: match self.report.map(|report| report.ended) {
                _ if self.baked.contact == 0 => Ran::CondensedLinear,
                Some(Ended::Exact) => Ran::CondensedExact,
                _ => Ran::CondensedSweeps,
            },
            factored: None,
            outputs: self.outputs.iter().map(|x| x.wide()).collect(),
            sweeps: self.report.map_or(0, |report| report.sweeps),
            omega: self.baked.sweeps.omega.wide(),
            residual: largest_violation(whole, &p, &x),
            force: whole.force(&p, &x),
            active,
            bound: certificate.map(ErrorBound::new),
            no_bound: self.report.and_then(|report| {
                let reason = || whole.certificate.as_ref().err().cloned();
                let data = || reason().map(NoBound::Condensed);
                NoBound::of_verdict(&report.verdict, problem, data)
            }),
            certified: certified.filter(|_| certificate.is_some()).unwrap_or_default(),
            u,
            flux,
        })
    }
}

/// How far the law of contact fails, over the largest x or residual: max |min(x, r)| where no flux has a limit.
fn largest_violation(whole: &CondensedModel, p: &[f64], x: &[f64]) -> f64 {
    let (residual, spans) = (whole.residual(p, x), whole.span_of(p));
    let size = x.iter().chain(&residual).fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    let violations = residual.iter().zip(x).enumerate().map(|(at, (r, x))| {
        let span = spans.get(at).copied().unwrap_or(f64::INFINITY);
        // x > 0 goes with the least flux, x < 0 with the largest.
        let (to_least, to_most) = (r - span.min(0.0), span.max(0.0) - r);
        match *x {
            x if x > 0.0 => to_least.min(x).abs(),
            x if x < 0.0 => to_most.min(-x).abs(),
            _ => (-to_least).max(-to_most).max(0.0),
        }
    });
    violations.fold(0.0, f64::max) / size
}

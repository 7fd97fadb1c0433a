//! The controller of a condensed model, with the way back to fields on the mesh.

use signorini_bake::Bakes;
use signorini_bake::choice::Origin;
use signorini_bake::condensed::{Baked, Controller};
use signorini_bake::intervals::NarrowMidpoint;
use signorini_bake::module_api::hash;
use signorini_bake::narrow::narrow;
use signorini_certify::{CertifiedFields, ErrorBound, NoBound};
use signorini_condense::CondensedModel;
use signorini_kernel::report::{Ended, Report};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_solve::{Ending, Ran, Solution, unfit};

use crate::Session;

/// A session of a condensed model.
pub(crate) struct Condensed<'b, R: Bakes> {
    problem: &'b Problem,
    origin: &'b Origin,
    baked: &'b Baked<R>,
    controller: Controller<'b, R>,
    midpoints: Vec<Option<NarrowMidpoint<R>>>,
    inputs: Vec<R>,
    /// What the last tick has begun from, of steps in time.
    past: Vec<R>,
    /// Outputs and report of the last tick.
    last: Option<(Vec<R>, Report<R>)>,
}

impl<'b, R: Bakes> Condensed<'b, R> {
    /// A session of `baked`, the model of `problem` that was made of `origin`, with the midpoints of its outputs.
    pub fn new(
        problem: &'b Problem,
        (baked, origin): (&'b Baked<R>, &'b Origin),
        midpoints: Vec<Option<NarrowMidpoint<R>>>,
    ) -> Self {
        let (controller, inputs, past) = (Controller::new(baked), Vec::new(), Vec::new());
        Self { problem, origin, baked, controller, midpoints, inputs, past, last: None }
    }

    fn ran(&self, ended: Ended) -> Ran {
        match ended {
            _ if self.baked.contact == 0 => Ran::CondensedLinear,
            Ended::Exact => Ran::CondensedExact,
            _ => Ran::CondensedSweeps,
        }
    }
}

impl<R: Bakes> Session for Condensed<'_, R> {
    fn tick(&mut self, inputs: &[f64]) -> Result<u32> {
        self.inputs = narrow(inputs);
        let past = self.controller.past().to_vec();
        let last = self.controller.tick(&self.inputs).map_err(unfit::<R>(&self.problem.scene))?;
        self.past = past;
        Ok(self.last.insert(last).1.sweeps)
    }

    fn restart(&mut self) {
        (self.controller, self.last) = (Controller::new(self.baked), None);
    }

    fn window(&self) -> Option<[f64; 2]> {
        let window = self.controller.window()?;
        Some([window.energy, window.seconds].map(R::wide))
    }

    fn s_at_start(&self, at: &Problem) -> Option<CertifiedFields> {
        let Origin { steps, recovery, .. } = self.origin;
        steps.as_ref()?.s_at_start(recovery, at)
    }

    fn state(&self) -> Option<Vec<u8>> {
        self.controller.state(hash(self.problem))
    }

    fn set_state(&mut self, bytes: &[u8]) -> Result<()> {
        let restored = self.controller.restore(hash(self.problem), bytes);
        Ok(restored.map_err(crate::refused_state)?)
    }

    fn between(&self) -> Vec<Option<[f64; 2]>> {
        let certificate = self.last.as_ref().and_then(|(_, report)| report.certificate());
        let Some(certificate) = certificate else { return Vec::new() };
        let of_output = |of: &Option<NarrowMidpoint<R>>| {
            let ends = of.as_ref()?.view().between(self.controller.combination(), certificate)?;
            Some(ends.map(|end| end.wide()))
        };
        self.midpoints.iter().map(of_output).collect()
    }

    fn answer(&self, at: &Problem) -> Result<Solution> {
        let Some((outputs, report)) = &self.last else { return Ok(Solution::default()) };
        let x: Vec<f64> = self.controller.x().iter().map(|x| x.wide()).collect();
        let p: Vec<f64> = std::iter::once(1.0)
            .chain(self.inputs.iter().chain(&self.past).map(|p| p.wide()))
            .collect();
        let (whole, recovery) = (self.origin.recovered(), &self.origin.recovery);
        let x = self.origin.expand(&p, x);
        let p = self.origin.inputs(p, &x);
        let (mut u, flux) = recovery.field(whole, &p, &x);
        let active = self.origin.touching(&x);
        // A sum of columns meets the gap but for rounding; a reader that asks for contact compares the two.
        let contact = u[at.topology.counts.free..].iter_mut().zip(&at.loads.gap).zip(&active);
        for ((u, &gap), _) in contact.filter(|(_, active)| **active) {
            *u = gap;
        }
        let certificate = report.certificate();
        let data = || whole.certificate.as_ref().err().cloned().map(NoBound::new);
        let certified = recovery.admissible(whole, at, &p, &x).filter(|_| certificate.is_some());
        let solution = Solution {
            scalar: crate::scalar_kind::<R>(),
            status: Ending::Tick(report.ended),
            ran: self.ran(report.ended),
            outputs: outputs.iter().map(|x| x.wide()).collect(),
            sweeps: report.sweeps,
            omega: self.baked.sweeps.omega.wide(),
            algebraic_residual: largest_violation(whole, &p, &x),
            contact_force: whole.force(&p, &x) + self.origin.pressing(at, &flux),
            bound: certificate.map(ErrorBound::new),
            no_bound: NoBound::of_verdict(&report.verdict, at, data),
            certified: certified.unwrap_or_default(),
            u,
            flux,
            ..Solution::default()
        };
        Ok(solution.with_active(at, active.into_iter()))
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

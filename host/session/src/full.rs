//! The controller of a full model: the mesh, swept as a baked module does.

use signorini_bake::Bakes;
use signorini_bake::full::{Baked, Controller};
use signorini_bake::narrow::narrow;
use signorini_certify::{CertifiedFields, NoBound};
use signorini_device::tick::Report;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_solve::{Factored, Ran, Solution, unfit};

use crate::on_mesh::answer;
use crate::{Session, Then};

struct Full<'b, R: Bakes> {
    scene: &'b Scene,
    baked: &'b Baked<R>,
    controller: Controller<'b, R>,
    /// Outputs and report of the last tick.
    last: Option<(Vec<R>, Report<R>)>,
}

/// Calls `then` with a session of a baked model of `scene`.
pub(crate) fn with_full<R: Bakes>(scene: &Scene, baked: &Baked<R>, then: Then) -> Result<()> {
    then(&mut Full { scene, baked, controller: Controller::new(baked), last: None })
}

impl<R: Bakes> Full<'_, R> {
    fn factored(&self) -> Option<Factored> {
        let (entries, solved) = self.baked.entries().zip(self.controller.solved())?;
        Some(Factored { entries, exchanges: solved.pivots, rounds: solved.rounds })
    }
}

impl<R: Bakes> Session for Full<'_, R> {
    fn tick(&mut self, inputs: &[f64]) -> Result<u32> {
        let last = self.controller.tick(&narrow(inputs)).map_err(unfit::<R>(self.scene))?;
        Ok(self.last.insert(last).1.sweeps)
    }

    fn restart(&mut self) {
        (self.controller, self.last) = (Controller::new(self.baked), None);
    }

    fn window(&self) -> Option<[f64; 2]> {
        let window = self.controller.window()?;
        Some([window.energy, window.seconds].map(R::wide))
    }

    fn state(&self) -> Option<Vec<u8>> {
        self.controller.state()
    }

    fn set_state(&mut self, bytes: &[u8]) -> Result<()> {
        Ok(self.controller.restore(bytes).map_err(crate::refused_state)?)
    }

    fn answer(&self, at: &Problem) -> Result<Solution> {
        let Some((outputs, report)) = &self.last else { return Ok(Solution::default()) };
        let left = self.controller.numbers();
        let found = answer(report, &left, &self.baked.units());
        let factored = self.factored();
        let active = left.u.iter().skip(at.topology.counts.free).zip(self.controller.lower());
        let solution = Solution {
            ran: if factored.is_some() { Ran::Factor } else { Ran::Sweeps },
            factored,
            outputs: outputs.iter().map(|x| x.wide()).collect(),
            no_bound: NoBound::of_verdict(&report.verdict, at, || self.baked.no_bound().cloned()),
            certified: match found.bound {
                Some(_) => found.certified,
                None => CertifiedFields::default(),
            },
            ..found
        };
        Ok(solution.with_active(at, active.map(|(u, lower)| u == lower)))
    }
}

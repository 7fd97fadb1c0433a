//! The controller of a baked module, on this machine and on the same numbers.

use signorini_device::controller::{Answer, Window};
use signorini_device::full::{Lengths, Numbers};
use signorini_device::sparse::Solved;
use signorini_device::tick::{Deadline, Limits, Report};
use signorini_kernel::Error;

use super::arrays::Baked;
use super::on_rows::{OnRows, on_rows};
use crate::desk::{Terms, Values};
use crate::{Bakes, state};

/// The controller of a baked scene.
#[derive(Debug)]
pub struct Controller<'b, R: Bakes> {
    baked: &'b Baked<R>,
    lengths: Lengths,
    own: OnRows<'b, R>,
    certificates: u32,
}

impl<'b, R: Bakes> Controller<'b, R> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        Self { baked, lengths: baked.lengths(), own: OnRows::new(baked), certificates: 0 }
    }

    /// Outputs and report for these inputs, within the limits of the baked module.
    ///
    /// # Errors
    /// Inputs outside their ranges, that are not finite, of another number, or so large that data or answers may overflow: the last answer
    /// stays.
    pub fn tick(&mut self, inputs: &[R]) -> Result<(Vec<R>, Report<R>), Error> {
        self.tick_within(inputs, self.baked.how.limits)
    }

    /// Outputs and report for these inputs, within other limits.
    ///
    /// # Errors
    /// As for [`Controller::tick`].
    pub fn tick_within(
        &mut self,
        inputs: &[R],
        limits: Limits<R>,
    ) -> Result<(Vec<R>, Report<R>), Error> {
        R::sweep(self, inputs, limits)
    }

    pub(crate) fn sweep(
        &mut self,
        inputs: &[R],
        limits: Limits<R>,
    ) -> Result<(Vec<R>, Report<R>), Error> {
        let mut looks = 0_u32;
        let clock = || {
            looks += 1;
            u32::MAX
        };
        let never = &mut Deadline { remaining: clock, sweep: 0, certificate: 0 };
        let (Answer { outputs: Values(outputs), report }, figures) = on_rows!(&mut self.own, own => {
            let answer = own.tick_within(Terms::new(inputs), limits, never)?;
            (answer, own.storage().solver.figures)
        });
        // The clock is asked before every sweep and once more at the end, at every certificate, and after each but the last.
        self.certificates = (looks.saturating_sub(report.sweeps) / 2).max(1);
        Ok((outputs, report.with(figures)))
    }

    /// The bound of the evolution until the end of the last tick, of steps in time that have one.
    pub fn window(&self) -> Option<Window<R>> {
        on_rows!(&self.own, own => own.window())
    }

    /// The bytes of the `State` that firmware has after the last tick; nothing where ticks are no steps in time.
    pub fn state(&self) -> Option<Vec<u8>> {
        self.baked.stored.as_ref()?;
        let mut numbers = vec![R::ZERO; self.lengths.handed_on()];
        on_rows!(&self.own, of => of.storage().own.hand_on(&self.lengths, &mut numbers));
        Some(state::bytes(self.baked.face.hash, &numbers))
    }

    /// Goes on from there.
    ///
    /// # Errors
    /// The bytes of a state of another scene, or damaged ones: nothing has changed then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let numbers = state::numbers(self.baked.face.hash, bytes)?;
        on_rows!(&mut self.own, of => of.storage_mut().own.take_over(&self.lengths, &numbers))
    }

    /// Certificates of the last tick, where it was swept.
    pub fn certificates(&self) -> u32 {
        self.certificates
    }

    /// Work of the factor in the last tick; `None` without one, or where sweeps had to help.
    pub fn solved(&self) -> Option<Solved<R>> {
        on_rows!(&self.own, own => own.storage().solver.solved)
    }

    /// Whether the factor alone answers for these inputs.
    pub(super) fn solves(&mut self, inputs: &[R]) -> bool {
        self.tick(inputs)
            .is_ok_and(|(_, report)| report.sweeps == 0 && report.figures.residual.finite())
    }

    /// Means of u over the edges, in [`Baked::units`] as all arrays below.
    pub fn u(&self) -> &[R] {
        self.numbers().u
    }

    /// Means of ψ over the contact edges in the last tick.
    pub fn lower(&self) -> &[R] {
        let own = self.numbers().gap;
        if own.is_empty() { &self.baked.data.loads.gap } else { own }
    }

    /// The arrays of the last tick, in [`Baked::units`]: τ is balanced, or σ_h of (15) of a tick without certificate, and s is empty then.
    pub fn numbers(&self) -> Numbers<&[R]> {
        on_rows!(&self.own, of => of.storage().own.numbers(&self.lengths)).unwrap_or_default()
    }
}

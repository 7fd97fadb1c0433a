//! The controller of a baked module, on this machine and on the same numbers.

use signorini_device::controller::Window;
use signorini_device::full::{Lengths, Numbers};
use signorini_device::sparse::Solved;
use signorini_device::tick::{Limits, Report};
use signorini_kernel::Error;

use super::arrays::Baked;
use super::on_rows::OnRows;
use crate::{Bakes, state};

/// The controller of a baked scene.
#[derive(Debug)]
pub struct Controller<'b, R: Bakes> {
    baked: &'b Baked<R>,
    lengths: Lengths,
    own: Box<dyn OnRows<R> + 'b>,
    certificates: u32,
}

impl<'b, R: Bakes> Controller<'b, R> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        Self { baked, lengths: baked.lengths(), own: R::on_rows(baked), certificates: 0 }
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
        let mut looks = 0;
        let answer = self.own.tick(inputs, limits, &mut looks)?;
        // The clock is asked before every sweep and once more at the end, at every certificate, and after each but the last.
        self.certificates = (looks.saturating_sub(answer.1.sweeps) / 2).max(1);
        Ok(answer)
    }

    /// The bound of the evolution until the end of the last tick, of steps in time that have one.
    pub fn window(&self) -> Option<Window<R>> {
        self.own.window()
    }

    /// The bytes of the `State` that firmware has after the last tick; nothing where ticks are no steps in time.
    pub fn state(&self) -> Option<Vec<u8>> {
        self.baked.stored.as_ref()?;
        let mut numbers = vec![R::ZERO; self.lengths.handed_on()];
        self.own.hand_on(&self.lengths, &mut numbers);
        Some(state::bytes(self.baked.face.hash, &numbers))
    }

    /// Goes on from there.
    ///
    /// # Errors
    /// The bytes of a state of another scene, or damaged ones: nothing has changed then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let numbers = state::numbers(self.baked.face.hash, bytes)?;
        self.own.take_over(&self.lengths, &numbers)
    }

    /// Goes back to before the first tick.
    pub fn reset(&mut self) {
        self.own.reset();
    }

    /// Certificates of the last tick, where it was swept.
    pub fn certificates(&self) -> u32 {
        self.certificates
    }

    /// Work of the factor in the last tick; `None` without one, or where sweeps had to help.
    pub fn solved(&self) -> Option<Solved<R>> {
        self.own.solved()
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

    /// ∫τ·n of every edge along its direction: balanced, or of a tick without certificate σ_h of (15).
    pub fn tau(&self) -> &[R] {
        self.numbers().tau
    }

    /// Means of ψ over the contact edges in the last tick.
    pub fn lower(&self) -> &[R] {
        let own = self.numbers().gap;
        if own.is_empty() { &self.baked.data.gap } else { own }
    }

    /// s at the vertices; empty without a certificate.
    pub fn vertices(&self) -> &[R] {
        self.numbers().vertices
    }

    /// The bubbles of s, one an edge; empty without quads or certificate.
    pub fn bubbles(&self) -> &[R] {
        self.numbers().bubbles
    }

    fn numbers(&self) -> Numbers<&[R]> {
        self.own.numbers(&self.lengths)
    }
}

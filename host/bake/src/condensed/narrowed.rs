//! Condensed models, with modes or steps and without, become arrays of the target.

use signorini_condense::{CondensedModel, ModalModel, SteppedModel};
use signorini_contact::method::Sweeps;
use signorini_kernel::Error;
use signorini_problem::inputs::ranges;

use super::arrays::{Baked, Work};
use super::bound::Bound;
use super::modes::Scaled;
use super::start::{InitialState, best_omega};
use super::steps::Steps;
use crate::Bakes;

impl<R: Bakes> Baked<R> {
    /// Narrows `condensate`; without `certified` the certificate is left out.
    ///
    /// # Errors
    /// Numbers that the scalar type cannot hold.
    pub fn new(condensate: &CondensedModel, work: Work, certified: bool) -> Result<Self, Error> {
        R::bake_condensed(condensate, work, certified)
    }

    pub(crate) fn bake(
        condensate: &CondensedModel,
        work: Work,
        certified: bool,
    ) -> Result<Self, Error> {
        let n = condensate.contact;
        // Where the default inputs have no solution, everything touches.
        let x = condensate.solve(&condensate.defaults).unwrap_or_else(|_| vec![0.0; n]);
        Self::beginning(condensate, &x, work, certified)
    }

    /// Narrows a model of modes, as [`Baked::new`] does one without.
    ///
    /// # Errors
    /// As for [`Baked::new`].
    pub fn modal(of: &ModalModel, work: Work, certified: bool) -> Result<Self, Error> {
        let scaled = Scaled::new(of);
        let baked = Self::new(&scaled.model, Work { pivots: None, ..work }, certified)?;
        let modes = scaled.modes(baked.bound.is_ok());
        let now = of.in_own_scale(of.model.defaults[of.input]);
        let omega = R::narrow(best_omega(&now, modes.diagonal));
        let mut bound = baked.bound;
        bound.iter_mut().for_each(|bound| scaled.tell(bound));
        let baked = Self {
            inputs: of.inputs,
            work,
            sweeps: Sweeps { omega, ..baked.sweeps },
            is_monotone: modes.is_monotone,
            start: InitialState::at(&scaled.x),
            ranges: ranges(of.model.ranges.get(1..of.inputs).unwrap_or_default()),
            modes: Some(modes),
            bound,
            ..baked
        };
        baked.check().map(|()| baked)
    }

    /// Narrows a model that steps in time, as [`Baked::new`] does a steady one.
    ///
    /// # Errors
    /// As for [`Baked::new`].
    pub fn stepped(of: &SteppedModel, work: Work, certified: bool) -> Result<Self, Error> {
        let x = &of.start()[of.inputs - 1..][..of.model.contact];
        // Corrections have columns in the form alone.
        let bare = of.without_bound();
        let baked = Self::beginning(&bare.model, x, work, certified)?;
        let bound = match &of.model.certificate {
            Ok(form) if certified => Ok(Bound::new(&of.model, form)),
            Err(reason) => Err(reason.clone()),
            Ok(_) => baked.bound,
        };
        let baked = Self {
            inputs: of.inputs,
            steps: Some(Steps::new(if bound.is_ok() { of } else { &bare })),
            ranges: ranges(of.model.ranges.get(1..of.inputs).unwrap_or_default()),
            has_bound: of.model.certificate.is_ok(),
            bound,
            ..baked
        };
        baked.check().map(|()| baked)
    }

    /// How many terms a tick has: inputs with the constant 1, amplitudes, and what the last tick has left.
    pub fn terms(&self) -> usize {
        let of_modes = self.modes.as_ref().map_or(0, |modes| modes.count);
        self.inputs + of_modes + self.steps.as_ref().map_or(0, |steps| steps.begin.len())
    }
}

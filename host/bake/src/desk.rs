//! Inputs and outputs of a controller on this machine: as many numbers as the scene has.

use signorini_device::controller::{Inputs, Outputs, Reading};
use signorini_kernel::Error;

use signorini_problem::scalar::Scalar;

/// The constant 1, then each input.
pub(crate) struct Terms<R>(Vec<R>);

impl<R: Scalar> Terms<R> {
    pub fn new(inputs: &[R]) -> Self {
        Self(std::iter::once(R::ONE).chain(inputs.iter().copied()).collect())
    }
}

impl<R: Scalar> Inputs<R> for Terms<R> {
    type Terms = Vec<R>;

    fn terms(self) -> Vec<R> {
        self.0
    }
}

/// Every output in order.
pub(crate) struct Values<R>(pub Vec<R>);

impl<R: Scalar> Outputs<R> for Values<R> {
    fn read(of: &impl Reading<R>) -> Result<Self, Error> {
        (0..of.count()).map(|number| of.value(number)).collect::<Result<_, _>>().map(Self)
    }
}

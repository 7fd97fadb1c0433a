//! Room that inputs leave in the ranges of fluxes, as the target has it: in a condensed model as in a full one.

use signorini_kernel::flux_range;
use signorini_problem::scalar::Scalar;

use crate::narrow::narrow;
use crate::statics::{Statics, lines, record};

/// hi − lo as a form of the inputs, see [`flux_range::Room`].
#[derive(Debug, Clone)]
pub(crate) struct Room<R> {
    terms: Vec<R>,
    size: R,
}

impl<R: Scalar> Room<R> {
    /// In the scalar of the target.
    pub fn new(of: &signorini_problem::Room) -> Self {
        Self { terms: narrow(&of.terms), size: R::narrow(of.size) }
    }

    pub fn view(&self) -> flux_range::Room<'_, R> {
        flux_range::Room { terms: &self.terms, size: self.size }
    }
}

/// The statics of all forms, and what borrows them.
pub(crate) fn written<R: Scalar>(rooms: &[flux_range::Room<R>], to: &mut Statics) -> String {
    let doc = "limit − flux of contact edges, by the inputs.";
    lines(rooms.iter().enumerate().map(|(at, room)| {
        let terms = to.numbers(&format!("ROOM_{at}"), doc, room.terms);
        record("Room", [("terms", terms), ("size", format!("{:?}", room.size))])
    }))
}

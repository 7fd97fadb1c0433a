//! Loads that the fluxes of a part which contact alone holds have to balance, as the target has it.
//!
//! Only the signs of sums matter: all numbers of a part are in the unit of its largest, so that any scalar holds them.

use signorini_contact::balance;
use signorini_problem::BALANCE;
use signorini_problem::scalar::Scalar;

use crate::narrow::narrow;
use crate::statics::{Statics, lines, record};

/// Roundings of a sum beside one an input.
const FEW: usize = 4;

/// Sums over a part, see [`balance::Balance`].
#[derive(Debug, Clone)]
pub(super) struct Balance<R> {
    cell: usize,
    least: Vec<R>,
    greatest: Vec<R>,
    slack: Vec<R>,
}

impl<R: Scalar> Balance<R> {
    /// In the scalar of the target. Rounding is what `solve` takes for it, and what sums and their terms lose in a short scalar.
    pub fn new(of: &signorini_condense::Balance) -> Self {
        let all = of.least.iter().chain(&of.greatest).chain(&of.size);
        let unit = all.fold(f64::MIN_POSITIVE, |most, of| most.max(of.abs()));
        let roundings = (of.size.len() + FEW) as f64 * R::EPSILON.wide();
        let scaled =
            |of: &[f64], by: f64| -> Vec<f64> { of.iter().map(|x| x / unit * by).collect() };
        Self {
            cell: of.cell,
            least: narrow(&scaled(&of.least, 1.0)),
            greatest: narrow(&scaled(&of.greatest, 1.0)),
            slack: narrow(&scaled(&of.size, roundings.max(BALANCE))),
        }
    }

    pub fn view(&self) -> balance::Balance<'_, R> {
        let Self { cell, least, greatest, slack } = self;
        balance::Balance { cell: *cell, least, greatest, slack }
    }
}

/// The statics of all parts, and what borrows them.
pub(super) fn written<R: Scalar>(parts: &[balance::Balance<R>], to: &mut Statics) -> String {
    let doc = "Loads of a part that contact alone holds, by inputs.";
    lines(parts.iter().enumerate().map(|(at, of)| {
        let mut numbers = |end: &str, of: &[R]| to.numbers(&format!("PART_{at}_{end}"), doc, of);
        record(
            "Balance",
            [
                ("cell", of.cell.to_string()),
                ("least", numbers("LEAST", of.least)),
                ("greatest", numbers("GREATEST", of.greatest)),
                ("slack", numbers("SLACK", of.slack)),
            ],
        )
    }))
}

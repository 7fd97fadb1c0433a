//! States of a condensed model for all inputs of a box: where its solution lies, and the edges that may change sides.
//!
//! ```text
//!   ranges of the inputs ─► load box b_lo ≤ B̂p ≤ b_hi ─► enclosure lo ≤ x ≤ hi ─► open, touching, at its limit, may change
//!                                                                                    ├─► where every output lies
//!                                                                                    └─► the largest error bound
//! ```
//! All of it is proved: rounding of this machine is counted, and what cannot be told may change.

mod affine;
mod change;
pub mod enclosure;
pub mod follow;
pub(crate) mod history;
pub mod interval;
mod lags;
pub mod largest;
pub mod lasting;
pub mod outputs;
pub mod reduced;
mod reduced_form;
pub mod reduction;
pub mod released;
pub mod sides;
mod slopes;
pub mod split;
#[cfg(test)]
mod tests;

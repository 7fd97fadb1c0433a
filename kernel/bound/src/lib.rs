#![no_std]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// `!(a < b)` is meant: it is true where a or b is NaN.
#![allow(clippy::neg_cmp_op_on_partial_ord)]
//! How wrong an iterate can be, with no unknown constant.
//!
//! [`forest`] → packed [`cells`] → [`averages`] → [`conforming`] and [`equilibrium`] → [`certificate`], which ends in a
//! [`Verdict`](signorini_kernel::Verdict). [`prepare`] does once for a mesh what the first two need.

pub mod averages;
pub mod cells;
pub mod certificate;
pub mod conforming;
pub mod equilibrium;
pub mod forest;
pub mod prepare;

//! The tests of condensed contact as one program: `cargo test -p signorini-contact --test main NAME`.
//!
//! `strip` and `memory` are what the other files test on.

mod condensed;
mod condensed_extremes;
mod condensed_limits;
mod condensed_modes;
mod limited;
mod memory;
mod phases;
mod strip;

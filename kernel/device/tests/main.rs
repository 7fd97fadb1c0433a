//! The tests of the device as one program: `cargo test -p signorini-device --test main NAME`.
//!
//! `plate`, `strip`, `memory`, `numbering`, `owned` and `ldlt` are what the other files test on.

#[path = "../../contact/tests/memory.rs"]
#[allow(dead_code, reason = "the tests of condensed contact need the rest")]
mod memory;
#[path = "../../contact/tests/strip.rs"]
#[allow(dead_code, reason = "the tests of condensed contact need the rest")]
mod strip;

mod certificate;
mod condensed_reports;
mod conditions;
mod conforming;
mod damaged;
mod degenerate;
mod equilibrium;
mod factored_ticks;
mod forces;
mod ldlt;
mod lengths;
mod numbering;
mod outputs;
mod owned;
mod plate;
mod replay;
mod sparse;
mod stability;
mod tick;
mod workspace;

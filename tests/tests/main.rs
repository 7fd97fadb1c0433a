//! The tests that need twins or host and kernel together, as one program:
//! `cargo test -p signorini-tests --test main NAME`.
//!
//! `mesh` makes the meshes that `bound` and `condensed` solve on; `ldlt` and `numbering` are the device's own.

mod another_factor;
mod bound;
mod catalogue;
mod condensed;
mod factored;
mod forces;
mod hostile;
mod identities;
#[path = "../../kernel/device/tests/ldlt.rs"]
mod ldlt;
mod mesh;
#[path = "../../kernel/device/tests/numbering.rs"]
#[allow(dead_code, reason = "the tests of the device need the rest")]
mod numbering;
mod replay;
mod scene_data;
mod standard;
mod time;
mod twins;

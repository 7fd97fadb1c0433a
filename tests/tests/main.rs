//! The tests that need twins or host and kernel together, as one program:
//! `cargo test -p signorini-tests --test main NAME`.
//!
//! `mesh` makes the meshes that `bound` and `condensed` solve on; `factored` is the kernel tests' own.

mod bound;
mod catalogue;
mod condensed;
#[path = "../../kernel/device/tests/factored.rs"]
mod factored;
mod forces;
mod hostile;
mod identities;
mod mesh;
mod scene_data;
mod standard;
mod twins;

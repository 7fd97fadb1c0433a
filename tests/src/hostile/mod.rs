//! Arbitrary bytes into everything that takes data from outside.
//!
//! | function | what the bytes are |
//! |---|---|
//! | [`mesh()`] | a Gmsh file |
//! | [`scene()`] | a scene file, on a small mesh that has whatever groups it names |
//! | [`expression()`] | an expression, and a point to evaluate it at |
//! | [`constructors()`] | arrays of the kernel: meshes, numberings, matrices, conditions, baked statics |
//! | [`tick()`] | loads, gaps, inputs and limits of a control loop on sound arrays |
//!
//! A function panics where an invariant breaks: input is accepted or refused with a typed error, in bounded
//! time; what is accepted holds no NaN, feasible iterates lie on or above the gap, and a bound is a number ≥ 0.
//! `tests/fuzz` lets libFuzzer choose the bytes, `tests/tests/hostile.rs` replays what it has found.

mod bytes;
mod certified;
mod condensed;
mod constructors;
mod expression;
mod mesh;
#[path = "../../../kernel/device/tests/numbering.rs"]
#[allow(dead_code, reason = "the tests of the device need the rest")]
mod numbering;
#[path = "../../../kernel/device/tests/owned.rs"]
#[allow(dead_code, reason = "the tests of the device need the rest")]
mod owned;
mod plate;
mod scene;
mod scenes;
mod solved;
mod stages;
mod tick;

pub use constructors::constructors;
pub use expression::expression;
pub use mesh::mesh;
pub use scene::scene;
pub use tick::tick;

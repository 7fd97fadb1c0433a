//! `cargo xtask c`: controllers for C, as `signorini bake --c` writes them.
//!
//! ```text
//!   program    every kind of scene on every board: the lines of the desk's Rust program
//!   cost       what a call from C takes beside one from Rust, on the same code of the controller
//!   headers    C and C++ of every age, without a warning; what a library is not built for is refused
//!   states     several libraries in one program: states that are saved, damaged, exchanged, refused
//!   flight     1200 inputs that an RTIC program flew, with the bits of the desk
//!   example    the program that a bake writes, built by CMake, to its end
//! ```

mod cost;
mod example;
mod headers;
pub mod package;
pub mod program;
mod states;

use crate::flight;
use crate::modules;
use crate::setup;
use crate::steps::Steps;

/// The steps of the six.
pub fn run(steps: &mut Steps) {
    setup::for_c(steps);
    modules::bake_for_c(steps);
    headers::run(steps);
    states::run(steps);
    example::run(steps);
    cost::run(steps);
    program::run(steps);
    steps.check("the flight, from C, bit for bit", flight::from_c);
}

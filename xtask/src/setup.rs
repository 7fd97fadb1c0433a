//! `cargo xtask setup`: what the checks on microcontrollers need.

use signorini_image::board::TRIPLES;
use signorini_image::tools::{ensure, ensure_for_c};

use crate::steps::Steps;

/// The verb.
pub fn run(steps: &mut Steps) {
    steps.check_once("tools for microcontrollers", || ensure(&TRIPLES));
}

/// Compilers for C beside them.
pub fn for_c(steps: &mut Steps) {
    run(steps);
    steps.check_once("tools for C", ensure_for_c);
}

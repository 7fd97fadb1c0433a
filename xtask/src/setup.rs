//! `cargo xtask setup`: what the checks on microcontrollers need.

use signorini_image::tools::ensure;

use crate::steps::Steps;

/// The verb.
pub fn run(steps: &mut Steps) {
    steps.check_once("tools for microcontrollers", ensure);
}

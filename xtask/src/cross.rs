//! `cargo xtask cross`: the kernel and every image for every core.
//!
//! The kernel has no features to choose among: both scalars and both square roots are in the images.

use crate::board::{Board, Build, M4, M4F, M7};
use crate::cargo::run as run_cargo;
use crate::export::scenes;
use crate::setup;
use crate::steps::Steps;

const BOARDS: [Board; 3] = [M4, M4F, M7];

/// What is built: package, features, what to call it.
const PACKAGES: [(&str, &[&str], &str); 4] = [
    ("signorini-kernel", &[], "the kernel"),
    ("signorini-firmware", &[], "the images"),
    ("signorini-firmware", &["dwt"], "the images for a real board"),
    ("signorini-rtic", &[], "the RTIC example"),
];

/// Builds for the M4 without and with its unit for f32, and for the M7.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    for board in BOARDS {
        for (package, features, what) in PACKAGES {
            steps.check(&format!("{what} for the {}", board.name), || {
                let scenes = scenes()?;
                let build = Build { package, bins: &[], features, scenes: &scenes };
                run_cargo(board.build(build)?.0)
            });
        }
    }
}

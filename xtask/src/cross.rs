//! `cargo xtask cross`: the kernel and every image for every core.
//!
//! With all features: both scalars and both square roots are in the images. A baked scene, which names the
//! features that it needs, is built as well; `audit`, `size` and `firmware` build more of them.

use std::fs;

use crate::crates::DEVICE;
use crate::export::{scenes, stages};
use crate::modules::rows;
use crate::setup;
use crate::steps::Steps;
use signorini_image::board::{Board, Build, HARDWARE, M4, M4F, M7};
use signorini_image::cargo::{run as run_cargo, target_dir};
use signorini_image::files;

/// Boards, the first of which links every image in every run, and the last of which a whole run alone builds for.
const BOARDS: [Board; 3] = [M4F, M4, M7];

/// Packages of images, and what to call them.
const PACKAGES: [(&str, &str); 2] =
    [("signorini-firmware", "the images"), ("signorini-rtic", "the RTIC example")];

/// Builds for the M4 without and with its unit for f32, for the M7, and for a real board.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let is_whole = steps.is_whole();
    let boards = if is_whole { &BOARDS[..] } else { &BOARDS[..2] };
    for (at, board) in boards.iter().enumerate() {
        let kernel = [(DEVICE, "the kernel")];
        let images = PACKAGES.into_iter().filter(|_| is_whole || at == 0);
        for (package, what) in kernel.into_iter().chain(images) {
            steps.check(&format!("{what} for the {}", board.name), || {
                let what = Build { package, bins: &[], features: &[], scenes: &scenes()? };
                run_cargo(board.build(what)?.0)
            });
        }
    }
    for row in rows(is_whole) {
        for board in row.linked.iter().take(if is_whole { row.linked.len() } else { 1 }) {
            steps.check(&format!("{} for the {}", row.name(), board.name), || {
                Ok(row.module()?.image(board).map(drop)?)
            });
        }
    }
    if !is_whole {
        return;
    }
    steps.check("the cost image for a real board", || {
        let built = stages(&HARDWARE, &["cost"], &["dwt"])?;
        // Out of the way of the emulator's image of the same name.
        let folder = files::folder(&target_dir("firmware").join("hardware"))?;
        let copied = fs::copy(built.join("cost"), folder.join("cost"));
        copied.map(drop).map_err(|error| error.to_string())
    });
}

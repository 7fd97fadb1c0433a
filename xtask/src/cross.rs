//! `cargo xtask cross`: the kernel and every image for every core.
//!
//! With all features: both scalars and both square roots are in the images. A baked scene, which names the
//! features that it needs, is built as well; `audit`, `size` and `firmware` build more of them.

use std::fs;

use crate::baked::Recipe;
use crate::export::scenes;
use crate::setup;
use crate::steps::Steps;
use signorini_image::board::{Board, Build, HARDWARE, M4, M4F, M7};
use signorini_image::cargo::{run as run_cargo, target_dir};

const BOARDS: [Board; 3] = [M4, M4F, M7];

/// Packages, and what to call them.
const PACKAGES: [(&str, &str); 3] = [
    ("signorini-device", "the kernel"),
    ("signorini-firmware", "the images"),
    ("signorini-rtic", "the RTIC example"),
];

/// Builds for the M4 without and with its unit for f32, for the M7, and for a real board.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    for board in BOARDS {
        for (package, what) in PACKAGES {
            steps.check(&format!("{what} for the {}", board.name), || {
                build(&board, Build { package, bins: &[], features: &[], scenes: &scenes()? })
            });
        }
        steps.check(&format!("a baked scene for the {}", board.name), || {
            let recipe = Recipe::of("meshes/scenes/levee.toml", "--condensed");
            Ok(recipe.bake()?.image(&board, &[]).map(drop)?)
        });
    }
    steps.check("the cost image for a real board", || {
        let (package, bins) = ("signorini-firmware", &["cost"]);
        let what = Build { package, bins, features: &["dwt"], scenes: &scenes()? };
        build(&HARDWARE, what)?;
        // Out of the way of the emulator's image of the same name.
        let folder = target_dir("firmware").join("hardware");
        fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
        let copied = fs::copy(HARDWARE.build(what)?.1.join("cost"), folder.join("cost"));
        copied.map(drop).map_err(|error| error.to_string())
    });
}

fn build(board: &Board, what: Build) -> Result<(), String> {
    run_cargo(board.build(what)?.0)
}

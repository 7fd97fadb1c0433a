//! Several controllers in one program, found by CMake: states that are saved, damaged, exchanged and refused.

use std::fs;
use std::process::Command;

use super::package::{folder, machine};
use super::program::sources;
use crate::modules::ROWS;
use crate::steps::Steps;
use signorini_image::cargo::root;
use signorini_image::toolchain::output;

/// Controllers of one program, all there are in CMakeLists.txt: two scenes, one of them in another scalar and in another model,
/// too, of the same contents under other names.
const CONTROLLERS: [&str; 6] =
    ["levee", "levee-double", "levee-full", "levee-swept", "slab", "words"];

/// A step for the desk, and one for a board.
pub fn run(steps: &mut Steps) {
    let words: &[&str] = if steps.is_whole() { &["m4", "host"] } else { &["m4"] };
    for word in words {
        steps.check(&format!("states of six controllers in one program, {word}"), || check(word));
    }
}

fn check(word: &str) -> Result<(), String> {
    let machine = machine(word)?;
    let row = |name: &str| ROWS.iter().find(|row| row.recipe().scene_name() == name);
    let packages = CONTROLLERS.map(|name| row(name).ok_or(format!("no module of {name}")));
    let packages = packages.into_iter().map(|row| row?.package(word));
    let packages: Vec<_> = packages.collect::<Result<_, String>>()?;
    let build = folder().join(word).join("states");
    let _ = fs::remove_dir_all(&build);
    let places: Vec<_> =
        packages.iter().map(|package| package.folder.display().to_string()).collect();
    let mut configure = Command::new("cmake");
    configure.arg("-S").arg(sources()).arg("-B").arg(&build);
    configure.arg(format!("-DPACKAGES={}", places.join(";")));
    configure.arg(format!("-DPEERS={}", root().join("tests/firmware/peers").display()));
    if machine.board.is_some() {
        let toolchain = packages[0].folder.join("example/toolchain.cmake");
        configure.arg("-DBOARD=ON").arg(format!("-DCMAKE_TOOLCHAIN_FILE={}", toolchain.display()));
    }
    output(&mut configure)?;
    let mut make = Command::new("cmake");
    // What a compiler says goes to either of the two.
    output(make.arg("--build").arg(&build).args(["--", "--no-print-directory"]))?;
    let program = build.join("states");
    let said = match &machine.board {
        Some(board) => board.run(&program, false)?,
        None => {
            output(&mut Command::new(&program)).map_err(|why| format!("{why}: it tells why"))?
        }
    };
    print!("{said}");
    match said.matches(": as it should\n").count() {
        count if count == CONTROLLERS.len() => Ok(()),
        other => Err(format!("{other} controllers are as they should: {said}")),
    }
}

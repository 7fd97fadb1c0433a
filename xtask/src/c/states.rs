//! Several controllers in one program, found by CMake: states that are saved, damaged, exchanged and refused.

use std::process::Command;

use super::package::{folder, machine};
use super::program::{configure, sources};
use crate::modules::rows;
use crate::steps::Steps;
use signorini_image::cargo::root;
use signorini_image::toolchain::output;

/// Controllers of one program, all there are in CMakeLists.txt: two scenes, one of them in another scalar and in another model,
/// too, of the same contents under other names; the last one steps in time.
const CONTROLLERS: [&str; 7] =
    ["levee", "levee-double", "levee-full", "levee-swept", "slab", "words", "antiicing-warm"];

/// A step for the desk, and one for a board.
pub fn run(steps: &mut Steps) {
    let words: &[&str] = if steps.is_whole() { &["m4", "host"] } else { &["m4"] };
    for word in words {
        steps.check(&format!("states of seven controllers in one program, {word}"), || check(word));
    }
}

fn check(word: &str) -> Result<(), String> {
    let machine = machine(word)?;
    let row = |name: &str| rows(false).find(|row| row.recipe().scene_name() == name);
    let packages = CONTROLLERS.map(|name| row(name).ok_or(format!("no module of {name}")));
    let packages = packages.into_iter().map(|row| row?.package(word));
    let packages: Vec<_> = packages.collect::<Result<_, String>>()?;
    let build = folder().join(word).join("states");
    let places: Vec<_> =
        packages.iter().map(|package| package.folder.display().to_string()).collect();
    let mut defines = vec![
        format!("-DPACKAGES={}", places.join(";")),
        format!("-DPEERS={}", root().join("tests/firmware/peers").display()),
    ];
    if machine.board.is_some() {
        let toolchain = packages[0].folder.join("example/toolchain.cmake");
        let toolchain = format!("-DCMAKE_TOOLCHAIN_FILE={}", toolchain.display());
        defines.extend(["-DBOARD=ON".to_owned(), toolchain]);
    }
    configure(&sources(), &build, &defines)?;
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

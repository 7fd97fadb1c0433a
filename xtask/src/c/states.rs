//! Several controllers in one program, found by CMake: states that are saved, damaged, exchanged and refused.

use std::fs;
use std::process::Command;

use super::package::{Package, folder, machine, write};
use super::program::sources;
use crate::baked::Recipe;
use crate::steps::Steps;
use signorini_image::cargo::root;
use signorini_image::toolchain::output;

/// Controllers of one program, all there are in CMakeLists.txt.
const CONTROLLERS: usize = 6;

/// A step for the desk, and one for a board.
pub fn run(steps: &mut Steps) {
    for word in ["host", "m4"] {
        steps.check(&format!("states of six controllers in one program, {word}"), || check(word));
    }
}

fn check(word: &str) -> Result<(), String> {
    let machine = machine(word)?;
    let packages = recipes()?.into_iter().map(|recipe| Package::bake(&recipe, machine));
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
        CONTROLLERS => Ok(()),
        other => Err(format!("{other} of {CONTROLLERS} controllers are as they should: {said}")),
    }
}

/// Two scenes, one of them in another scalar and in another model, too: of the same contents under other names.
fn recipes() -> Result<Vec<Recipe>, String> {
    let condensed = |scene| Recipe::of(scene, "--condensed");
    let double =
        Recipe { scalar: Some("f64".to_owned()), ..Recipe::of(&levee("double")?, "--condensed") };
    Ok(vec![
        condensed("meshes/scenes/levee.toml"),
        double,
        Recipe::of(&levee("full")?, "--full"),
        Recipe::of("tests/firmware/scenes/levee-swept.toml", "--full"),
        condensed("meshes/scenes/slab.toml"),
        condensed("tests/firmware/scenes/words.toml"),
    ])
}

/// The levee under another name.
fn levee(more: &str) -> Result<String, String> {
    let scenes = root().join("meshes/scenes");
    let to = folder().join("scenes");
    let copied = |from: &str, name: &str| {
        let bytes = fs::read(scenes.join(from)).map_err(|error| format!("{from}: {error}"))?;
        write(&to.join(name), &bytes)
    };
    copied("levee.msh", "levee.msh")?;
    let name = format!("levee_{more}.toml");
    copied("levee.toml", &name)?;
    Ok(to.join(name).display().to_string())
}

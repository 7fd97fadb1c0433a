//! The program that a bake writes beside a library, as its user builds and runs it: by CMake, to its end.

use std::process::Command;

use super::package::Package;
use super::program::configure;
use crate::modules::row;
use crate::steps::Steps;

/// The last words of the example: 40 steps, one of which hangs on a board, until the watchdog resets it.
const LAST: [(&str, &str); 4] = [
    ("m4", "done: 40 steps, 1 resets"),
    ("m7", "done: 40 steps, 1 resets"),
    ("m33", "done: 40 steps, 1 resets"),
    ("host", "done: 40 steps, 0 resets"),
];

/// Inputs with ranges, none at all, and names that are words of C.
const SCENES: [&str; 3] = ["levee", "bare", "words"];

/// Seconds that an example may take: it hangs where no watchdog resets it.
const LIMIT: &str = "120";

/// A step for each scene.
pub fn run(steps: &mut Steps) {
    let is_whole = steps.is_whole();
    let count = if is_whole { SCENES.len() } else { 1 };
    for scene in SCENES.into_iter().take(count) {
        steps.check(&format!("the example of {scene}, by CMake, to its end"), || {
            let row = row(scene, "--condensed")?;
            let words = row.c.words(is_whole);
            let built = LAST.iter().filter(|(word, _)| words.contains(word));
            built.clone().try_for_each(|(word, last)| check(&row.package(word)?, word, last))
        });
    }
}

fn check(package: &Package, word: &str, last: &str) -> Result<(), String> {
    let build = package.folder.join("build");
    configure(&package.folder.join("example"), &build, &[])?;
    let mut run = Command::new("timeout");
    run.args([LIMIT, "cmake", "--build"]).arg(&build).args(["--target", "run"]);
    let ran = run.output().map_err(|error| format!("timeout: {error}"))?;
    // The emulator's console is standard error.
    let said = [ran.stdout, ran.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    let said = said.concat();
    let steps = said.lines().filter(|line| line.starts_with("step ")).count();
    match said.lines().any(|line| line.trim() == last) && ran.status.success() && steps == 40 {
        true => Ok(()),
        false => Err(format!("{word}: {}, {steps} steps, not `{last}`: {said}", ran.status)),
    }
}

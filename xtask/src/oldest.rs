//! The program that README's first command builds runs on every x86-64: a scene is solved on an emulated one without AVX.

use std::path::Path;
use std::process::Command;

use crate::program;
use crate::steps::Steps;
use signorini_image::cargo::{root, target_dir};
use signorini_image::tools::{answer, ensured};

const EMULATOR: &str = "qemu-x86_64";
/// Of 2008, with SSE 4.2; AVX came with the next one.
const PROCESSOR: &str = "Nehalem";
const SCENE: &str = "meshes/catalogue/h-mixed.toml";
/// Solved in a fifth of the time.
const LIGHT: &str = "meshes/catalogue/a-tri.toml";
/// The kernel's sweeps and the direct solver, whose products find the widest registers as they run.
const SOLVERS: [&str; 2] = ["kernel", "direct"];

/// A solve by sweeps.
pub fn witness(steps: &mut Steps) {
    solves(steps, LIGHT, &SOLVERS[..1]);
}

/// A solve by each solver.
pub fn run(steps: &mut Steps) {
    solves(steps, SCENE, &SOLVERS);
}

/// No step on other processors.
fn solves(steps: &mut Steps, scene: &str, solvers: &[&str]) {
    if !cfg!(target_arch = "x86_64") {
        return;
    }
    steps.check("a solve on an x86-64 without AVX", || {
        ensured(&["qemu-user"], || answer(&[EMULATOR]))?;
        let program = program::path()?;
        solvers.iter().try_for_each(|solver| solve(&program, scene, solver))
    });
}

fn solve(program: &Path, scene: &str, solver: &str) -> Result<(), String> {
    let mut command = Command::new(EMULATOR);
    command.args(["-cpu", PROCESSOR]).arg(program).args(["solve", scene, "--solver", solver]);
    command.arg("--out").arg(target_dir("oldest").join(solver)).current_dir(root());
    let ended = command.output().map_err(|error| format!("{EMULATOR}: {error}"))?;
    if ended.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&ended.stderr);
    Err(format!("--solver {solver} on a {PROCESSOR}: {}: {}", ended.status, said.trim()))
}

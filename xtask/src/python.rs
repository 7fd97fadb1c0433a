//! Environments of Python, each in a folder below `target/python`; `cargo xtask python`: the module `signorini` is built by pip in a fresh environment, and its tests run there beside the command line; `cargo xtask wheel`: the same module as one file that pip installs anywhere.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::program;
use crate::steps::Steps;
use signorini_image::cargo::{root, run as run_command, target_dir};
use signorini_image::files;
use signorini_image::toolchain::output;
use signorini_image::tools::{ensured, install_packages};

/// The package of the module: what it is linked to, pip knows.
pub const PACKAGE: &str = "signorini-python";

/// Packages that the library of Gmsh asks of a system.
const OF_GMSH: [&str; 6] =
    ["libglu1-mesa", "libxrender1", "libxcursor1", "libxft2", "libxinerama1", "libgl1"];

/// The folder of the environment: removed first, so that nothing of an earlier build is left.
const ENVIRONMENT: &str = "module-environment";

/// The steps.
pub fn run(steps: &mut Steps) {
    // Pip builds into the folder of the program, whose crates serve the module.
    steps.check("pip builds the module signorini, and its tests pass", || {
        let _ = std::fs::remove_dir_all(target_dir("python").join(ENVIRONMENT));
        let python = environment(ENVIRONMENT, &["./host/python[test]"], &[])?;
        if output(Command::new(&python).args(["-c", "import gmsh"])).is_err() {
            install_packages(&OF_GMSH)?;
        }
        let mut tests = Command::new(&python);
        tests.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "host/python/tests"]);
        tests.env("SIGNORINI", program::path()?).current_dir(root());
        run_command(tests)
    });
}

/// The folder of the environment in which the wheel is tried.
const TRIED: &str = "wheel-environment";
/// What the wheel is tried with: the seepage of the levee in m²/s.
const TRIAL: &str = "import signorini; r = signorini.solve('meshes/scenes/levee.toml'); \
    assert 3e-5 < r.outputs['seepage'].value < 4e-5, r.outputs";

/// The verb `wheel`: maturin builds the wheel, and a fresh environment solves a scene with it alone.
pub fn wheel(steps: &mut Steps) {
    steps.check("maturin builds the wheel", || {
        let dist = files::folder(&target_dir("dist"))?;
        wheels(&dist)?.iter().try_for_each(|old| {
            std::fs::remove_file(old).map_err(|error| format!("{}: {error}", old.display()))
        })?;
        let maturin = environment("maturin-environment", &["maturin>=1.8,<2"], &[])?;
        let mut build = Command::new(&maturin);
        build.args(["-m", "maturin", "build", "--release", "--locked"]);
        build.args(["--manifest-path", "host/python/Cargo.toml", "--out"]).arg(&dist);
        build.current_dir(root());
        run_command(build)
    });
    steps.check("the wheel solves a scene", || {
        let built = wheels(&target_dir("dist"))?;
        let [wheel] = &built[..] else { return Err(format!("{} wheels", built.len())) };
        let _ = std::fs::remove_dir_all(target_dir("python").join(TRIED));
        let wheel = wheel.display().to_string();
        let python = environment(TRIED, &[wheel.as_str()], &[])?;
        output(Command::new(&python).args(["-c", TRIAL]).current_dir(root()))?;
        println!("{wheel}");
        Ok(())
    });
}

/// The wheels in a folder.
fn wheels(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let is_wheel = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "whl");
    Ok(files::within(folder)?.into_iter().filter(is_wheel).collect())
}

/// The Python of the environment `name`, made just now where need be and possible, after `pip install` with these words; `variables` are
/// for what pip runs.
///
/// # Errors
/// No Python, or a package that pip does not find or cannot build.
pub fn environment(
    name: &str,
    words: &[&str],
    variables: &[(&str, PathBuf)],
) -> Result<PathBuf, String> {
    let folder = target_dir("python").join(name);
    let [system, own] = match cfg!(windows) {
        true => ["python", "Scripts/python.exe"],
        false => ["python3", "bin/python"],
    };
    let python = folder.join(own);
    if !python.exists() {
        // What a failed attempt has left has a Python and no pip: it is cleared.
        let words = ["-m", "venv", "--clear"];
        let make = || output(Command::new(system).args(words).arg(&folder)).map(drop);
        ensured(&["python3-venv"], make).inspect_err(|_| drop(std::fs::remove_dir_all(&folder)))?;
    }
    let mut pip = Command::new(&python);
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(words);
    pip.envs(variables.iter().map(|(name, value)| (name, value))).current_dir(root());
    output(&mut pip)?;
    Ok(python)
}

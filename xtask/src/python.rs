//! Environments of Python, each in a folder below `target/python`; `cargo xtask python`: the module `signorini` is built by pip in a fresh environment, and its tests run there beside the command line.
//! `cargo xtask wheel` has the same module as one file that pip installs anywhere, `cargo xtask installs` the source distribution, too.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::program;
use crate::steps::Steps;
use signorini_image::cargo::{root, run as run_command, target_dir};
use signorini_image::files;
use signorini_image::toolchain::output;
use signorini_image::tools::{ensure_for_c, ensured, install_packages};

/// The package of the module: what it is linked to, pip knows.
pub const PACKAGE: &str = "signorini-python";

/// Its manifest.
const MANIFEST: &str = "host/python/Cargo.toml";

/// Packages that the library of Gmsh asks of a system.
const OF_GMSH: [&str; 6] =
    ["libglu1-mesa", "libxrender1", "libxcursor1", "libxft2", "libxinerama1", "libgl1"];

/// The folder of the environment: removed first, so that nothing of an earlier build is left.
const ENVIRONMENT: &str = "module-environment";

/// The steps.
pub fn run(steps: &mut Steps) {
    // Pip builds into the folder of the program, whose crates serve the module.
    let is_whole = steps.is_whole();
    steps.check("pip builds the module signorini, and its tests pass", || {
        let _ = std::fs::remove_dir_all(target_dir("python").join(ENVIRONMENT));
        let python = environment(ENVIRONMENT, &["./host/python[test]"], &[])?;
        if output(Command::new(&python).args(["-c", "import gmsh"])).is_err() {
            install_packages(&OF_GMSH)?;
        }
        let mut tests = Command::new(&python);
        tests.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "host/python/tests"]);
        tests.env("SIGNORINI", program::path()?).current_dir(root());
        if is_whole {
            // A notebook goes to a board, and shows what the command says: nothing of packages.
            ensure_for_c()?;
            tests.env("SIGNORINI_WHOLE", "1");
        }
        run_command(tests)
    });
}

/// The verb `wheel`: the module as one file, in target/dist.
pub fn wheel(steps: &mut Steps) {
    steps.check("the wheel of this machine, in a fresh environment", || {
        let dist = files::folder(&target_dir("dist"))?;
        wheels(&dist)?.iter().try_for_each(|old| {
            std::fs::remove_file(old).map_err(|error| format!("{}: {error}", old.display()))
        })?;
        let mut build = Command::new(maturin()?);
        build.args(["build", "--release", "--locked", "--manifest-path", MANIFEST, "--out"]);
        // The folder of the program, whose crates serve the module.
        build.arg(&dist).env("CARGO_TARGET_DIR", target_dir("")).current_dir(root());
        output(&mut build)?;
        installed("wheel-environment", &wheels(&dist)?, &[])
    });
}

/// What is handed to users: the wheel, and the source distribution.
pub fn distributed(steps: &mut Steps) {
    wheel(steps);
    steps.check("the source distribution builds a wheel, in a fresh environment", || {
        let folder = target_dir("python").join("distributed");
        files::emptied(&folder)?;
        let mut pack = Command::new(maturin()?);
        pack.args(["sdist", "--manifest-path", MANIFEST, "--out"]);
        output(pack.arg(&folder).current_dir(root()))?;
        let packed = files::within(&folder)?;
        // A folder of its own, without what was built of the checkout's files, which cargo would take for these. That it builds is
        // asked, not how fast it is.
        let target = files::emptied(&target_dir("python").join("sdist-target"))?;
        let variables =
            [("CARGO_TARGET_DIR", target), ("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0".into())];
        installed("sdist-environment", &packed, &variables)
    });
}

/// The program that packs modules.
fn maturin() -> Result<PathBuf, String> {
    let python = environment("maturin", &["maturin>=1.8,<2"], &[])?;
    Ok(python.with_file_name("maturin"))
}

/// The wheels in a folder.
fn wheels(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let is_wheel = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "whl");
    Ok(files::within(folder)?.into_iter().filter(is_wheel).collect())
}

/// What an installed module is tried with: its version, and the seepage of the levee in m²/s.
const TRIAL: &str = "import signorini, sys; r = signorini.solve(sys.argv[1]); \
    assert 3e-5 < r.outputs['seepage'].value < 4e-5, r.outputs; print(signorini.__version__)";

/// Installs one file in a fresh environment, where the module solves a scene away from the checkout; `variables` are for what builds it.
fn installed(name: &str, files: &[PathBuf], variables: &[(&str, PathBuf)]) -> Result<(), String> {
    let _ = std::fs::remove_dir_all(target_dir("python").join(name));
    let [file] = files else { return Err(format!("{} files", files.len())) };
    let python = environment(name, &[&file.display().to_string()], variables)?;
    let mut trial = Command::new(python);
    trial.args(["-I", "-c", TRIAL]).arg(root().join("meshes/scenes/levee.toml"));
    let said = output(trial.current_dir(std::env::temp_dir()))?;
    match said.trim() == env!("CARGO_PKG_VERSION") {
        true => Ok(()),
        false => Err(format!("{} has version {}", file.display(), said.trim())),
    }
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

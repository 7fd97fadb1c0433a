//! Environments of Python, each in a folder below `target/python`; `cargo xtask python`: the module `signorini` is built by pip in a fresh environment, and its tests run there beside the command line.
//! `cargo xtask installs` has the module as users get it, from a wheel and from the source distribution.

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

/// The steps of what is handed to users.
pub fn distributed(steps: &mut Steps) {
    let folder = target_dir("python").join("distributed");
    let maturin = || {
        files::emptied(&folder)?;
        let python = environment("maturin", &["maturin>=1.8,<2"], &[])?;
        Ok::<_, String>(python.with_file_name("maturin"))
    };
    steps.check("the wheel of this machine, in a fresh environment", || {
        let mut build = Command::new(maturin()?);
        build.args(["build", "--release", "--locked", "--manifest-path", MANIFEST, "--out"]);
        // The folder of the program, whose crates serve the module.
        build.arg(&folder).env("CARGO_TARGET_DIR", target_dir("")).current_dir(root());
        output(&mut build)?;
        imported("wheel-environment", &folder, &[])
    });
    steps.check("the source distribution builds a wheel, in a fresh environment", || {
        let mut pack = Command::new(maturin()?);
        pack.args(["sdist", "--manifest-path", MANIFEST, "--out"]);
        output(pack.arg(&folder).current_dir(root()))?;
        // A folder of its own, without what was built of the checkout's files, which cargo would take for these. That it builds is
        // asked, not how fast it is.
        let target = files::emptied(&target_dir("python").join("sdist-target"))?;
        let variables =
            [("CARGO_TARGET_DIR", target), ("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0".into())];
        imported("sdist-environment", &folder, &variables)
    });
}

/// Installs the one file of a folder in a fresh environment, where the module then tells its version, away from the checkout; `variables` are
/// for what builds it.
fn imported(name: &str, folder: &Path, variables: &[(&str, PathBuf)]) -> Result<(), String> {
    let _ = std::fs::remove_dir_all(target_dir("python").join(name));
    let files = files::within(folder)?;
    let [file] = &files[..] else { return Err(format!("{} files", files.len())) };
    let python = environment(name, &[&file.display().to_string()], variables)?;
    let mut import = Command::new(python);
    import.args(["-I", "-c", "import signorini; print(signorini.__version__)"]);
    let said = output(import.current_dir(std::env::temp_dir()))?;
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
    let python = folder.join("bin/python");
    if !python.exists() {
        // What a failed attempt has left has a Python and no pip: it is cleared.
        let words = ["-m", "venv", "--clear"];
        let make = || output(Command::new("python3").args(words).arg(&folder)).map(drop);
        ensured(&["python3-venv"], make).inspect_err(|_| drop(std::fs::remove_dir_all(&folder)))?;
    }
    let mut pip = Command::new(&python);
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(words);
    pip.envs(variables.iter().map(|(name, value)| (name, value))).current_dir(root());
    output(&mut pip)?;
    Ok(python)
}

//! `cargo xtask python`: the module `signorini` is built by pip in a fresh environment, and its tests run there beside the command line.

use std::process::Command;

use crate::program;
use crate::steps::Steps;
use crate::venv;
use signorini_image::cargo::{root, run as run_command, target_dir};
use signorini_image::toolchain::output;
use signorini_image::tools::install_packages;

/// The package of the module: what it is linked to, pip knows.
pub const PACKAGE: &str = "signorini-python";

/// What the library of Gmsh asks of a system.
const OF_GMSH: [&str; 6] =
    ["libglu1-mesa", "libxrender1", "libxcursor1", "libxft2", "libxinerama1", "libgl1"];

/// The folder of the environment: removed first, so that nothing of an earlier build is left.
const ENVIRONMENT: &str = "module-environment";

/// The steps.
pub fn run(steps: &mut Steps) {
    // Pip builds into the folder of the program, whose crates serve the module.
    steps.check("pip builds the module signorini, and its tests pass", || {
        let _ = std::fs::remove_dir_all(target_dir("python").join(ENVIRONMENT));
        let python = venv::with(ENVIRONMENT, &["./host/python[test]"], &[])?;
        if output(Command::new(&python).args(["-c", "import gmsh"])).is_err() {
            install_packages(&OF_GMSH)?;
        }
        let mut tests = Command::new(&python);
        tests.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "host/python/tests"]);
        tests.env("SIGNORINI", program::path()?).current_dir(root());
        run_command(tests)
    });
}

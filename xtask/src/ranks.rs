//! Campaigns on two ranks of MPI: tests that `cargo test` leaves out, since they need an installed MPI.

use std::path::Path;
use std::process::Command;

use crate::counted::counted;
use crate::steps::Steps;
use signorini_image::toolchain::output;
use signorini_image::tools::{answer, ensured};

/// An MPI, and what its bindings are made with.
const PACKAGES: [&str; 3] = ["libopenmpi-dev", "openmpi-bin", "libclang-dev"];

/// The whole workspace, as the tests before, so that its dependencies are compiled already.
const TESTS: [&str; 8] = [
    "test",
    "--release",
    "--workspace",
    "--locked",
    "--features",
    "signorini/mpi",
    "--test",
    "ranks",
];

/// The step.
pub fn run(steps: &mut Steps) {
    steps.step("two ranks under MPI", || {
        ensure()?;
        Ok(counted(&TESTS))
    });
}

/// `Ok` where all is there, installed just now where need be and possible.
fn ensure() -> Result<(), String> {
    ensured(&PACKAGES, || {
        answer(&["mpicc", "mpirun"])?;
        // A library without a program to ask; elsewhere the build says whether it is there.
        match Path::new("/etc/debian_version").exists() {
            true => output(Command::new("dpkg-query").args(["--show", "libclang-dev"])).map(drop),
            false => Ok(()),
        }
    })
}

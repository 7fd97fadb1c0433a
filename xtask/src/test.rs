//! `cargo xtask test`: everything that must hold, in the order in which it is cheap to find out; `--all` has beside it what
//! need not run each time.
//!
//! ```text
//!   formatting, house ─► signorini ─┬─► host: clippy, tests, documentation, Python
//!                                   └─► boards: modules, images, C, audits, records
//!   --all: more boards and breaches in the steps above; then fuzzing, sanitizer, mutants, MPI, OSQP, old processors, PyVista,
//!          archives, what is installed
//! ```
//! `--only PART` runs one of these parts, which no other has to go before: the jobs of `.github/workflows/test.yml`.
//!
//! The host's steps use all processors while they compile, those of the boards one: images are linked as a whole.

use clap::{Args, ValueEnum};

use crate::counted::counted_by;
use crate::crates::{KERNEL, of_kernel};
use crate::steps::{Mode, Steps};
use crate::{
    audit, boards, c, cost, cross, firmware, fuzz, house, installs, logs, modules, mutants, no_std,
    oldest, osqp, package, program, python, ranks, results, sanitize, seen, setup, size,
};
use signorini_image::cargo::{cargo, require, run as run_cargo};
use signorini_image::tools::ensure_for_c;

/// Workspaces of their own, and all packages of each.
const FORMATTED: [&str; 6] = [
    "Cargo.toml",
    no_std::MANIFEST,
    fuzz::MANIFEST,
    mutants::MANIFEST,
    osqp::MANIFEST,
    "tests/firmware/Cargo.toml",
];

/// The sources of all programs, and the scenes that tests read.
const HOST: [&str; 9] = [
    "kernel",
    "host",
    "meshes",
    "tests/src",
    "tests/tests",
    "tests/Cargo.toml",
    "tests/tolerances",
    "tests/fuzz",
    "tests/fixtures",
];
/// Files that tests compare with what programs say.
const PAGES: [&str; 8] = [
    "docs",
    ".github",
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "tests/firmware",
];
/// What the module is built from, and the pages and scenes that its tests run.
const PYTHON: [&str; 5] = ["kernel", "host", "meshes", "tests/firmware", "docs"];
/// The sources and scenes of what boards run.
const BOARDS: [&str; 5] = ["kernel", "host", "meshes", "tests/firmware", "docs/firmware.md"];

/// How the verb is called.
#[derive(Debug, Args)]
pub struct Options {
    #[command(flatten)]
    pub mode: Mode,
    /// Runs one part alone, as a job of continuous integration does
    #[arg(long, value_name = "PART", value_enum)]
    pub only: Option<Part>,
}

/// A part of the verb, which needs no other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// Formatting, and rules of the house
    House,
    /// Clippy, tests, documentation
    Host,
    /// The kernel without std
    NoStd,
    /// The Python module
    Python,
    /// Controllers and images on emulated boards
    Boards,
    /// Sanitizer, mutants, an old processor, a little of each; with --all in full, and fuzzing, MPI, OSQP, PyVista too
    Rest,
}

/// The verb: all parts, or one.
pub fn run(steps: &mut Steps, only: Option<Part>) {
    let runs = move |part: Part| only.is_none_or(|only| only == part);
    if runs(Part::House) {
        formatting(steps);
        house::run(steps);
    }
    if !matches!(only, Some(Part::House | Part::NoStd)) {
        steps.compile("the program signorini", || program::path().map(drop));
    }
    steps.beside(
        |steps| on_host(steps, runs),
        |steps| {
            if runs(Part::Boards) {
                on_boards(steps);
            }
        },
    );
    if runs(Part::Rest) {
        match steps.is_whole() {
            true => at_length(steps),
            false => witnesses(steps),
        }
    }
}

fn formatting(steps: &mut Steps) {
    steps.lint("formatting", || {
        require("fmt", "rustfmt")?;
        FORMATTED.iter().try_for_each(|manifest| {
            run_cargo(cargo(&["fmt", "--manifest-path", manifest, "--all", "--check"]))
        })
    });
}

fn on_host(steps: &mut Steps, runs: impl Fn(Part) -> bool) {
    if runs(Part::Host) {
        steps.group("host", &[&HOST[..], &PAGES].concat(), |steps| {
            clippy(steps);
            tests(steps);
            documentation(steps);
        });
    }
    if runs(Part::NoStd) {
        steps.group("the kernel without std", &["kernel", "tests/no_std"], no_std::run);
    }
    if runs(Part::Python) {
        steps.group("Python", &PYTHON, python::run);
    }
}

/// Clippy, on what the tests build.
pub fn clippy(steps: &mut Steps) {
    steps.lint("clippy", || {
        require("clippy", "clippy")?;
        let words = ["clippy", "--release", "--workspace", "--all-targets", "--locked"];
        let mut command = cargo(&words);
        command.args(["--", "-D", "warnings"]);
        run_cargo(command)
    });
}

fn documentation(steps: &mut Steps) {
    steps.lint("documentation", || {
        let mut doc = cargo(&["doc", "--release", "--workspace", "--no-deps", "--locked"]);
        doc.env("RUSTDOCFLAGS", "-D warnings");
        run_cargo(doc)
    });
}

/// All tests as the program is built; those of the kernel with debug assertions and checks of overflow.
fn tests(steps: &mut Steps) {
    let built = |words: &[&str]| {
        let mut command = cargo(&["test", "--release", "--workspace", "--locked"]);
        let others = KERNEL.iter().chain(&[python::PACKAGE]);
        command.args(others.flat_map(|package| ["--exclude", package]));
        command.args(words);
        command
    };
    let checked = |words: &[&str]| {
        let mut command = of_kernel(cargo(&["test", "--locked"]));
        command.args(words);
        command
    };
    steps.compile("tests, built", || run_cargo(built(&["--no-run"])));
    steps.compile("tests of the kernel, built", || run_cargo(checked(&["--no-run"])));
    let (mut told, is_whole) = (seen::emptied(), steps.is_whole());
    for (name, command) in [
        ("tests", built(&["--no-fail-fast"])),
        ("tests of the kernel, overflow checked", checked(&["--no-fail-fast"])),
    ] {
        steps.step(name, || {
            std::mem::replace(&mut told, Ok(()))?;
            let mut command = seen::told(command);
            if is_whole {
                // `tests/tolerances` tells how many cases are tried without it.
                command.env("SIGNORINI_WHOLE", "1");
            }
            Ok(counted_by(command))
        });
    }
    seen::run(steps);
}

fn on_boards(steps: &mut Steps) {
    setup::run(steps);
    steps.check_once("tools for C", ensure_for_c);
    steps.group("boards", &BOARDS, |steps| {
        modules::bake_all(steps);
        firmware::check(steps);
        size::run(steps);
        c::run(steps);
        audit::run(steps);
        cross::run(steps);
        boards::run(steps);
        cost::run(steps);
        logs::run(steps);
        firmware::check_worst(steps);
        let is_whole = steps.is_whole();
        steps.check("each module was baked once", || modules::baked_once(is_whole));
    });
}

/// The steps that need not run each time.
fn at_length(steps: &mut Steps) {
    fuzz::check(steps);
    sanitize::run(steps);
    mutants::verify(steps);
    ranks::run(steps);
    osqp::check(steps);
    oldest::run(steps);
    results::run(steps);
    package::run(steps);
    installs::run(steps);
}

/// A small part of each of them. Others stand among the tests above: hostile bytes (fuzzing), a campaign's parts in one rank (MPI),
/// results that meshio reads (PyVista). Of OSQP the lock file is checked.
fn witnesses(steps: &mut Steps) {
    sanitize::witness(steps);
    mutants::witness(steps);
    oldest::witness(steps);
    package::run(steps);
    installs::witness(steps);
    steps.lint("packages apart: their lock files are whole", || {
        [fuzz::MANIFEST, osqp::MANIFEST, mutants::MANIFEST].iter().try_for_each(|manifest| {
            let words =
                ["tree", "--quiet", "--locked", "--depth", "0", "--manifest-path", manifest];
            run_cargo(cargo(&words))
        })
    });
}

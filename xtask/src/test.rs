//! `cargo xtask test`: everything that must hold, in the order in which it is cheap to find out.

use crate::counted::counted_by;
use crate::steps::{Steps, Tally};
use crate::{
    audit, boards, c, cost, cross, firmware, fuzz, imports, mutants, no_std, oldest, osqp, python,
    ranks, results, sanitize, seen, size,
};
use signorini_image::cargo::{cargo, require, run as run_cargo};

/// Formatting, clippy, tests, ranks of MPI, documentation, the kernel without std, the images.
pub fn run(steps: &mut Steps) {
    steps.check("formatting", || {
        require("fmt", "rustfmt")?;
        run_cargo(cargo(&["fmt", "--all", "--check"]))
    });
    steps.check("formatting, tests/no_std", || {
        require("fmt", "rustfmt")?;
        run_cargo(cargo(&["fmt", "--manifest-path", no_std::MANIFEST, "--check"]))
    });
    steps.check("clippy", || {
        require("clippy", "clippy")?;
        let what = ["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"];
        run_cargo(cargo(&what))
    });
    imports::run(steps);
    steps.step("tests", || {
        let all = cargo(&["test", "--workspace", "--locked", "--no-fail-fast"]);
        match seen::told(all) {
            Ok(all) => counted_by(all),
            Err(why) => (Tally { passed: 0, failed: 1 }, Some(why)),
        }
    });
    seen::run(steps);
    mutants::verify(steps);
    ranks::run(steps);
    steps.check("documentation", || {
        let mut doc = cargo(&["doc", "--workspace", "--no-deps", "--locked"]);
        doc.env("RUSTDOCFLAGS", "-D warnings");
        run_cargo(doc)
    });
    results::run(steps);
    python::run(steps);
    oldest::run(steps);
    no_std::run(steps);
    sanitize::run(steps);
    osqp::check(steps);
    steps.check("formatting, tests/fuzz", || {
        run_cargo(cargo(&["fmt", "--manifest-path", fuzz::MANIFEST, "--check"]))
    });
    fuzz::check(steps);
    steps.check("formatting, tests/firmware", || {
        run_cargo(cargo(&[
            "fmt",
            "--manifest-path",
            "tests/firmware/Cargo.toml",
            "--all",
            "--check",
        ]))
    });
    cross::run(steps);
    boards::run(steps);
    firmware::check(steps);
    firmware::check_worst(steps);
    c::run(steps);
    audit::run(steps);
    size::run(steps);
    cost::run(steps);
}

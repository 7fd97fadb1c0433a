//! `cargo xtask no-std`: the kernel needs neither std nor an allocator, shown by a link for the host
//! on a plain stable toolchain, and shown to fail where it should.
//!
//! `tests/no_std` holds every stage of the kernel as machine code. Rustc refuses to build it as soon
//! as a dependency links std (a second panic handler) or alloc (nobody brings an allocator). Where a
//! dependency brings an allocator of its own, the names in the archive tell. Features of that crate
//! stand for the three; `extern crate std`, `extern crate alloc` in the kernel itself and nalgebra with
//! its feature `alloc` have been tried as well, and each fails the first step.

use std::process::Command;

use crate::audit::kinds::{ALLOCATOR, free_of};
use crate::caught::caught;
use crate::crates::{DEVICE, of_kernel};
use crate::steps::Steps;
use signorini_image::cargo::{cargo, run as run_cargo, target_dir};
use signorini_image::objects::symbols;
use signorini_image::toolchain::output;

/// The crate that links the kernel.
pub const MANIFEST: &str = "tests/no_std/Cargo.toml";

/// The functions that stand for the kernel in both scalars: without them the archive shows nothing.
const ENTRIES: [&str; 2] = ["force_f32_u16", "force_f64_u32"];

/// Ways of breaking it, with the feature for each, and what is said then.
const BREACHES: [(&str, &str, &str); 3] = [
    ("std", "broken-std", "panic_impl"),
    ("alloc", "broken-alloc", "no global memory allocator"),
    ("an allocator", "broken-allocator", "__rust_alloc"),
];

/// The kernel as it is, then each way of breaking it.
pub fn run(steps: &mut Steps) {
    steps.check("kernel without std and allocator", || {
        run_cargo(build(None))?;
        inspect()
    });
    steps.check("the kernel of a condensed scene needs libm alone", || {
        let tree = ["tree", "--package", DEVICE, "--no-default-features"];
        let mut command = cargo(&tree);
        let said = output(command.args(["--edges", "normal", "--prefix", "none", "--locked"]))?;
        let names = said.lines().filter_map(|line| line.split(' ').next());
        let mut others: Vec<_> = names.filter(|name| !name.starts_with("signorini-")).collect();
        others.dedup();
        match others[..] {
            ["libm"] => Ok(()),
            ref others => Err(format!("it needs {}", others.join(", "))),
        }
    });
    steps.lint("no warning whatever the kernel leaves out", || {
        ["", "mesh", "triangles", "quads,contact", "workspace", "micromath"].iter().try_for_each(
            |of| {
                let words = ["clippy", "--release", "--locked", "--no-default-features"];
                let mut command = cargo(&words);
                command.args(["--package", DEVICE]);
                command.args(["--features", of, "--", "-D", "warnings"]);
                run_cargo(command)
            },
        )
    });
    let is_whole = steps.is_whole();
    steps.lint("the kernel's pages without a warning", || {
        let sets = [&["--all-features"][..], &["--no-default-features"], &[]];
        sets[..if is_whole { 3 } else { 1 }].iter().try_for_each(|features| {
            let mut doc = of_kernel(cargo(&["doc", "--release", "--no-deps", "--locked"]));
            doc.args(*features).env("RUSTDOCFLAGS", "-D warnings");
            run_cargo(doc)
        })
    });
    for (what, feature, reason) in BREACHES {
        steps.check(&format!("a kernel with {what} is caught"), || {
            caught(output(&mut build(Some(feature))).and_then(|_| inspect()), &[reason])
        });
    }
}

fn build(feature: Option<&str>) -> Command {
    let mut command = cargo(&["build", "--locked", "--manifest-path", MANIFEST, "--target-dir"]);
    command.arg(target_dir("no_std"));
    if let Some(feature) = feature {
        command.args(["--features", feature]);
    }
    command
}

/// `Err` where the archive lacks the kernel or has anything to do with an allocator.
fn inspect() -> Result<(), String> {
    let names = symbols("", &target_dir("no_std").join("debug/libsignorini_no_std.a"))?;
    let names: Vec<String> = names.into_iter().map(|symbol| symbol.name).collect();
    // Some object formats put an underscore before every name.
    let holds = |entry| names.iter().any(|name| name.trim_start_matches('_') == entry);
    match ENTRIES.into_iter().find(|entry| !holds(*entry)) {
        Some(entry) => Err(format!("the archive has no `{entry}`")),
        None => free_of(&names, &[ALLOCATOR]),
    }
}

//! `cargo xtask sanitize`: tests of the kernel under AddressSanitizer, for the one file with `unsafe` code.
//!
//! A sweep reads u by offsets without a test (`psor`). Compiled with the sanitizer, a test ends at the first access
//! outside of an array on the heap or the stack. The flag is not stable: `RUSTC_BOOTSTRAP` lets a stable compiler take
//! it, for this build alone. Std comes as it is, without; the kernel has none of it, and the allocator of the tests
//! is the sanitizer's. What it cannot see is an offset that is wrong and still inside of u: the tests see that.
//!
//! Ticks on damaged states are among the tests: of what a state holds nothing may lead outside of it (`flags`, `OwnedRows`).
//!
//! Offsets of `Rows` made too large by hand end each of the tests, at the line of `psor` that reads there.

use std::io::Write as _;
use std::process::{Command, Stdio};

use crate::counted::counted_by;
use crate::crates::of_kernel;
use crate::steps::Steps;
use signorini_image::cargo::{cargo, target_dir};
use signorini_image::files;
use signorini_image::toolchain::host;

/// Whole solves and ticks in both scalars, with short and long indices; ticks on states with wrong bits.
const TESTS: [&str; 4] = ["replay::", "exact::", "tick::", "damaged::"];
/// Reads one number behind an array.
const OUTSIDE: &str = "
fn main() {
    let numbers = vec![1_u32; std::env::args().count()];
    std::process::exit(unsafe { *numbers.as_ptr().add(numbers.len()) } as i32 & 1);
}
";
const FLAG: &str = "-Zsanitizer=address";

/// Shows that the toolchain has a sanitizer that catches anything.
pub fn witness(steps: &mut Steps) {
    steps.check("a number behind an array is caught", caught);
}

/// The sanitizer, then the tests.
pub fn run(steps: &mut Steps) {
    witness(steps);
    steps.step("sweeps stay inside of u", || Ok(counted_by(tests()?)));
}

fn caught() -> Result<(), String> {
    let program = files::folder(&target_dir("sanitize"))?.join("outside");
    let mut compiler = Command::new("rustc");
    compiler.args([FLAG, "--edition", "2024", "-", "-o"]).arg(&program);
    compiler.env("RUSTC_BOOTSTRAP", "1").stdin(Stdio::piped());
    let mut compiler = compiler.spawn().map_err(|error| format!("rustc: {error}"))?;
    if let Some(mut text) = compiler.stdin.take() {
        text.write_all(OUTSIDE.as_bytes()).map_err(|error| format!("rustc: {error}"))?;
    }
    let status = compiler.wait().map_err(|error| format!("rustc: {error}"))?;
    if !status.success() {
        return Err(format!("no AddressSanitizer in this toolchain: rustc {FLAG}: {status}"));
    }
    let ran = Command::new(&program).output().map_err(|error| error.to_string())?;
    let said = String::from_utf8_lossy(&ran.stderr);
    if said.contains("heap-buffer-overflow") { Ok(()) } else { Err("not caught".to_owned()) }
}

fn tests() -> Result<Command, String> {
    let mut command = of_kernel(cargo(&["test", "--locked", "--no-fail-fast", "--test", "main"]));
    // With a target of its own, programs that run while it builds stay as they are.
    command.arg("--target").arg(host()?).arg("--target-dir").arg(target_dir("sanitize"));
    command.arg("--").args(TESTS);
    command.env("RUSTC_BOOTSTRAP", "1").env("RUSTFLAGS", FLAG);
    Ok(command)
}

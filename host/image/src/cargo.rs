//! Runs cargo at the root of the repository, with the toolchain that runs this program.

use std::env;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

pub use crate::checkout::root;

/// Where builds of a workspace apart from the main one go.
pub fn target_dir(workspace: &str) -> PathBuf {
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
    root().join(target).join(workspace)
}

/// `cargo` with these words.
pub fn cargo(words: &[&str]) -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(words).current_dir(root());
    command
}

/// Milliseconds that builds of programs for boards and desks took.
static BUILDING: AtomicU64 = AtomicU64::new(0);

/// The time that all calls of [`build`] took.
pub fn building() -> Duration {
    Duration::from_millis(BUILDING.load(Ordering::Relaxed))
}

/// Runs `command`, which compiles, with its output in sight or not.
///
/// # Errors
/// It does not start, or fails.
pub fn build(command: Command, is_quiet: bool) -> Result<(), String> {
    let start = Instant::now();
    let built = if is_quiet { run_quietly(command) } else { run(command) };
    let took = u64::try_from(start.elapsed().as_millis()).unwrap_or(u64::MAX);
    BUILDING.fetch_add(took, Ordering::Relaxed);
    built
}

/// Runs `command` with its output in sight.
///
/// # Errors
/// It does not start, or fails.
pub fn run(mut command: Command) -> Result<(), String> {
    let status = command.status().map_err(|error| not_started(&command, &error))?;
    verdict(status)
}

/// Runs `command` with its output out of sight; an error ends with the first error that it told, or else with what it said last.
///
/// # Errors
/// It does not start, or fails.
pub fn run_quietly(mut command: Command) -> Result<(), String> {
    let ran = command.stdin(Stdio::null()).output();
    let ran = ran.map_err(|error| not_started(&command, &error))?;
    let said = String::from_utf8_lossy(&ran.stderr);
    let mut lines = said.lines().map(str::trim).filter(|line| !line.is_empty());
    let first = lines.clone().find(|line| line.starts_with("error"));
    let why = first.or_else(|| lines.next_back()).unwrap_or_default();
    verdict(ran.status).map_err(|status| format!("{status}: {why}"))
}

/// Runs `command` with its output in sight, and hands each line of its standard output on.
///
/// # Errors
/// It does not start, or fails.
pub fn run_with_lines(mut command: Command, mut each: impl FnMut(&str)) -> Result<(), String> {
    let child = command.stdout(Stdio::piped()).spawn();
    let mut child = child.map_err(|error| not_started(&command, &error))?;
    for line in child.stdout.take().into_iter().flat_map(|pipe| BufReader::new(pipe).split(b'\n')) {
        let line = line.map_err(|error| error.to_string())?;
        let line = String::from_utf8_lossy(&line);
        println!("{line}");
        each(&line);
    }
    verdict(child.wait().map_err(|error| error.to_string())?)
}

/// `Err` with the line to run where a subcommand of cargo is not installed.
///
/// # Errors
/// That line.
pub fn require(subcommand: &str, component: &str) -> Result<(), String> {
    let probe = cargo(&[subcommand, "--version"]).output();
    if probe.is_ok_and(|output| output.status.success()) {
        return Ok(());
    }
    Err(format!("cargo {subcommand} is missing; run `rustup component add {component}`"))
}

fn not_started(command: &Command, error: &std::io::Error) -> String {
    format!("{} did not start: {error}", command.get_program().display())
}

fn verdict(status: ExitStatus) -> Result<(), String> {
    if status.success() { Ok(()) } else { Err(status.to_string()) }
}

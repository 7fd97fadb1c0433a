//! The tests of the tree: built once, with what each of them reaches and how long it takes.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde::Deserialize;

use crate::error::{Result, failed};
use crate::shared::each;

/// The crates of the kernel, with the tests that judge: those that need the host would take minutes to build, and kill
/// no more.
pub const PACKAGES: [&str; 4] =
    ["signorini-kernel", "signorini-bound", "signorini-contact", "signorini-device"];
/// A test that takes longer judges nothing.
const SLOWEST: Duration = Duration::from_secs(10);
/// Bytes of memory, in units of 1024.
const MEMORY: &str = "ulimit -v 6000000; exec \"$0\" \"$@\"";

#[derive(Deserialize)]
struct Artifact {
    executable: Option<PathBuf>,
    manifest_path: Option<PathBuf>,
    profile: Option<Profile>,
}

#[derive(Deserialize)]
struct Profile {
    test: bool,
}

/// A test of a program.
#[derive(Debug, Clone)]
pub struct Test {
    program: PathBuf,
    folder: PathBuf,
    pub name: String,
    /// The mutants that it comes past.
    pub reached: BTreeSet<u32>,
    pub takes: Duration,
}

/// How a run of a test ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    Passed,
    Failed,
    TimedOut,
}

/// Builds and measures; the fastest test is the first.
pub fn suite(tree: &Path, target: &Path, workers: usize) -> Result<Vec<Test>> {
    let tests = list(tree, target)?;
    let measured = each(&tests, workers, |worker, test| {
        measure(test, &target.join(format!("reached-{worker}")))
    })?;
    let mut measured: Vec<Test> = measured.into_iter().flatten().collect();
    measured.sort_by_key(|test| test.takes);
    Ok(measured)
}

fn list(tree: &Path, target: &Path) -> Result<Vec<Test>> {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(["test", "--no-run", "--locked", "--lib", "--tests", "--message-format", "json"]);
    command.args(PACKAGES.iter().flat_map(|package| ["--package", package]));
    let output = command.arg("--target-dir").arg(target).current_dir(tree);
    let output = output.stderr(Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err(failed("the tests do not compile with switches in the kernel"));
    }
    let mut tests = Vec::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(Artifact { executable: Some(program), manifest_path: Some(manifest), profile }) =
            serde_json::from_str(line)
        else {
            continue;
        };
        if !profile.is_some_and(|profile| profile.test) {
            continue;
        }
        let folder = manifest.parent().unwrap_or(tree).to_owned();
        let listed = Command::new(&program).args(["--list", "--format", "terse"]).output()?;
        for line in String::from_utf8_lossy(&listed.stdout).lines() {
            let Some(name) = line.strip_suffix(": test") else { continue };
            let (program, folder, name) = (program.clone(), folder.clone(), name.to_owned());
            let (reached, takes) = (BTreeSet::new(), SLOWEST);
            tests.push(Test { program, folder, name, reached, takes });
        }
    }
    Ok(tests)
}

/// The test with what it reaches; nothing where it reaches no mutant or is too slow.
fn measure(test: &Test, file: &Path) -> Result<Option<Test>> {
    let start = Instant::now();
    match test.run(0, None, SLOWEST)? {
        Ended::Passed => {}
        Ended::Failed => return Err(failed(format!("{} fails without a mutant", test.name))),
        Ended::TimedOut => {
            eprintln!("{} takes too long", test.name);
            return Ok(None);
        }
    }
    let takes = start.elapsed();
    let _ = fs::remove_file(file);
    if test.run(0, Some(file), 20 * SLOWEST)? != Ended::Passed {
        return Err(failed(format!("{} fails while it is watched", test.name)));
    }
    let Ok(text) = fs::read_to_string(file) else { return Ok(None) };
    let reached = text.lines().filter_map(|line| line.parse().ok()).collect();
    Ok(Some(Test { reached, takes, ..test.clone() }))
}

impl Test {
    /// Runs it with a mutant, or with 0 for none, or to see what it reaches.
    pub fn run(&self, mutant: u32, reached: Option<&Path>, limit: Duration) -> Result<Ended> {
        let mut command = Command::new("sh");
        command.args(["-c", MEMORY]).arg(&self.program).args(["--exact", &self.name]);
        command.args(["--test-threads", "1", "--quiet"]).current_dir(&self.folder);
        match reached {
            Some(file) => command.env("MUTANTS_REACHED", file),
            None => command.env("MUTANT", mutant.to_string()),
        };
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn()?;
        let (start, mut pause) = (Instant::now(), Duration::from_micros(500));
        loop {
            if let Some(status) = child.try_wait()? {
                return Ok(if status.success() { Ended::Passed } else { Ended::Failed });
            }
            if start.elapsed() > limit {
                child.kill()?;
                child.wait()?;
                return Ok(Ended::TimedOut);
            }
            std::thread::sleep(pause);
            pause = (pause * 3 / 2).min(Duration::from_millis(50));
        }
    }
}

//! OSQP, an operator-splitting method in C, in a process of its own that counts its own cycles.
//!
//! Its build needs cmake, so it is no dependency: `cargo xtask osqp` builds `tests/osqp` where this program
//! runs inside a checkout. One line of JSON hands the problem over, then one line asks for each solve and
//! one answers:
//! ```text
//!   → {"matrix": {"starts", "rows", "values"}, "constraints": the same, "ticks": [{"cost", "least"}, …]}
//!   → {"tick", "cold", "tolerance", "manner"}
//!   ← {"cycles", "iterations", "z" or null}
//! ```
//! The problem is a [`Program`].

use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, OnceLock};
use std::thread;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::json;

use super::failed;
use super::quadratic::{Program, Quadratic};
use super::series::{InitialGuess, Run, TimedSolver};
use crate::checkout::root;
use crate::cycles::IS_WIDE;
use signorini_scene::Result;

/// The program, built once a run; `Err` in one line why it cannot be had.
pub(super) fn program() -> std::result::Result<&'static Path, &'static str> {
    static PROGRAM: OnceLock<std::result::Result<PathBuf, String>> = OnceLock::new();
    let program = PROGRAM.get_or_init(build).as_ref();
    program.map(PathBuf::as_path).map_err(String::as_str)
}

fn build() -> std::result::Result<PathBuf, String> {
    let root = root().map_err(|error| format!("OSQP is left out: {error}"))?;
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["xtask", "osqp"]).current_dir(root).stdin(Stdio::null());
    // The registers of the kernel that it is compared with.
    command.args(IS_WIDE.then_some("--wide"));
    let output = command.output().map_err(|error| format!("OSQP is left out: cargo: {error}"))?;
    let last = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes);
        text.lines().rfind(|line| !line.trim().is_empty()).unwrap_or("nothing said").to_owned()
    };
    if !output.status.success() {
        return Err(format!("OSQP is left out: cargo xtask osqp: {}", last(&output.stderr)));
    }
    Ok(PathBuf::from(last(&output.stdout)))
}

/// How OSQP is set; see the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Manner {
    Defaults,
    /// With the loosest tolerance that will do, looked at every 5 iterations.
    Watched,
    /// The loosest tolerance that will do, looked at after every iteration.
    Eager,
    /// Looked at every 5 iterations, and the answer solved again on the bounds found active.
    Polished,
}

#[derive(Deserialize)]
struct OsqpAnswer {
    cycles: f64,
    iterations: u32,
    /// `None` where it has none.
    z: Option<Vec<f64>>,
}

/// Longer than any answer takes by a factor of thousands (the longest in the record is 0.06 s): a program silent that long hangs.
pub(super) const LIMIT: Duration = Duration::from_secs(300);

/// The solver on its problem, until it is dropped.
pub(super) struct Osqp {
    manner: Manner,
    limit: Duration,
    /// How many entries of z are u.
    unknowns: usize,
    child: Mutex<Child>,
    questions: BufWriter<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Osqp {
    /// Starts the program with a limit for the time that a problem or an answer may take.
    pub fn new(
        program: &Path,
        quadratic: &Quadratic,
        manner: Manner,
        limit: Duration,
    ) -> Result<Self> {
        let mut command = Command::new(program);
        let mut child =
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().map_err(failed)?;
        let (Some(questions), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(failed("OSQP's process has no pipes"));
        };
        let (questions, answers) = (BufWriter::new(questions), BufReader::new(answers));
        let (unknowns, child) = (quadratic.matrix.order(), Mutex::new(child));
        let mut osqp = Self { manner, limit, unknowns, child, questions, answers };
        let all = Program::new(quadratic)?;
        let data = |tick| json!({"cost": all.cost(tick), "least": all.least(tick)});
        let ticks: Vec<_> = quadratic.ticks.iter().map(data).collect();
        let (matrix, constraints) = (&all.matrix, &all.constraints);
        let problem = json!({"matrix": matrix, "constraints": constraints, "ticks": ticks});
        within(limit, &osqp.child, || say(&mut osqp.questions, &problem))?;
        Ok(osqp)
    }
}

fn say(to: &mut impl Write, what: &impl Serialize) -> Result<()> {
    serde_json::to_writer(&mut *to, what).map_err(failed)?;
    writeln!(to).and_then(|()| to.flush()).map_err(failed)
}

/// Returns the result of `work` on the pipes of `child`. A process that keeps it waiting beyond `limit` is killed, which ends
/// both reading and writing.
fn within<T>(limit: Duration, child: &Mutex<Child>, work: impl FnOnce() -> Result<T>) -> Result<T> {
    let (done, waiting) = channel::<()>();
    let watch = move || {
        let is_late = waiting.recv_timeout(limit) == Err(RecvTimeoutError::Timeout);
        if let (true, Ok(mut child)) = (is_late, child.lock()) {
            let _ = child.kill();
        }
        is_late
    };
    thread::scope(|scope| {
        let watch = scope.spawn(watch);
        let result = work();
        drop(done);
        match watch.join() {
            Ok(true) => Err(failed(format!(
                "OSQP was stopped: it was silent for {} s",
                limit.as_secs_f64()
            ))),
            _ => result,
        }
    })
}

impl TimedSolver for Osqp {
    fn run(&mut self, tick: usize, start: InitialGuess, tolerance: f64) -> Result<Run> {
        let (cold, manner) = (start == InitialGuess::Cold, self.manner);
        let (questions, answers) = (&mut self.questions, &mut self.answers);
        let line = within(self.limit, &self.child, || {
            let asked =
                json!({"tick": tick, "cold": cold, "tolerance": tolerance, "manner": manner});
            say(questions, &asked)?;
            let mut line = String::new();
            answers.read_line(&mut line).map(|_| line).map_err(failed)
        })?;
        let OsqpAnswer { cycles, iterations, z } =
            serde_json::from_str(&line).map_err(|error| failed(format!("OSQP: {error}")))?;
        let mut u = z.ok_or_else(|| failed(format!("no answer after {iterations} iterations")))?;
        u.truncate(self.unknowns);
        Ok(Run { cycles, iterations, u })
    }

    fn finest(&self) -> i32 {
        if self.manner == Manner::Defaults { -1 } else { -10 }
    }
}

impl Drop for Osqp {
    /// Ends the process: no answer is waited for any more.
    fn drop(&mut self) {
        if let Ok(child) = self.child.get_mut() {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::PermissionsExt;

    use super::super::tests::full;
    use super::*;
    use crate::trade::tests::scene;
    use signorini_problem::Problem;
    use signorini_scene::mesh::structured::{Cells, grid};

    /// The error of a process that runs this script instead of OSQP.
    fn ended(script: &str, limit: Duration) -> String {
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join("osqp");
        std::fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
        std::fs::set_permissions(&program, PermissionsExt::from_mode(0o755)).unwrap();
        let scene = scene("catalogue/moving-tri");
        let problem = Problem::new(&scene, grid(16, Cells::Triangles)).unwrap();
        let (full, _) = full(&problem, 1);
        let run = Osqp::new(&program, &full, Manner::Watched, limit)
            .and_then(|mut osqp| osqp.run(0, InitialGuess::Cold, 1e-3));
        run.unwrap_err().to_string()
    }

    #[test]
    fn a_process_that_hangs_is_stopped_and_said() {
        let short = Duration::from_millis(200);
        // It never reads the problem, which is larger than a pipe; it reads all and never answers.
        for script in ["exec sleep 600", "cat > /dev/null; sleep 1"] {
            let why = ended(script, short);
            assert!(why.contains("stopped") && why.contains("0.2 s"), "{script}: {why}");
        }
    }

    #[test]
    fn a_process_that_ends_is_not_waited_for() {
        let why = ended("exit 1", Duration::from_secs(600));
        assert!(why.contains("baseline failed") && !why.contains("stopped"), "{why}");
    }
}

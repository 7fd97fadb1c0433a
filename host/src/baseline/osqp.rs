//! OSQP, an operator-splitting method in C, in a process of its own that counts its own cycles.
//!
//! Its build needs cmake, so it is no dependency: `cargo xtask osqp` builds `tests/osqp` where this program
//! runs inside a checkout. One line of JSON hands the problem over, then one line asks for each solve and
//! one answers:
//! ```text
//!   → {"starts", "rows", "values", "contact", "ticks": [{"load", "lower"}, …]}
//!   → {"tick", "cold", "tolerance", "manner"}
//!   ← {"cycles", "iterations", "u" or null}
//! ```

use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use super::contest::{Contestant, Run, Start};
use super::failed;
use super::quadratic::Quadratic;
use crate::error::Result;

/// The program, built once a run; `Err` in one line why it cannot be had.
pub(super) fn program() -> std::result::Result<&'static Path, &'static str> {
    static PROGRAM: OnceLock<std::result::Result<PathBuf, String>> = OnceLock::new();
    let program = PROGRAM.get_or_init(build).as_ref();
    program.map(PathBuf::as_path).map_err(String::as_str)
}

fn build() -> std::result::Result<PathBuf, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let root = root.filter(|root| root.join("tests/osqp/Cargo.toml").exists());
    let root = root.ok_or("OSQP is left out: this program runs outside of its checkout")?;
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["xtask", "osqp"]).current_dir(root).stdin(Stdio::null());
    if cfg!(target_arch = "x86_64") {
        // The features of the kernel that it is compared with, whatever the environment says today.
        let is_wide = cfg!(all(target_feature = "avx2", target_feature = "fma"));
        command.env("RUSTFLAGS", if is_wide { "-C target-feature=+avx2,+fma" } else { "" });
    }
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

#[derive(Serialize)]
struct Data<'a> {
    load: &'a [f64],
    lower: &'a [f64],
}

#[derive(Serialize)]
struct Problem<'a> {
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
    contact: usize,
    ticks: Vec<Data<'a>>,
}

#[derive(Serialize)]
struct Question {
    tick: usize,
    cold: bool,
    tolerance: f64,
    manner: Manner,
}

/// How OSQP is set; see the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Manner {
    /// As it comes.
    Defaults,
    /// With the loosest tolerance that will do, looked at every 5 iterations.
    Watched,
    /// The same, looked at after every iteration.
    Eager,
    /// Looked at every 5 iterations, and the answer solved again on the bounds found active.
    Polished,
}

#[derive(Deserialize)]
struct Answer {
    cycles: f64,
    iterations: u32,
    /// `None` where it has none.
    u: Option<Vec<f64>>,
}

/// The solver on its problem, until it is dropped.
pub(super) struct Osqp {
    manner: Manner,
    child: Child,
    questions: BufWriter<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Osqp {
    pub fn new(program: &Path, quadratic: &Quadratic, manner: Manner) -> Result<Self> {
        let mut command = Command::new(program);
        let mut child =
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().map_err(failed)?;
        let (Some(questions), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(failed("OSQP's process has no pipes"));
        };
        let (questions, answers) = (BufWriter::new(questions), BufReader::new(answers));
        let mut osqp = Self { manner, child, questions, answers };
        let (starts, rows, values) = quadratic.matrix.upper();
        let ticks = quadratic.ticks.iter();
        let ticks = ticks.map(|tick| Data { load: &tick.load, lower: &tick.lower }).collect();
        osqp.say(&Problem { starts, rows, values, contact: quadratic.contact(), ticks })?;
        Ok(osqp)
    }

    fn say(&mut self, what: &impl Serialize) -> Result<()> {
        serde_json::to_writer(&mut self.questions, what).map_err(failed)?;
        writeln!(self.questions).and_then(|()| self.questions.flush()).map_err(failed)
    }
}

impl Contestant for Osqp {
    fn run(&mut self, tick: usize, start: Start, tolerance: f64) -> Result<Run> {
        let (cold, manner) = (start == Start::Cold, self.manner);
        self.say(&Question { tick, cold, tolerance, manner })?;
        let mut line = String::new();
        self.answers.read_line(&mut line).map_err(failed)?;
        let Answer { cycles, iterations, u } =
            serde_json::from_str(&line).map_err(|error| failed(format!("OSQP: {error}")))?;
        let u = u.ok_or_else(|| failed(format!("no answer after {iterations} iterations")))?;
        Ok(Run { cycles, iterations, u })
    }

    fn finest(&self) -> i32 {
        if self.manner == Manner::Defaults { -1 } else { -10 }
    }
}

impl Drop for Osqp {
    /// Nobody waits for an answer any more.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

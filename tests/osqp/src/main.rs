//! OSQP on the problems that `signorini` sends, timed here by the same counter: one line of JSON with
//! the problem, then a line for each solve. `host/lab/src/baseline/osqp.rs` has the other end.
//!
//! minimise ½ zᵀPz + qᵀz over Cz ≥ r. Cold: set up and solved; warm: new q and r go
//! into the workspace, and it starts from its last answer. Settings are OSQP's own but for the tolerance,
//! the number of iterations, and a look every 5 of them or after each, so that it need not go on when it is done.

use std::io::{BufRead, Write};

use osqp::{CscMatrix, Problem, Settings};
use serde::{Deserialize, Serialize};

#[path = "../../../host/lab/src/cycles.rs"]
#[allow(dead_code)]
mod cycles;

/// Iterations after which it is given up.
const MOST: u32 = 50_000;
/// OSQP's infinity.
const INFINITY: f64 = 1e30;

/// q and r.
#[derive(Deserialize)]
struct Tick {
    cost: Vec<f64>,
    least: Vec<f64>,
}

/// A matrix by columns.
#[derive(Deserialize)]
struct Columns {
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

/// The upper triangle of P, and C.
#[derive(Deserialize)]
struct Given {
    matrix: Columns,
    constraints: Columns,
    ticks: Vec<Tick>,
}

#[derive(Deserialize)]
struct Question {
    tick: usize,
    cold: bool,
    tolerance: f64,
    manner: Manner,
}

/// How OSQP is set.
#[derive(Deserialize, Clone, Copy, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Manner {
    /// OSQP as it comes; the tolerance has no say.
    Defaults,
    /// A look at the tolerance every 5 iterations, not 25, and steps adapted by iterations,
    /// not by the clock: the same every time.
    Watched,
    /// A look at the tolerance after every iteration.
    Eager,
    /// Every 5 iterations, and the answer solved again on the bounds found active.
    Polished,
}

#[derive(Serialize)]
struct Answer {
    cycles: u64,
    iterations: u32,
    /// `None` where it has none.
    z: Option<Vec<f64>>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut lines = std::io::stdin().lock().lines();
    let Some(first) = lines.next() else { return Err("no problem given".into()) };
    let given: Given = serde_json::from_str(&first?)?;
    let mut workspace = None;
    for line in lines {
        let question: Question = serde_json::from_str(&line?)?;
        let answer = solve(&given, &question, &mut workspace)?;
        println!("{}", serde_json::to_string(&answer)?);
        std::io::stdout().flush()?;
    }
    Ok(())
}

fn solve(
    given: &Given,
    question: &Question,
    workspace: &mut Option<Problem>,
) -> Result<Answer, Box<dyn std::error::Error>> {
    let tick = given.ticks.get(question.tick).ok_or("no such tick")?;
    let (cycles, iterations, z) = match workspace.take().filter(|_| !question.cold) {
        Some(mut kept) => {
            let start = cycles::now();
            kept.update_lin_cost(&tick.cost);
            kept.update_lower_bound(&tick.least);
            let answer = run(&mut kept, start);
            *workspace = Some(kept);
            answer
        }
        None => {
            let count = tick.least.len();
            let matrix = columns(&given.matrix, tick.cost.len());
            let constraints = columns(&given.constraints, count);
            let upper = vec![INFINITY; count];
            let settings = settings(question);
            let start = cycles::now();
            let mut fresh =
                Problem::new(matrix, &tick.cost, constraints, &tick.least, &upper, &settings)?;
            let answer = run(&mut fresh, start);
            *workspace = Some(fresh);
            answer
        }
    };
    Ok(Answer { cycles, iterations, z })
}

fn run(problem: &mut Problem, start: u64) -> (u64, u32, Option<Vec<f64>>) {
    let status = problem.solve();
    let cycles = cycles::now().saturating_sub(start);
    let z = match &status {
        osqp::Status::Solved(solution)
        | osqp::Status::SolvedInaccurate(solution)
        | osqp::Status::MaxIterationsReached(solution) => Some(solution.x().to_vec()),
        _ => None,
    };
    (cycles, status.iter(), z)
}

fn settings(question: &Question) -> Settings {
    let settings = Settings::default().verbose(false);
    if question.manner == Manner::Defaults {
        return settings;
    }
    settings
        .eps_abs(question.tolerance)
        .eps_rel(question.tolerance)
        .max_iter(MOST)
        .check_termination(Some(if question.manner == Manner::Eager { 1 } else { 5 }))
        .adaptive_rho_interval(Some(25))
        .polish(question.manner == Manner::Polished)
}

/// A matrix of so many rows as OSQP takes it.
fn columns(given: &Columns, rows: usize) -> CscMatrix<'_> {
    CscMatrix {
        nrows: rows,
        ncols: given.starts.len() - 1,
        indptr: (&given.starts).into(),
        indices: (&given.rows).into(),
        data: (&given.values).into(),
    }
}

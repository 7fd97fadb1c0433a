//! OSQP on the problems that `signorini` sends, timed here by the same counter: one line of JSON with
//! the problem, then a line for each solve. `host/lab/src/baseline/osqp.rs` has the other end.
//!
//! minimise ½ uᵀPu − bᵀu over u ≥ ψ on the last unknowns. Cold: set up and solved; warm: new b and ψ go
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
/// What OSQP takes for infinity.
const INFINITY: f64 = 1e30;

#[derive(Deserialize)]
struct Tick {
    load: Vec<f64>,
    lower: Vec<f64>,
}

/// P by columns of its upper triangle; bounds act on the last `contact` unknowns.
#[derive(Deserialize)]
struct Problem {
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
    contact: usize,
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
    /// As it comes; the tolerance has no say.
    Defaults,
    /// It looks every 5 iterations, not 25, whether the tolerance is met, and adapts its step by iterations,
    /// not by the clock: the same every time.
    Watched,
    /// The same, after every iteration.
    Eager,
    /// Every 5 iterations, and the answer solved again on the bounds found active.
    Polished,
}

#[derive(Serialize)]
struct Answer {
    cycles: u64,
    iterations: u32,
    /// `None` where it has none.
    u: Option<Vec<f64>>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut lines = std::io::stdin().lock().lines();
    let Some(first) = lines.next() else { return Err("no problem given".into()) };
    let given: Problem = serde_json::from_str(&first?)?;
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
    given: &Problem,
    question: &Question,
    workspace: &mut Option<Problem>,
) -> Result<Answer, Box<dyn std::error::Error>> {
    let tick = given.ticks.get(question.tick).ok_or("no such tick")?;
    let cost: Vec<f64> = tick.load.iter().map(|b| -b).collect();
    let (cycles, iterations, u) = match workspace.take().filter(|_| !question.cold) {
        Some(mut kept) => {
            let start = cycles::now();
            kept.update_lin_cost(&cost);
            kept.update_lower_bound(&tick.lower);
            let answer = run(&mut kept, start);
            *workspace = Some(kept);
            answer
        }
        None => {
            let (matrix, constraints) = (matrix(given), constraints(given));
            let upper = vec![INFINITY; given.contact];
            let settings = settings(question);
            let start = cycles::now();
            let mut fresh =
                Problem::new(matrix, &cost, constraints, &tick.lower, &upper, &settings)?;
            let answer = run(&mut fresh, start);
            *workspace = Some(fresh);
            answer
        }
    };
    Ok(Answer { cycles, iterations, u })
}

fn run(problem: &mut Problem, start: u64) -> (u64, u32, Option<Vec<f64>>) {
    let status = problem.solve();
    let cycles = cycles::now().saturating_sub(start);
    let u = match &status {
        osqp::Status::Solved(solution)
        | osqp::Status::SolvedInaccurate(solution)
        | osqp::Status::MaxIterationsReached(solution) => Some(solution.x().to_vec()),
        _ => None,
    };
    (cycles, status.iter(), u)
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

fn matrix(given: &Problem) -> CscMatrix<'_> {
    let n = given.starts.len() - 1;
    CscMatrix {
        nrows: n,
        ncols: n,
        indptr: (&given.starts).into(),
        indices: (&given.rows).into(),
        data: (&given.values).into(),
    }
}

/// One row a bound: 1 on its unknown.
fn constraints(given: &Problem) -> CscMatrix<'static> {
    let n = given.starts.len() - 1;
    let free = n - given.contact;
    CscMatrix {
        nrows: given.contact,
        ncols: n,
        indptr: (0..=n).map(|column| column.saturating_sub(free)).collect(),
        indices: (0..given.contact).collect(),
        data: vec![1.0; given.contact].into(),
    }
}

//! All solvers on problems whose fluxes have limits: answers are those of the kernel's solve, and of each other.

use crate::trade::tests::problem;
use signorini_scene::Result;
use signorini_solve::{Options, SolverKind, solve};
use signorini_tolerances::lab::{CLARABEL_LIMITED, PIVOTING_LIMITED};

use super::super::benchmark::Benchmark;
use super::super::clarabel::Clarabel;
use super::super::condensed::condensed;
use super::super::discretisation_error;
use super::super::load_case::load_cases;
use super::super::quadratic::{Matrix, Program, Quadratic, QuadraticLoads};
use super::super::series::{InitialGuess, TimedSolver};
use super::full;

/// The unknowns one by one, relative to the largest.
fn check(name: &str, found: &[f64], u: &[f64]) {
    assert_eq!(found.len(), u.len(), "{name}");
    let size = u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
    for (at, (found, u)) in found.iter().zip(u).enumerate() {
        CLARABEL_LIMITED.check(format_args!("{name} {at}"), (found - u) / size);
    }
}

#[test]
fn clarabel_agrees_where_fluxes_have_limits() -> Result<()> {
    for name in ["limits/l-tri", "limits/l-quad", "scenes/antiicing"] {
        let problem = problem(name);
        let (full, factor) = full(&problem, 0);
        let solution =
            solve(&problem, &Options { solver: SolverKind::Kernel, ..Options::default() })?;
        let u = &solution.u[..full.matrix.order()];
        let states: Vec<_> = u[full.free()..].iter().zip(&full.ticks[0].lower).collect();
        assert!(
            states.iter().any(|(u, gap)| u < gap) && states.iter().any(|(u, gap)| u > gap),
            "{name}"
        );
        check(name, &full.answers[0], u);
        check(name, &Clarabel::new(&full)?.run(0, InitialGuess::Cold, 1e-12)?.u, u);
        let (condensed, _) = condensed(&problem, &full, &factor)?;
        let found = Clarabel::new(&condensed)?.run(0, InitialGuess::Cold, 1e-12)?.u;
        check(name, &found, &condensed.answers[0]);
    }
    Ok(())
}

/// Answers are compared inside, as on small grids; the last scene has no limits.
#[test]
fn all_solvers_follow_limits_from_tick_to_tick() -> Result<()> {
    for name in ["limits/l-tri", "scenes/antiicing", "scenes/strip"] {
        let (problem, mut notes) = (problem(name), Vec::new());
        let moments = load_cases(&problem, 3)?;
        let (full, _) = full(&problem, 3);
        let size = full.distance(0, &vec![0.0; full.matrix.order()]);
        let error = discretisation_error(&problem, &mut notes)?;
        let found = Benchmark::new(&problem, &moments, error).hold(&mut notes)?;
        assert!(found.iter().all(|b| b.algebraic_error <= b.target), "{name}: {found:?}");
        // Sweeps in two scalars, each with two ω, the active set with and without its factor, Clarabel; and condensed
        // Clarabel and exchanges in two scalars: all of them cold and warm.
        assert_eq!(found.len(), 2 * 10, "{name}: {found:?}");
        assert!(notes.iter().all(|note| note.starts_with("condensing")), "{name}: {notes:?}");
        let exact = found.iter().filter(|b| b.solver == "kernel pivoting f64");
        exact.for_each(|b| PIVOTING_LIMITED.check_over(name, b.algebraic_error, size));
    }
    Ok(())
}

/// K = (2, −1; −1, 2) with both unknowns in contact.
fn small(spans: [f64; 2]) -> Result<Quadratic> {
    let mut matrix = Matrix::new();
    matrix.push([(0, 2.0), (1, -1.0)]);
    matrix.push([(0, -1.0), (1, 2.0)]);
    let tick = QuadraticLoads::new(vec![-3.0, 1.0], vec![0.0, -1.0], spans.to_vec());
    Ok(Quadratic::new(matrix, Vec::new(), vec![tick])?.0)
}

#[test]
fn a_slack_stands_where_there_is_a_limit() -> Result<()> {
    let quadratic = small([1.5, f64::NEG_INFINITY])?;
    let program = Program::new(&quadratic)?;
    // u₁ + s ≥ 0,  −u₂ ≥ 1,  s ≥ 0.
    assert_eq!(program.constraints.row_ptr, [0, 1, 2, 4]);
    assert_eq!(program.constraints.col_idx, [0, 1, 0, 2]);
    assert_eq!(program.constraints.values, [1.0, -1.0, 1.0, 1.0]);
    assert_eq!(program.matrix.row_ptr, [0, 1, 3, 3]);
    let tick = &quadratic.ticks[0];
    assert_eq!(program.cost(tick), [3.0, -1.0, 1.5]);
    assert_eq!(program.least(tick), [0.0, 1.0, 0.0]);
    // At its limit 2u₁ − u₂ = −3 + 1.5; the other one touches, with λ₂ = 1.25 − 2 − 1 < 0.
    assert_eq!(quadratic.answers[0], [-1.25, -1.0]);
    Ok(())
}

#[test]
fn a_limit_in_the_load_changes_ends() -> Result<()> {
    // b₁ = −3 with −1.5 to the other end is b₁ = −4.5 with 1.5.
    let tick = &small([-1.5, 0.0])?.ticks[0];
    assert_eq!((&tick.load[..], &tick.spans[..]), (&[-4.5, 1.0][..], &[1.5, 0.0][..]));
    // A given flux has neither row nor slack.
    assert_eq!(Program::new(&small([-1.5, 0.0])?)?.count, 2);
    Ok(())
}

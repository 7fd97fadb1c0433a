//! Input that has no answer is named, never a panic.

use super::stencil::{Side, Stencil, crouzeix_raviart};
use crate::{Factor, Problem, ReferenceError};

fn two_by_two(off_diagonal: f64) -> Stencil {
    let rows = [vec![(0, 1.0), (1, off_diagonal)], vec![(1, 1.0), (0, off_diagonal)]];
    Stencil::from_rows(&rows, vec![1.0, 1.0], vec![0.0])
}

fn refusal(problem: &Problem) -> ReferenceError {
    let outcome = Factor::new(problem)
        .and_then(|factor| factor.solve_between(problem.load, problem.lower, &[], None).map(drop));
    outcome.expect_err("must be refused")
}

#[test]
fn arrays_that_do_not_fit() {
    let stencil = two_by_two(0.5);
    let good = stencil.problem();
    let bad = [
        Problem { row_ptr: &[], ..good },
        Problem { row_ptr: &[0, 3, 2], ..good },
        Problem { row_ptr: &[1, 2, 4], ..good },
        Problem { row_ptr: &[0, 2, 5], ..good },
        Problem { col_idx: &[0, 1, 1, 2], ..good },
        Problem { values: &[1.0], ..good },
        Problem { lower: &[0.0; 3], ..good },
        Problem { floating: &[true, false], ..good },
    ];
    for problem in bad {
        assert!(matches!(refusal(&problem), ReferenceError::Malformed(_)), "{problem:?}");
    }
    let factor = Factor::new(&good).expect("definite");
    for (load, lower, guess) in [(1, 1, 1), (2, 2, 1), (2, 1, 0)] {
        let guess = vec![true; guess];
        let outcome = factor.solve_between(&vec![1.0; load], &vec![0.0; lower], &[], Some(&guess));
        assert!(matches!(outcome, Err(ReferenceError::Malformed(_))));
    }
}

#[test]
fn entries_that_are_not_finite() {
    let mut stencil = two_by_two(f64::NAN);
    assert_eq!(
        refusal(&stencil.problem()),
        ReferenceError::NotFinite { array: "values", index: 1 }
    );
    stencil = two_by_two(0.5);
    stencil.load[1] = f64::INFINITY;
    assert_eq!(refusal(&stencil.problem()), ReferenceError::NotFinite { array: "load", index: 1 });
    stencil = two_by_two(0.5);
    stencil.lower[0] = f64::NEG_INFINITY;
    assert_eq!(refusal(&stencil.problem()), ReferenceError::NotFinite { array: "lower", index: 0 });
    stencil = two_by_two(0.5);
    stencil.values.iter_mut().for_each(|value| *value *= 1e-200);
    stencil.load.fill(1e200);
    assert!(matches!(
        refusal(&stencil.problem()),
        ReferenceError::NotFinite { array: "solution", .. }
    ));
}

#[test]
fn matrices_that_are_not_definite() {
    let mut stencil = two_by_two(0.5);
    stencil.values[0] = -1.0;
    assert_eq!(refusal(&stencil.problem()), ReferenceError::NotPositiveDefinite { unknown: 0 });
    let indefinite = two_by_two(1.25);
    assert_eq!(refusal(&indefinite.problem()), ReferenceError::NotPositiveDefinite { unknown: 1 });
}

#[test]
fn contact_beyond_a_dense_matrix() {
    let n = 20_000;
    let rows: Vec<_> = (0..n).map(|i| vec![(i, 1.0)]).collect();
    let stencil = Stencil::from_rows(&rows, vec![0.0; n as usize], vec![0.0; n as usize]);
    let error = refusal(&stencil.problem());
    assert!(matches!(error, ReferenceError::TooManyContacts { contact: 20_000, .. }), "{error}");
}

/// Nothing holds these squares and nothing touches them: K is singular, to rounding.
#[test]
fn square_that_nothing_holds() {
    for cells in [1, 5, 20, 33] {
        let place = |i: usize, j: usize| [i as f64, j as f64 + 0.3 * i as f64];
        let stencil = crouzeix_raviart(
            cells,
            [Side::Neumann; 4],
            place,
            |_, _| 1.3,
            |x, y| x - y,
            |_, _| 0.0,
        );
        let error = refusal(&stencil.problem());
        let named = matches!(
            error,
            ReferenceError::Singular { .. } | ReferenceError::NotPositiveDefinite { .. }
        );
        assert!(named, "{cells}: {error}");
    }
}

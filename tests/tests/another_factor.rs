//! The exact solver on two springs, by the factor of this matrix or of another: what is a solution, and what only looks
//! like one.

use crate::factored;
use signorini_device::sparse::Solved;
use signorini_kernel::Error;
use signorini_kernel::csr::Csr;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{EdgeCounts, Edges};
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::system::System;
use signorini_solve::by_factor::SolveSummary;
use signorini_tolerances::kernel::SOLVED as ON_PAPER;

/// A free knot, one in contact and one held at 0, each joined to both others.
const COUNTS: EdgeCounts = EdgeCounts { free: 1, contact: 1, dirichlet: 1 };

/// A matrix [[a, −1], [−1, 2]] of the knots that are not held, by its first entry, times a factor.
#[derive(Clone, Copy)]
struct Springs {
    first: f64,
    times: f64,
}

impl Springs {
    const PLAIN: Self = Self { first: 2.0, times: 1.0 };

    /// Entries by rows, the diagonal first.
    fn values(self) -> [f64; 6] {
        [self.first, -1.0, -1.0, 2.0, -1.0, -1.0].map(|entry| self.times * entry)
    }
}

/// Solves [[2, −1], [−1, 2]] u = `load` above 0 from `u`, by the factor of `other`.
fn solve(other: Springs, load: [f64; 2], u: &mut [f64; 3]) -> Result<SolveSummary<f64>, Error> {
    let (pointers, columns) = ([0, 3, 6], [0_u16, 1, 2, 1, 0, 2]);
    let (own, values) = (Springs::PLAIN.values(), other.values());
    let system =
        System::new(Csr::new(&pointers, &columns, &own, 3)?, &load, Law::above(&[0.0]), COUNTS)?;
    let matrix = Csr::new(&pointers, &columns, &values, 3)?;
    let nothing = Boundary::new(&Edges::baked(&[], &[], &[], COUNTS), &[], &[], &[])?;
    let diagonal = DiagonalTerms::new(&nothing);
    let settings = Settings::default();
    let found = factored::solve(&matrix, &system, diagonal, &settings, &[0], u, &mut [0.0; 3])?;
    Ok(found.expect("an answer")[0])
}

/// A factor of 10⁴ K moves u by a ten-thousandth of what is asked, which looks like the last digits. One of 1.9 K halves what
/// is left in each round, not more: after the last round it is 1e−5 of u.
#[test]
fn a_small_correction_is_no_solution_by_itself() -> Result<(), Error> {
    // u = (1, 0) is pressed with −1 + 1 − 3.
    for (times, start) in [(1e4, 1.001), (1e6, 1.001), (1e9, 1.001), (1.9, 0.0)] {
        let mut u = [start, 0.0, 0.0];
        let found = solve(Springs { times, ..Springs::PLAIN }, [2.0, -4.0], &mut u)?;
        assert_eq!(found.status, Status::Stalled, "{times:e}: {found:?} {u:?}");
    }
    let mut u = [1.001, 0.0, 0.0];
    let found = solve(Springs::PLAIN, [2.0, -4.0], &mut u)?;
    assert_eq!((found.status, u), (Status::Converged, [1.0, 0.0, 0.0]));
    Ok(())
}

/// From 0 the other factor sees u = 2.01/2.02, which pulls the contact edge less than the load 1 presses it. The answer of
/// this matrix is (4.02 − 1, 2.01 − 2)/3: it opens.
#[test]
fn an_edge_that_opens_on_the_way_is_noticed() -> Result<(), Error> {
    let mut u = [0.0; 3];
    let found = solve(Springs { first: 2.02, times: 1.0 }, [2.01, -1.0], &mut u)?;
    for (u, exact) in u.iter().zip([3.02 / 3.0, 0.01 / 3.0]) {
        ON_PAPER.check(format_args!("{found:?}"), u - exact);
    }
    assert!(found.pivots == 1 && found.rounds > 4, "{found:?}");
    Ok(())
}

/// The other way round: 1.99/1.98 pulls more than 1, and by corrections the edge sinks below its gap. u stays within the
/// law whatever the factor, but the free knot has followed an edge that was open: (1.98/2, 0) is not reached.
#[test]
fn an_edge_that_closes_on_the_way_is_put_on_its_gap_and_is_no_solution() -> Result<(), Error> {
    for first in [1.98, 1.95, 1.9] {
        let mut u = [0.0; 3];
        let load = [1.0 + first / 2.0, -1.0];
        let found = solve(Springs { first, times: 1.0 }, load, &mut u)?;
        assert_eq!((found.pivots, u[1], found.residual.active), (1, 0.0, 1), "{found:?} {u:?}");
        assert_eq!(found.status, Status::Stalled, "{first}: {found:?} {u:?}");
    }
    Ok(())
}

/// A first step of more than 16 times the answer is made once more; u = (1, 0) and all steps are exact here.
#[test]
fn a_far_start_is_made_once_more() -> Result<(), Error> {
    for (start, rounds) in [(1.0, 2), (9.0, 2), (17.0, 2), (18.0, 3), (33.0, 3), (1025.0, 3)] {
        let mut u = [start, 0.0, 0.0];
        let found = solve(Springs::PLAIN, [2.0, -4.0], &mut u)?;
        assert_eq!((found.rounds, u), (rounds, [1.0, 0.0, 0.0]), "{start}: {found:?}");
    }
    Ok(())
}

#[test]
fn corrections_tell_by_how_much_they_shrink() {
    let solved = |first: f64, change: f64| Solved { pivots: 0, rounds: 2, change, first };
    for (first, change, contracts) in [
        (1.0, 1.0 / 64.0, true),
        (1.0, 1.0 / 63.0, false),
        (16.0, 0.25, true),
        (16.5, 0.0, false),
        (1e-9, 1e-11, true),
        (1e-9, 1e-10, false),
        (0.0, 0.0, true),
        (1.0, f64::INFINITY, false),
        (f64::NAN, 0.0, false),
    ] {
        assert_eq!(solved(first, change).contracts(), contracts, "{first} {change}");
    }
    let ran_out = Solved { rounds: 16, ..solved(1.0, 0.0) };
    assert!(!ran_out.contracts() && Solved { rounds: 15, ..ran_out }.contracts());
    for (change, has_digits) in
        [(0.0, true), (1.0 / 1024.0, true), (1.0 / 1023.0, false), (f64::INFINITY, false)]
    {
        assert_eq!(solved(1.0, change).has_digits(), has_digits, "{change}");
    }
}

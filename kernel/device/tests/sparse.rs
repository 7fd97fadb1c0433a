//! Elimination on chains of springs, whose Schur complements are known: springs in a row add their compliances.

use crate::ldlt::Ldlt;
use signorini_contact::dense::blocks::Block;
use signorini_kernel::Error;
use signorini_kernel::csr::Csr;
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_tolerances::kernel::{CANCELLED, SCHUR};

/// Rows of the matrix of springs (a, b, stiffness) between n knots, the diagonal first.
fn springs(n: usize, springs: &[(u16, u16, f64)]) -> (Vec<u32>, Vec<u16>, Vec<f64>) {
    let (mut row_ptr, mut col_idx, mut values) = (vec![0], Vec::new(), Vec::new());
    for knot in 0..n as u16 {
        let own = springs.iter().filter(|(a, b, _)| *a == knot || *b == knot);
        col_idx.push(knot);
        values.push(own.clone().map(|(_, _, k)| k).sum());
        for &(a, b, k) in own {
            col_idx.push(if a == knot { b } else { a });
            values.push(-k);
        }
        row_ptr.push(col_idx.len() as u32);
    }
    (row_ptr, col_idx, values)
}

/// Entries of L and S, for `free` knots eliminated in this order; `None` where a pivot vanishes.
fn eliminate(
    n: usize,
    free: usize,
    all: &[(u16, u16, f64)],
    order: &[u16],
) -> Result<Option<(usize, Block<f64>)>, Error> {
    let (row_ptr, col_idx, values) = springs(n, all);
    let counts = EdgeCounts { free, contact: n - free, dirichlet: 0 };
    let matrix = Csr::new(&row_ptr, &col_idx, &values, n)?;
    Ok(Ldlt::new(&matrix, counts, order)?.map(|ldlt| (ldlt.values.len(), ldlt.schur[0])))
}

/// Knots 0, 1, 2 between the contact knots 3 and 4.
const CHAIN: [(u16, u16, f64); 4] = [(3, 0, 1.0), (0, 1, 2.0), (1, 2, 4.0), (2, 4, 0.5)];

#[test]
fn springs_in_a_row_add_their_compliances() {
    let whole = 1.0 / (1.0 + 0.5 + 0.25 + 2.0);
    for order in [[0, 1, 2], [1, 0, 2], [2, 1, 0], [0, 2, 1], [1, 2, 0], [2, 0, 1]] {
        let (entries, schur) = eliminate(5, 3, &CHAIN, &order).unwrap().expect("a factor");
        let expected = [[whole, -whole], [-whole, whole]];
        for (row, expected) in schur.iter().zip(expected) {
            for (found, expected) in row.iter().zip(expected) {
                SCHUR.check_relative(format_args!("{order:?}: {schur:?}"), *found, expected);
            }
        }
        assert!(schur.iter().flatten().filter(|entry| **entry != 0.0).count() == 4, "padding");
        // Whichever goes first, every knot has two neighbours left.
        assert_eq!(entries, 6, "{order:?}");
    }
}

#[test]
fn orders_that_are_none_are_refused() {
    for order in [[0, 1, 1], [0, 1, 3], [7, 1, 2]] {
        let refused = eliminate(5, 3, &CHAIN, &order);
        assert!(matches!(refused, Err(Error::OutOfRange { .. })), "{order:?}: {refused:?}");
    }
    assert!(matches!(eliminate(5, 3, &CHAIN, &[0, 1]), Err(Error::Length { .. })));
}

#[test]
fn knots_that_nothing_holds_have_no_factor() {
    let loose = [(3, 0, 1.0), (1, 2, 4.0), (0, 4, 0.5)];
    for order in [[0, 1, 2], [2, 1, 0]] {
        let found = eliminate(5, 3, &loose, &order).unwrap();
        assert!(found.is_none(), "{order:?}: {found:?}");
    }
}

#[test]
fn a_spring_a_trillion_times_softer_keeps_its_digits() {
    let chain = [(3, 0, 1e12), (0, 1, 1e12), (1, 2, 1e12), (2, 4, 1.0)];
    let expected = 1.0 / (1.0 + 3e-12);
    for order in [[0, 1, 2], [2, 1, 0], [1, 0, 2]] {
        let (_, schur) = eliminate(5, 3, &chain, &order).unwrap().expect("a factor");
        // Knot 4 sees its own spring; knot 3 sees a difference of large ones.
        SCHUR.check(format_args!("{order:?}"), schur[1][1] - expected);
        CANCELLED.check(format_args!("{order:?}"), schur[0][1] + expected);
    }
}

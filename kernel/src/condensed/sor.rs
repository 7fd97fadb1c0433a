//! Projected successive over-relaxation on the condensed problem, four rows at a time.
//!
//! ```text
//!   x_i ← max(0, x_i + ω (b_i − Σ_j S_ij x_j)),      S_ii = 1
//! ```
//! All products of a panel are formed with the old x; then its own four are relaxed one after the other,
//! each change being brought to the rows below it. That is Gauss–Seidel, exactly, in another order of
//! the sums.

use super::panels::{Panels, ROWS};
use crate::error::{Array, Error, same_length};
use crate::real::Real;

/// One sweep. Returns the largest |min(x_i, r_i)| that it met, r = Sx − b: how far from
/// complementarity x was, NaN where anything is.
///
/// # Errors
/// Arrays of the wrong length.
#[inline(never)]
pub fn sweep<R: Real>(
    matrix: &Panels<R>,
    load: &[R],
    omega: R,
    x: &mut [R],
) -> Result<R, Error> {
    same_length(Array::Load, load.len(), matrix.order())?;
    same_length(Array::Unknowns, x.len(), matrix.order())?;
    let mut largest = R::ZERO;
    for (number, (panel, load)) in matrix.iter().zip(load.chunks(ROWS)).enumerate() {
        let mut product = products(panel, x);
        let first = ROWS * number;
        let own = x.iter_mut().skip(first).zip(panel.iter().skip(first));
        for (row, ((x, column), &load)) in own.zip(load).enumerate() {
            let Some(&sum) = product.get(row) else { break };
            let residual = sum - load;
            let defect = if *x < residual { *x } else { residual };
            // Written so that a NaN is taken over and then stays.
            if !(defect.magnitude() <= largest) {
                largest = defect.magnitude();
            }
            let relaxed = *x - omega * residual;
            let next = if relaxed > R::ZERO { relaxed } else { R::ZERO };
            let change = next - *x;
            *x = next;
            // Rows above are done with: what is added to their products is not read again.
            product.iter_mut().zip(column).for_each(|(product, &entry)| *product += entry * change);
        }
    }
    Ok(largest)
}

/// Σ_j S_ij x_j for the rows of a panel.
#[inline(always)]
fn products<R: Real>(panel: &[[R; ROWS]], x: &[R]) -> [R; ROWS] {
    let mut sums = [R::ZERO; ROWS];
    for (column, &x) in panel.iter().zip(x) {
        sums.iter_mut().zip(column).for_each(|(sum, &entry)| *sum += entry * x);
    }
    sums
}

//! Inputs with which boundary edges that meet exclude each other's values of u.
//!
//! Where a gap or a Dirichlet value follows inputs without a range, one edge may come to ask for a u that the edge beside it
//! excludes: no function of finite energy satisfies both. The host has found where, and a tick looks at each such place,
//! ```text
//!   Σ_j factor_j · (1, inputs)_j ≤ slack,      row by row: slack, factors
//! ```
//! before anything else: a refused one keeps state and answer.

use signorini_kernel::{Error, Real};

/// `Ok` where the inputs meet every row: `terms` are the constant 1 and the inputs.
///
/// # Errors
/// [`Error::Excluded`] with the number of the first row that is not met, by more than rounding of its terms.
pub fn check<R: Real>(terms: &[R], rows: &[R]) -> Result<(), Error> {
    let is_beyond = |row: &[R]| {
        let Some((&slack, factors)) = row.split_first() else { return false };
        let parts = || factors.iter().zip(terms).map(|(&factor, &term)| factor * term);
        let sum = parts().fold(R::ZERO, |sum, part| sum + part);
        let size = parts().fold(R::ZERO, |size, part| size + part.magnitude());
        let hidden = R::from_count(terms.len() as u32 + 4) * R::EPSILON * size;
        // An input that is no number is refused for that.
        sum > slack + hidden
    };
    match rows.chunks_exact(terms.len() + 1).position(is_beyond) {
        Some(at) => Err(Error::Excluded { at }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_row_that_is_not_met_is_named() {
        // p ≤ 2 and q − p ≤ 0.1
        let rows = [0.0, -2.0, 1.0, 0.0, 0.1_f32, 0.0, -1.0, 1.0];
        let tried = |p, q| check(&[1.0, p, q], &rows);
        assert_eq!((tried(2.0, 2.1), tried(-5.0, -5.0)), (Ok(()), Ok(())));
        assert_eq!(tried(2.000_01, 9.0), Err(Error::Excluded { at: 0 }));
        assert_eq!(tried(1.0, 1.101), Err(Error::Excluded { at: 1 }));
        assert_eq!((tried(f32::NAN, 0.0), check(&[1.0, 7.0], &[])), (Ok(()), Ok(())));
    }
}

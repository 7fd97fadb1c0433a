//! How large vectors are, and how large a load may be.
//!
//! ```text
//!   ‖x‖ = √Σ x_i²         where these squares neither overflow nor vanish
//!         Σ |x_i|         elsewhere, for short code: at most √n times as large
//! ```
//! A threshold that is drawn from a size holds nothing back once it is infinite, and lets nothing pass once it is
//! 0 by underflow: sizes stay right over the whole range of the scalar.
//!
//! An x may be larger than the load that it answers by 1/(64 ε) at most: no matrix that this scalar holds has
//! such an answer. So whoever refuses loads within n/ε of the largest number refuses them before anything changes.

use super::blocks::{SIDE, groups};
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error};
use signorini_kernel::index::read;

/// An answer may be larger than the load by 1/(this many ε).
const ABSURD: u32 = 64;

/// Σ x_i², padded
#[inline(never)]
fn square<R: Real>(x: &[R]) -> R {
    let mut sums = [R::ZERO; SIDE];
    for group in groups(x) {
        sums.iter_mut().zip(group).for_each(|(sum, &x)| *sum += x * x);
    }
    total(sums)
}

/// ‖x‖, padded; NaN where anything is.
#[inline(never)]
pub fn norm<R: Real>(x: &[R]) -> R {
    root(square(x), x.len(), &|at| read(x, at))
}

/// The root of the sum of r_i² over the edges that are open, or should be.
pub(crate) fn unbalanced<R: Real>(residual: &[R], x: &[R]) -> R {
    let wrong = |r: R, x: R| if x > R::ZERO { r } else { r.or_smaller(R::ZERO) };
    let entries = residual.iter().zip(x).map(|(&r, &x)| wrong(r, x));
    let sum = entries.fold(R::ZERO, |sum, wrong| sum + wrong * wrong);
    let entry = |at: usize| wrong(read(residual, at), read(x, at));
    root(sum, residual.len().min(x.len()), &entry)
}

/// Norm of `count` numbers.
pub(super) fn norm_of<R: Real>(count: usize, entry: &dyn Fn(usize) -> R) -> R {
    let squares = (0..count).fold(R::ZERO, |sum, at| sum + entry(at) * entry(at));
    root(squares, count, entry)
}

/// The sum of eight numbers.
fn total<R: Real>([a, b, c, d, e, f, g, h]: [R; SIDE]) -> R {
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// √`squares`, which is the sum of the squares of `count` entries.
fn root<R: Real>(squares: R, count: usize, entry: &dyn Fn(usize) -> R) -> R {
    // Below, squares that have underflowed may be more than ε of the sum.
    if squares.finite() && squares >= R::TINY / (R::EPSILON * R::EPSILON) {
        squares.rounded_sqrt()
    } else {
        sum(count, entry)
    }
}

/// Σ|x_i|, at most √n times ‖x‖.
#[cold]
#[inline(never)]
fn sum<R: Real>(count: usize, entry: &dyn Fn(usize) -> R) -> R {
    (0..count).fold(R::ZERO, |sum, at| sum + entry(at).magnitude())
}

/// Whether an answer of this size is none to a load of `own`.
pub(crate) fn is_absurd<R: Real>(size: R, own: R) -> bool {
    !(R::from_count(ABSURD) * R::EPSILON * size <= own)
}

/// The largest ‖x‖ that is not absurd.
pub(crate) fn room<R: Real>(own: R) -> R {
    own / (R::from_count(ABSURD) * R::EPSILON)
}

/// ‖b‖ of a load whose answer, and all on the way there, this scalar can hold.
///
/// # Errors
/// [`Error::NotFinite`] for any other.
pub(crate) fn of_load<R: Real>(load: &[R]) -> Result<R, Error> {
    let own = norm(load);
    let count = R::from_count(load.len() as u32);
    if (own / R::EPSILON * count).finite() {
        return Ok(own);
    }
    let larger = |most: (usize, R), (at, x): (usize, &R)| {
        let stays = x.magnitude() <= most.1 || !(most.1 >= R::ZERO);
        if stays { most } else { (at, x.magnitude()) }
    };
    let (at, _) = load.iter().enumerate().fold((0, R::ZERO), larger);
    Err(Error::NotFinite { of: Array::Load, at })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_hold_over_the_whole_range() {
        for exponent in [-120, -80, -64, -30, 0, 30, 63, 64, 100, 125] {
            let unit = 2f32.powi(exponent);
            let x = [3.0, 0.0, -4.0, 0.0, 0.0, 0.0, 0.0, 12.0].map(|x: f32| x / 16.0 * unit);
            // Where squares are no use, a sum: of three numbers it is at most √3 times as large.
            let is_plain = (-50..64).contains(&exponent);
            let check = |size: f32, exact: f32| {
                let most = if is_plain { exact } else { 1.74 * exact };
                assert!(size >= exact && size <= most, "{exponent}: {size:e} {exact:e}");
            };
            check(norm(&x), 13.0 / 16.0 * unit);
            // An edge that is closed and pressed is no defect, one that is pulled is.
            check(unbalanced(&x, &[0.0; 8]), 0.25 * unit);
            check(unbalanced(&x, &[1.0; 8]), 13.0 / 16.0 * unit);
        }
        assert_eq!((norm(&[0.0; 8]), norm::<f64>(&[])), (0.0, 0.0));
        let mut x = [1.0; 8];
        x[3] = f64::INFINITY;
        assert_eq!(norm(&x), f64::INFINITY);
        x[4] = f64::NAN;
        assert!(norm(&x).is_nan());
    }

    #[test]
    fn loads_at_the_end_of_the_range_are_refused_by_name() {
        let mut load = [1.0_f32; 8];
        assert!(of_load(&load).is_ok_and(|own| own * own == 8.0 || own > 2.8));
        load[5] = 1e30;
        assert_eq!(of_load(&load), Ok(1e30));
        for extreme in [1e38, f32::MAX, f32::INFINITY] {
            load[5] = -extreme;
            assert_eq!(of_load(&load), Err(Error::NotFinite { of: Array::Load, at: 5 }));
        }
        load[5] = f32::NAN;
        assert_eq!(of_load(&load), Err(Error::NotFinite { of: Array::Load, at: 5 }));
        assert!(
            is_absurd(f32::INFINITY, 1.0) && is_absurd(f32::NAN, 1.0) && is_absurd(1e6_f32, 1.0)
        );
        assert!(!is_absurd(1e5, 1.0_f32) && !is_absurd(0.0, 0.0_f32) && is_absurd(1e-9, 0.0_f32));
    }
}

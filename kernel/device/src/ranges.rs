//! The values that the inputs of a baked scene may have.
//!
//! What was worked out beforehand, such as edges that never change sides, holds for these and no others: a tick refuses
//! the rest by number and keeps its last answer. Who would rather have the nearest answer asks for [`clamp`] first.

use signorini_kernel::{Error, Real};

/// `Ok` where every value lies within its range \[lo, hi\]; NaN lies in none.
///
/// # Errors
/// [`Error::InputOutOfRange`] with the number of the first that does not.
pub fn check<R: Real>(values: &[R], ranges: &[[R; 2]]) -> Result<(), Error> {
    let is_outside = |(&value, &[lo, hi]): (&R, &[R; 2])| !(lo <= value && value <= hi);
    match values.iter().zip(ranges).position(is_outside) {
        Some(input) => Err(Error::InputOutOfRange { input }),
        None => Ok(()),
    }
}

/// The nearest value of a range; NaN stays what it is, and is refused.
pub fn clamp<R: Real>(value: R, [lo, hi]: [R; 2]) -> R {
    if value < lo {
        lo
    } else if value > hi {
        hi
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGES: [[f32; 2]; 3] = [[-1.0, 2.0], [f32::NEG_INFINITY, f32::INFINITY], [0.0, 0.0]];

    #[test]
    fn the_first_input_outside_its_range_is_named() {
        let tried = |values: [f32; 3]| check(&values, &RANGES);
        let refused = |input| Err(Error::InputOutOfRange { input });
        assert_eq!(tried([-1.0, 1e30, 0.0]), Ok(()));
        assert_eq!(tried([2.0, -1e30, -0.0]), Ok(()));
        assert_eq!(tried([2.0000002, 0.0, 1.0]), refused(0));
        assert_eq!(tried([-1.0000001, 0.0, 0.0]), refused(0));
        assert_eq!(tried([f32::NAN, 0.0, 0.0]), refused(0));
        assert_eq!(tried([0.0, f32::NAN, 0.0]), refused(1));
        assert_eq!(tried([0.0, 0.0, 1e-45]), refused(2));
    }

    #[test]
    fn the_nearest_value_is_taken() {
        let nearest = |value: f32| clamp(value, RANGES[0]);
        assert_eq!([-7.0, -1.0, 0.5, 2.0, 1e9].map(nearest), [-1.0, -1.0, 0.5, 2.0, 2.0]);
        assert!(nearest(f32::NAN).is_nan());
    }
}

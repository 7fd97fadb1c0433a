//! Each part against dense arithmetic, and the whole against projected relaxation in f64.

mod contact;
mod parts;
mod square;

use signorini_problem::random::Random;
use square::Square;

/// Numbers of (−1, 1).
fn vector(random: &mut Random, length: usize) -> Vec<f64> {
    (0..length).map(|_| random.between(-1.0, 1.0)).collect()
}

//! Stands in for an analogue converter: how much heat the wind takes.

use super::mesh::COLUMNS;

/// Losses in W/m²: from 1500 to 3546, another at every segment and tick, and in one tick of 16 a gust
/// that takes 5000 more from everything behind its front. Xorshift (Marsaglia) makes every run the
/// same.
pub fn read(seed: &mut u32) -> [f32; COLUMNS] {
    let mut next = || {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 17;
        *seed ^= *seed << 5;
        *seed
    };
    let front = if next() % 16 == 0 { next() as usize % COLUMNS } else { COLUMNS };
    core::array::from_fn(|at| {
        let gust = if at < front { 0.0 } else { 5000.0 };
        1500.0 + gust + 2.0 * (next() % 1024) as f32
    })
}

//! Stands in for an analogue converter: how much heat the wind takes.

use crate::plant::COLUMNS;

/// Losses in W/m²: from 1500 to 3546, another at every segment and tick, and in one tick of 64 a gust
/// that takes 2500 more. Xorshift (Marsaglia) makes every run the same.
pub fn read(seed: &mut u32) -> [f32; COLUMNS] {
    let mut next = || {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 17;
        *seed ^= *seed << 5;
        *seed
    };
    let base = if next() % 64 == 0 { 4000.0 } else { 1500.0 };
    [(); COLUMNS].map(|()| base + 2.0 * (next() % 1024) as f32)
}

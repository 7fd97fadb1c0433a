//! Stands in for an analogue converter: how much heat the wind takes.

use signorini_board::draw::Draw;

use super::mesh::COLUMNS;

/// Losses in W/m²: from 1500 to 3546, another at every segment and tick, and in one tick of 16 a gust
/// that takes 5000 more from everything behind its front. Every run has the same.
pub fn read(draw: &mut Draw) -> [f32; COLUMNS] {
    let front = if draw.bits() % 16 == 0 { draw.bits() as usize % COLUMNS } else { COLUMNS };
    core::array::from_fn(|at| {
        let gust = if at < front { 0.0 } else { 5000.0 };
        1500.0 + gust + 2.0 * (draw.bits() % 1024) as f32
    })
}

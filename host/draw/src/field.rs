//! The solution over the plane: u as colour, σ = A∇u as arrows.

use super::ScenePanel;
use super::arrows::arrows;
use super::isobands::Surface;
use super::plane::Plane;
use super::scale::{extent, plain};

/// Bands of colour; more cannot be told apart.
const BANDS: u32 = 64;
/// A range below this part of the values is rounding of f32, not a picture.
const ROUNDING: f64 = 1e-6;

/// A picture with what to say about it.
pub struct Field {
    /// The SVG element.
    pub svg: String,
    /// The |σ| of the longest arrows, and whether an axis is stretched.
    pub notes: Vec<String>,
}

/// The picture of a scene; `None` when its vertices span no area.
pub fn field(panel: &ScenePanel) -> Option<Field> {
    let mut plane = Plane::new(panel, "the solution u over the plane")?;
    let surface = Surface::new(panel, &plane.view, panel.vertex_u.iter().copied());
    if let Some([low, high]) = extent(surface.values()) {
        let visible = high - low > ROUNDING * low.abs().max(high.abs());
        let range = if visible { [low, high] } else { [low, low] };
        plane.bands(range, BANDS, "u", |level| surface.above(level));
    }
    let mut notes: Vec<String> = plane.view.note().into_iter().collect();
    if let Some((path, full)) = arrows(panel, &plane.view) {
        plane.arrows = path;
        notes.insert(0, format!("arrows σ = A∇u, the longest |σ| ≥ {}", plain(full)));
    }
    Some(Field { svg: plane.finish(panel), notes })
}

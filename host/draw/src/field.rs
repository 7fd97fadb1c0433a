//! The scene over the plane: u as colour with σ = A∇u as arrows, and where the error comes from, a colour a cell.

use super::ScenePanel;
use super::arrows::arrows;
use super::isobands::Surface;
use super::plane::Plane;
use super::scale::{extent, plain};
use super::svg::Svg;

/// Bands of colour; more cannot be told apart.
const BANDS: u32 = 64;
/// A range below this part of the values is rounding of f32, not a picture.
const ROUNDING: f64 = 1e-6;

/// Classes of colour of the error's map; each costs outlines.
const CLASSES: u32 = 24;

/// The picture of a scene, with the |σ| of the longest arrows and a note where an axis is stretched; `None` when its
/// vertices span no area.
pub fn field(panel: &ScenePanel) -> Option<(Svg, Vec<String>)> {
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
    Some((plane.finish(panel), notes))
}

/// Where the error comes from: the root of each cell's part of gap². `None` without a bound, or where it is nothing
/// but rounding.
///
/// As with the bands of u, all cells from a level on are one shape, painted over the one before: sides
/// between cells of one colour are not written, and no seams show.
pub fn errors(panel: &ScenePanel) -> Option<String> {
    panel.bound.filter(|bound| bound.gap > bound.rounding)?;
    let mut plane = Plane::new(panel, "what each cell contributes to the error bound")?;
    let cells = Surface::new(panel, &plane.view, panel.vertices.iter().map(|_| 0.0));
    let values: Vec<f64> = panel.indicators.iter().map(|square| square.max(0.0).sqrt()).collect();
    let [_, most] = extent(values.iter().copied())?;
    plane
        .bands([0.0, most], CLASSES, "error", |level| cells.around(|at| is_in(&values, at, level)));
    Some(plane.finish(panel).finish())
}

/// Whether a cell has a value of at least `level`.
fn is_in(values: &[f64], cell: usize, level: f64) -> bool {
    values.get(cell).is_some_and(|&value| value.is_finite() && value >= level)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BoundTerms;
    use crate::plane::View;

    /// Four triangles around the centre of a square, one of them the other way round.
    fn square(indicators: [f64; 4], gap: f64) -> ScenePanel {
        let bound = BoundTerms { total: gap, of_u: gap, gap, ..Default::default() };
        ScenePanel {
            vertices: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]],
            triangles: vec![[0, 1, 4], [2, 1, 4], [2, 3, 4], [3, 0, 4]],
            indicators: indicators.to_vec(),
            bound: Some(bound),
            ..ScenePanel::default()
        }
    }

    #[test]
    fn cells_of_one_class_are_one_shape() {
        let panel = square([1.0, 1.0, 1.0, 4.0], 1.0);
        let view = View::new(&panel.vertices, [0.0, 0.0]).unwrap();
        let cells = Surface::new(&panel, &view, [0.0; 5].into_iter());
        let above = |level| cells.around(|at| is_in(&[1.0, 1.0, 1.0, 2.0], at, level));
        let corners = |level| above(level).iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(corners(0.0), [4]);
        assert_eq!(corners(1.5), [3]);
        assert!(corners(2.5).is_empty());
    }

    #[test]
    fn what_is_not_finite_is_left_out_and_no_bound_has_no_map() {
        let broken = square([1.0, f64::NAN, f64::INFINITY, 4.0], 1.0);
        assert!(errors(&broken).is_some_and(|svg| !svg.contains("NaN") && !svg.contains("inf")));
        assert!(errors(&square([1.0; 4], 0.0)).is_none());
        assert!(errors(&ScenePanel { bound: None, ..square([1.0; 4], 1.0) }).is_none());
    }
}

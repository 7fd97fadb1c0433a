//! Where the error comes from: a colour a cell, for the root of its part of gap².
//!
//! As with the bands of u, all cells from a level on are one shape, painted over the one before: sides
//! between cells of one colour are not written, and no seams show.

use super::ScenePanel;
use super::outline::{Segments, rim};
use super::plane::Plane;
use super::scale::extent;
use super::view::View;

/// Classes of colour; each costs outlines.
const CLASSES: u32 = 24;

/// The map; `None` without a bound, or where it is nothing but rounding.
pub fn mosaic(panel: &ScenePanel) -> Option<String> {
    panel.bound.filter(|bound| bound.gap > bound.rounding)?;
    let mut plane = Plane::new(panel, "what each cell contributes to the error bound")?;
    let tiles = Tiles::new(panel, &plane.view);
    let [_, most] = extent(tiles.values.iter().copied())?;
    plane.bands([0.0, most], CLASSES, "error", |level| tiles.above(level));
    plane.mesh(panel);
    plane.boundary(panel);
    plane.axes();
    Some(plane.svg.finish())
}

/// Cells with their values, in pixels.
struct Tiles {
    points: Vec<[f64; 2]>,
    /// All of the same orientation.
    cells: Vec<Vec<usize>>,
    values: Vec<f64>,
}

impl Tiles {
    /// Leaves out cells at which something is not finite or missing.
    fn new(panel: &ScenePanel, view: &View) -> Self {
        let points: Vec<_> = panel.vertices.iter().map(|&vertex| view.at(vertex)).collect();
        let cells = panel.triangles.iter().map(|cell| cell.as_slice());
        let cells = cells.chain(panel.quads.iter().map(|cell| cell.as_slice()));
        let known = |cell: &[u32]| {
            let of = |&vertex: &u32| points.get(vertex as usize);
            cell.iter().all(|vertex| of(vertex).is_some_and(|p| p.iter().all(|x| x.is_finite())))
        };
        let mut tiles = Self { points: Vec::new(), cells: Vec::new(), values: Vec::new() };
        for (cell, &square) in cells.zip(&panel.indicators) {
            if square.is_finite() && known(cell) {
                tiles.cells.push(oriented(cell, &points));
                tiles.values.push(square.max(0.0).sqrt());
            }
        }
        tiles.points = points;
        tiles
    }

    /// The outlines of all cells whose value is at least `level`.
    fn above(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        let cells = self.cells.iter().zip(&self.values).filter(|&(_, value)| *value >= level);
        let mut segments = Segments::default();
        for [a, b] in rim(cells.map(|(cell, _)| cell.as_slice())) {
            segments.add([a, a], [b, b]);
        }
        segments.outlines(|[vertex, _]| self.points[vertex])
    }
}

/// The corners, clockwise on the screen.
fn oriented(cell: &[u32], points: &[[f64; 2]]) -> Vec<usize> {
    let mut corners: Vec<usize> = cell.iter().map(|&vertex| vertex as usize).collect();
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let turn = |(&a, &b): (&usize, &usize)| {
        let ([x0, y0], [x1, y1]) = (points[a], points[b]);
        x0 * y1 - x1 * y0
    };
    if sides.map(turn).sum::<f64>() < 0.0 {
        corners.reverse();
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BoundTerms;

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
        let tiles = Tiles::new(&panel, &view);
        let corners = |level| tiles.above(level).iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(corners(0.0), [4]);
        assert_eq!(corners(1.5), [3]);
        assert!(corners(2.5).is_empty());
    }

    #[test]
    fn what_is_not_finite_is_left_out_and_no_bound_has_no_map() {
        let broken = square([1.0, f64::NAN, f64::INFINITY, 4.0], 1.0);
        assert!(mosaic(&broken).is_some_and(|svg| !svg.contains("NaN") && !svg.contains("inf")));
        assert!(mosaic(&square([1.0; 4], 0.0)).is_none());
        assert!(mosaic(&ScenePanel { bound: None, ..square([1.0; 4], 1.0) }).is_none());
    }
}

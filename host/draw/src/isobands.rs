//! The colour map of u: for each level the set {u ≥ level}, painted over the one before.
//!
//! On a triangle u is linear, so {u ≥ level} cuts it along a straight line. Crossing all triangles,
//! these lines close up, together with the part of the rim where u ≥ level, to polygons with the
//! set on one side:
//! ```text
//!        c (out)             a, b in, c out: going around a → b → c, the set is left on edge bc
//!       ╱ ╲                  and entered again on edge ca, so one directed segment crosses
//!   ca ●───● bc              from bc to ca
//!     ╱ in  ╲
//!    a───────b
//! ```
//! A band of colour is then one shape instead of thousands of pieces, and no seams show between
//! cells. A quad is four triangles around its centre, where u is the mean of its corners.

use super::ScenePanel;
use super::outline::{Node, Segments, crossing, rim};
use super::view::View;

/// u as a piecewise linear function of the pixel.
#[derive(Debug, Default)]
pub struct Surface {
    points: Vec<[f64; 2]>,
    values: Vec<f64>,
    /// All of the same orientation.
    triangles: Vec<[usize; 3]>,
    /// The edges with a triangle on one side only, directed as in their triangle.
    rim: Vec<[usize; 2]>,
}

impl Surface {
    /// Leaves out cells at which something is not finite or missing.
    pub fn new(panel: &ScenePanel, view: &View) -> Self {
        let count = panel.vertices.len().min(panel.vertex_u.len());
        let mut surface = Self {
            points: panel.vertices[..count].iter().map(|&vertex| view.at(vertex)).collect(),
            values: panel.vertex_u[..count].to_vec(),
            ..Self::default()
        };
        for triangle in &panel.triangles {
            surface.push(triangle.map(|vertex| vertex as usize));
        }
        for quad in &panel.quads {
            surface.push_quad(quad.map(|vertex| vertex as usize));
        }
        surface.rim = rim(surface.triangles.iter().map(|cell| cell.as_slice()));
        surface
    }

    /// The values at the corners of all triangles.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        self.triangles.iter().flatten().map(|&vertex| self.values[vertex])
    }

    /// The outlines of {u ≥ level}, holes the other way round.
    pub fn above(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        let inside = |vertex: usize| self.values[vertex] >= level;
        let mut segments = Segments::default();
        for &[a, b, c] in &self.triangles {
            let edges = [[a, b], [b, c], [c, a]];
            let leaves = edges.into_iter().find(|&[p, q]| inside(p) && !inside(q));
            let enters = edges.into_iter().find(|&[p, q]| !inside(p) && inside(q));
            if let (Some(leaves), Some(enters)) = (leaves, enters) {
                segments.add(crossing(leaves), crossing(enters));
            }
        }
        for &[a, b] in &self.rim {
            match (inside(a), inside(b)) {
                (true, true) => segments.add([a, a], [b, b]),
                (true, false) => segments.add([a, a], crossing([a, b])),
                (false, true) => segments.add(crossing([a, b]), [b, b]),
                (false, false) => {}
            }
        }
        segments.outlines(|node| self.point(node, level))
    }

    fn point(&self, [a, b]: Node, level: f64) -> [f64; 2] {
        let (p, q) = (self.points[a], self.points[b]);
        if a == b {
            return p;
        }
        let along = (level - self.values[a]) / (self.values[b] - self.values[a]);
        [p[0] + along * (q[0] - p[0]), p[1] + along * (q[1] - p[1])]
    }

    fn push(&mut self, triangle: [usize; 3]) {
        let known = |&vertex: &usize| {
            let (Some(point), Some(value)) = (self.points.get(vertex), self.values.get(vertex))
            else {
                return false;
            };
            value.is_finite() && point.iter().all(|part| part.is_finite())
        };
        if triangle.iter().all(known) {
            let [a, b, c] = triangle;
            let [p, q, r] = triangle.map(|vertex| self.points[vertex]);
            let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            self.triangles.push(if area < 0.0 { [a, b, c] } else { [a, c, b] });
        }
    }

    fn push_quad(&mut self, quad: [usize; 4]) {
        let count = self.points.len();
        if quad.iter().any(|&vertex| vertex >= count) {
            return;
        }
        let mean = |part: &dyn Fn(usize) -> f64| quad.iter().map(|&v| 0.25 * part(v)).sum::<f64>();
        let centre = [mean(&|v| self.points[v][0]), mean(&|v| self.points[v][1])];
        let value = mean(&|v| self.values[v]);
        self.points.push(centre);
        self.values.push(value);
        for side in 0..4 {
            self.push([quad[side], quad[(side + 1) % 4], count]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::draw::{AREA, ROUND_AREA};

    /// The area that outlines enclose (holes count as negative).
    fn area(outlines: &[Vec<[f64; 2]>]) -> f64 {
        let one = |outline: &Vec<[f64; 2]>| {
            let ends = outline.iter().zip(outline.iter().cycle().skip(1));
            ends.map(|(p, q)| 0.5 * (p[0] * q[1] - p[1] * q[0])).sum::<f64>()
        };
        outlines.iter().map(one).sum::<f64>().abs()
    }

    /// The square (0, 240)² in n × n quads.
    fn square(n: u32, u: impl Fn(f64, f64) -> f64) -> Surface {
        let coordinates = |i: u32| f64::from(i) / f64::from(n);
        let vertices: Vec<[f64; 2]> =
            (0..=n).flat_map(|j| (0..=n).map(move |i| [coordinates(i), coordinates(j)])).collect();
        let corner = |i: u32, j: u32| j * (n + 1) + i;
        let quads = (0..n * n)
            .map(|cell| (cell % n, cell / n))
            .map(|(i, j)| [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)])
            .collect();
        let vertex_u = vertices.iter().map(|&[x, y]| u(x, y)).collect();
        let panel = ScenePanel { vertices, quads, vertex_u, ..ScenePanel::default() };
        let view = View::new(&panel.vertices, [0.0, 0.0]).unwrap();
        Surface::new(&panel, &view)
    }

    #[test]
    fn the_set_above_a_level_has_the_right_area() {
        let whole = 360.0 * 360.0;
        let plane = square(4, |x, _| x);
        AREA.check_over("above 0.3", area(&plane.above(0.3)) - 0.7 * whole, whole);
        AREA.check_over("all of it", area(&plane.above(-1.0)) - whole, whole);
        assert!(plane.above(1.1).is_empty());
    }

    #[test]
    fn holes_are_cut_out() {
        let bowl = square(64, |x, y| (x - 0.5).hypot(y - 0.5));
        let outlines = bowl.above(0.25);
        let expected = 360.0 * 360.0 * (1.0 - std::f64::consts::PI / 16.0);
        assert_eq!(outlines.len(), 2);
        ROUND_AREA.check_over("without a disc", area(&outlines) - expected, expected);
    }

    #[test]
    fn straight_outlines_need_few_points() {
        let outlines = square(50, |x, _| x).above(0.505);
        assert_eq!(outlines.len(), 1);
        assert!(outlines[0].len() <= 6, "{}", outlines[0].len());
    }

    #[test]
    fn a_vertex_that_is_not_finite_takes_its_cells_along() {
        let holed = square(4, |x, y| if x == 0.5 && y == 0.5 { f64::NAN } else { x });
        let whole = 360.0 * 360.0;
        AREA.check_over("with a hole", area(&holed.above(-1.0)) - 0.75 * whole, whole);
        assert!(holed.values().all(f64::is_finite));
    }
}

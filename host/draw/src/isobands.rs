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
use super::outline::{Node, Segments, around, crossing, rim};
use super::plane::View;

/// The cells of a scene as triangles in pixels, with values at their corners.
#[derive(Debug, Default)]
pub struct Surface {
    points: Vec<[f64; 2]>,
    values: Vec<f64>,
    triangles: Vec<Triangle>,
    /// The sides of one triangle alone.
    rim: Vec<[usize; 2]>,
}

/// A triangle, and the cell that it is part of.
#[derive(Debug)]
struct Triangle {
    /// All triangles have the same orientation.
    corners: [usize; 3],
    cell: usize,
}

impl Surface {
    /// The cells with a value at each vertex; those at which something is not finite or missing are left out.
    pub fn new(panel: &ScenePanel, view: &View, values: impl Iterator<Item = f64>) -> Self {
        let (points, values) = panel.vertices.iter().map(|&at| view.at(at)).zip(values).unzip();
        let mut surface = Self { points, values, ..Self::default() };
        let count = surface.points.len();
        for (number, cell) in panel.cells().enumerate() {
            let corners: Vec<usize> = cell.iter().map(|&vertex| vertex as usize).collect();
            match corners[..] {
                _ if corners.iter().any(|&vertex| vertex >= count) => {}
                [a, b, c] => surface.push([a, b, c], number),
                _ => surface.push_around_centre(&corners, number),
            }
        }
        surface.rim = rim(surface.triangles.iter().map(|triangle| triangle.corners));
        surface
    }

    /// The values at the corners of all triangles.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        self.triangles.iter().flat_map(|triangle| triangle.corners.map(|at| self.values[at]))
    }

    /// The outlines of {u ≥ level}, holes the other way round.
    pub fn above(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        let inside = |vertex: usize| self.values[vertex] >= level;
        let mut segments = Segments::default();
        for &Triangle { corners: [a, b, c], .. } in &self.triangles {
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

    /// The outlines of the cells that are `chosen` by number.
    pub fn around(&self, chosen: impl Fn(usize) -> bool) -> Vec<Vec<[f64; 2]>> {
        let inside = self.triangles.iter().filter(|triangle| chosen(triangle.cell));
        around(inside.map(|triangle| triangle.corners), |vertex| self.points[vertex])
    }

    fn point(&self, [a, b]: Node, level: f64) -> [f64; 2] {
        let (p, q) = (self.points[a], self.points[b]);
        if a == b {
            return p;
        }
        let along = (level - self.values[a]) / (self.values[b] - self.values[a]);
        [p[0] + along * (q[0] - p[0]), p[1] + along * (q[1] - p[1])]
    }

    fn push(&mut self, [a, b, c]: [usize; 3], cell: usize) {
        let [p, q, r] = [a, b, c].map(|vertex| self.points[vertex]);
        let values = [a, b, c].map(|vertex| self.values[vertex]);
        if [p, q, r].as_flattened().iter().chain(&values).all(|number| number.is_finite()) {
            let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            let corners = if area < 0.0 { [a, b, c] } else { [a, c, b] };
            self.triangles.push(Triangle { corners, cell });
        }
    }

    fn push_around_centre(&mut self, corners: &[usize], cell: usize) {
        let (centre, share) = (self.points.len(), 1.0 / corners.len() as f64);
        let mean = |part: &dyn Fn(usize) -> f64| corners.iter().map(|&v| share * part(v)).sum();
        let [x, y] = [0, 1].map(|axis| mean(&|v| self.points[v][axis]));
        let value = mean(&|v| self.values[v]);
        self.points.push([x, y]);
        self.values.push(value);
        for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            self.push([a, b, centre], cell);
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
        Surface::new(&panel, &view, panel.vertex_u.iter().copied())
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

//! Closure: a cell with hanging nodes, divided into cells that have none.
//!
//! ```text
//!        c           c          d───────c    d───────c    d───n───c    d───n───c
//!       ╱│╲         ╱ ╲         │╲     ╱│    │╲‾──__ │    │   │   │    │   │╲  │
//!      ╱ │ ╲       ╱ __m        │ ╲   ╱ │    │ ╲   ‾─m    │   │   │    │   │ ╲ m
//!     ╱  │  ╲     ╱─‾ ╱ ╲       │  ╲ ╱  │    │  ╲   ╱│    │   │   │    │   │ ╱ │
//!    a───l───b   a───l───b      a───l───b    a───l───b    a───l───b    a───l───b
//! ```
//! A triangle's median cuts an angle γ into parts of γ/3 at least: no angle of a piece is less than a third
//! of the least of the triangle. Of a quad let J be the least turn d₁ × d₂ of two sides that follow each other
//! and h the longest side: no piece has an angle with a sine below J/16h², and halves keep J/h² up to a half.
//!
//! Where several cuts do, the one with the largest least angle is taken. Every cut ends in a hanging node,
//! never in two corners: nodes belong to one edge each, so no cut is an edge of another cell as well,
//! not even where cells overlap.

use crate::mesh::shape::direction;

/// Cuts whose sines differ by less, relatively, count as equally good: coordinates are rounded.
const EQUAL: f64 = 1e-9;

type Triangle = [u32; 3];

/// The cells that closure makes of those over some vertices, by kind.
#[derive(Debug)]
pub(super) struct Pieces<'v> {
    vertices: &'v [[f64; 2]],
    pub(super) triangles: Vec<Triangle>,
    pub(super) quads: Vec<[u32; 4]>,
}

impl<'v> Pieces<'v> {
    /// No cell.
    pub(super) fn over(vertices: &'v [[f64; 2]]) -> Self {
        Self { vertices, triangles: Vec::new(), quads: Vec::new() }
    }

    /// Adds a triangle, divided at the nodes in its sides.
    pub(super) fn add_triangle(&mut self, corners: Triangle, nodes: [Option<u32>; 3]) {
        for turn in 0..3 {
            let [a, b, c] = turned(corners, turn);
            match turned(nodes, turn) {
                [None, None, None] => self.triangles.push(corners),
                [Some(l), None, None] => self.triangles.extend([[a, l, c], [l, b, c]]),
                [Some(l), Some(m), None] => {
                    self.triangles.push([l, b, m]);
                    let cuts = [[[a, l, m], [a, m, c]], [[a, l, c], [l, m, c]]];
                    self.triangles.extend(self.best(cuts));
                }
                [Some(l), Some(m), Some(n)] => {
                    self.triangles.extend([[a, l, n], [l, b, m], [n, m, c], [m, n, l]]);
                }
                _ => continue,
            }
            return;
        }
    }

    /// Adds a quad, divided at the nodes in its sides.
    pub(super) fn add_quad(&mut self, corners: [u32; 4], nodes: [Option<u32>; 4]) {
        for turn in 0..4 {
            let [a, b, c, d] = turned(corners, turn);
            match turned(nodes, turn) {
                [None, None, None, None] => self.quads.push(corners),
                [Some(l), None, None, None] => {
                    self.triangles.extend([[a, l, d], [l, b, c], [l, c, d]]);
                }
                [Some(l), Some(m), None, None] => {
                    self.triangles.push([l, b, m]);
                    let at_d = [[a, l, d], [l, m, d], [m, c, d]];
                    let at_l = [[a, l, d], [l, m, c], [l, c, d]];
                    let at_m = [[a, l, m], [a, m, d], [m, c, d]];
                    self.triangles.extend(self.best([at_d, at_l, at_m]));
                }
                [Some(l), None, Some(n), None] => self.quads.extend([[a, l, n, d], [l, b, c, n]]),
                [Some(l), Some(m), Some(n), None] => {
                    self.triangles.extend([[l, b, m], [m, c, n], [l, m, n]]);
                    self.quads.push([a, l, n, d]);
                }
                [Some(l), Some(m), Some(n), Some(o)] => {
                    self.triangles.extend([[a, l, o], [l, b, m], [m, c, n], [n, d, o]]);
                    self.quads.push([l, m, n, o]);
                }
                _ => continue,
            }
            return;
        }
    }

    /// The cut whose least angle is largest; among equals the first.
    fn best<const K: usize, const C: usize>(&self, cuts: [[Triangle; K]; C]) -> [Triangle; K] {
        let sine = |&piece: &Triangle| least_sine(self.vertices, piece);
        let least = |cut: &[Triangle; K]| cut.iter().map(sine).fold(1.0, f64::min);
        let better = |best: [Triangle; K], cut: [Triangle; K]| {
            if least(&cut) > (1.0 + EQUAL) * least(&best) { cut } else { best }
        };
        cuts[1..].iter().fold(cuts[0], |best, &cut| better(best, cut))
    }
}

fn turned<T, const N: usize>(mut items: [T; N], turn: usize) -> [T; N] {
    items.rotate_left(turn);
    items
}

/// The sine of the least angle, which is the least of the three sines.
fn least_sine(vertices: &[[f64; 2]], triangle: Triangle) -> f64 {
    let points = triangle.map(|vertex| vertices[vertex as usize]);
    let ways: [_; 3] = std::array::from_fn(|k| direction(points[k], points[(k + 1) % 3]));
    let sine = |k: usize| {
        let ([x, y], [u, v]) = (ways[k], ways[(k + 1) % 3]);
        (x * v - y * u).abs()
    };
    (0..3).map(sine).fold(1.0, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::{Orientation, orientation};
    use crate::mesh::tests::Draw;

    /// Corners on a circle of radius 1 at random angles, then the midpoints of the sides.
    fn drawn<const N: usize>(draw: &mut Draw) -> Vec<[f64; 2]> {
        let mut angles: [f64; N] = std::array::from_fn(|_| std::f64::consts::TAU * draw.unit());
        angles.sort_by(f64::total_cmp);
        let mut points: Vec<[f64; 2]> = angles.map(|angle| [angle.cos(), angle.sin()]).to_vec();
        for k in 0..N {
            let (a, b) = (points[k], points[(k + 1) % N]);
            points.push([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
        }
        points
    }

    /// Which of the midpoints `mask` counts as nodes.
    fn nodes<const N: usize>(mask: u32) -> [Option<u32>; N] {
        std::array::from_fn(|k| (mask >> k & 1 == 1).then_some((N + k) as u32))
    }

    /// The pieces are counterclockwise, fill the polygon, and have its halves and whole sides as outline.
    fn assert_divided<const N: usize>(points: &[[f64; 2]], mask: u32, pieces: &Pieces) {
        let triangles = pieces.triangles.iter().map(|piece| piece.to_vec());
        let all: Vec<_> =
            triangles.chain(pieces.quads.iter().map(|piece| piece.to_vec())).collect();
        let mut sides = Vec::new();
        for piece in &all {
            let corners: Vec<_> = piece.iter().map(|&corner| points[corner as usize]).collect();
            assert_eq!(
                orientation(&corners),
                Ok(Orientation::Counterclockwise),
                "{mask} {piece:?}"
            );
            sides.extend((0..piece.len()).map(|k| [piece[k], piece[(k + 1) % piece.len()]]));
        }
        let inside = |&[a, b]: &[u32; 2]| sides.contains(&[b, a]);
        let mut outline: Vec<_> = sides.iter().filter(|side| !inside(side)).copied().collect();
        outline.sort_unstable();
        let side = |k: usize| {
            let (a, b, node) = (k as u32, ((k + 1) % N) as u32, nodes::<N>(mask)[k]);
            node.map_or(vec![[a, b]], |node| vec![[a, node], [node, b]])
        };
        let mut expected: Vec<_> = (0..N).flat_map(side).collect();
        expected.sort_unstable();
        assert_eq!(outline, expected, "{mask}: {all:?}");
    }

    #[test]
    fn every_set_of_nodes_in_polygons_at_random() {
        let mut draw = Draw(1);
        for _ in 0..200 {
            let points = drawn::<3>(&mut draw);
            for mask in 0..8 {
                let mut pieces = Pieces::over(&points);
                pieces.add_triangle([0, 1, 2], nodes(mask));
                assert_divided::<3>(&points, mask, &pieces);
            }
            let points = drawn::<4>(&mut draw);
            for mask in 0..16 {
                let mut pieces = Pieces::over(&points);
                pieces.add_quad([0, 1, 2, 3], nodes(mask));
                assert_divided::<4>(&points, mask, &pieces);
            }
        }
    }

    #[test]
    fn the_better_cut_is_taken() {
        // Nodes 3 and 4 in the sides at corner 1: the trapezoid 0 3 4 2 is cut along its shorter diagonal.
        for (top, cut) in [([-0.5, 1.0], [0, 4]), ([1.0, 0.3], [2, 3])] {
            let mut points = vec![[0.0, 0.0], [1.0, 0.0], top];
            points.extend([[0.5, 0.0], [0.5 * (1.0 + top[0]), 0.5 * top[1]]]);
            let mut pieces = Pieces::over(&points);
            pieces.add_triangle([0, 1, 2], [Some(3), Some(4), None]);
            let cut = |piece: &&Triangle| cut.iter().all(|end| piece.contains(end));
            assert_eq!(pieces.triangles.iter().filter(cut).count(), 2, "{top:?}");
        }
    }

    #[test]
    fn a_square_with_a_node_keeps_its_symmetry() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.0]];
        let mut pieces = Pieces::over(&points);
        pieces.add_quad([0, 1, 2, 3], [Some(4), None, None, None]);
        assert_eq!(pieces.triangles, [[0, 4, 3], [4, 1, 2], [4, 2, 3]]);
    }
}

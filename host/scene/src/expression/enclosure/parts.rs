//! Parts of regions: quarters, and halves of what is thin.

use super::polynomial::Shape;
use super::region::{Region, cross, from, middle};

impl Region {
    /// Halves of a segment; quarters of a triangle or a quad, or halves across its longer direction where it is thin.
    pub fn parts(&self) -> Vec<Self> {
        match self.shape {
            Shape::Segment => self.halves(0),
            Shape::Quad => {
                let [u, v] = [0, 1].map(|k| self.along[k][0].hypot(self.along[k][1]));
                match (u > THIN * v, v > THIN * u) {
                    (true, _) => self.halves(0),
                    (_, true) => self.halves(1),
                    _ => self.halves(0).iter().flat_map(|half| half.halves(1)).collect(),
                }
            }
            Shape::Triangle => self.parts_of_triangle(),
        }
    }

    /// Vectors along ξ and η, of a triangle along all its sides.
    pub fn directions(&self) -> [[f64; 2]; 3] {
        let [u, v, _] = self.along;
        let beside = if self.shape == Shape::Triangle { from(u, v) } else { [0.0; 2] };
        [u, v, beside]
    }

    /// Halves across the direction in which a function varies most, if it does so much along each; else [`Region::parts`].
    pub fn parts_across(&self, variations: [f64; 3]) -> Vec<Self> {
        let most = variations.iter().copied().fold(0.0, f64::max);
        let [along_u, along_v, _] = variations;
        match self.shape {
            _ if most == 0.0 || !most.is_finite() => self.parts(),
            Shape::Segment => self.halves(0),
            Shape::Quad => self.halves(if along_u >= along_v { 0 } else { 1 }),
            Shape::Triangle if along_u == most => self.halved(0),
            Shape::Triangle if along_v == most => self.halved(2),
            Shape::Triangle => self.halved(1),
        }
    }

    /// Halves across the direction of ξ or η.
    fn halves(&self, axis: usize) -> Vec<Self> {
        let [a, b, c, d] = self.corners;
        let corners = |way: f64| match (self.shape, axis, way < 0.0) {
            (Shape::Segment, _, true) => [a, middle(a, b), middle(a, b), middle(a, b)],
            (Shape::Segment, _, false) => [middle(a, b), b, b, b],
            (_, 0, true) => [a, middle(a, b), middle(c, d), d],
            (_, 0, false) => [middle(a, b), b, c, middle(c, d)],
            (_, _, true) => [a, b, middle(b, c), middle(d, a)],
            (_, _, false) => [middle(d, a), middle(b, c), c, d],
        };
        let [own, across] = [self.along[axis], self.along[1 - axis]];
        let half = |way: f64| {
            let twist = self.along[2];
            let centre = [0, 1].map(|k| self.centre[k] + 0.5 * way * own[k]);
            let mut along = self.along.map(|along| along.map(|x| 0.5 * x));
            along[1 - axis] = [0, 1].map(|k| across[k] + 0.5 * way * twist[k]);
            Self { shape: self.shape, corners: corners(way), centre, along }
        };
        [-1.0, 1.0].map(half).to_vec()
    }

    /// Quarters, or halves at the middle of the longest side where its height is less than a quarter of it.
    fn parts_of_triangle(&self) -> Vec<Self> {
        let [a, b, c, _] = self.corners;
        let [u, v, w] = self.directions();
        let squares = [u, w, v].map(|[x, y]| x * x + y * y);
        let longest = squares.iter().copied().fold(0.0, f64::max);
        if longest * 0.25 > cross(u, v).abs() {
            return self.halved(squares.iter().position(|&of| of == longest).unwrap_or(2));
        }
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        let corners = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]];
        let parts = corners.iter().enumerate();
        let part = |(k, corners): (usize, &[[f64; 2]; 3])| {
            let scale = if k == 3 { -0.5 } else { 0.5 };
            Self::in_triangle(*corners, [u, v].map(|along| along.map(|x| scale * x)))
        };
        parts.map(part).collect()
    }

    /// Halves of a triangle at the middle of a side: 0 from the first corner to the second, and so on.
    fn halved(&self, side: usize) -> Vec<Self> {
        let ([a, b, c, _], [u, v, w]) = (self.corners, self.directions());
        let back = |u: [f64; 2]| u.map(|x| -x);
        // The side from its first corner, and from there to the third.
        let ([a, b, c], [u, v]) = match side {
            0 => ([a, b, c], [u, v]),
            1 => ([b, c, a], [w, back(u)]),
            _ => ([c, a, b], [back(v), back(w)]),
        };
        let (middle, half) = (middle(a, b), u.map(|x| 0.5 * x));
        let other = [0, 1].map(|k| v[k] - half[k]);
        vec![
            Self::in_triangle([a, middle, c], [half, v]),
            Self::in_triangle([middle, b, c], [half, other]),
        ]
    }
}

/// A side so much longer than the other is halved alone.
const THIN: f64 = 2.0;

//! Segments that lie on each other: what nodes that were not merged leave of a joint.
//!
//! ```text
//!       a ────────────── b          e lies on f, the longer one, where both its ends are within
//!   e:      c ──── d                TOLERANCE |e| of the line through f, and both have OVERLAP |e|
//!   f:  a'────────────── b'         or more in common
//! ```
//! Whole edges, edges with one node in common, and the halves at a hanging node are found alike.
//! Segments are hashed by length (a power of two l ≤ |e|), by the squares of side l that they touch, and by
//! direction; each is compared with those in its own squares that are as long or longer. That is
//! O(n) whatever lies where, but for many nearly parallel segments through one square, which no cells
//! of sound shape have as sides.

use std::collections::HashMap;
use std::f64::consts::PI;

/// How far from the line of the longer segment the ends of the shorter one may lie, as part of its
/// own length: what files with seven digits leave.
pub const TOLERANCE: f64 = 1e-6;
/// That distance where both have their cell on the side of the other: then it is a cell's thickness unless rounding
/// made it.
const THICKNESS: f64 = 1e-9;
/// The least that two segments have in common, as part of the shorter one.
const OVERLAP: f64 = 1e-3;
/// Classes of directions, each wider than twice `ANGLE`.
const DIRECTIONS: u32 = 300_000;
/// The largest angle between two segments that lie on each other: 2 TOLERANCE, with room.
const ANGLE: f64 = 4e-6;

/// A side of a cell, which lies to the left of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Its ends.
    pub ends: [[f64; 2]; 2],
    /// The cell: two sides of the same one never count.
    pub cell: u32,
}

/// Which of the segments lie on another one, at least in part.
pub fn coincident(segments: &[Segment]) -> Vec<bool> {
    let lines: Vec<_> = segments.iter().map(Line::new).collect();
    let classes = Classes::of(&lines);
    let mut found = vec![false; lines.len()];
    for (at, line) in lines.iter().enumerate() {
        classes.longer(line, |other| {
            if other != at && line.lies_on(&lines[other]) {
                (found[at], found[other]) = (true, true);
            }
        });
    }
    found
}

/// A segment with what comparisons need of it.
struct Line {
    ends: [[f64; 2]; 2],
    /// The unit vector from the first end to the second.
    direction: [f64; 2],
    length: f64,
    /// The largest power of two that is no longer.
    level: i32,
    cell: u32,
    /// The error of its rounded coordinates.
    rounding: f64,
}

impl Line {
    fn new(&Segment { ends: [a, b], cell }: &Segment) -> Self {
        let way = [b[0] - a[0], b[1] - a[1]];
        let length = way[0].hypot(way[1]);
        let largest = [a, b].as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        Self {
            ends: [a, b],
            direction: way.map(|d| d / length),
            length,
            level: length.log2().floor() as i32,
            cell,
            rounding: 16.0 * f64::EPSILON * largest,
        }
    }

    /// How far along the line a point lies, and how far to the left of it.
    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let [[x, y], [dx, dy]] = [self.ends[0], self.direction];
        let way = [point[0] - x, point[1] - y];
        [dx * way[0] + dy * way[1], dx * way[1] - dy * way[0]]
    }

    /// Whether it lies on `other`, which is as long or longer.
    fn lies_on(&self, other: &Self) -> bool {
        if self.cell == other.cell {
            return false;
        }
        let [[from, left], [to, left_too]] = self.ends.map(|end| other.place(end));
        // Run through in opposite directions, both have their cells outside where nothing lies between.
        let inwards = if to < from { THICKNESS } else { TOLERANCE };
        let near = |left: f64| {
            let part = if left > 0.0 { inwards } else { TOLERANCE };
            left.abs() <= part * self.length + self.rounding
        };
        let common = from.max(to).min(other.length) - from.min(to).max(0.0);
        near(left) && near(left_too) && common >= OVERLAP * self.length
    }

    /// The angle of its line, from 0 to π.
    fn angle(&self) -> f64 {
        self.direction[1].atan2(self.direction[0]).rem_euclid(PI)
    }

    /// The squares of side 2^level that it touches.
    fn squares(&self, level: i32) -> impl Iterator<Item = [i64; 2]> {
        let side = f64::from(level).exp2();
        let margin = TOLERANCE * self.length + self.rounding;
        let range = |axis: usize| {
            let [a, b] = self.ends.map(|end| end[axis]);
            let [low, high] = [a.min(b) - margin, a.max(b) + margin];
            [low, high].map(|x| (x / side).floor() as i64)
        };
        let [[left, right], [bottom, top]] = [range(0), range(1)];
        (left..=right).flat_map(move |x| (bottom..=top).map(move |y| [x, y]))
    }
}

/// The segments by level, square and direction.
struct Classes {
    levels: Vec<i32>,
    members: HashMap<(i32, [i64; 2], u32), Vec<u32>>,
}

impl Classes {
    fn of(lines: &[Line]) -> Self {
        let mut members: HashMap<_, Vec<_>> = HashMap::new();
        for (at, line) in (0..).zip(lines) {
            for square in line.squares(line.level) {
                members.entry((line.level, square, class(line.angle()))).or_default().push(at);
            }
        }
        let mut levels: Vec<_> = lines.iter().map(|line| line.level).collect();
        levels.sort_unstable();
        levels.dedup();
        Self { levels, members }
    }

    /// Calls `each` with the numbers of segments near `line` that are nearly parallel and about as long or
    /// longer; with some of them several times.
    fn longer(&self, line: &Line, mut each: impl FnMut(usize)) {
        let classes = [-ANGLE, ANGLE].map(|turn| class((line.angle() + turn).rem_euclid(PI)));
        let classes = if classes[0] == classes[1] { &classes[..1] } else { &classes };
        for &level in self.levels.iter().filter(|&&level| level >= line.level) {
            for square in line.squares(level) {
                for &class in classes {
                    let members = self.members.get(&(level, square, class));
                    members.into_iter().flatten().for_each(|&other| each(other as usize));
                }
            }
        }
    }
}

/// The class of an angle from 0 to π, where the first begins again.
fn class(angle: f64) -> u32 {
    (angle / PI * f64::from(DIRECTIONS)) as u32 % DIRECTIONS
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each segment of a cell of its own.
    fn apart(ends: &[[[f64; 2]; 2]]) -> Vec<bool> {
        let segments = (0..).zip(ends).map(|(cell, &ends)| Segment { ends, cell });
        coincident(&segments.collect::<Vec<_>>())
    }

    #[test]
    fn whole_edges_parts_of_edges_and_common_ends() {
        let [a, b, c] = [[0.1, 0.7], [0.2, 0.9], [0.15, 0.8]];
        assert_eq!(apart(&[[a, b], [b, a]]), [true; 2]);
        assert_eq!(apart(&[[a, b], [a, b]]), [true; 2], "two cells on the same side");
        assert_eq!(apart(&[[a, b], [b, c], [c, a]]), [true; 3], "a hanging node");
        assert_eq!(apart(&[[a, c], [c, b]]), [false; 2], "one after the other");
        assert_eq!(apart(&[[a, b], [a, [0.1, 0.9]]]), [false; 2], "a corner");
        let shifted = [[0.175, 0.85], [0.275, 1.05]];
        assert_eq!(apart(&[[a, b], shifted]), [true; 2], "half of each");
        let sixth = 1.0 / 6.0;
        let third = [[0.0, 0.0], [1.0, sixth]];
        let parts = [[[1.0 / 3.0, sixth / 3.0], [0.0, 0.0]], [[1.0, sixth], [0.9, 0.9 * sixth]]];
        assert_eq!(apart(&[third, parts[0], parts[1]]), [true; 3]);
    }

    #[test]
    fn what_only_lies_near_is_left_alone() {
        let near = |y: f64| apart(&[[[0.0, 0.0], [1.0, 0.0]], [[1.0, y], [0.0, y]]]);
        // The first has its cell above, the second below: a gap at y < 0, a plate at y > 0.
        assert_eq!(
            [-1e-7, -1e-5, 1e-7, 1e-5, 0.0].map(|y| near(y)[0]),
            [true, false, false, false, true]
        );
        assert_eq!(apart(&[[[0.0, 0.0], [1.0, 0.0]], [[0.5, 1e-7], [0.5, -1.0]]]), [false; 2]);
        let same = [[0.0, 0.0], [1.0, 0.0]].map(|end| Segment { ends: [end, [2.0, 0.0]], cell: 3 });
        assert_eq!(coincident(&same), [false; 2], "sides of one cell");
        assert_eq!(apart(&[]), [false; 0]);
    }

    #[test]
    fn every_scale_and_place_and_direction() {
        for scale in [1e-300, 1e-9, 1.0, 1e12, 1e300] {
            for turn in 0..1000 {
                let (sin, cos) = (f64::from(turn) * PI / 500.0).sin_cos();
                let at = |r: f64| [scale * (3.0 + r * cos), scale * (r * sin - 2.0)];
                let found = apart(&[[at(0.0), at(1.0)], [at(1.0), at(0.5)], [at(0.5), at(0.0)]]);
                assert_eq!(found, [true; 3], "{scale} {turn}");
            }
        }
        // Coordinates of a survey: millions of metres, edges of centimetres.
        let [a, b] = [[512_345.67, 5_412_345.67], [512_345.68, 5_412_345.69]];
        let middle = [512_345.675, 5_412_345.68];
        assert_eq!(apart(&[[a, b], [b, middle], [middle, a]]), [true; 3]);
    }

    #[test]
    fn hundreds_of_thousands_are_quick() {
        let n = 200_000;
        let along = |k: i32| f64::from(k) / f64::from(n);
        // A straight slit on one long edge.
        let slit = (0..n).map(|k| [[0.0, along(k + 1)], [0.0, along(k)]]);
        let long = std::iter::once([[0.0, 0.0], [0.0, 1.0]]);
        assert!(apart(&long.chain(slit).collect::<Vec<_>>()).iter().all(|&found| found));
        // A fan whose every side has nodes of its own.
        let rim = |k: i32| (2.0 * PI * along(k)).sin_cos().into();
        let sides = |k: i32| [[[0.0, 0.0], rim(k)], [rim(k + 1), [0.0, 0.0]]];
        assert!(apart(&(0..n).flat_map(sides).collect::<Vec<_>>()).iter().all(|&found| found));
    }
}

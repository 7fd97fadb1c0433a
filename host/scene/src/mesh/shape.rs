//! Lengths of edges; is a cell convex, and which way round is it written?
//!
//! At each corner stands the turn d₁ × d₂ of the side that comes in and the side that leaves. All
//! turns positive: strictly convex and counterclockwise; all negative: clockwise. A quad with two
//! of each crosses itself, with one against three it has a reflex corner.
//!
//! Coordinates come rounded, so a turn is known up to
//! ε (|x|(|dy₁| + |dy₂|) + |y|(|dx₁| + |dx₂|)) with |x|, |y| the largest of the cell; what is below
//! twice that counts as zero. The bound goes by component: a mesh may be flat as 1 : 10⁻²⁰.

use thiserror::Error;

/// The length |b − a| of an edge.
pub fn edge_length([a, b]: [[f64; 2]; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// The unit vector from a point to another; scaled first, so that no square overflows or vanishes.
pub(super) fn direction(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let way = [to[0] - from[0], to[1] - from[1]];
    let way = way.map(|d| d / way[0].abs().max(way[1].abs()));
    let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
    way.map(|d| d / length)
}

/// The sense in which the corners of a convex cell are listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Orientation {
    /// The interior lies to the left.
    Counterclockwise,
    /// The interior lies to the right.
    Clockwise,
}

/// Why a cell is not a strictly convex polygon; corners are counted from 0 as listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Defect {
    /// No area within rounding, or two corners at one place.
    #[error("is degenerate: it has no area, or two corners in one place")]
    Degenerate,
    /// The angle at this corner is 180° within rounding.
    #[error("has an angle of 180°")]
    Straight(usize),
    /// The angle at this corner is more than 180°.
    #[error("is not convex: it has an angle of more than 180°")]
    Reflex(usize),
    /// Two opposite sides cross.
    #[error("crosses itself")]
    SelfCrossing,
}

impl Defect {
    /// The corner at fault, where it is one.
    pub fn corner(self) -> Option<usize> {
        match self {
            Self::Straight(corner) | Self::Reflex(corner) => Some(corner),
            Self::Degenerate | Self::SelfCrossing => None,
        }
    }
}

/// The orientation of the triangle or quad with the given corners, if it is strictly convex.
pub fn orientation(corners: &[[f64; 2]]) -> Result<Orientation, Defect> {
    let signs = turns(corners);
    let signs = &signs[..corners.len()];
    let with = |sign| signs.iter().filter(move |&&s| s == sign).count();
    let only = |sign| signs.iter().position(|&s| s == sign).unwrap_or(0);
    match (with(1), with(0), with(-1)) {
        (_, 0, 0) => Ok(Orientation::Counterclockwise),
        (0, 0, _) => Ok(Orientation::Clockwise),
        (3, 0, 1) => Err(Defect::Reflex(only(-1))),
        (1, 0, 3) => Err(Defect::Reflex(only(1))),
        (3, 1, 0) | (0, 1, 3) => Err(Defect::Straight(only(0))),
        (_, 0, _) => Err(Defect::SelfCrossing),
        _ => Err(Defect::Degenerate),
    }
}

/// The sign of the turn at each corner, 0 where rounding hides it or a value is not finite.
fn turns(corners: &[[f64; 2]]) -> [i8; 4] {
    let count = corners.len();
    let side = |from: usize, axis: usize| corners[(from + 1) % count][axis] - corners[from][axis];
    let largest = |axis: usize| corners.iter().fold(0.0, |max: f64, p| max.max(p[axis].abs()));
    // Sides are measured in the cell's own width and height: no overflow, no underflow.
    let extent = |axis: usize| (0..count).fold(0.0, |max: f64, k| max.max(side(k, axis).abs()));
    let (width, height) = (extent(0), extent(1));
    let noise = [0, 1].map(|axis| 2.0 * f64::EPSILON * largest(axis) / [width, height][axis]);
    let sides: [[f64; 2]; 4] = std::array::from_fn(|k| {
        let from = k % count;
        [side(from, 0) / width, side(from, 1) / height]
    });
    std::array::from_fn(|k| {
        let (came, goes) = (sides[(k + count - 1) % count], sides[k % count]);
        let turn = came[0] * goes[1] - came[1] * goes[0];
        let bound =
            noise[0] * (came[1].abs() + goes[1].abs()) + noise[1] * (came[0].abs() + goes[0].abs());
        i8::from(turn > bound) - i8::from(turn < -bound)
    })
}

/// The mean of some of the vertices.
pub(super) fn mean(vertices: &[[f64; 2]], corners: &[u32]) -> [f64; 2] {
    let share = 1.0 / corners.len() as f64;
    let part = |axis: usize| corners.iter().map(move |&at| share * vertices[at as usize][axis]);
    [0, 1].map(|axis| part(axis).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    fn reversed(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
        corners.iter().rev().copied().collect()
    }

    #[test]
    fn both_senses() {
        for corners in [&SQUARE[..], &SQUARE[..3]] {
            assert_eq!(orientation(corners), Ok(Orientation::Counterclockwise));
            assert_eq!(orientation(&reversed(corners)), Ok(Orientation::Clockwise));
        }
    }

    #[test]
    fn defects_of_quads_in_both_senses() {
        let cases = [
            ([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]], Defect::SelfCrossing, None),
            ([[0.0, 0.0], [4.0, 0.0], [1.0, 1.0], [0.0, 4.0]], Defect::Reflex(2), Some(1)),
            ([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]], Defect::Straight(1), Some(2)),
            ([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Defect::Degenerate, None),
            ([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]], Defect::Degenerate, None),
        ];
        for (corners, defect, mirrored) in cases {
            assert_eq!(orientation(&corners), Err(defect));
            assert_eq!(orientation(&reversed(&corners)).map_err(Defect::corner), Err(mirrored));
        }
    }

    #[test]
    fn a_point_rounded_onto_a_side_counts_as_on_it() {
        for k in 1..500 {
            let t = f64::from(k) / 500.0;
            let (a, b) = ([0.1, 0.3], [1234.7, 77.9]);
            let middle = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            assert_eq!(orientation(&[a, middle, b]), Err(Defect::Degenerate));
            assert_eq!(orientation(&[a, middle, b, [0.0, 90.0]]), Err(Defect::Straight(1)));
        }
    }

    #[test]
    fn every_scale_and_thin_cells_are_taken() {
        for scale in [1e-300, 1e-160, 1e-20, 1.0, 1e20, 1e160, 1e300] {
            let scaled = SQUARE.map(|[x, y]| [x * scale, y * scale]);
            assert_eq!(orientation(&scaled), Ok(Orientation::Counterclockwise), "{scale}");
            let flat = SQUARE.map(|[x, y]| [x, y * scale]);
            assert_eq!(orientation(&flat), Ok(Orientation::Counterclockwise), "{scale}");
        }
        let thin = [[0.0, 0.0], [1.0, 1.0], [0.5, 0.5 + 1e-13]];
        assert_eq!(orientation(&thin), Ok(Orientation::Counterclockwise));
    }

    #[test]
    fn overflowing_sides_are_a_defect() {
        let huge = SQUARE.map(|[x, y]| [(2.0 * x - 1.0) * 1.7e308, y]);
        assert_eq!(orientation(&huge), Err(Defect::Degenerate));
    }
}

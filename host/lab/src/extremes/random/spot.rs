//! Where a feature of random data is: a point, or a strip, and how wide it is.

use super::cut::Line;
use signorini_problem::random::Random;

/// A side of (−1, 1) × (0, 1): its name, the coordinate along it with its ends, and the value of the other.
pub(super) type Side = (&'static str, usize, [f64; 2], f64);
pub(super) const SIDES: [Side; 4] = [
    ("bottom", 0, [-1.0, 1.0], 0.0),
    ("right", 1, [0.0, 1.0], 1.0),
    ("top", 0, [-1.0, 1.0], 1.0),
    ("left", 1, [0.0, 1.0], -1.0),
];
pub(super) const NAMES: [&str; 2] = ["x", "y"];

/// The place of a feature: its middle, in one coordinate where it is a strip, and half of its width.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    middle: [Option<f64>; 2],
    width: f64,
}

impl Spot {
    /// Inside: a point, or a strip along the other coordinate.
    pub fn inside(random: &mut Random, width: f64, is_strip: bool) -> Self {
        let mut middle = [Some(random.between(-1.0, 1.0)), Some(random.between(0.0, 1.0))];
        if is_strip {
            middle[random.below(2) as usize] = None;
        }
        Self { middle, width }
    }

    pub fn on((_, axis, ..): Side, at: f64, other: f64, width: f64) -> Self {
        let middle = if axis == 0 { [at, other] } else { [other, at] };
        Self { middle: middle.map(Some), width }
    }

    /// The square of the distance to its middle over its width, in these coordinates.
    pub fn square(&self, axes: &[usize]) -> String {
        let of = |&axis: &usize| {
            Some(format!("(({} - {:e})/{:e})^2", NAMES[axis], self.middle[axis]?, self.width))
        };
        format!("({})", axes.iter().filter_map(of).collect::<Vec<_>>().join(" + "))
    }

    /// Lines through its middle, and graded to it.
    pub fn lines(&self) -> Vec<Line> {
        let mut factors = vec![0.5, 1.0, 1.5, 2.0, 3.0];
        while let Some(last) = factors.last().filter(|last| *last * self.width < 2.0) {
            factors.push(3.0 * last);
        }
        let both = factors.iter().flat_map(|factor| [-factor, *factor]).chain([0.0]);
        let on = |off: f64| {
            let at = move |axis: usize| self.middle[axis].map(|at| Line { axis, at: at + off });
            [0, 1].into_iter().filter_map(at)
        };
        both.flat_map(|factor| on(factor * self.width)).collect()
    }
}

/// 1 within a width, else 0; or exp of what is in `square`.
pub(super) fn shape(random: &mut Random, square: &str) -> String {
    match random.chance(0.5) {
        true => format!("(0.5+0.5*sign(1-{square}))"),
        false => format!("exp(-{square})"),
    }
}

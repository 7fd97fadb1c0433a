//! The inputs of a controller: their ranges in its scalar, and values drawn from them for trials.

use crate::scalar::Scalar;
use signorini_device::ranges::clamp;
use signorini_scene::scene::{Input, Scene};

/// Inputs of which all corners are tried; of more, those that are drawn.
const CORNERS: usize = 8;

/// Where values of an input are drawn from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputSpace {
    /// Value in the first tick.
    pub default: f64,
    /// The least and the largest value; infinite where the scene declares none.
    pub range: [f64; 2],
}

impl InputSpace {
    /// The inputs of a scene, in its order.
    pub fn of(scene: &Scene) -> Vec<Self> {
        let space = |input: &Input| Self { default: input.default, range: input.interval() };
        scene.inputs.iter().map(space).collect()
    }

    /// Within a tenth of `default`.
    pub fn near(default: f64) -> Self {
        Self { default, range: [f64::NEG_INFINITY, f64::INFINITY] }
    }

    /// The ends of its range; where there is none, a tenth of the default off it, as [`drawn`] has them.
    fn ends(&self) -> [f64; 2] {
        let [lo, hi] = self.range;
        match lo.is_finite() && hi.is_finite() {
            true => self.range,
            false => {
                let by = if self.default == 0.0 { 0.1 } else { 0.1 * self.default.abs() };
                [self.default - by, self.default + by]
            }
        }
    }

    /// The value of `tick` that 32 random bits stand for, in the arithmetic of the device: on a mesh another last digit of an
    /// input may lead the search for ω elsewhere, to another number of sweeps.
    fn value<R: Scalar>(&self, tick: usize, bits: u32) -> R {
        let [default, lo, hi] = [self.default, self.range[0], self.range[1]].map(R::narrow);
        let part = R::from_count(bits >> 8) / R::from_count(1 << 24);
        match (tick % 4, lo.finite() && hi.finite()) {
            _ if tick == 0 => default,
            (_, false) => {
                let unit = if default == R::ZERO { R::ONE } else { default };
                default + unit * (R::narrow(0.2) * part - R::narrow(0.1))
            }
            (0 | 1, true) => clamp(lo + (hi - lo) * part, [lo, hi]),
            _ if part < R::HALF => lo,
            _ => hi,
        }
    }
}

/// The defaults, then so many ticks more, the same in every run: of four, two are drawn evenly from the ranges and two
/// are corners of them, one after the other. An input without a range stays within a tenth of its default (within ±0.1
/// where that is 0). `cargo xtask firmware` draws them so too.
pub fn drawn<R: Scalar>(spaces: &[InputSpace], ticks: usize) -> impl Iterator<Item = Vec<R>> {
    let mut state = 0x5169_0e1d_u32;
    let mut bits = move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state
    };
    (0..=ticks).map(move |tick| {
        let value = |space: &InputSpace| {
            let bits = if tick == 0 { 0 } else { bits() };
            space.value(tick, bits)
        };
        spaces.iter().map(value).collect()
    })
}

/// All corners of the ranges where inputs are few; none without inputs.
pub fn corners(spaces: &[InputSpace]) -> Vec<Vec<f64>> {
    let few = (1..=CORNERS).contains(&spaces.len());
    let corner = |bits: usize| {
        let end = |(at, space): (usize, &InputSpace)| space.ends()[(bits >> at) & 1];
        spaces.iter().enumerate().map(end).collect()
    };
    (0..if few { 1_usize << spaces.len() } else { 0 }).map(corner).collect()
}

/// The ranges in the scalar of the target; none where no input has one.
pub fn ranges<R: Scalar>(ranges: &[[f64; 2]]) -> Vec<[R; 2]> {
    let is_declared = |[lo, hi]: &[f64; 2]| lo.is_finite() || hi.is_finite();
    match ranges.iter().any(is_declared) {
        true => ranges.iter().map(|range| range.map(R::narrow)).collect(),
        false => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_in_their_ranges_and_at_both_ends() {
        let spaces = [InputSpace { default: 3.0, range: [-1.0, 7.0] }, InputSpace::near(10.0)];
        let ticks: Vec<Vec<f64>> = drawn(&spaces, 100).collect();
        assert_eq!((ticks.len(), &ticks[0]), (101, &vec![3.0, 10.0]));
        assert!(ticks.iter().all(|p| (-1.0..=7.0).contains(&p[0]) && (p[1] - 10.0).abs() <= 1.0));
        let jumps = ticks.windows(2).filter(|pair| (pair[0][0] - pair[1][0]).abs() == 8.0);
        assert!(jumps.count() > 8, "from end to end");
        let inside = ticks.iter().filter(|p| ![-1.0, 3.0, 7.0].contains(&p[0]));
        assert_eq!(inside.count(), 50);
        assert!(ticks.iter().map(|p| p[1]).fold(0.0, f64::max) > 10.9);
    }

    #[test]
    fn ranges_are_those_of_the_scalar() {
        assert_eq!(ranges::<f32>(&[[0.1, 0.3]]), [[0.1_f32, 0.3]]);
        assert_eq!(ranges::<f32>(&[InputSpace::near(1.0).range]), [[0.0_f32; 2]; 0]);
    }
}

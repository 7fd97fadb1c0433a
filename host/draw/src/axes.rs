//! The axes of a diagram: a rectangle of a picture, with a scale along its bottom and one along its left.

use super::look::Look;
use super::scale::Scale;
use super::simplify::simplify;
use super::svg::{Anchor, Path, Svg};

/// A curve of no more points has a marker at each of them.
const MARKED: usize = 64;
/// Markers of a longer one, where there is another curve to tell apart.
const SPARSE: usize = 12;

/// A diagram being drawn.
pub struct Axes<'s> {
    /// The picture that it is part of.
    pub svg: &'s mut Svg,
    /// From values to pixels, from the left to the right.
    pub across: Scale,
    /// From values to pixels, from the bottom to the top.
    pub up: Scale,
}

impl Axes<'_> {
    /// The pixel of a point; `None` outside of the diagram and for values without a place on its axes.
    pub fn at(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let pixel = [self.across.at(x), self.up.at(y)];
        (pixel[0].is_finite() && self.is_in_sight(pixel[1])).then_some(pixel)
    }

    fn is_in_sight(&self, y: f64) -> bool {
        let [bottom, top] = self.up.pixels();
        (top - 1.0..=bottom + 1.0).contains(&y)
    }

    /// Draws the sides of the rectangle.
    pub fn frame(&mut self) {
        let ([left, right], [bottom, top]) = (self.across.pixels(), self.up.pixels());
        self.svg.rectangle("frame", [left, top], [right, bottom]);
    }

    /// Writes above the diagram what it shows.
    pub fn heading(&mut self, quantity: &str) {
        let place = [self.across.pixels()[0], self.up.pixels()[1] - 8.0];
        self.svg.text("quantity", place, Anchor::Start, quantity);
    }

    /// Draws about `count` upright grid lines.
    pub fn columns(&mut self, count: usize) {
        let [bottom, top] = self.up.pixels();
        for (value, _) in self.across.ticks(count) {
            let x = self.across.at(value);
            self.svg.line("grid", [x, top], [x, bottom]);
        }
    }

    /// Draws about `count` level grid lines with their values; 0 is drawn as an axis where it is in sight.
    pub fn levels(&mut self, count: usize, label: impl Fn(f64, String) -> String) {
        let [left, right] = self.across.pixels();
        for (value, text) in self.up.ticks(count) {
            let y = self.up.at(value);
            if self.is_in_sight(y) {
                self.svg.line("grid", [left, y], [right, y]);
                self.svg.text("tick", [left - 8.0, y + 4.0], Anchor::End, &label(value, text));
            }
        }
        let zero = self.up.at(0.0);
        if self.is_in_sight(zero) {
            self.svg.line("axis", [left, zero], [right, zero]);
        }
    }

    /// Draws the horizontal axis with about `count` values, and what it shows.
    pub fn feet(&mut self, count: usize, quantity: &str) {
        let ([_, right], [bottom, _]) = (self.across.pixels(), self.up.pixels());
        for (value, label) in self.across.ticks(count) {
            let x = self.across.at(value);
            self.svg.line("axis", [x, bottom], [x, bottom + 4.0]);
            self.svg.text("tick", [x, bottom + 18.0], Anchor::Middle, &label);
        }
        self.svg.text("quantity", [right, bottom + 36.0], Anchor::End, quantity);
    }

    /// Draws a line through points, interrupted where one is missing or out of sight.
    pub fn line(&mut self, class: &str, points: impl IntoIterator<Item = Option<[f64; 2]>>) {
        let pixels: Vec<_> = points.into_iter().map(|point| self.at(point?)).collect();
        self.polyline(class, &pixels);
    }

    fn polyline(&mut self, class: &str, pixels: &[Option<[f64; 2]>]) {
        let mut line = Path::default();
        for run in pixels.split(Option::is_none) {
            line.line(&simplify(run.iter().flatten().copied().collect()));
        }
        self.svg.path(class, &line);
    }

    /// Draws a line with markers: at each of a few points, at some of many unless the curve is alone.
    pub fn curve(
        &mut self,
        look: Look,
        points: impl IntoIterator<Item = Option<[f64; 2]>>,
        alone: bool,
    ) {
        let pixels: Vec<_> = points.into_iter().map(|point| self.at(point?)).collect();
        self.polyline(&look.class("curve"), &pixels);
        let drawn: Vec<[f64; 2]> = pixels.iter().flatten().copied().collect();
        let step = match pixels.len() {
            0..=MARKED => 1,
            _ if alone => return,
            _ => drawn.len().div_ceil(SPARSE).max(1),
        };
        look.markers(self.svg, drawn.into_iter().step_by(step));
    }

    /// Fills the area between two values, interrupted where they are missing.
    pub fn ribbon(&mut self, class: &str, ends: impl IntoIterator<Item = Option<(f64, [f64; 2])>>) {
        let pixels = |end: Option<(f64, [f64; 2])>| {
            let (x, [low, high]) = end?;
            Some([self.at([x, low])?, self.at([x, high])?])
        };
        let pixels: Vec<Option<[[f64; 2]; 2]>> = ends.into_iter().map(pixels).collect();
        let mut area = Path::default();
        for run in pixels.split(Option::is_none) {
            let side = |k: usize| simplify(run.iter().flatten().map(|ends| ends[k]).collect());
            let (low, mut high) = (side(0), side(1));
            high.reverse();
            area.polygon(&[low, high].concat());
        }
        self.svg.path(class, &area);
    }
}

/// A scale that shows 0 and a little more than the range.
pub fn with_zero([low, high]: [f64; 2], pixels: [f64; 2]) -> Scale {
    let [low, high] = [low.min(0.0), high.max(0.0)];
    let high = if low == high { 1.0 } else { high };
    let room = 0.06 * (high - low);
    Scale::linear([if low < 0.0 { low - room } else { 0.0 }, high + room], pixels)
}

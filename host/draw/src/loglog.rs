//! A chart with two logarithmic axes, in which powers are straight lines.

use super::look::Look;
use super::scale::Scale;
use super::svg::{Anchor, Path, Svg};

const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 330.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 428.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 286.0;

/// A chart being drawn.
pub struct LogLog {
    across: Scale,
    up: Scale,
    /// What is drawn so far.
    pub svg: Svg,
}

impl LogLog {
    /// The empty chart of positive ranges, with `quantity` along its horizontal axis.
    pub fn new(label: &str, quantity: &str, across: [f64; 2], up: [f64; 2]) -> Self {
        let across = Scale::logarithmic(across, [LEFT, RIGHT]);
        let up = Scale::logarithmic(up, [BOTTOM, TOP]);
        let mut svg = Svg::new(WIDTH, HEIGHT, label);
        svg.rectangle("frame", [LEFT, TOP], [RIGHT, BOTTOM]);
        upright(&mut svg, &across, [TOP, BOTTOM]);
        for (value, label) in up.ticks(5) {
            let y = up.at(value);
            svg.line("grid", [LEFT, y], [RIGHT, y]);
            svg.text("tick", [LEFT - 8.0, y + 4.0], Anchor::End, &label);
        }
        svg.text("quantity", [RIGHT, BOTTOM + 36.0], Anchor::End, quantity);
        Self { across, up, svg }
    }

    /// The pixel of a point.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.across.at(x), self.up.at(y)]
    }

    /// Draws a curve with a marker at each of its points, in the look of its index.
    pub fn curve(&mut self, index: usize, points: &[[f64; 2]]) {
        self.line(index, points);
        let pixels: Vec<[f64; 2]> = points.iter().map(|&point| self.at(point)).collect();
        Look::of(index).markers(&mut self.svg, &pixels);
    }

    /// Draws a curve without markers.
    pub fn line(&mut self, index: usize, points: &[[f64; 2]]) {
        self.polyline("curve", index, points);
    }

    /// Draws a wide, pale line to lie under others.
    pub fn wide(&mut self, index: usize, points: &[[f64; 2]]) {
        self.polyline("wide", index, points);
    }

    fn polyline(&mut self, class: &str, index: usize, points: &[[f64; 2]]) {
        let pixels: Vec<[f64; 2]> = points.iter().map(|&point| self.at(point)).collect();
        let mut line = Path::default();
        line.line(&pixels);
        self.svg.path(&Look::of(index).class(class), &line);
    }

    /// The finished element.
    pub fn finish(self) -> String {
        self.svg.finish()
    }
}

/// The upright grid lines with their values below.
pub fn upright(svg: &mut Svg, across: &Scale, [top, bottom]: [f64; 2]) {
    for (value, label) in across.ticks(5) {
        let x = across.at(value);
        svg.line("grid", [x, top], [x, bottom]);
        svg.text("tick", [x, bottom + 18.0], Anchor::Middle, &label);
    }
}

/// The pairs that both have a logarithm.
pub fn positive(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    let pairs = x.iter().zip(y).filter(|&(&x, &y)| has_logarithm(x) && has_logarithm(y));
    pairs.map(|(&x, &y)| [x, y]).collect()
}

/// Whether a value has a place on a logarithmic axis.
pub fn has_logarithm(value: f64) -> bool {
    value.is_normal() && value > 0.0
}

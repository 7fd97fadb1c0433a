//! A chart with two logarithmic axes, in which powers are straight lines.

use super::scale::Scale;
use super::svg::{Anchor, Path, Svg};

const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 330.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 428.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 286.0;
/// Looks that the style sheet tells apart; more curves begin again with the first.
pub const LOOKS: usize = 6;
/// Half the width of a marker, roughly.
pub const MARKER: f64 = 3.6;

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
        let look = index % LOOKS;
        let mut markers = Path::default();
        points.iter().for_each(|&point| markers.polygon(&marker(look, self.at(point), MARKER)));
        self.svg.path(&format!("marker series-{look}"), &markers);
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
        self.svg.path(&format!("{class} series-{}", index % LOOKS), &line);
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

/// Square, diamond or triangle, so that colour is not the only difference.
pub fn marker(look: usize, [x, y]: [f64; 2], r: f64) -> Vec<[f64; 2]> {
    let offsets: &[[f64; 2]] = match look % 3 {
        0 => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
        1 => &[[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]],
        _ => &[[0.0, -1.3], [1.2, 0.9], [-1.2, 0.9]],
    };
    offsets.iter().map(|[dx, dy]| [x + r * dx, y + r * dy]).collect()
}

/// The look of a curve by itself, for a legend.
pub fn legend_marker(index: usize) -> String {
    let look = index % LOOKS;
    let mut svg = Svg::new(26.0, 12.0, "");
    svg.line(&format!("curve series-{look}"), [1.0, 6.0], [25.0, 6.0]);
    let mut path = Path::default();
    path.polygon(&marker(look, [13.0, 6.0], MARKER));
    svg.path(&format!("marker series-{look}"), &path);
    svg.finish()
}

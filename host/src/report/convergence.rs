//! Error over mesh width, both logarithmic: error ~ h^p is a straight line of slope p. Below the
//! curves a triangle for each expected rate shows the slope they should have.

use super::ConvergencePlot;
use super::ConvergenceSeries;
use super::scale::{Scale, extent};
use super::svg::{Anchor, Path, Svg};

const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 330.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 428.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 286.0;
/// Looks that the style sheet tells apart; more series begin again with the first.
pub const LOOKS: usize = 6;
const MARKER: f64 = 3.6;

/// Mesh widths with errors, those that a logarithm can show.
fn points(series: &ConvergenceSeries) -> Vec<[f64; 2]> {
    let positive = |value: f64| value.is_normal() && value > 0.0;
    let pairs = series.h.iter().zip(&series.error);
    pairs.filter(|&(&h, &e)| positive(h) && positive(e)).map(|(&h, &e)| [h, e]).collect()
}

/// The exponent p in error ~ h^p: the least-squares slope over all meshes.
pub fn measured_rate(series: &ConvergenceSeries) -> Option<f64> {
    let points: Vec<_> = points(series).iter().map(|point| point.map(f64::ln)).collect();
    let count = points.len() as f64;
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / count;
    let (h, error) = (mean(0), mean(1));
    let sum =
        |f: fn(f64, f64) -> f64| points.iter().map(|p| f(p[0] - h, p[1] - error)).sum::<f64>();
    let rate = sum(|h, error| h * error) / sum(|h, _| h * h);
    rate.is_finite().then_some(rate)
}

/// The log-log picture; `None` without a point to draw.
pub fn convergence(plot: &ConvergencePlot) -> Option<String> {
    let curves: Vec<Vec<[f64; 2]>> = plot.series.iter().map(points).collect();
    let all = || curves.iter().flatten();
    let [fine, coarse] = extent(all().map(|point| point[0]))?;
    let [least, most] = extent(all().map(|point| point[1]))?;
    let across = Scale::logarithmic([fine, coarse], [LEFT, RIGHT]);
    // Below the curves there is room for the slope triangles.
    let up = Scale::logarithmic([least * (least / most).max(1e-2).powf(0.3), most], [BOTTOM, TOP]);
    let at = |[h, error]: [f64; 2]| [across.at(h), up.at(error)];

    let mut svg = Svg::new(WIDTH, HEIGHT, &format!("{}: error over mesh width", plot.title));
    axes(&mut svg, &across, &up);
    let mut heights: Vec<f64> = Vec::new();
    for (rate, corner, width) in slopes(&plot.series) {
        let height = up.at(corner[1]);
        // One on top of another could not be read.
        if heights.iter().all(|other| (other - height).abs() > 30.0) {
            slope_triangle(&mut svg, &at, rate, corner, width);
            heights.push(height);
        }
    }
    for (index, curve) in curves.iter().enumerate() {
        let look = index % LOOKS;
        let pixels: Vec<[f64; 2]> = curve.iter().map(|&point| at(point)).collect();
        let (mut line, mut markers) = (Path::default(), Path::default());
        line.line(&pixels);
        pixels.iter().for_each(|&centre| markers.polygon(&marker(look, centre)));
        svg.path(&format!("curve series-{look}"), &line);
        svg.path(&format!("marker series-{look}"), &markers);
    }
    Some(svg.finish())
}

fn axes(svg: &mut Svg, across: &Scale, up: &Scale) {
    svg.rectangle("frame", [LEFT, TOP], [RIGHT, BOTTOM]);
    for (value, label) in across.ticks(5) {
        let x = across.at(value);
        svg.line("grid", [x, TOP], [x, BOTTOM]);
        svg.text("tick", [x, BOTTOM + 18.0], Anchor::Middle, &label);
    }
    for (value, label) in up.ticks(5) {
        let y = up.at(value);
        svg.line("grid", [LEFT, y], [RIGHT, y]);
        svg.text("tick", [LEFT - 8.0, y + 4.0], Anchor::End, &label);
    }
    svg.text("quantity", [RIGHT, BOTTOM + 36.0], Anchor::End, "mesh width h");
}

/// For each expected rate the finest point of its lowest curve, and the width of the last step.
fn slopes(series: &[ConvergenceSeries]) -> Vec<(f64, [f64; 2], f64)> {
    let mut lowest: Vec<(f64, [f64; 2], f64)> = Vec::new();
    for series in series {
        let [.., [coarse, _], fine] = points(series)[..] else { continue };
        let slope = (series.expected_rate, fine, coarse / fine[0]);
        match lowest.iter_mut().find(|known| known.0 == slope.0) {
            Some(known) if known.1[1] > fine[1] => *known = slope,
            Some(_) => {}
            None => lowest.push(slope),
        }
    }
    lowest
}

/// A right triangle below the finest step of a curve, its longest side as steep as expected.
fn slope_triangle(
    svg: &mut Svg,
    at: &impl Fn([f64; 2]) -> [f64; 2],
    rate: f64,
    [h, error]: [f64; 2],
    ratio: f64,
) {
    let [left, start] = at([h, error]);
    let [right, stop] = at([h * ratio, error * ratio.powf(rate)]);
    let drop = 12.0;
    let mut path = Path::default();
    path.polygon(&[[left, start + drop], [right, start + drop], [right, stop + drop]]);
    svg.path("slope", &path);
    let middle = 0.5 * (start + stop) + drop + 4.0;
    svg.text("slope-label", [right + 5.0, middle], Anchor::Start, &rate_label(rate));
}

/// A rate as theory writes it: 1, 2, 1.5.
pub fn rate_label(rate: f64) -> String {
    if !rate.is_finite() {
        return "–".to_owned();
    }
    let text = format!("{rate:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Square, diamond or triangle, so that colour is not the only difference.
pub(super) fn marker(look: usize, [x, y]: [f64; 2]) -> Vec<[f64; 2]> {
    let r = MARKER;
    let offsets: &[[f64; 2]] = match look % 3 {
        0 => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
        1 => &[[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]],
        _ => &[[0.0, -1.3], [1.2, 0.9], [-1.2, 0.9]],
    };
    offsets.iter().map(|[dx, dy]| [x + r * dx, y + r * dy]).collect()
}

/// The marker of a look by itself, for a legend.
pub fn legend_marker(look: usize) -> String {
    let mut svg = Svg::new(26.0, 12.0, "");
    svg.line(&format!("curve series-{look}"), [1.0, 6.0], [25.0, 6.0]);
    let mut path = Path::default();
    path.polygon(&marker(look, [13.0, 6.0]));
    svg.path(&format!("marker series-{look}"), &path);
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(h: &[f64], error: &[f64]) -> ConvergenceSeries {
        let (h, error) = (h.to_vec(), error.to_vec());
        ConvergenceSeries { label: "test".to_owned(), h, error, expected_rate: 2.0 }
    }

    #[test]
    fn the_rate_is_the_slope_over_all_meshes() {
        let rate = measured_rate(&series(&[0.4, 0.2, 0.1], &[9.0, 4.0, 1.0])).unwrap();
        // The middle one of three equidistant points has no say in the slope.
        assert!((rate - 9f64.ln() / 4f64.ln()).abs() < 1e-14);
        assert_eq!(measured_rate(&series(&[0.1], &[1.0])), None);
        assert_eq!(measured_rate(&series(&[0.1, 0.1], &[1.0, 2.0])), None);
    }

    #[test]
    fn what_has_no_logarithm_is_left_out() {
        let odd = series(&[0.4, 0.2, 0.1, 0.05], &[1.0, 0.0, f64::NAN, 0.5]);
        assert_eq!(points(&odd), [[0.4, 1.0], [0.05, 0.5]]);
        let plot = |series| ConvergencePlot { title: String::new(), series };
        assert!(convergence(&plot(vec![])).is_none());
        assert!(convergence(&plot(vec![series(&[0.1], &[0.0])])).is_none());
        assert!(convergence(&plot(vec![odd])).is_some());
    }

    #[test]
    fn one_triangle_a_rate_under_the_lowest_curve() {
        let upper = series(&[0.2, 0.1], &[4.0, 1.0]);
        let lower = series(&[0.2, 0.1], &[0.4, 0.1]);
        assert_eq!(slopes(&[upper, lower]), [(2.0, [0.1, 0.1], 2.0)]);
    }
}

//! Error over mesh width, both logarithmic: error ~ h^p is a straight line of slope p. Below the
//! curves a triangle for each expected rate shows the slope they should have.

use super::ConvergencePlot;
use super::ConvergenceSeries;
use super::loglog::{LogLog, positive};
use super::scale::extent;
use super::svg::{Anchor, Path};

/// Mesh widths with errors, those that a logarithm can show.
fn points(series: &ConvergenceSeries) -> Vec<[f64; 2]> {
    positive(&series.h, &series.error)
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
    // Below the curves there is room for the slope triangles.
    let up = [least * (least / most).max(1e-2).powf(0.3), most];
    let label = format!("{}: error over mesh width", plot.title);
    let mut chart = LogLog::new(&label, "mesh width h", [fine, coarse], up);
    let mut heights: Vec<f64> = Vec::new();
    for (rate, corner, width) in slopes(&plot.series) {
        let [_, height] = chart.at(corner);
        // One on top of another could not be read.
        if heights.iter().all(|other| (other - height).abs() > 30.0) {
            slope_triangle(&mut chart, rate, corner, width);
            heights.push(height);
        }
    }
    for (index, curve) in curves.iter().enumerate() {
        chart.curve(index, curve);
    }
    Some(chart.finish())
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
fn slope_triangle(chart: &mut LogLog, rate: f64, [h, error]: [f64; 2], ratio: f64) {
    let [left, start] = chart.at([h, error]);
    let [right, stop] = chart.at([h * ratio, error * ratio.powf(rate)]);
    let drop = 12.0;
    let mut path = Path::default();
    path.polygon(&[[left, start + drop], [right, start + drop], [right, stop + drop]]);
    chart.svg.path("slope", &path);
    let middle = 0.5 * (start + stop) + drop + 4.0;
    chart.svg.text("slope-label", [right + 5.0, middle], Anchor::Start, &rate_label(rate));
}

/// A rate as theory writes it: 1, 2, 1.5.
pub fn rate_label(rate: f64) -> String {
    if !rate.is_finite() {
        return "–".to_owned();
    }
    let text = format!("{rate:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::draw::SLOPE;

    fn series(h: &[f64], error: &[f64]) -> ConvergenceSeries {
        let (h, error) = (h.to_vec(), error.to_vec());
        ConvergenceSeries { label: "test".to_owned(), h, error, expected_rate: 2.0 }
    }

    #[test]
    fn the_rate_is_the_slope_over_all_meshes() {
        let rate = measured_rate(&series(&[0.4, 0.2, 0.1], &[9.0, 4.0, 1.0])).unwrap();
        // The middle one of three equidistant points has no say in the slope.
        SLOPE.check("three meshes", rate - 9f64.ln() / 4f64.ln());
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

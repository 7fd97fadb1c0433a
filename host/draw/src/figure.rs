//! A chart with two logarithmic axes, in which powers are straight lines, above a legend: a name and a note per
//! curve, beside the look it is drawn in.
//!
//! Where value ~ at^p is expected, a triangle below the curves shows the slope p that they should have.

use std::fmt::Write;

use super::axes::Axes;
use super::chart::{Chart, Curve};
use super::look::Look;
use super::scale::{Scale, extent, has_logarithm};
use super::svg::{Anchor, Path, Svg, escape};

const SIZE: [f64; 2] = [440.0, 330.0];
const ACROSS: [f64; 2] = [58.0, 428.0];
const UP: [f64; 2] = [286.0, 12.0];

/// The figure of a chart's only strip; `None` without a point to draw.
pub fn figure(chart: &Chart) -> Option<String> {
    let (picture, mut legend) = (picture(chart)?, String::new());
    for (index, curve) in chart.strips.iter().flat_map(|strip| &strip.curves).enumerate() {
        let note = curve.expected_rate.map_or_else(String::new, |expected| {
            let rate = measured_rate(&chart.at, &curve.values);
            let rate = rate.map_or("–".to_owned(), |rate| format!("{rate:.2}"));
            format!("<em>rate {rate}, expected {}</em>", rate_label(expected))
        });
        let (key, label) = (Look::of(index).key(), escape(&curve.label));
        let _ = writeln!(legend, "<li>{key}<span>{label}</span>{note}</li>");
    }
    let title = escape(&chart.title);
    Some(format!(
        "<figure class=\"card\">\n<h3>{title}</h3>\n{picture}<ul class=\"series\">\n{legend}</ul>\n\
         </figure>\n"
    ))
}

fn picture(chart: &Chart) -> Option<String> {
    let strip = chart.strips.first()?;
    let points = strip.curves.iter().map(|curve| points(&chart.at, &curve.values));
    let points: Vec<Vec<[f64; 2]>> = points.collect();
    let range = |axis: usize| extent(points.iter().flatten().map(|point| point[axis]));
    let [least, most] = range(1)?;
    let floor = strip.depth.map_or(least, |depth| least.max(depth * most));
    let slopes = slopes(&strip.curves, &points);
    // Below the curves there is room for the slope triangles.
    let room = if slopes.is_empty() { 1.0 } else { (least / most).max(1e-2).powf(0.3) };
    let label = format!("{}: over {}", chart.title, chart.across);
    let mut svg = Svg::new(SIZE[0], SIZE[1], &label);
    let across = Scale::logarithmic(range(0)?, ACROSS);
    let up = Scale::logarithmic([floor * room, most], UP);
    let mut axes = Axes { svg: &mut svg, across, up };
    axes.frame();
    axes.columns(5);
    axes.levels(5, |_, label| label);
    axes.feet(5, &chart.across);
    slope_triangles(&mut axes, &slopes);
    for (index, (curve, points)) in strip.curves.iter().zip(&points).enumerate() {
        let look = Look::of(index);
        let (shown, leaving) = above(points, floor);
        if curve.wide {
            axes.line(&look.class("wide"), [shown, &leaving].concat().into_iter().map(Some));
        }
        axes.curve(look, shown.iter().copied().map(Some), false);
        axes.line(&look.class("curve"), leaving.into_iter().map(Some));
    }
    Some(svg.finish())
}

/// The pairs of which both have a logarithm.
fn points(at: &[f64], values: &[Option<f64>]) -> Vec<[f64; 2]> {
    let pairs = at.iter().zip(values).filter_map(|(&x, &value)| Some([x, value?]));
    pairs.filter(|point| point.iter().copied().all(has_logarithm)).collect()
}

/// The exponent p in value ~ at^p: the least-squares slope over all points.
pub fn measured_rate(at: &[f64], values: &[Option<f64>]) -> Option<f64> {
    let points: Vec<_> = points(at, values).iter().map(|point| point.map(f64::ln)).collect();
    let count = points.len() as f64;
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / count;
    let (h, error) = (mean(0), mean(1));
    let sum =
        |f: fn(f64, f64) -> f64| points.iter().map(|p| f(p[0] - h, p[1] - error)).sum::<f64>();
    let rate = sum(|h, error| h * error) / sum(|h, _| h * h);
    rate.is_finite().then_some(rate)
}

/// The points down to the first one below `floor`, and the line along which the curve leaves there.
fn above(curve: &[[f64; 2]], floor: f64) -> (&[[f64; 2]], Vec<[f64; 2]>) {
    let count = curve.iter().take_while(|point| point[1] >= floor).count();
    let (shown, hidden) = curve.split_at(count);
    let (Some(&last), Some(&next)) = (shown.last(), hidden.first()) else {
        return (shown, Vec::new());
    };
    let part = (last[1] / floor).ln() / (last[1] / next[1]).ln();
    let leaving = [last[0] * (next[0] / last[0]).powf(part), floor];
    (shown, vec![last, leaving])
}

/// For each expected rate the finest point of its lowest curve, and the ratio of its last step.
fn slopes(curves: &[Curve], points: &[Vec<[f64; 2]>]) -> Vec<(f64, [f64; 2], f64)> {
    let mut lowest: Vec<(f64, [f64; 2], f64)> = Vec::new();
    for (curve, points) in curves.iter().zip(points) {
        let (Some(rate), [.., [coarse, _], fine]) = (curve.expected_rate, &points[..]) else {
            continue;
        };
        let slope = (rate, *fine, coarse / fine[0]);
        match lowest.iter_mut().find(|known| known.0 == rate) {
            Some(known) if known.1[1] > fine[1] => *known = slope,
            Some(_) => {}
            None => lowest.push(slope),
        }
    }
    lowest
}

/// Draws a right triangle below the finest step of each curve, its longest side as steep as expected.
fn slope_triangles(axes: &mut Axes, slopes: &[(f64, [f64; 2], f64)]) {
    const DROP: f64 = 12.0;
    let mut heights: Vec<f64> = Vec::new();
    for &(rate, [h, error], ratio) in slopes {
        let at = |[h, error]: [f64; 2]| [axes.across.at(h), axes.up.at(error)];
        let [left, start] = at([h, error]);
        let [right, stop] = at([h * ratio, error * ratio.powf(rate)]);
        // One on top of another could not be read.
        if heights.iter().any(|other| (other - start).abs() <= 30.0) {
            continue;
        }
        heights.push(start);
        let corners = [[left, start + DROP], [right, start + DROP], [right, stop + DROP]];
        axes.svg.path("slope", &Path::around(&corners));
        let middle = [right + 5.0, 0.5 * (start + stop) + DROP + 4.0];
        axes.svg.text("slope-label", middle, Anchor::Start, &rate_label(rate));
    }
}

/// A rate as theory writes it: 1, 2, 1.5.
fn rate_label(rate: f64) -> String {
    if !rate.is_finite() {
        return "–".to_owned();
    }
    let text = format!("{rate:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::super::chart::Strip;
    use super::*;
    use signorini_tolerances::draw::{POSITION, SLOPE};

    fn curve(values: &[f64]) -> Curve {
        let values = values.iter().copied().map(Some).collect();
        Curve { values, expected_rate: Some(2.0), ..Curve::default() }
    }

    fn rate(at: &[f64], values: &[f64]) -> Option<f64> {
        measured_rate(at, &curve(values).values)
    }

    #[test]
    fn the_rate_is_the_slope_over_all_meshes() {
        let found = rate(&[0.4, 0.2, 0.1], &[9.0, 4.0, 1.0]).unwrap();
        // The middle one of three equidistant points has no say in the slope.
        SLOPE.check("three meshes", found - 9f64.ln() / 4f64.ln());
        assert_eq!(rate(&[0.1], &[1.0]), None);
        assert_eq!(rate(&[0.1, 0.1], &[1.0, 2.0]), None);
    }

    #[test]
    fn what_has_no_logarithm_is_left_out() {
        let (at, odd) = (vec![0.4, 0.2, 0.1, 0.05], curve(&[1.0, 0.0, f64::NAN, 0.5]));
        assert_eq!(points(&at, &odd.values), [[0.4, 1.0], [0.05, 0.5]]);
        let plot = |curves| {
            let strips = vec![Strip { curves, ..Strip::default() }];
            figure(&Chart { at: at.clone(), strips, ..Chart::default() })
        };
        assert!(figure(&Chart::default()).is_none() && plot(vec![]).is_none());
        assert!(plot(vec![curve(&[0.0])]).is_none());
        assert!(plot(vec![odd]).is_some());
    }

    #[test]
    fn one_triangle_a_rate_under_the_lowest_curve() {
        let curves = [curve(&[4.0, 1.0]), curve(&[0.4, 0.1])];
        let points = curves.each_ref().map(|curve| points(&[0.2, 0.1], &curve.values));
        assert_eq!(slopes(&curves, &points), [(2.0, [0.1, 0.1], 2.0)]);
    }

    #[test]
    fn a_curve_leaves_at_the_bottom() {
        let curve = [[1.0, 1.0], [10.0, 1e-2], [1000.0, 1e-6], [1e4, 1.0]];
        let (shown, leaving) = above(&curve, 1e-4);
        assert_eq!(shown, &curve[..2]);
        assert_eq!(leaving[1][1], 1e-4);
        POSITION.check("where it leaves", leaving[1][0] - 100.0);
        assert_eq!(above(&curve[..2], 1e-2), (&curve[..2], Vec::new()));
        assert!(above(&curve[2..3], 1e-4).0.is_empty());
    }
}

//! Curves over one quantity: a chart, whose strips stand on top of each other over the same axis.

use super::axes::{Axes, with_zero};
use super::lettering::{shortened, width};
use super::look::Look;
use super::scale::{Scale, extent};
use super::svg::{Anchor, Svg};

/// Curves over one quantity: time, the width of a mesh, sweeps.
#[derive(Debug, Clone, Default)]
pub struct Chart {
    /// The heading.
    pub title: String,
    /// The quantity along the horizontal axis.
    pub across: String,
    /// Its values, in order: every curve has one for each.
    pub at: Vec<f64>,
    /// The diagrams.
    pub strips: Vec<Strip>,
}

/// One diagram of a chart.
#[derive(Debug, Clone, Default)]
pub struct Strip {
    /// The curves in it.
    pub curves: Vec<Curve>,
    /// Whether its vertical axis is logarithmic.
    pub logarithmic: bool,
    /// A value that should not be exceeded, and what to call it.
    pub limit: Option<(String, f64)>,
    /// Where the exact value of the first curve is known to lie.
    pub band: Option<Band>,
    /// Smaller values, as parts of the largest, are out of sight below.
    pub depth: Option<f64>,
}

/// An interval at each value of the horizontal axis.
#[derive(Debug, Clone, Default)]
pub struct Band {
    /// Its name.
    pub label: String,
    /// The least and the largest value, where they are known.
    pub ends: Vec<Option<[f64; 2]>>,
}

/// One quantity of a chart.
#[derive(Debug, Clone, Default)]
pub struct Curve {
    /// Its name.
    pub label: String,
    /// Its values, where there are any.
    pub values: Vec<Option<f64>>,
    /// The exponent p that theory gives in value ~ at^p.
    pub expected_rate: Option<f64>,
    /// Whether a wide, pale line lies under it, so that others that lie on it can be seen.
    pub wide: bool,
}

const SIDES: [f64; 2] = [66.0, 736.0];
const WIDTH: f64 = SIDES[1] + 24.0;
/// Top of the first diagram, height of each, and from one to the next.
const TOP: f64 = 66.0;
const HEIGHT: f64 = 96.0;
const STEP: f64 = 136.0;
/// Below the last diagram: its axis.
const FOOT: f64 = 48.0;
/// From one entry of a legend to the next, at most, and the part of it that its marker takes.
const ENTRY: f64 = 120.0;
const KEY: f64 = 14.0;
/// Size of the letters of its names.
const LETTERS: f64 = 11.5;

/// A chart over a linear axis as a file of its own; diagrams without a value to show are left out.
pub fn chart_file(chart: &Chart) -> String {
    let shown: Vec<&Strip> = chart.strips.iter().filter(|strip| range(strip).is_some()).collect();
    let bottom = TOP + STEP * shown.len() as f64 - (STEP - HEIGHT);
    let label = format!("{}: over {}", chart.title, chart.across);
    let mut svg = Svg::alone(WIDTH, bottom + FOOT, &label);
    svg.text("title", [18.0, 28.0], Anchor::Start, &chart.title);
    let across = Scale::linear(extent(chart.at.iter().copied()).unwrap_or_default(), SIDES);
    for (at, strip) in shown.iter().enumerate() {
        let top = TOP + STEP * at as f64;
        let up = upwards(strip, [top + HEIGHT, top]);
        draw(&mut Axes { svg: &mut svg, across, up }, strip, &chart.at);
    }
    let up = Scale::linear([0.0, 1.0], [bottom, TOP]);
    Axes { svg: &mut svg, across, up }.feet(6, &chart.across);
    svg.finish()
}

/// The values that a diagram can show.
fn values(strip: &Strip) -> impl Iterator<Item = f64> {
    let values = strip.curves.iter().flat_map(|curve| curve.values.iter().flatten().copied());
    let ends = strip.band.iter().flat_map(|band| band.ends.iter().flatten().flatten().copied());
    let values = values.chain(ends);
    values.filter(|&value| value.is_finite() && (value > 0.0 || !strip.logarithmic))
}

fn range(strip: &Strip) -> Option<[f64; 2]> {
    let limit = strip.limit.iter().map(|(_, value)| *value);
    extent(values(strip)).and_then(|range| extent(range.into_iter().chain(limit)))
}

/// The vertical axis. 0 is in sight unless that would flatten what changes.
fn upwards(strip: &Strip, pixels: [f64; 2]) -> Scale {
    let [low, high] = range(strip).unwrap_or_default();
    let change = high - low;
    if strip.logarithmic {
        Scale::logarithmic([low, high], pixels)
    } else if change > 0.0 && change < 0.5 * low.abs().min(high.abs()) {
        Scale::linear([low - 0.06 * change, high + 0.06 * change], pixels)
    } else {
        with_zero([low, high], pixels)
    }
}

fn draw(axes: &mut Axes, strip: &Strip, at: &[f64]) {
    let ([left, right], [bottom, top]) = (SIDES, axes.up.pixels());
    axes.columns(6);
    axes.levels(4, |_, label| label);
    axes.svg.line("frame", [left, bottom], [right, bottom]);
    let over = || at.iter().copied();
    if let Some(band) = &strip.band {
        axes.ribbon("band", over().zip(&band.ends).map(|(x, &ends)| Some((x, ends?))));
    }
    let shown = |curve: &&Curve| curve.values.iter().any(Option::is_some);
    let curves: Vec<&Curve> = strip.curves.iter().filter(shown).collect();
    for (index, curve) in curves.iter().enumerate() {
        let points = over().zip(&curve.values).map(|(x, &value)| Some([x, value?]));
        axes.curve(Look::beside_limits(index), points, curves.len() == 1);
    }
    let limit = strip.limit.iter().map(|(name, _)| width(name, LETTERS) + KEY).sum::<f64>();
    legend(axes, &curves, right - limit);
    if let Some(band) = &strip.band {
        let left = right - width(&band.label, LETTERS) - KEY;
        axes.svg.rectangle("band", [left, top - 17.0], [left + 10.0, top - 7.0]);
        axes.svg.text("band-label", [right, top - 8.0], Anchor::End, &band.label);
    }
    if let Some((name, value)) = &strip.limit {
        let y = axes.up.at(*value);
        axes.svg.line("limit", [left, y], [right, y]);
        axes.svg.text("limit-label", [right, top - 8.0], Anchor::End, name);
    }
}

/// Says what the diagram shows: its only curve by name, more of them with their markers.
fn legend(axes: &mut Axes, curves: &[&Curve], end: f64) {
    if let [curve] = curves {
        return axes.heading(&curve.label);
    }
    let top = axes.up.pixels()[1];
    let entry = ENTRY.min((end - SIDES[0]) / curves.len() as f64);
    for (at, curve) in curves.iter().enumerate() {
        let left = SIDES[0] + entry * at as f64;
        Look::beside_limits(at).markers(axes.svg, [[left + 4.0, top - 12.0]]);
        let text = shortened(&curve.label, LETTERS, entry - KEY - 4.0);
        let place = [left + KEY, top - 8.0];
        axes.svg.abridged("quantity", place, Anchor::Start, &text, &curve.label);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strip(values: &[Option<f64>], logarithmic: bool) -> Strip {
        let (label, values) = ("a < b".to_owned(), values.to_vec());
        let curve = Curve { label, values, ..Curve::default() };
        Strip { curves: vec![curve], logarithmic, ..Strip::default() }
    }

    fn drawn(strips: Vec<Strip>) -> String {
        let (title, at) = ("levee & rain".to_owned(), vec![0.0, 1.0, 2.0]);
        chart_file(&Chart { title, at, strips, ..Chart::default() })
    }

    #[test]
    fn what_has_no_value_is_left_out() {
        let missing = [None, Some(f64::NAN), Some(f64::INFINITY)];
        assert!(range(&strip(&missing, false)).is_none());
        assert!(range(&strip(&[Some(0.0), Some(-1.0)], true)).is_none());
        let picture =
            drawn(vec![strip(&missing, false), strip(&[Some(1.0), None, Some(2.0)], true)]);
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
        assert_eq!(picture.matches("a &lt; b").count(), 1);
        assert!(drawn(Vec::new()).ends_with("</svg>\n"));
    }

    #[test]
    fn zero_is_in_sight_unless_it_flattens_the_curve() {
        let at_zero =
            |low, high| upwards(&strip(&[Some(low), Some(high)], false), [100.0, 0.0]).at(0.0);
        assert_eq!(at_zero(1.0, 4.0), 100.0);
        assert!(at_zero(100.0, 101.0) > 1000.0);
        assert!((0.0..=100.0).contains(&at_zero(0.0, 0.0)));
    }

    #[test]
    fn a_million_ticks_are_a_picture_of_a_page() {
        let at: Vec<f64> = (0..1_000_000).map(f64::from).collect();
        let values = at.iter().map(|t| Some((t / 1e5).sin())).collect();
        let curves = vec![Curve { values, ..Curve::default() }];
        let strips = vec![Strip { curves, ..Strip::default() }];
        let picture = chart_file(&Chart { at, strips, ..Chart::default() });
        assert!(picture.len() < 40_000, "{}", picture.len());
    }
}

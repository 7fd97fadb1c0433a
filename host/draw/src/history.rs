//! What changes from tick to tick: a diagram a quantity, on top of each other over the same time, as a
//! picture that stands by itself.

use super::frame::STYLE;
use super::lettering::{shortened, width};
use super::look::Look;
use super::scale::{Scale, extent};
use super::simplify::simplify;
use super::strip::{across, frame, heading, vertical};
use super::svg::{Anchor, Path, Svg};
use super::{Band, Curve, History, Strip};

const LEFT: f64 = 66.0;
const RIGHT: f64 = 736.0;
const WIDTH: f64 = RIGHT + 24.0;
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
/// Each tick has a marker on curves that are no longer than this.
const MARKED: usize = 64;
/// On longer ones so many ticks have one, where there is another curve to tell apart.
const SPARSE: usize = 12;

/// The picture; diagrams without a value to show are left out.
pub fn history(history: &History) -> String {
    let shown: Vec<&Strip> = history.strips.iter().filter(|strip| range(strip).is_some()).collect();
    let bottom = TOP + STEP * shown.len() as f64 - (STEP - HEIGHT);
    let mut svg = Svg::new(WIDTH, bottom + FOOT, &format!("{}: over time", history.title));
    svg.style(STYLE);
    svg.rectangle("sheet", [0.0, 0.0], [WIDTH, bottom + FOOT]);
    svg.text("title", [18.0, 28.0], Anchor::Start, &history.title);
    let time = extent(history.time.iter().copied()).unwrap_or_default();
    let along = Scale::linear(time, [LEFT, RIGHT]);
    for (at, strip) in shown.iter().enumerate() {
        let top = TOP + STEP * at as f64;
        draw(&mut svg, strip, &history.time, &along, [top, top + HEIGHT]);
    }
    across(&mut svg, &along, [RIGHT, bottom], "t");
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
fn upwards(strip: &Strip, [top, bottom]: [f64; 2]) -> Scale {
    let [low, high] = range(strip).unwrap_or_default();
    let change = high - low;
    if strip.logarithmic {
        Scale::logarithmic([low, high], [bottom, top])
    } else if change > 0.0 && change < 0.5 * low.abs().min(high.abs()) {
        Scale::linear([low - 0.06 * change, high + 0.06 * change], [bottom, top])
    } else {
        vertical([low, high], [top, bottom])
    }
}

fn draw(svg: &mut Svg, strip: &Strip, time: &[f64], along: &Scale, [top, bottom]: [f64; 2]) {
    let up = upwards(strip, [top, bottom]);
    for (time, _) in along.ticks(6) {
        svg.line("grid", [along.at(time), top], [along.at(time), bottom]);
    }
    frame(svg, &up, 4, [LEFT, RIGHT], [top, bottom]);
    svg.line("frame", [LEFT, bottom], [RIGHT, bottom]);
    if let Some(band) = &strip.band {
        draw_band(svg, band, time, [along, &up]);
    }
    let shown = |curve: &&Curve| curve.values.iter().any(Option::is_some);
    let curves: Vec<&Curve> = strip.curves.iter().filter(shown).collect();
    for (at, curve) in curves.iter().enumerate() {
        let look = Look::beside_limits(at);
        let pixels = draw_curve(svg, curve, time, [along, &up], look);
        look.markers(svg, &marked(&pixels, curves.len()));
    }
    let limit = strip.limit.iter().map(|(name, _)| width(name, LETTERS) + KEY).sum::<f64>();
    legend(svg, &curves, [LEFT, RIGHT - limit], top);
    if let Some(band) = &strip.band {
        let left = RIGHT - width(&band.label, LETTERS) - KEY;
        svg.rectangle("band", [left, top - 17.0], [left + 10.0, top - 7.0]);
        svg.text("band-label", [RIGHT, top - 8.0], Anchor::End, &band.label);
    }
    if let Some((name, value)) = &strip.limit {
        let y = up.at(*value);
        svg.line("limit", [LEFT, y], [RIGHT, y]);
        svg.text("limit-label", [RIGHT, top - 8.0], Anchor::End, name);
    }
}

/// What the diagram shows: its only curve by name, more of them with their markers.
fn legend(svg: &mut Svg, curves: &[&Curve], [start, end]: [f64; 2], top: f64) {
    if let [curve] = curves {
        return heading(svg, start, top, &curve.label);
    }
    let entry = ENTRY.min((end - start) / curves.len() as f64);
    for (at, curve) in curves.iter().enumerate() {
        let left = start + entry * at as f64;
        Look::beside_limits(at).markers(svg, &[[left + 4.0, top - 12.0]]);
        let text = shortened(&curve.label, LETTERS, entry - KEY - 4.0);
        let place = [left + KEY, top - 8.0];
        svg.abridged("quantity", place, Anchor::Start, &text, &curve.label);
    }
}

/// The area between the ends, interrupted where there are none.
fn draw_band(svg: &mut Svg, band: &Band, time: &[f64], [along, up]: [&Scale; 2]) {
    let at = |(time, ends): (&f64, &Option<[f64; 2]>)| {
        let [low, high] = (*ends)?.map(|end| [along.at(*time), up.at(end)]);
        [low, high].as_flattened().iter().all(|pixel| pixel.is_finite()).then_some([low, high])
    };
    let points: Vec<Option<[[f64; 2]; 2]>> = time.iter().zip(&band.ends).map(at).collect();
    let mut area = Path::default();
    for run in points.split(Option::is_none) {
        let side = |k: usize| simplify(run.iter().flatten().map(|ends| ends[k]).collect());
        let (low, mut high) = (side(0), side(1));
        high.reverse();
        area.polygon(&[low, high].concat());
    }
    svg.path("band", &area);
}

/// The curve, interrupted where it has no value; the pixels of its ticks.
fn draw_curve(
    svg: &mut Svg,
    curve: &Curve,
    time: &[f64],
    [along, up]: [&Scale; 2],
    look: Look,
) -> Vec<Option<[f64; 2]>> {
    let at = |(time, value): (&f64, &Option<f64>)| {
        let point = [along.at(*time), up.at((*value)?)];
        point.iter().all(|pixel| pixel.is_finite()).then_some(point)
    };
    let points: Vec<Option<[f64; 2]>> = time.iter().zip(&curve.values).map(at).collect();
    let mut line = Path::default();
    for run in points.split(Option::is_none) {
        line.line(&simplify(run.iter().flatten().copied().collect()));
    }
    svg.path(&look.class("curve"), &line);
    points
}

/// The ticks that have a marker: all of a short curve, a few of a long one that is not alone.
fn marked(ticks: &[Option<[f64; 2]>], curves: usize) -> Vec<[f64; 2]> {
    let drawn: Vec<[f64; 2]> = ticks.iter().flatten().copied().collect();
    match ticks.len() {
        0..=MARKED => drawn,
        _ if curves == 1 => Vec::new(),
        _ => drawn.iter().copied().step_by(drawn.len().div_ceil(SPARSE).max(1)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strip(values: &[Option<f64>], logarithmic: bool) -> Strip {
        let curve = Curve { label: "a < b".to_owned(), values: values.to_vec() };
        Strip { curves: vec![curve], logarithmic, ..Strip::default() }
    }

    fn drawn(strips: Vec<Strip>) -> String {
        history(&History { title: "levee & rain".to_owned(), time: vec![0.0, 1.0, 2.0], strips })
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
            |low, high| upwards(&strip(&[Some(low), Some(high)], false), [0.0, 100.0]).at(0.0);
        assert_eq!(at_zero(1.0, 4.0), 100.0);
        assert!(at_zero(100.0, 101.0) > 1000.0);
        assert!((0.0..=100.0).contains(&at_zero(0.0, 0.0)));
    }

    #[test]
    fn a_million_ticks_are_a_picture_of_a_page() {
        let time: Vec<f64> = (0..1_000_000).map(f64::from).collect();
        let values = time.iter().map(|t| Some((t / 1e5).sin())).collect();
        let curves = vec![Curve { label: String::new(), values }];
        let strips = vec![Strip { curves, ..Strip::default() }];
        let picture = history(&History { title: String::new(), time, strips });
        assert!(picture.len() < 40_000, "{}", picture.len());
    }
}

//! Error over cost, both logarithmic: every setting a marker, the Pareto front a stair below and left of
//! which nothing was found, its points named, and above them how much error is certified.

mod key;
mod layout;

use super::axes::Axes;
use super::look::{Look, MARKER};
use super::scale::{Scale, has_logarithm};
use super::svg::{Anchor, Path, Svg, circle};
use layout::Layout;

/// Settings measured, as points of cost and error.
#[derive(Debug, Clone, Default)]
pub struct ParetoPlot {
    /// The heading.
    pub title: String,
    /// Name of the cost, with its unit.
    pub cost: String,
    /// The size of the solution, which makes percents of errors; 0 where there is none.
    pub size: f64,
    /// Name of each group of points, which share colour and marker.
    pub series: Vec<String>,
    /// The settings.
    pub points: Vec<ParetoPoint>,
}

/// One setting.
#[derive(Debug, Clone, Default)]
pub struct ParetoPoint {
    /// Its name, written beside it on the front.
    pub name: String,
    /// Shown where it is pointed at.
    pub note: String,
    /// Cost of a tick.
    pub cost: f64,
    /// How wrong it is.
    pub error: f64,
    /// How wrong it is certified to be at most.
    pub bound: Option<f64>,
    /// Its place in [`ParetoPlot::series`].
    pub series: usize,
    /// Nothing else is better in both.
    pub front: bool,
    /// The one to take.
    pub recommended: bool,
}

const WIDTH: f64 = 880.0;
const LEFT: f64 = 66.0;
const RIGHT: f64 = 810.0;
/// Name of the error, with its weight.
const ERROR: &str = "gradient error of u, weighed by A (energy norm ‖A^½∇(u − u_h)‖)";
/// Size of the letters of names.
const LETTERS: f64 = 11.5;

/// The picture for a page; `None` without a point to draw.
pub fn pareto(plot: &ParetoPlot) -> Option<String> {
    draw(plot, Svg::new)
}

/// The picture as a file of its own.
pub fn pareto_file(plot: &ParetoPlot) -> String {
    draw(plot, Svg::alone).unwrap_or_else(|| {
        let mut svg = Svg::alone(WIDTH, 80.0, &plot.title);
        key::title(&mut svg, &plot.title);
        svg.text("quantity", [LEFT, 56.0], Anchor::Start, "no setting with a cost and an error");
        svg.finish()
    })
}

fn draw(plot: &ParetoPlot, begin: fn(f64, f64, &str) -> Svg) -> Option<String> {
    let shown = shown(&plot.points);
    let keys = key::keys(plot, &shown);
    let top = key::bottom(&keys) + 34.0;
    let layout = Layout::new(&shown, top)?;
    let label = format!("{}: error over cost", plot.title);
    let mut svg = begin(WIDTH, layout.bottom + 46.0, &label);
    key::title(&mut svg, &plot.title);
    key::draw(&mut svg, &keys);
    axes(&mut svg, plot, &layout);
    stair(&mut svg, &layout, &shown);
    points(&mut svg, &layout, &shown);
    for (point, name) in front(&shown).zip(&layout.names) {
        let at = [name.end[0], name.end[1] + 4.0];
        svg.abridged("name", at, Anchor::End, &name.text, &point.name);
    }
    Some(svg.finish())
}

/// The points that both axes can show, in the order of their cost, from the worse.
fn shown(points: &[ParetoPoint]) -> Vec<&ParetoPoint> {
    let drawable = |point: &&ParetoPoint| has_logarithm(point.cost) && has_logarithm(point.error);
    let mut shown: Vec<&ParetoPoint> = points.iter().filter(drawable).collect();
    shown.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(b.error.total_cmp(&a.error)));
    shown
}

fn front<'p>(shown: &[&'p ParetoPoint]) -> impl Iterator<Item = &'p ParetoPoint> {
    shown.iter().copied().filter(|point| point.front)
}

/// Bounds are drawn where they are asked for: on the front.
fn drawn_bound(point: &ParetoPoint) -> Option<f64> {
    point.bound.filter(|&bound| (point.front || point.recommended) && has_logarithm(bound))
}

/// Draws cost along the bottom, the error in percent at the left and as it is at the right.
fn axes(svg: &mut Svg, plot: &ParetoPlot, layout: &Layout) {
    let percent = layout.range.map(|error| 100.0 * error / plot.size);
    let relative = percent.iter().copied().all(has_logarithm);
    let up = if relative { Scale::logarithmic(percent, layout.up.pixels()) } else { layout.up };
    let mut axes = Axes { svg, across: layout.across, up };
    axes.frame();
    axes.columns(5);
    axes.levels(5, |value, label| match relative {
        true => format!("{} %", decimals(value, label)),
        false => label,
    });
    axes.feet(5, &plot.cost);
    axes.heading(&format!("{ERROR}{}", if relative { ", of the solution’s" } else { "" }));
    if relative {
        for (value, label) in layout.up.ticks(5) {
            let y = layout.up.at(value);
            svg.line("axis", [RIGHT, y], [RIGHT + 4.0, y]);
            svg.text("tick", [RIGHT + 8.0, y + 4.0], Anchor::Start, &label);
        }
        let place = [WIDTH - 12.0, layout.top - 8.0];
        svg.text("quantity", place, Anchor::End, "in units of the scene");
    }
}

/// A percentage in plain decimals where that is short.
fn decimals(value: f64, label: String) -> String {
    let places = -(value.log10() + 1e-9).floor();
    match places {
        -3.0..=0.0 => format!("{value:.0}"),
        1.0..=3.0 => format!("{value:.*}", places as usize),
        _ => label,
    }
}

/// From the cheapest point of the front down its steps, and on to the right.
fn stair(svg: &mut Svg, layout: &Layout, shown: &[&ParetoPoint]) {
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for point in front(shown) {
        let [x, y] = layout.at(point);
        corners.extend(corners.last().map(|before| [x, before[1]]));
        corners.push([x, y]);
    }
    corners.extend(corners.last().map(|before| [RIGHT, before[1]]));
    svg.path("stair", &Path::through(&corners));
}

/// The markers, those of the front above the others; bounds, leaders to names and the ring.
fn points(svg: &mut Svg, layout: &Layout, shown: &[&ParetoPoint]) {
    for point in shown.iter().filter(|point| !point.front) {
        mark(svg, layout, point, "marker dominated", 0.75 * MARKER);
    }
    for (point, name) in front(shown).zip(&layout.names) {
        let at = layout.at(point);
        if name.end[1] - at[1] > 4.0 {
            svg.line("leader", [name.end[0] + 2.0, name.end[1]], at);
        }
    }
    for point in shown {
        let [x, y] = layout.at(point);
        if let Some(bound) = drawn_bound(point) {
            let height = layout.up.at(bound);
            svg.line("bound-line", [x, y], [x, height]);
            svg.line("bound-cap", [x - 5.0, height], [x + 5.0, height]);
        }
    }
    for point in front(shown) {
        mark(svg, layout, point, "marker", 1.15 * MARKER);
    }
    for point in shown.iter().filter(|point| point.recommended) {
        svg.path("ring", &Path::around(&circle(layout.at(point), 8.5)));
    }
}

fn mark(svg: &mut Svg, layout: &Layout, point: &ParetoPoint, class: &str, radius: f64) {
    let look = Look::of(point.series);
    let path = Path::around(&look.marker(layout.at(point), radius));
    let words = format!("{}: {}", point.name, point.note);
    svg.explained(&look.class(class), &path, &words);
}

//! How the curves of one plot are told apart: each has a colour and a marker, and no other has both.
//!
//! ```text
//! index    0       1        2         3       4      5       6        7         8    …  29   30
//! colour   0       1        2         3       4      5       0        1         2        5   0
//! shape  square diamond triangle circle cross square diamond triangle circle … cross square
//! ```
//! Both advance by one from curve to curve. Six and five share no factor, so all thirty pairs come before
//! the first returns.

use super::svg::{Path, Svg};

/// Colours that the style sheet knows as `series-0`, `series-1`, …
const COLORS: usize = 6;
/// Shapes that [`Look::marker`] knows.
const SHAPES: usize = 5;
/// The colour that limits are drawn in as well.
const OF_LIMITS: usize = 1;
/// Half the width of a marker, roughly.
pub const MARKER: f64 = 3.6;

/// The look of one curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    color: usize,
    shape: usize,
}

impl Look {
    /// The look of a plot's curve; after thirty curves they begin again with the first.
    pub fn of(index: usize) -> Self {
        Self { color: index % COLORS, shape: index % SHAPES }
    }

    /// The look of a curve that may cross a limit: never in its colour.
    pub fn beside_limits(index: usize) -> Self {
        let mut others = (0..).map(Self::of).filter(|look| look.color != OF_LIMITS);
        others.nth(index).unwrap_or(Self::of(0))
    }

    /// The classes of something drawn in this colour.
    pub fn class(self, kind: &str) -> String {
        format!("{kind} series-{}", self.color)
    }

    /// The outline of a marker, so that colour is not the only difference.
    pub fn marker(self, [x, y]: [f64; 2], r: f64) -> Vec<[f64; 2]> {
        let offsets = match self.shape {
            0 => vec![[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
            1 => vec![[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]],
            2 => vec![[0.0, -1.3], [1.2, 0.9], [-1.2, 0.9]],
            3 => disc(),
            _ => cross(),
        };
        offsets.iter().map(|[dx, dy]| [x + r * dx, y + r * dy]).collect()
    }

    /// Draws a marker at each of the pixels.
    pub fn markers(self, svg: &mut Svg, pixels: impl IntoIterator<Item = [f64; 2]>) {
        let mut path = Path::default();
        pixels.into_iter().for_each(|pixel| path.polygon(&self.marker(pixel, MARKER)));
        svg.path(&self.class("marker"), &path);
    }

    /// The look by itself, for a legend.
    pub fn key(self) -> String {
        let mut svg = Svg::new(26.0, 12.0, "");
        svg.line(&self.class("curve"), [1.0, 6.0], [25.0, 6.0]);
        self.markers(&mut svg, [[13.0, 6.0]]);
        svg.finish()
    }
}

/// A circle of few corners: a marker is too small to show them.
fn disc() -> Vec<[f64; 2]> {
    const CORNERS: u32 = 12;
    let corner = |at: u32| (f64::from(at) * std::f64::consts::TAU / f64::from(CORNERS)).sin_cos();
    (0..CORNERS).map(corner).map(|(sin, cos)| [1.1 * cos, 1.1 * sin]).collect()
}

/// Two bars that cross, as one outline.
fn cross() -> Vec<[f64; 2]> {
    const END: f64 = 1.25;
    const HALF: f64 = 0.45;
    let arm = [[HALF, 0.0], [END, END - HALF], [END - HALF, END]];
    let quarter = |turns: u32| arm.map(|corner| (0..turns).fold(corner, |[x, y], _| [-y, x]));
    (0..4).flat_map(quarter).collect()
}

#[cfg(test)]
mod tests {
    use super::super::figure::figure;
    use super::super::{Chart, Curve, ParetoPlot, ParetoPoint, Strip, chart_file, pareto_file};
    use super::*;

    const CURVES: usize = 16;

    /// Corners of a shape, relative to the first, in units of the farthest.
    type Shape = Vec<[f64; 2]>;

    /// Colour and first shape of each path of markers.
    fn looks(svg: &str) -> Vec<(String, Shape)> {
        let paths = svg.split("<path class=\"marker ").skip(1);
        let look = |path: &str| {
            let [class, _, outline, ..] = path.split('"').collect::<Vec<_>>()[..] else {
                panic!("{path}")
            };
            (class.replace("dominated ", ""), shape(outline))
        };
        paths.map(look).collect()
    }

    fn shape(outline: &str) -> Shape {
        let first = outline.trim_start_matches('M').split('Z').next().unwrap();
        let numbers: Vec<f64> = first.split(' ').map(|number| number.parse().unwrap()).collect();
        let corners = numbers.chunks(2).map(|pair| [pair[0] - numbers[0], pair[1] - numbers[1]]);
        let corners: Shape = corners.collect();
        let size = corners.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
        corners.iter().map(|corner| corner.map(|offset| offset / size)).collect()
    }

    /// Equal up to the rounding of coordinates.
    fn same(a: &(String, Shape), b: &(String, Shape)) -> bool {
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 0.05;
        let mut shapes = a.1.as_flattened().iter().zip(b.1.as_flattened());
        a.0 == b.0 && a.1.len() == b.1.len() && shapes.all(near)
    }

    fn assert_all_differ(looks: &[(String, Shape)]) {
        assert_eq!(looks.len(), CURVES);
        for (at, look) in looks.iter().enumerate() {
            let before = looks[..at].iter().position(|before| same(before, look));
            assert_eq!(before, None, "curve {at} looks like another: {look:?}");
        }
    }

    /// A picture and a legend of the same looks, all of them different.
    fn assert_told_apart(picture: &[(String, Shape)], legend: &[(String, Shape)]) {
        assert_all_differ(picture);
        assert_all_differ(legend);
        assert!(picture.iter().zip(legend).all(|(drawn, named)| same(drawn, named)));
    }

    fn name(at: usize) -> String {
        format!("curve {at}")
    }

    fn value(at: usize) -> f64 {
        1.0 + at as f64
    }

    /// A chart of sixteen curves.
    fn chart(at: Vec<f64>, expected_rate: Option<f64>) -> Chart {
        let curve = |number| Curve {
            label: name(number),
            values: at.iter().map(|x| Some(value(number) + x)).collect(),
            expected_rate,
            ..Curve::default()
        };
        let curves = (0..CURVES).map(curve).collect();
        let strips = vec![Strip { curves, ..Strip::default() }];
        Chart { at, strips, ..Chart::default() }
    }

    #[test]
    fn sixteen_rates_and_bounds_look_different() {
        for expected in [None, Some(1.0)] {
            let looks = looks(&figure(&chart(vec![5.0, 1.0], expected)).unwrap());
            assert_told_apart(&looks[..CURVES], &looks[CURVES..]);
        }
    }

    #[test]
    fn sixteen_series_of_settings_look_different() {
        let point = |series| {
            let error = 1.0 / value(series);
            let cost = value(series);
            ParetoPoint { name: name(series), cost, error, series, ..ParetoPoint::default() }
        };
        let points: Vec<ParetoPoint> = (0..CURVES).map(point).collect();
        let series = (0..CURVES).map(name).collect();
        let looks = looks(&pareto_file(&ParetoPlot { series, points, ..ParetoPlot::default() }));
        assert_told_apart(&looks[CURVES..], &looks[..CURVES]);
    }

    #[test]
    fn sixteen_curves_over_time_look_different_and_unlike_limits() {
        for ticks in [3, 1000] {
            let at = (0..ticks).map(f64::from).collect();
            let looks = looks(&chart_file(&chart(at, None)));
            assert_told_apart(&looks[..CURVES], &looks[CURVES..]);
            assert!(looks.iter().all(|look| look.0 != format!("series-{OF_LIMITS}")));
        }
    }

    #[test]
    fn thirty_looks_come_before_the_first_returns() {
        let looks: Vec<Look> = (0..30).map(Look::of).collect();
        assert!((0..30).all(|at| !looks[..at].contains(&looks[at])));
        assert_eq!(Look::of(30), looks[0]);
    }
}

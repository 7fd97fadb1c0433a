//! Heading and legend of the picture of a Pareto front.

use super::{LEFT, LETTERS, ParetoPlot, ParetoPoint, RIGHT, WIDTH, drawn_bound};
use crate::lettering::{shortened, width};
use crate::look::Look;
use crate::svg::{Anchor, Path, Svg, circle};

/// An entry of the legend.
pub enum Key<'p> {
    /// A colour with a marker, and what they mean.
    Series(usize, &'p str),
    /// The stair.
    Front,
    /// The marks above points.
    Bound,
    /// The ring.
    Recommended,
}

const TITLE: f64 = 15.0;
const FIRST: f64 = 50.0;
const LINE: f64 = 19.0;
/// Room of an entry's mark, and between entries.
const MARK: f64 = 24.0;
const BETWEEN: f64 = 18.0;

/// The heading, shortened where it would leave the picture.
pub fn title(svg: &mut Svg, title: &str) {
    let text = shortened(title, 1.06 * TITLE, WIDTH - 36.0);
    svg.abridged("title", [18.0, 26.0], Anchor::Start, &text, title);
}

/// Entries that the legend of the picture needs.
pub fn keys<'p>(plot: &'p ParetoPlot, shown: &[&ParetoPoint]) -> Vec<Key<'p>> {
    let used = |series: &usize| shown.iter().any(|point| point.series == *series);
    let entry = |(at, name): (usize, &'p String)| Key::Series(at, name.as_str());
    let series = plot.series.iter().enumerate().filter(|(at, _)| used(at));
    let mut keys: Vec<Key> = series.map(entry).collect();
    let mut add = |wanted: bool, key| keys.extend(wanted.then_some(key));
    add(shown.iter().any(|point| point.front), Key::Front);
    add(shown.iter().any(|point| drawn_bound(point).is_some()), Key::Bound);
    add(shown.iter().any(|point| point.recommended), Key::Recommended);
    keys
}

impl Key<'_> {
    fn text(&self) -> String {
        let text = match self {
            Self::Series(_, name) => name,
            Self::Front => "Pareto front",
            Self::Bound => "certified bound",
            Self::Recommended => "recommended",
        };
        shortened(text, LETTERS, RIGHT - LEFT - MARK)
    }

    fn draw(&self, svg: &mut Svg, [x, y]: [f64; 2]) {
        match *self {
            Self::Series(at, _) => Look::of(at).markers(svg, [[x + 10.0, y]]),
            Self::Front => {
                let corners = [[0.0, -4.0], [10.0, -4.0], [10.0, 4.0], [20.0, 4.0]];
                let corners = corners.map(|[right, down]| [x + right, y + down]);
                svg.path("stair", &Path::through(&corners));
            }
            Self::Bound => {
                svg.line("bound-line", [x + 10.0, y + 6.0], [x + 10.0, y - 5.0]);
                svg.line("bound-cap", [x + 5.0, y - 5.0], [x + 15.0, y - 5.0]);
            }
            Self::Recommended => {
                svg.path("ring", &Path::around(&circle([x + 10.0, y], 6.5)));
            }
        }
    }
}

/// Entries side by side, as many a line as fit: each with its place.
fn placed<'k>(keys: &'k [Key<'k>]) -> Vec<(&'k Key<'k>, String, [f64; 2])> {
    let (mut x, mut y) = (LEFT, FIRST);
    let mut place = |key: &'k Key<'k>| {
        let text = key.text();
        let length = MARK + width(&text, LETTERS);
        if x > LEFT && x + length > RIGHT {
            (x, y) = (LEFT, y + LINE);
        }
        let at = [x, y];
        x += length + BETWEEN;
        (key, text, at)
    };
    keys.iter().map(&mut place).collect()
}

/// The lowest line of the legend.
pub fn bottom(keys: &[Key]) -> f64 {
    placed(keys).last().map_or(FIRST - LINE, |(.., at)| at[1])
}

/// Draws the legend.
pub fn draw(svg: &mut Svg, keys: &[Key]) {
    for (key, text, at) in placed(keys) {
        key.draw(svg, at);
        svg.text("tick", [at[0] + MARK, at[1] + 4.0], Anchor::Start, &text);
    }
}

//! Where everything lies in the picture of a Pareto front, first of all the names of its points.
//!
//! ```text
//!        name of 1 ●────┐            Nothing is cheaper and more exact than a point of the front, so left
//!                   name of 2 ●──┐   of a point and below it the picture is empty: a name that ends at its
//!                    name of 3 ╱ ●   point lies on no other point. Names nearer to each other than a line
//!                                    are moved down, into more of the same emptiness.
//! ```
//! Every name has a height of its own, so no two overlap, whatever their widths.

use super::{LEFT, LETTERS, ParetoPoint, RIGHT, drawn_bound, front};
use crate::lettering::{shortened, width};
use crate::scale::{Scale, extent};

/// Height of the diagram where names don't make it longer.
const HEIGHT: f64 = 380.0;
/// From the end of a name to the middle of its point, and to the frame.
const GAP: f64 = 12.0;
const BORDER: f64 = 6.0;
/// So that rounding shortens no name.
const SLACK: f64 = 0.5;
/// From one line of names to the next.
const LINE: f64 = 15.0;
/// The most of the picture that is kept free for names at its left.
const MOST_ROOM: f64 = 0.42 * (RIGHT - LEFT);
/// Factor by which a logarithmic axis goes beyond its range: a tenth of a decade.
const MARGIN: f64 = 1.258_925_411_794_167_2;

/// A name: its text, and the middle of its line where it ends.
pub struct Name {
    pub text: String,
    pub end: [f64; 2],
}

/// Where everything lies.
pub struct Layout {
    /// Cost.
    pub across: Scale,
    /// Error.
    pub up: Scale,
    /// The errors that `up` shows.
    pub range: [f64; 2],
    /// Upper end of the frame.
    pub top: f64,
    /// Its lower end.
    pub bottom: f64,
    /// The names of the front, in its order.
    pub names: Vec<Name>,
}

impl Layout {
    /// The layout below `top`; `None` without a point.
    pub fn new(shown: &[&ParetoPoint], top: f64) -> Option<Self> {
        let costs = extent(shown.iter().map(|point| point.cost))?;
        let errors = shown.iter().map(|point| point.error);
        let [least, most] = extent(errors.chain(shown.iter().copied().filter_map(drawn_bound)))?;
        let unit = Scale::logarithmic(costs, [0.0, 1.0]);
        let needed = |point: &ParetoPoint| {
            (unit.at(point.cost), width(&point.name, LETTERS) + GAP + BORDER + SLACK)
        };
        let kept = room(front(shown).map(needed), RIGHT - LEFT).min(MOST_ROOM);
        let across = Scale::logarithmic(costs, [LEFT + kept, RIGHT]);
        let up = Scale::logarithmic([least, most], [top + HEIGHT, top]);
        let wanted: Vec<f64> = front(shown).map(|point| up.at(point.error)).collect();
        let heights = moved_down(&wanted, LINE);
        let name = |(point, height): (&ParetoPoint, f64)| {
            let end = across.at(point.cost) - GAP;
            Name { text: shortened(&point.name, LETTERS, end - LEFT - BORDER), end: [end, height] }
        };
        let names: Vec<Name> = front(shown).zip(heights).map(name).collect();
        let lowest = names.last().map_or(0.0, |name| name.end[1] + LINE);
        let bottom = lowest.max(top + HEIGHT);
        // The axes go on where names need more room than the points.
        let costs = [across.value(LEFT) * MARGIN, costs[1]];
        let range = [up.value(bottom) * MARGIN, most];
        let across = Scale::logarithmic(costs, [LEFT, RIGHT]);
        let up = Scale::logarithmic(range, [bottom, top]);
        Some(Self { across, up, range, top, bottom, names })
    }

    /// The pixel of a point.
    pub fn at(&self, point: &ParetoPoint) -> [f64; 2] {
        [self.across.at(point.cost), self.up.at(point.error)]
    }
}

/// Heights (downwards, increasing) at least `step` apart, none above what was wanted, each as near to it
/// as the ones before it allow.
fn moved_down(wanted: &[f64], step: f64) -> Vec<f64> {
    let mut last = f64::NEG_INFINITY;
    let place = |&height: &f64| {
        last = height.max(last + step);
        last
    };
    wanted.iter().map(place).collect()
}

/// The least room left of an axis of `length` pixels (the room included) for a name of each width to end
/// where its point lies, at a fraction of the rest of the axis: room + fraction·(length − room) ≥ width.
fn room(names: impl Iterator<Item = (f64, f64)>, length: f64) -> f64 {
    let needed = names.map(|(fraction, width)| (width - fraction * length) / (1.0 - fraction));
    needed.filter(|room| room.is_finite()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::draw::POSITION;

    #[test]
    fn heights_keep_their_distance_and_move_no_further_than_they_must() {
        assert_eq!(moved_down(&[0.0, 50.0, 52.0, 90.0], 15.0), [0.0, 50.0, 65.0, 90.0]);
        assert_eq!(moved_down(&[7.0; 3], 10.0), [7.0, 17.0, 27.0]);
        assert!(moved_down(&[], 10.0).is_empty());
    }

    #[test]
    fn every_name_fits_beside_its_point() {
        let names = [(0.1, 200.0), (0.5, 120.0), (0.0, 80.0)];
        let room = room(names.into_iter(), 700.0);
        let spare = names.map(|(fraction, width)| room + fraction * (700.0 - room) - width);
        POSITION.check("no more than the least", spare.into_iter().fold(f64::INFINITY, f64::min));
        assert_eq!(super::room([(0.9, 100.0)].into_iter(), 700.0), 0.0);
    }

    fn crowded(front: usize, others: usize) -> Vec<ParetoPoint> {
        let point = |at: usize| ParetoPoint {
            name: format!("condensed, quads, level {at}, f32+f64, {} sweeps", at * at),
            cost: 1e4 * 1.03_f64.powi(at as i32),
            error: 0.1 * 0.97_f64.powi((at * at % 97 + at) as i32 / 3),
            front: at < front,
            ..ParetoPoint::default()
        };
        let mut points: Vec<_> = (0..front + others).map(point).collect();
        let mut least = f64::INFINITY;
        for point in &mut points {
            // Each of the front is no worse than the one before, the others are worse than all of it.
            if point.front {
                least = least.min(point.error);
                point.error = least;
            } else {
                point.error = 2.0 * point.error.max(least);
            }
        }
        points
    }

    /// Corners of the room of a name.
    fn frame(name: &Name) -> [[f64; 2]; 2] {
        let [x, y] = name.end;
        [[x - width(&name.text, LETTERS), y - 0.5 * LETTERS], [x, y + 0.5 * LETTERS]]
    }

    #[test]
    fn names_lie_on_no_other_and_on_no_point() {
        for (front, others) in [(2, 0), (12, 48), (60, 0)] {
            let points = crowded(front, others);
            let shown = super::super::shown(&points);
            let layout = Layout::new(&shown, 100.0).unwrap();
            let frames: Vec<_> = layout.names.iter().map(frame).collect();
            assert_eq!(frames.len(), front);
            for (at, [low, high]) in frames.iter().enumerate() {
                assert!(low[0] > LEFT && high[0] < RIGHT && high[1] < layout.bottom, "{low:?}");
                let apart = |other: &[[f64; 2]; 2]| {
                    (0..2).any(|axis| other[1][axis] < low[axis] || high[axis] < other[0][axis])
                };
                assert!(frames[..at].iter().all(apart), "{at}");
                let free = |point: &&ParetoPoint| apart(&[layout.at(point); 2]);
                assert!(shown.iter().all(free), "{at}");
            }
        }
    }

    #[test]
    fn axes_go_on_below_names_without_moving_the_points() {
        let points = crowded(60, 0);
        let shown = super::super::shown(&points);
        let layout = Layout::new(&shown, 100.0).unwrap();
        assert!(layout.bottom > 100.0 + HEIGHT);
        for (point, name) in shown.iter().zip(&layout.names) {
            let [x, y] = layout.at(point);
            POSITION.check("above its name", (y - name.end[1]).max(0.0));
            POSITION.check("an end", x - GAP - name.end[0]);
        }
    }
}

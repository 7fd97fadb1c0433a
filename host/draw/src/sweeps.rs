//! The error bound over sweeps, both logarithmic: what a solve that is cut off is worth.

use super::SweepPlot;
use super::loglog::{LogLog, positive};
use super::scale::extent;

/// Smaller values, as parts of the largest, are out of sight below: all that matters is above.
const DEPTH: f64 = 1e-4;

/// The log-log picture; `None` without a point to draw. The first curve is a wide line, so that others
/// that lie on it can be seen.
pub fn sweeps(plot: &SweepPlot) -> Option<String> {
    let curves: Vec<_> =
        plot.curves.iter().map(|(_, values)| positive(&plot.sweeps, values)).collect();
    let range = |axis: usize| extent(curves.iter().flatten().map(|point| point[axis]));
    let [least, most] = range(1)?;
    let floor = least.max(DEPTH * most);
    let label = format!("{}: error bound over sweeps", plot.title);
    let mut chart = LogLog::new(&label, "sweeps", range(0)?, [floor, most]);
    for (index, curve) in curves.iter().enumerate() {
        if index == 0 {
            chart.wide(index, curve);
        }
        let (shown, leaving) = above(curve, floor);
        chart.curve(index, shown);
        chart.line(index, &leaving);
    }
    Some(chart.finish())
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

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::draw::POSITION;

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

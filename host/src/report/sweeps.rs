//! The error bound over sweeps, both logarithmic: what a solve that is cut off is worth.

use super::SweepPlot;
use super::loglog::{LogLog, positive};
use super::scale::extent;

/// The log-log picture; `None` without a point to draw.
pub fn sweeps(plot: &SweepPlot) -> Option<String> {
    let curves: Vec<_> =
        plot.curves.iter().map(|(_, values)| positive(&plot.sweeps, values)).collect();
    let range = |axis: usize| extent(curves.iter().flatten().map(|point| point[axis]));
    let label = format!("{}: error bound over sweeps", plot.title);
    let mut chart = LogLog::new(&label, "sweeps", range(0)?, range(1)?);
    for (index, curve) in curves.iter().enumerate() {
        chart.curve(index, curve);
    }
    Some(chart.finish())
}

//! Charts with their legends: a name and a note a curve, beside the look it is drawn in.

use std::fmt::Write;

use super::convergence::{convergence, measured_rate, rate_label};
use super::look::Look;
use super::svg::escape;
use super::sweeps::sweeps;
use super::{ConvergencePlot, SweepPlot};

/// Error over mesh width; `None` without a point to draw.
pub fn convergence_figure(plot: &ConvergencePlot) -> Option<String> {
    let entries = plot.series.iter().map(|series| {
        let rate = measured_rate(series).map_or("–".to_owned(), |rate| format!("{rate:.2}"));
        let expected = rate_label(series.expected_rate);
        let note = format!("<em>rate {rate}, expected {expected}</em>");
        (series.label.as_str(), note)
    });
    Some(figure(&plot.title, &convergence(plot)?, entries))
}

/// Bounds and errors over sweeps; `None` without a point to draw.
pub fn sweeps_figure(plot: &SweepPlot) -> Option<String> {
    let entries = plot.curves.iter().map(|(label, _)| (label.as_str(), String::new()));
    Some(figure(&plot.title, &sweeps(plot)?, entries))
}

fn figure<'a>(
    title: &str,
    picture: &str,
    entries: impl Iterator<Item = (&'a str, String)>,
) -> String {
    let mut legend = String::new();
    for (index, (label, note)) in entries.enumerate() {
        let (key, label) = (Look::of(index).key(), escape(label));
        let _ = writeln!(legend, "<li>{key}<span>{label}</span>{note}</li>");
    }
    format!(
        "<figure class=\"card\">\n<h3>{}</h3>\n{picture}<ul class=\"series\">\n{legend}</ul>\n\
         </figure>\n",
        escape(title)
    )
}

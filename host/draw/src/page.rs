//! The page around the pictures. Every tag is closed, so the page is well-formed XML as well.

use std::fmt::Write;

use super::convergence::{convergence, measured_rate, rate_label};
use super::extremes::extremes;
use super::frame::{frame, mark};
use super::loglog::legend_marker;
use super::panel::panel;
use super::svg::escape;
use super::sweeps::sweeps;
use super::table::checked;
use super::tradeoff::tradeoff;
use super::{Check, ConvergencePlot, Report, SweepPlot};

/// The whole page as one file, complete in itself.
pub fn html(report: &Report) -> String {
    let mut page = String::new();
    header(&mut page, report);
    page.push_str("<main>\n");
    if !report.table.rows.is_empty() {
        section(&mut page, "Every run", &checked(&report.table, &report.scenes));
    }
    if !report.checks.is_empty() {
        section(&mut page, "Further checks", &checks(&report.checks));
    }
    let plots: String = report.convergence.iter().filter_map(convergence_figure).collect();
    if !plots.is_empty() {
        section(&mut page, "Convergence", &format!("<div class=\"plots\">\n{plots}</div>\n"));
    }
    cut_off(&mut page, report);
    if let Some(found) = &report.tradeoff {
        section(&mut page, "Speed for accuracy", &tradeoff(found));
    }
    if let Some(found) = &report.extremes {
        section(&mut page, "Extremes", &extremes(found));
    }
    if !report.scenes.is_empty() {
        let panels: String = report.scenes.iter().enumerate().map(panel).collect();
        section(&mut page, "Solutions", &format!("<div class=\"panels\">\n{panels}</div>\n"));
    }
    let made_by = escape(&report.generated_by);
    let _ = write!(page, "</main>\n<footer>{made_by}</footer>\n");
    frame(&report.title, &page)
}

fn section(page: &mut String, heading: &str, body: &str) {
    let _ = write!(page, "<section>\n<h2>{heading}</h2>\n{body}</section>\n");
}

fn cut_off(page: &mut String, report: &Report) {
    if report.cut_off.rows.is_empty() {
        return;
    }
    let table = checked(&report.cut_off, &report.scenes);
    let plots: String = report.sweeps.iter().filter_map(sweeps_figure).collect();
    let body = format!(
        "<p class=\"lead\">A control loop stops the solver when its time is up, and the bound says how \
         wrong the answer is then. A column for each number of sweeps from a cold start: the gap of the \
         bound in units of the energy error of u at that moment. In the pictures the true error is that \
         of what the bound is about, and lies on it.</p>\n{table}<div class=\"plots\">\n{plots}</div>\n"
    );
    section(page, "Cut off", &body);
}

fn header(page: &mut String, report: &Report) {
    let runs = failures("run", report.table.rows.iter().map(|row| row.passed));
    let stopped = failures("cut-off run", report.cut_off.rows.iter().map(|row| row.passed));
    let checks = failures("check", report.checks.iter().map(|check| check.passed));
    let scenes = failures("scene", report.scenes.iter().map(|scene| scene.passed));
    let failed: Vec<String> = [runs, stopped, checks, scenes].into_iter().flatten().collect();
    let verdict = if failed.is_empty() {
        format!("<p class=\"verdict\">{} Every check holds</p>", mark(true))
    } else {
        format!("<p class=\"verdict failed\">{} Failed: {}</p>", mark(false), failed.join(", "))
    };
    let _ = write!(
        page,
        "<header>\n<h1>{}</h1>\n<p class=\"lead\">The scalar Signorini problem: u solves \
         −∇·(A∇u) = f, and on the contact boundary C it stays above the gap ψ; it is pushed back \
         by λ ≥ 0, and only where it touches. Each picture shows u as colour, the flux σ = A∇u as \
         arrows and the part of C in contact as a thick red line; beside it, which cells the error \
         comes from, and a guaranteed bound on it: no exact solution is needed for that.</p>\n{verdict}\n</header>\n",
        escape(&report.title)
    );
}

/// `2 of 9 runs`, or nothing when all passed.
fn failures(noun: &str, passed: impl ExactSizeIterator<Item = bool>) -> Option<String> {
    let total = passed.len();
    let failed = passed.filter(|passed| !passed).count();
    let plural = if total == 1 { "" } else { "s" };
    (failed > 0).then(|| format!("{failed} of {total} {noun}{plural}"))
}

fn checks(checks: &[Check]) -> String {
    let mut html = String::from("<ul class=\"checks\">\n");
    for check in checks {
        let (claim, found) = (escape(&check.claim), escape(&check.found));
        let mark = mark(check.passed);
        let _ = writeln!(html, "<li>{mark}<span>{claim}</span><em>{found}</em></li>");
    }
    html + "</ul>\n"
}

fn convergence_figure(plot: &ConvergencePlot) -> Option<String> {
    let entries = plot.series.iter().map(|series| {
        let rate = measured_rate(series).map_or("–".to_owned(), |rate| format!("{rate:.2}"));
        let expected = rate_label(series.expected_rate);
        let note = format!("<em>rate {rate}, expected {expected}</em>");
        (series.label.as_str(), note)
    });
    Some(figure(&plot.title, &convergence(plot)?, entries))
}

fn sweeps_figure(plot: &SweepPlot) -> Option<String> {
    let entries = plot.curves.iter().map(|(label, _)| (label.as_str(), String::new()));
    Some(figure(&plot.title, &sweeps(plot)?, entries))
}

/// A chart with its legend: a name and a note a curve.
fn figure<'a>(
    title: &str,
    picture: &str,
    entries: impl Iterator<Item = (&'a str, String)>,
) -> String {
    let mut legend = String::new();
    for (index, (label, note)) in entries.enumerate() {
        let (marker, label) = (legend_marker(index), escape(label));
        let _ = writeln!(legend, "<li>{marker}<span>{label}</span>{note}</li>");
    }
    format!(
        "<figure class=\"card\">\n<h3>{}</h3>\n{picture}<ul class=\"series\">\n{legend}</ul>\n\
         </figure>\n",
        escape(title)
    )
}

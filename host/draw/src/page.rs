//! The page around the pictures: contents first, then the scenes, tests after them, then what was found out about both.
//! Every tag is closed, so the page is well-formed XML as well.

use std::fmt::Write;

use super::extremes::extremes;
use super::figure::figure;
use super::markup::{enclosed, frame, list, mark};
use super::panel::panel;
use super::svg::escape;
use super::tradeoff::tradeoff;
use super::{Check, Mark, Report, ScenePanel};

/// The whole page as one file, complete in itself.
pub fn html(report: &Report) -> String {
    let sections = sections(report);
    let mut page = header(report) + &contents(&sections) + "<main>\n";
    page.extend(sections.iter().map(Section::html));
    let made_by = escape(&report.generated_by);
    let _ = write!(page, "</main>\n<footer>{made_by}</footer>\n");
    frame(&report.title, &page)
}

/// The sections that have something to show, in the order of the page.
fn sections(report: &Report) -> Vec<Section> {
    let all = [
        solutions(&report.scenes),
        tests(&report.scenes),
        runs(report),
        further_checks(&report.checks),
        rates(report),
        cut_off(report),
        speed_for_accuracy(report),
        pushed(report),
    ];
    all.into_iter().flatten().collect()
}

fn solutions(scenes: &[ScenePanel]) -> Option<Section> {
    let shown = || scenes.iter().enumerate().filter(|(_, scene)| !scene.is_test);
    let panels: String = shown().map(panel).collect();
    let links = scene_links(shown());
    let body =
        format!("{}{links}<div class=\"panels\">\n{panels}</div>\n", list("notes", &PICTURES));
    section("solutions", "Scenes", shown().count(), "scene", body)
}

/// How to read a solution.
const PICTURES: [&str; 3] = [
    "The first picture: colour shows u, arrows its flux σ = A∇u, and a thick red line where there is contact.",
    "The second one goes along the contact boundary C: the force λ, and how far u is from the gap ψ.",
    "The third one shows which cells the error comes from, with a guaranteed bound on it: no exact solution is \
     needed for that.",
];

fn tests(scenes: &[ScenePanel]) -> Option<Section> {
    let shown = || scenes.iter().enumerate().filter(|(_, scene)| scene.is_test);
    let panels: String = shown().map(panel).collect();
    let lead = "The exact solution of these is known: each line says how wrong an answer can be, and how wrong it \
                is; opened, it shows pictures and numbers.";
    let body = format!("<p class=\"lead\">{lead}</p>\n{panels}");
    section("tests", "Tests", shown().count(), "exact solution", body)
}

/// Links to the panels, where there are several.
fn scene_links<'s>(scenes: impl Iterator<Item = (usize, &'s ScenePanel)>) -> String {
    let link = |(at, scene): (usize, &ScenePanel)| {
        format!("<li><a href=\"#scene-{at}\">{}</a></li>", escape(&scene.name))
    };
    let links: Vec<String> = scenes.map(link).collect();
    if links.len() < 2 {
        return String::new();
    }
    enclosed("<ul class=\"links\">", links.into_iter(), "</ul>")
}

fn runs(report: &Report) -> Option<Section> {
    let body = report.table.html(&report.scenes);
    section("runs", "Every run", report.table.rows.len(), "run", body)
}

fn further_checks(checks: &[Check]) -> Option<Section> {
    let entry = |Check { claim, found, passed }: &Check| {
        let (mark, claim, found) = (mark(*passed), escape(claim), escape(found));
        format!("<li>{mark}<span>{claim}</span><em>{found}</em></li>")
    };
    let body = enclosed("<ul class=\"checks\">", checks.iter().map(entry), "</ul>");
    section("checks", "Further checks", checks.len(), "claim", body)
}

fn rates(report: &Report) -> Option<Section> {
    let plots: Vec<String> = report.convergence.iter().filter_map(figure).collect();
    let body = format!("<div class=\"plots\">\n{}</div>\n", plots.concat());
    section("convergence", "Convergence", plots.len(), "plot", body)
}

fn cut_off(report: &Report) -> Option<Section> {
    let table = report.cut_off.html(&report.scenes);
    let plots: String = report.sweeps.iter().filter_map(figure).collect();
    let body = format!(
        "<p class=\"lead\">A control loop stops the solver when its time is up, and the bound says how \
         wrong the answer is then.</p>\n{}{table}<div class=\"plots\">\n{plots}</div>\n",
        list("notes", &CUT_OFF)
    );
    section("cut-off", "Cut off", report.cut_off.rows.len(), "scene", body)
}

/// How to read the section.
const CUT_OFF: [&str; 3] = [
    "Each column of the table stands for a number of sweeps from a cold start.",
    "Its numbers give the gap of the bound over the error of u at that moment: the gradient error, weighed \
     by A (energy norm ‖A^½∇(u − u_h)‖).",
    "In the pictures the true error is that of s and τ, which the bound is about, and lies on it: the \
     gradient of s is weighed by A, the flux τ by A⁻¹ (energy norms).",
];

fn speed_for_accuracy(report: &Report) -> Option<Section> {
    let found = report.tradeoff.as_ref()?;
    let extent = counted(found.scenes.len(), "scene");
    let body = tradeoff(found);
    Some(Section { id: "tradeoff", heading: "Speed for accuracy", extent, body })
}

fn pushed(report: &Report) -> Option<Section> {
    let found = report.extremes.as_ref()?;
    let maps = found.studies.iter().map(|study| study.maps.len()).sum();
    let extent = counted(maps, "map");
    Some(Section { id: "extremes", heading: "Extremes", extent, body: extremes(found) })
}

/// A part of the page with a heading.
struct Section {
    /// The name in links to it.
    id: &'static str,
    heading: &'static str,
    /// How much there is of what.
    extent: String,
    /// Everything below the heading, as HTML.
    body: String,
}

/// The section on so many of `noun`; none where there is none.
fn section(
    id: &'static str,
    heading: &'static str,
    count: usize,
    noun: &str,
    body: String,
) -> Option<Section> {
    (count > 0).then(|| Section { id, heading, extent: counted(count, noun), body })
}

impl Section {
    fn html(&self) -> String {
        let Self { id, heading, body, .. } = self;
        format!("<section id=\"{id}\">\n<h2>{heading}</h2>\n{body}</section>\n")
    }
}

/// Links to the sections, in their order; nothing where there is none.
fn contents(sections: &[Section]) -> String {
    let link = |Section { id, heading, extent, .. }: &Section| {
        format!("<li><a href=\"#{id}\">{heading}</a><small>{extent}</small></li>")
    };
    let open = "<nav aria-label=\"Contents\">\n<h2>Contents</h2>\n<ul>";
    enclosed(open, sections.iter().map(link), "</ul>\n</nav>")
}

/// `1 run`, `9 runs`
fn counted(count: usize, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

fn header(report: &Report) -> String {
    let (title, verdict) = (escape(&report.title), verdict(report));
    format!("<header>\n<h1>{title}</h1>\n<p class=\"lead\">{LEAD}</p>\n{verdict}</header>\n")
}

/// What one sees.
const LEAD: &str = "Signorini problems, solved, drawn and checked: u solves −∇·(A∇u) = f, and on the contact \
                    boundary C it stays above the gap ψ, pushed back by λ ≥ 0 only where it touches.";

/// Whether everything holds, and otherwise how much does not.
fn verdict(report: &Report) -> String {
    let runs = failures("run", report.table.rows.iter().map(|row| row.mark == Mark::Passed));
    let stopped =
        failures("cut-off run", report.cut_off.rows.iter().map(|row| row.mark == Mark::Passed));
    let checks = failures("check", report.checks.iter().map(|check| check.passed));
    let scenes = failures("scene", report.scenes.iter().map(|scene| scene.passed));
    let failed: Vec<String> = [runs, stopped, checks, scenes].into_iter().flatten().collect();
    if failed.is_empty() {
        return format!("<p class=\"verdict\">{} Every check holds</p>\n", mark(true));
    }
    format!("<p class=\"verdict failed\">{} Failed: {}</p>\n", mark(false), failed.join(", "))
}

/// `2 of 9 runs`, or nothing when all passed.
fn failures(noun: &str, passed: impl ExactSizeIterator<Item = bool>) -> Option<String> {
    let total = passed.len();
    let failed = passed.filter(|passed| !passed).count();
    (failed > 0).then(|| format!("{failed} of {}", counted(total, noun)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_section_no_contents() {
        assert_eq!(contents(&[]), "");
        assert_eq!([0, 1, 2].map(|count| counted(count, "run")), ["0 runs", "1 run", "2 runs"]);
    }
}

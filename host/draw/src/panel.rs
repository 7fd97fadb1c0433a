//! One solved scene: its pictures side by side, beside them how wrong its answer can be, for someone who does not know
//! the theory; all its numbers are folded away below.

use super::ScenePanel;
use super::contact::contact;
use super::field::{errors, field};
use super::legend::{Key, boundary_keys, contact_keys};
use super::markup::{enclosed, folded, list, mark, typeset};
use super::scale::plain;
use super::svg::escape;

/// The card of a scene, numbered for links to it; that of a test opens below a line.
pub fn panel((index, scene): (usize, &ScenePanel)) -> String {
    let (mark, title, name) = (mark(scene.passed), escape(&scene.title), escape(&scene.name));
    let body = body(scene);
    if scene.is_test {
        let error = error(scene);
        return format!(
            "<details class=\"card\">\n<summary>{mark} {title}<small>{name}{error}</small></summary>\n\
             <article id=\"scene-{index}\">\n{body}</article>\n</details>\n"
        );
    }
    format!(
        "<article class=\"card\" id=\"scene-{index}\">\n<h3>{mark} {title}<small>{name}</small></h3>\n\
         {body}</article>\n"
    )
}

/// The bound and what it is on, where that is known, as the end of a line.
fn error(scene: &ScenePanel) -> String {
    let bound = scene.bound.map(|bound| format!("; error at most {}", plain(bound.total)));
    let truth = scene.error.map(|error| format!(", in truth {}", plain(error)));
    bound.into_iter().chain(truth).collect()
}

fn body(scene: &ScenePanel) -> String {
    let sentence = scene.sentence.as_ref().map_or_else(String::new, |sentence| {
        format!("<p class=\"sentence\">{}</p>\n", escape(sentence))
    });
    let figures = [solution_figure(scene), contact_figure(scene), error_figure(scene)].concat();
    let bound = bound(scene);
    let norms = if scene.bound.is_some() { list("notes", &NORMS) } else { String::new() };
    let numbers = folded("All numbers of this scene", &(facts(scene) + &norms));
    format!("{sentence}<div class=\"pictures\">\n{figures}<div>\n{bound}</div>\n</div>\n{numbers}")
}

fn solution_figure(scene: &ScenePanel) -> String {
    let Some((picture, notes)) = field(scene) else { return String::new() };
    let notes: String = notes.iter().map(|note| format!("<li>{}</li>", escape(note))).collect();
    figure(&picture.finish(), &(entries(boundary_keys(scene)) + &notes))
}

fn contact_figure(scene: &ScenePanel) -> String {
    let Some(picture) = contact(scene) else { return String::new() };
    figure(&picture.finish(), &entries(contact_keys(scene)))
}

fn error_figure(scene: &ScenePanel) -> String {
    let Some(map) = errors(scene) else { return String::new() };
    let notes = "<li>Colour shows each cell’s part of the gap, which tells where to refine.</li>\
                 <li>The squares of the parts add up to gap².</li>";
    figure(&map, notes)
}

fn figure(picture: &str, legend: &str) -> String {
    format!("<figure>\n{picture}<ul class=\"legend\">{legend}</ul>\n</figure>\n")
}

/// The caption of a panel's bound.
fn bound(panel: &ScenePanel) -> String {
    let Some(bound) = &panel.bound else {
        let reason = panel.no_bound.as_deref().map_or_else(String::new, escape);
        return format!("<p class=\"caption\">No error bound: {reason}</p>\n");
    };
    let terms = [
        ("total", bound.total, TOTAL),
        ("of u_h", bound.of_u, OF_U),
        ("gap", bound.gap, "of the total, from mesh and solver together"),
        ("algebraic", bound.algebraic, "the part of the total that more sweeps would remove"),
        ("oscillation", bound.oscillation, "loads vary inside cells, the method sees their means"),
        ("rounding", bound.rounding, "the most that the processor’s arithmetic can hide"),
    ];
    let entry = |(name, value, words)| {
        let (value, words) = (plain(value), escape(words));
        format!("<div><dt>{name}</dt><dd>{value}<span>{words}</span></dd></div>")
    };
    let terms = enclosed("<dl class=\"bound\">", terms.into_iter().map(entry), "</dl>");
    terms + &list("notes", &beside(panel, bound.total))
}

/// The guarantees of the bounds.
const TOTAL: &str =
    "guaranteed: the continuous s and the flux τ, in the energy norm, are no further off than this";
const OF_U: &str = "guaranteed: the means over the edges, in the energy norm, cell by cell, are no further off than this";

/// How errors are weighed.
const NORMS: [&str; 3] = [
    "The energy norm of errors of s and u_h weighs the gradient by A: ‖A^½∇(u − s)‖, ‖A^½∇(u − u_h)‖.",
    "The energy norm of errors of τ weighs the flux by A⁻¹: ‖A^−½(σ − τ)‖.",
    "The total counts those of s and τ together, with what Robin edges add.",
];

/// The total as a part of the solution, and the truth.
fn beside(panel: &ScenePanel, total: f64) -> Vec<String> {
    let (energy, name) = panel.energy;
    let part = 100.0 * total / energy;
    let size = part
        .is_finite()
        .then(|| format!("The total is {} % of the solution’s energy norm {name}.", plain(part)));
    let truth = panel.error.map(|error| format!("In truth s and τ are {} off.", plain(error)));
    size.into_iter().chain(truth).collect()
}

/// Letters of a fact that a column has room for.
const LETTERS: usize = 24;

fn facts(scene: &ScenePanel) -> String {
    let entry = |(name, value): &(String, String)| {
        // A sentence has a line of its own.
        let class = if value.chars().count() > LETTERS { " class=\"wide\"" } else { "" };
        format!("<div{class}><dt>{}</dt><dd>{}</dd></div>", typeset(name), escape(value))
    };
    enclosed("<dl class=\"facts\">", scene.facts.iter().map(entry), "</dl>")
}

/// Keys with their words.
fn entries<'a>(keys: impl IntoIterator<Item = (Key<'a>, &'a str)>) -> String {
    let entry = |(Key::Line(class) | Key::Area(class), words): (Key, &str)| {
        format!("<li><i class=\"{class}-key\"></i>{words}</li>")
    };
    keys.into_iter().map(entry).collect()
}

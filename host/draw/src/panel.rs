//! One solved scene: its pictures side by side, its numbers below.

use std::fmt::Write;

use super::bound::bound;
use super::contact::contact;
use super::field::{errors, field};
use super::markup::{enclosed, mark};
use super::svg::escape;
use super::{BoundaryKind, ContactState, ScenePanel};

/// The panel, numbered for links to it.
pub fn panel((index, scene): (usize, &ScenePanel)) -> String {
    let sentence = scene.sentence.as_ref().map_or_else(String::new, |sentence| {
        format!("<p class=\"sentence\">{}</p>\n", escape(sentence))
    });
    let mut html = format!(
        "<article class=\"card\" id=\"scene-{index}\">\n<h3>{} {}<small>{}</small></h3>\n{sentence}\
         <div class=\"pictures\">\n<div>\n",
        mark(scene.passed),
        escape(&scene.title),
        escape(&scene.name)
    );
    html += &solution_figure(scene);
    html += &contact_figure(scene);
    let (map, bound, facts) = (error_figure(scene), bound(scene), facts(scene));
    let _ = write!(html, "</div>\n<div>\n{map}{bound}{facts}</div>\n</div>\n");
    html + "</article>\n"
}

fn solution_figure(scene: &ScenePanel) -> String {
    let Some((picture, notes)) = field(scene) else { return String::new() };
    let notes: String = notes.iter().map(|note| format!("<li>{}</li>", escape(note))).collect();
    let legend = legend(scene);
    format!("<figure>\n{picture}<ul class=\"legend\">{legend}{notes}</ul>\n</figure>\n")
}

fn contact_figure(scene: &ScenePanel) -> String {
    let Some(picture) = contact(scene) else { return String::new() };
    let exact = scene.contact.iter().any(|edge| !edge.exact_multiplier.is_empty());
    let exact = if exact { entry("exact-key", "exact λ") } else { String::new() };
    let discrete = entry("multiplier-key", "discrete λ");
    let [touching, saturated] =
        [ContactState::Touching, ContactState::Saturated].map(|state| state.look()[1]);
    let mut zones = entry("zone-key", touching);
    if scene.contact.iter().any(|edge| edge.state == ContactState::Saturated) {
        zones += &entry("saturated-zone-key", saturated);
    }
    format!("<figure>\n{picture}<ul class=\"legend\">{discrete}{exact}{zones}</ul>\n</figure>\n")
}

fn error_figure(scene: &ScenePanel) -> String {
    let Some(map) = errors(scene) else { return String::new() };
    let notes = "<li>Colour shows each cell’s part of the gap, which tells where to refine.</li>\
                 <li>The squares of the parts add up to gap².</li>";
    format!("<figure>\n{map}<ul class=\"legend\">{notes}</ul>\n</figure>\n")
}

/// Letters of a fact that a column has room for.
const LETTERS: usize = 24;

fn facts(scene: &ScenePanel) -> String {
    let entry = |(name, value): &(String, String)| {
        // A sentence has a line of its own.
        let class = if value.chars().count() > LETTERS { " class=\"wide\"" } else { "" };
        format!("<div{class}><dt>{}</dt><dd>{}</dd></div>", escape(name), escape(value))
    };
    enclosed("<dl class=\"facts\">", scene.facts.iter().map(entry), "</dl>")
}

/// The kinds of boundary that the scene has.
fn legend(scene: &ScenePanel) -> String {
    let states = [ContactState::Touching, ContactState::Open, ContactState::Saturated];
    let states =
        states.into_iter().filter(|state| scene.contact.iter().any(|of| of.state == *state));
    let kinds = [BoundaryKind::Dirichlet, BoundaryKind::Neumann, BoundaryKind::Robin];
    let kinds = kinds.into_iter().filter(|kind| scene.boundary.iter().any(|of| of.kind == *kind));
    let looks = states.map(ContactState::look).chain(kinds.map(BoundaryKind::look));
    looks.map(|[class, words]| entry(&format!("{class}-key"), words)).collect()
}

fn entry(key: &str, text: &str) -> String {
    format!("<li><i class=\"{key}\"></i>{text}</li>")
}

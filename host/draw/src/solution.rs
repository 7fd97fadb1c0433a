//! A solution as a file of its own: u and the flux over the plane, what happens along the contact, and facts below.

use super::ScenePanel;
use super::contact::contact;
use super::field::field;
use super::legend::{LETTERS, ROW, boundary_keys, contact_keys, row};
use super::lettering::shortened;
use super::svg::{Anchor, MARGIN, Svg};

/// Above the first picture: room for the title.
const TOP: f64 = 46.0;
/// Between two parts.
const APART: f64 = 16.0;
/// No picture is narrower: titles and facts have to be read.
const NARROWEST: f64 = 660.0;

/// The picture; `None` when the vertices span no area.
pub fn solution_file(panel: &ScenePanel) -> Option<String> {
    let (plane, notes) = field(panel)?;
    let line = contact(panel);
    let facts: Vec<String> =
        panel.facts.iter().map(|(name, value)| format!("{name}  {value}")).collect();
    let rows = 1 + notes.len() + facts.len();
    let below = line.as_ref().map_or(0.0, |line| line.size[1] + ROW + 2.0 * APART);
    let width = line.as_ref().map_or(0.0, |line| line.size[0]).max(plane.size[0]).max(NARROWEST);
    let height = TOP + plane.size[1] + APART + ROW * rows as f64 + below + APART;
    let mut svg = Svg::alone(width, height, &format!("{}: the solution", panel.title));
    svg.heading(&panel.title);
    let mut y = TOP + plane.size[1] + APART;
    svg.nest([0.0, TOP], plane);
    row(&mut svg, [MARGIN, y], boundary_keys(panel));
    for words in notes.iter().chain(&facts) {
        y += ROW;
        let short = shortened(words, LETTERS, width - 2.0 * MARGIN);
        svg.abridged("name", [MARGIN, y], Anchor::Start, &short, words);
    }
    if let Some(line) = line {
        y += 2.0 * APART;
        let height = line.size[1];
        svg.nest([0.0, y], line);
        row(&mut svg, [MARGIN, y + height + APART], contact_keys(panel));
    }
    Some(svg.finish())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BoundaryEdge, BoundaryKind, ContactEdge};

    #[test]
    fn a_solution_has_a_field_a_contact_and_facts() {
        let panel = ScenePanel {
            title: "a <plate>".to_owned(),
            vertices: vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]],
            quads: vec![[0, 1, 2, 3]],
            vertex_u: vec![0.0, 1.0, 1.0, 0.0],
            cell_flux: vec![[1.0, 0.0]],
            contact: vec![ContactEdge {
                ends: [[0.0, 0.0], [2.0, 0.0]],
                arc_length: [0.0, 2.0],
                ..ContactEdge::default()
            }],
            boundary: vec![BoundaryEdge {
                ends: [[0.0, 1.0], [0.0, 0.0]],
                kind: BoundaryKind::Dirichlet,
            }],
            facts: vec![("heat".to_owned(), "3 W".to_owned())],
            ..ScenePanel::default()
        };
        let svg = solution_file(&panel).expect("a picture");
        for words in ["a &lt;plate&gt;", ">open</text>", ">Dirichlet</text>", "heat  3 W", "u − ψ"]
        {
            assert!(svg.contains(words), "{words}");
        }
        assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
        assert!(!svg.contains("NaN") && !svg.contains("var("));
        assert!(svg.contains(".contact-zone { fill: #d9124e; fill-opacity: 0.08; }"));
        let alone = ScenePanel { contact: Vec::new(), ..panel };
        assert!(!solution_file(&alone).expect("a picture").contains("u − ψ"));
        assert!(solution_file(&ScenePanel::default()).is_none());
    }
}

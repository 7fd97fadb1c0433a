//! The legend of a picture: what is met on the boundary, and rows of keys with their words.

use super::lettering::width;
use super::svg::{Anchor, Svg};
use super::{BoundaryKind, ContactState, ScenePanel};

/// From one row to the next.
pub const ROW: f64 = 22.0;
/// Width of a key.
const KEY: f64 = 22.0;
/// Size of letters beside keys, and of names.
pub const LETTERS: f64 = 11.5;

/// A key beside its words, in the look of a class.
#[derive(Debug, Clone, Copy)]
pub enum Key<'a> {
    /// A line.
    Line(&'a str),
    /// An area.
    Area(&'a str),
}

/// Draws keys side by side, the first at `x`, on the baseline `y`.
pub fn row<'a>(
    svg: &mut Svg,
    [mut x, y]: [f64; 2],
    entries: impl IntoIterator<Item = (Key<'a>, &'a str)>,
) {
    for (key, words) in entries {
        match key {
            Key::Line(class) => svg.line(class, [x, y - 4.0], [x + KEY, y - 4.0]),
            Key::Area(class) => svg.rectangle(class, [x, y - 9.0], [x + KEY, y + 2.0]),
        }
        svg.text("name", [x + KEY + 6.0, y], Anchor::Start, words);
        x += KEY + 26.0 + width(words, LETTERS);
    }
}

/// Key of each state and each kind of boundary that a solved scene has.
pub fn boundary_keys(scene: &ScenePanel) -> impl Iterator<Item = (Key<'static>, &'static str)> {
    let states = [ContactState::Touching, ContactState::Open, ContactState::Saturated];
    let states =
        states.into_iter().filter(|state| scene.contact.iter().any(|of| of.state == *state));
    let kinds = [BoundaryKind::Dirichlet, BoundaryKind::Neumann, BoundaryKind::Robin];
    let kinds = kinds.into_iter().filter(|kind| scene.boundary.iter().any(|of| of.kind == *kind));
    let looks = states.map(ContactState::look).chain(kinds.map(BoundaryKind::look));
    looks.map(|[class, words]| (Key::Line(class), words))
}

/// Keys of the diagrams along the contact of a solved scene.
pub fn contact_keys(scene: &ScenePanel) -> Vec<(Key<'static>, &'static str)> {
    let has_exact = scene.contact.iter().any(|edge| !edge.exact_multiplier.is_empty());
    let zone = |state, class| {
        let is_met = scene.contact.iter().any(|edge| edge.state == state);
        is_met.then(|| (Key::Area(class), state.look()[1]))
    };
    let lines = [
        Some((Key::Line("multiplier"), "discrete λ")),
        has_exact.then_some((Key::Line("exact"), "exact λ")),
    ];
    let zones = [
        zone(ContactState::Touching, "contact-zone"),
        zone(ContactState::Saturated, "saturated-zone"),
    ];
    lines.into_iter().chain(zones).flatten().collect()
}

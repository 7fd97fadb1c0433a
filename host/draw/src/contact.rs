//! The contact boundary C as a picture: the multiplier λ against the exact one, and below it,
//! over the same arc length, the opening u − ψ. Where one of them is positive the other should be 0; below the gap
//! λ is at its limit. Stretches, one a boundary and a piece of it, stand side by side, each with its name and the
//! point that it begins at.

use super::axes::{Axes, with_zero};
use super::legend::LETTERS;
use super::lettering::shortened;
use super::scale::{Scale, extent, plain};
use super::svg::{Anchor, Svg};
use super::{ContactEdge, ContactState, ScenePanel};

const SIDES: [f64; 2] = [58.0, 538.0];
const WIDTH: f64 = 642.0;
/// Bottom and top of the two diagrams.
const MULTIPLIER: [f64; 2] = [164.0, 24.0];
const OPENING: [f64; 2] = [266.0, 212.0];
const HEIGHT: f64 = 306.0;
/// The line between them that names of stretches stand on.
const NAMES: f64 = 182.0;
/// An exact λ may be infinite at a corner; the axis ends at this multiple of the discrete one.
const TALLEST: f64 = 1.6;
/// States with a ground of their own.
const ZONES: [(ContactState, &str); 2] =
    [(ContactState::Touching, "contact-zone"), (ContactState::Saturated, "saturated-zone")];

/// The two diagrams; `None` without a finite edge of contact.
pub fn contact(panel: &ScenePanel) -> Option<Svg> {
    let mut edges: Vec<&ContactEdge> = panel.contact.iter().collect();
    edges.retain(|edge| edge.arc_length.iter().all(|s| s.is_finite()));
    edges.sort_by(|a, b| a.arc_length[0].total_cmp(&b.arc_length[0]));
    let length = extent(edges.iter().flat_map(|edge| edge.arc_length))?;
    let across = Scale::linear(length, SIDES);
    let mut svg = Svg::new(WIDTH, HEIGHT, &format!("{}: λ and u − ψ along C", panel.title));

    let up = with_zero(multiplier_range(&edges), MULTIPLIER);
    let mut axes = Axes { svg: &mut svg, across, up };
    diagram(&mut axes, &edges, "multiplier", "λ = σ·n − q", |edge| edge.multiplier);
    axes.line("exact", points(&edges, exact_points));

    let range = extent(edges.iter().map(|edge| edge.opening)).unwrap_or_default();
    let mut axes = Axes { svg: &mut svg, across, up: with_zero(range, OPENING) };
    diagram(&mut axes, &edges, "opening", "u − ψ", |edge| edge.opening);
    axes.feet(6, "arc length along C");
    name_stretches(&mut svg, across, &edges);
    Some(svg)
}

/// Parts stretches by a line, and writes under each whose it is and where it begins.
fn name_stretches(svg: &mut Svg, across: Scale, edges: &[&ContactEdge]) {
    for stretch in edges.chunk_by(|a, b| continues(a, b) && a.boundary == b.boundary) {
        let ends = [stretch.first(), stretch.last()];
        let [Some(first), Some(last)] = ends else { continue };
        let [from, to] = [first.arc_length[0], last.arc_length[1]].map(|s| across.at(s));
        let ([x, y], name) = (first.ends[0].map(plain), &first.boundary);
        let whole = format!("{name} from ({x}, {y})");
        let short = shortened(&whole, LETTERS, to - from - 4.0);
        svg.abridged("tick", [from, NAMES], Anchor::Start, &short, &whole);
        if from > SIDES[0] {
            svg.line("axis", [from - 2.0, MULTIPLIER[1]], [from - 2.0, OPENING[0]]);
        }
    }
}

/// Draws a value that is constant on each edge: the area down to 0, and its upper end as a line.
fn diagram(
    axes: &mut Axes,
    edges: &[&ContactEdge],
    class: &str,
    quantity: &str,
    value: impl Fn(&ContactEdge) -> f64,
) {
    let [bottom, top] = axes.up.pixels();
    for (state, zone) in ZONES {
        for run in runs(edges, state) {
            let [from, to] = run.map(|s| axes.across.at(s));
            axes.svg.rectangle(zone, [from, top], [to, bottom]);
        }
    }
    axes.levels(if bottom - top > 100.0 { 4 } else { 2 }, |_, label| label);
    axes.heading(quantity);
    let steps = points(edges, |edge| edge.arc_length.map(|s| [s, value(edge)]).to_vec());
    let area = steps.iter().map(|step| step.map(|[s, value]| (s, [0.0, value])));
    axes.ribbon(&format!("{class}-area"), area);
    axes.line(class, steps);
}

/// The points on all edges, one missing where the boundary is interrupted.
fn points(
    edges: &[&ContactEdge],
    of: impl Fn(&ContactEdge) -> Vec<[f64; 2]>,
) -> Vec<Option<[f64; 2]>> {
    let runs = edges.chunk_by(|a, b| continues(a, b));
    let run = |run: &[&ContactEdge]| run.iter().flat_map(|edge| of(edge)).collect::<Vec<_>>();
    runs.flat_map(|edges| run(edges).into_iter().map(Some).chain([None])).collect()
}

/// The arc lengths between which edges are in this state, neighbouring edges joined.
fn runs(edges: &[&ContactEdge], state: ContactState) -> Vec<[f64; 2]> {
    let mut runs: Vec<[f64; 2]> = Vec::new();
    for edge in edges.iter().filter(|edge| edge.state == state) {
        match runs.last_mut() {
            Some(run) if touches(run[1], edge) => run[1] = edge.arc_length[1],
            _ => runs.push(edge.arc_length),
        }
    }
    runs
}

/// Whether the walk goes on from one edge to the other: pieces that lie apart follow one another in arc length alone.
fn continues(edge: &ContactEdge, next: &ContactEdge) -> bool {
    edge.ends[1] == next.ends[0] && touches(edge.arc_length[1], next)
}

/// Whether an edge begins where the one before ended, up to rounding.
fn touches(end: f64, edge: &ContactEdge) -> bool {
    let [start, stop] = edge.arc_length;
    (start - end).abs() <= 1e-6 * (stop - start).abs()
}

fn multiplier_range(edges: &[&ContactEdge]) -> [f64; 2] {
    let exact = extent(edges.iter().flat_map(|edge| edge.exact_multiplier.iter().copied()));
    let Some([low, high]) = extent(edges.iter().map(|edge| edge.multiplier)) else {
        return exact.unwrap_or_default();
    };
    let room = TALLEST * low.abs().max(high.abs());
    let [exact_low, exact_high] = exact.unwrap_or([low, high]);
    [low.min(exact_low.max(-room)), high.max(exact_high.min(room))]
}

/// Arc length and exact λ at the sample points of an edge.
fn exact_points(edge: &ContactEdge) -> Vec<[f64; 2]> {
    let [start, stop] = edge.arc_length;
    let values = &edge.exact_multiplier;
    let fraction = |index: usize| match values.len() {
        1 => 0.5,
        count => index as f64 / (count - 1) as f64,
    };
    let points = values.iter().enumerate();
    points.map(|(index, &value)| [start + fraction(index) * (stop - start), value]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(start: f64, touches: bool, multiplier: f64) -> ContactEdge {
        let arc_length = [start, start + 1.0];
        let state = if touches { ContactState::Touching } else { ContactState::Open };
        ContactEdge { arc_length, state, multiplier, ..ContactEdge::default() }
    }

    #[test]
    fn edges_of_a_state_join_unless_something_is_between() {
        let edges = [edge(0.0, true, 1.0), edge(1.0, true, 1.0), edge(2.0, false, 0.0)];
        let apart = [edge(3.0, true, 1.0), edge(5.0, true, 1.0)];
        let all: Vec<&ContactEdge> = edges.iter().chain(&apart).collect();
        assert_eq!(runs(&all, ContactState::Touching), [[0.0, 2.0], [3.0, 4.0], [5.0, 6.0]]);
        assert_eq!(runs(&all, ContactState::Open), [[2.0, 3.0]]);
        assert!(runs(&all, ContactState::Saturated).is_empty());
    }

    #[test]
    fn stretches_have_names_and_no_line_between_them() {
        let along = |start: f64, x: f64, boundary: &str| ContactEdge {
            ends: [[x, 0.0], [x + 1.0, 0.0]],
            boundary: boundary.to_owned(),
            ..edge(start, false, 1.0)
        };
        // The second lies apart, the third belongs to another boundary.
        let edges = vec![along(0.0, 0.0, "rib"), along(1.0, 5.0, "rib"), along(2.0, 6.0, "tip")];
        let apart = points(&edges.iter().collect::<Vec<_>>(), |of| vec![of.arc_length]);
        assert_eq!(apart, [Some([0.0, 1.0]), None, Some([1.0, 2.0]), Some([2.0, 3.0]), None]);
        let panel = ScenePanel { contact: edges, ..ScenePanel::default() };
        let svg = contact(&panel).expect("a picture").finish();
        for name in [">rib from (0, 0)<", ">rib from (5.00, 0)<", ">tip from (6.00, 0)<"] {
            assert!(svg.contains(name), "{name}: {svg}");
        }
    }

    #[test]
    fn a_singular_exact_multiplier_does_not_flatten_the_rest() {
        let exact_multiplier = vec![f64::INFINITY, 1e9, 1.0];
        let edges = [ContactEdge { exact_multiplier, ..edge(0.0, true, 2.0) }];
        let edges: Vec<&ContactEdge> = edges.iter().collect();
        assert_eq!(multiplier_range(&edges), [1.0, TALLEST * 2.0]);
    }

    #[test]
    fn one_exact_value_is_at_the_midpoint() {
        let midpoint = ContactEdge { exact_multiplier: vec![7.0], ..edge(2.0, true, 7.0) };
        assert_eq!(exact_points(&midpoint), [[2.5, 7.0]]);
        let ends = ContactEdge { exact_multiplier: vec![7.0, 8.0], ..edge(2.0, true, 7.0) };
        assert_eq!(exact_points(&ends), [[2.0, 7.0], [3.0, 8.0]]);
    }

    #[test]
    fn no_contact_no_picture() {
        assert!(contact(&ScenePanel::default()).is_none());
    }
}

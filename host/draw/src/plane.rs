//! The domain as a picture: colours with a bar that explains them, the mesh, the boundary by what holds
//! on it, axes.

use super::colormap::color;
use super::scale::{Scale, plain};
use super::svg::{Anchor, Path, Svg};
use super::view::View;
use super::{BoundaryKind, ContactState, ScenePanel};

/// Finer meshes would cover the colours.
const MOST_CELLS_WITH_LINES: usize = 1200;
const MARGIN: f64 = 58.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 30.0;
const BAR_GAP: f64 = 20.0;
const BAR: f64 = 14.0;
const BAR_LABELS: f64 = 70.0;

/// A picture over the domain being drawn.
pub struct Plane {
    /// Where the domain lies in it.
    pub view: View,
    /// Arrows to lie above everything else.
    pub arrows: Path,
    svg: Svg,
}

impl Plane {
    /// An empty picture of `what` of a scene; `None` when its vertices span no area.
    pub fn new(panel: &ScenePanel, what: &str) -> Option<Self> {
        let view = View::new(&panel.vertices, [MARGIN, TOP])?;
        let [width, height] = view.size();
        let total = MARGIN + width + BAR_GAP + BAR + BAR_LABELS;
        let label = format!("{}: {what}", panel.title);
        let svg = Svg::new(total, TOP + height + BOTTOM, &label);
        Some(Self { view, arrows: Path::default(), svg })
    }

    /// Fills the outlines `above` each of equally spaced levels from `low` on, each over the one before,
    /// and draws the bar of `quantity`. A range without a width has one colour.
    pub fn bands(
        &mut self,
        [low, high]: [f64; 2],
        most: u32,
        quantity: &str,
        above: impl Fn(f64) -> Vec<Vec<[f64; 2]>>,
    ) {
        let count = if low < high { most } else { 1 };
        for band in 0..count {
            let fraction = f64::from(band) / f64::from(count);
            let level = low * (1.0 - fraction) + high * fraction;
            let mut path = Path::default();
            above(level.max(low)).iter().for_each(|outline| path.polygon(outline));
            self.svg.fill(&band_color(band, count), &path);
        }
        self.bar([low, high], count, quantity);
    }

    fn bar(&mut self, [low, high]: [f64; 2], count: u32, quantity: &str) {
        let [width, height] = self.view.size();
        let (left, bottom, top) = (MARGIN + width + BAR_GAP, TOP + height, TOP);
        let (svg, right) = (&mut self.svg, left + BAR);
        for band in 0..count {
            let start = bottom + (top - bottom) * f64::from(band) / f64::from(count);
            let path = Path::around(&[[left, start], [right, start], [right, top], [left, top]]);
            svg.fill(&band_color(band, count), &path);
        }
        svg.rectangle("frame", [left, bottom], [right, top]);
        let scale = Scale::linear([low, high], [bottom, top]);
        let ticks = if low < high { scale.ticks(5) } else { vec![(low, plain(low))] };
        for (value, label) in ticks {
            let y = scale.at(value);
            svg.line("axis", [right, y], [right + 4.0, y]);
            svg.text("tick", [right + 8.0, y + 4.0], Anchor::Start, &label);
        }
        svg.text("quantity", [left, bottom + 21.0], Anchor::Start, quantity);
    }

    /// Draws the mesh (unless its cells are too many), boundary, axes and arrows, and ends the picture.
    pub fn finish(mut self, panel: &ScenePanel) -> String {
        if panel.cells().count() <= MOST_CELLS_WITH_LINES {
            self.svg.path("mesh", &mesh_lines(panel, &self.view));
        }
        self.boundary(panel);
        self.axes();
        self.svg.path("arrows", &self.arrows);
        self.svg.finish()
    }

    /// Draws the rest of the boundary first, so that the contact zone lies on top.
    fn boundary(&mut self, panel: &ScenePanel) {
        let draw = |ends: &mut dyn Iterator<Item = [[f64; 2]; 2]>| {
            let mut path = Path::default();
            ends.for_each(|ends| path.line(&ends.map(|end| self.view.at(end))));
            path
        };
        for kind in [BoundaryKind::Neumann, BoundaryKind::Robin, BoundaryKind::Dirichlet] {
            let edges = panel.boundary.iter().filter(|edge| edge.kind == kind);
            self.svg.path(class(kind), &draw(&mut edges.map(|edge| edge.ends)));
        }
        for state in ContactState::ALL {
            let edges = panel.contact.iter().filter(|edge| edge.state == state);
            let path = draw(&mut edges.map(|edge| edge.ends));
            ["halo", state.class()].iter().for_each(|class| self.svg.path(class, &path));
        }
    }

    /// Draws the coordinates around the domain.
    fn axes(&mut self) {
        let (svg, [x_range, y_range]) = (&mut self.svg, self.view.ranges());
        let [width, height] = self.view.size();
        let (bottom, right) = (TOP + height, MARGIN + width);
        let x = Scale::linear(x_range, [MARGIN, right]);
        for (value, label) in x.ticks(if width > 240.0 { 5 } else { 3 }) {
            svg.line("axis", [x.at(value), bottom + 6.0], [x.at(value), bottom + 10.0]);
            svg.text("tick", [x.at(value), bottom + 23.0], Anchor::Middle, &label);
        }
        let y = Scale::linear(y_range, [bottom, TOP]);
        for (value, label) in y.ticks(if height > 160.0 { 4 } else { 2 }) {
            svg.line("axis", [MARGIN - 10.0, y.at(value)], [MARGIN - 6.0, y.at(value)]);
            svg.text("tick", [MARGIN - 14.0, y.at(value) + 4.0], Anchor::End, &label);
        }
    }
}

fn band_color(band: u32, count: u32) -> String {
    color((f64::from(band) + 0.5) / f64::from(count))
}

fn mesh_lines(panel: &ScenePanel, view: &View) -> Path {
    let mut edges: Vec<[u32; 2]> = panel
        .cells()
        .flat_map(|cell| cell.iter().zip(cell.iter().cycle().skip(1)))
        .map(|(&a, &b)| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    let mut path = Path::default();
    for [a, b] in edges {
        if let (Some(&p), Some(&q)) =
            (panel.vertices.get(a as usize), panel.vertices.get(b as usize))
        {
            path.line(&[view.at(p), view.at(q)]);
        }
    }
    path
}

/// The class that shows a kind of boundary.
pub fn class(kind: BoundaryKind) -> &'static str {
    match kind {
        BoundaryKind::Dirichlet => "dirichlet",
        BoundaryKind::Neumann => "neumann",
        BoundaryKind::Robin => "robin",
    }
}

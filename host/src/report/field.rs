//! The solution over the plane: u as colour, σ = A∇u as arrows, the boundary by what holds on it.

use super::arrows::arrows;
use super::colormap::color;
use super::isobands::Surface;
use super::scale::{Scale, extent, plain};
use super::svg::{Anchor, Path, Svg};
use super::view::View;
use super::{BoundaryKind, ScenePanel};

/// Bands of colour; more cannot be told apart.
const BANDS: u32 = 64;
/// A range below this part of the values is rounding of f32, not a picture.
const ROUNDING: f64 = 1e-6;
/// Finer meshes would cover the colours.
const MOST_CELLS_WITH_LINES: usize = 1200;
const MARGIN: f64 = 58.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 30.0;
const BAR_GAP: f64 = 20.0;
const BAR: f64 = 14.0;
const BAR_LABELS: f64 = 70.0;

/// A picture with what to say about it.
pub struct Field {
    /// The SVG element.
    pub svg: String,
    /// The |σ| of the longest arrows, and whether an axis is stretched.
    pub notes: Vec<String>,
}

/// The picture of a scene; `None` when its vertices span no area.
pub fn field(panel: &ScenePanel) -> Option<Field> {
    let view = View::new(&panel.vertices, [MARGIN, TOP])?;
    let surface = Surface::new(panel, &view);
    let [width, height] = view.size();
    let total = MARGIN + width + BAR_GAP + BAR + BAR_LABELS;
    let label = format!("{}: the solution u over the plane", panel.title);
    let mut svg = Svg::new(total, TOP + height + BOTTOM, &label);

    if let Some([low, high]) = extent(surface.values()) {
        let visible = high - low > ROUNDING * low.abs().max(high.abs());
        let range = if visible { [low, high] } else { [low, low] };
        bands(&mut svg, &surface, range);
        color_bar(&mut svg, range, MARGIN + width + BAR_GAP, [TOP + height, TOP]);
    }
    if panel.triangles.len() + panel.quads.len() <= MOST_CELLS_WITH_LINES {
        svg.path("mesh", &mesh_lines(panel, &view));
    }
    boundary(&mut svg, panel, &view);
    axes(&mut svg, &view);
    let mut notes: Vec<String> = view.note().into_iter().collect();
    if let Some((path, full)) = arrows(panel, &view) {
        svg.path("arrows", &path);
        notes.insert(0, format!("arrows σ = A∇u, the longest |σ| ≥ {}", plain(full)));
    }
    Some(Field { svg: svg.finish(), notes })
}

/// Band k shows the values from `low` + k/64 of the range on; the next covers what is higher.
fn bands(svg: &mut Svg, surface: &Surface, [low, high]: [f64; 2]) {
    let count = if low < high { BANDS } else { 1 };
    for band in 0..count {
        let fraction = f64::from(band) / f64::from(count);
        let level = low * (1.0 - fraction) + high * fraction;
        let mut path = Path::default();
        surface.above(level.max(low)).iter().for_each(|outline| path.polygon(outline));
        svg.fill(&band_color(band, count), &path);
    }
}

fn band_color(band: u32, count: u32) -> String {
    color((f64::from(band) + 0.5) / f64::from(count))
}

fn color_bar(svg: &mut Svg, [low, high]: [f64; 2], left: f64, [bottom, top]: [f64; 2]) {
    let right = left + BAR;
    let constant = low >= high;
    let count = if constant { 1 } else { BANDS };
    for band in 0..count {
        let start = bottom + (top - bottom) * f64::from(band) / f64::from(count);
        let mut path = Path::default();
        path.polygon(&[[left, start], [right, start], [right, top], [left, top]]);
        svg.fill(&band_color(band, count), &path);
    }
    svg.rectangle("frame", [left, bottom], [right, top]);
    let scale = Scale::linear([low, high], [bottom, top]);
    let ticks = if constant { vec![(low, plain(low))] } else { scale.ticks(5) };
    for (value, label) in ticks {
        let y = scale.at(value);
        svg.line("axis", [right, y], [right + 4.0, y]);
        svg.text("tick", [right + 8.0, y + 4.0], Anchor::Start, &label);
    }
    svg.text("quantity", [left + 0.5 * BAR, bottom + 20.0], Anchor::Middle, "u");
}

fn mesh_lines(panel: &ScenePanel, view: &View) -> Path {
    let cells = panel.triangles.iter().map(|cell| cell.as_slice());
    let cells = cells.chain(panel.quads.iter().map(|cell| cell.as_slice()));
    let mut edges: Vec<[u32; 2]> = cells
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

/// The rest of the boundary first, so that the contact zone lies on top.
fn boundary(svg: &mut Svg, panel: &ScenePanel, view: &View) {
    let draw = |ends: &mut dyn Iterator<Item = [[f64; 2]; 2]>| {
        let mut path = Path::default();
        ends.for_each(|[from, to]| path.line(&[view.at(from), view.at(to)]));
        path
    };
    for kind in [BoundaryKind::Neumann, BoundaryKind::Robin, BoundaryKind::Dirichlet] {
        let edges = panel.boundary.iter().filter(|edge| edge.kind == kind);
        svg.path(class(kind), &draw(&mut edges.map(|edge| edge.ends)));
    }
    for (active, classes) in [(false, ["halo", "open"]), (true, ["halo", "active"])] {
        let edges = panel.contact.iter().filter(|edge| edge.active == active);
        let path = draw(&mut edges.map(|edge| edge.ends));
        classes.iter().for_each(|class| svg.path(class, &path));
    }
}

/// The class that shows a kind of boundary.
pub fn class(kind: BoundaryKind) -> &'static str {
    match kind {
        BoundaryKind::Dirichlet => "dirichlet",
        BoundaryKind::Neumann => "neumann",
        BoundaryKind::Robin => "robin",
    }
}

fn axes(svg: &mut Svg, view: &View) {
    let [x_range, y_range] = view.ranges();
    let [width, height] = view.size();
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

//! The plan of a scene as a file of its own: what holds on which part of the boundary, and which material lies where.

use super::legend::{Key, LETTERS, ROW, row};
use super::lettering::shortened;
use super::outline::around;
use super::plane::{MOST_CELLS_WITH_LINES, View, mesh_lines};
use super::svg::{Anchor, MARGIN, Path, Svg};
use super::{BoundaryKind, ScenePanel};

/// A scene that has not been solved.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// Title, vertices and cells.
    pub panel: ScenePanel,
    /// The boundaries.
    pub boundaries: Vec<PlanBoundary>,
    /// The materials: a name and cells, triangles first.
    pub materials: Vec<(String, Vec<u32>)>,
}

/// A boundary of a plan.
#[derive(Debug, Clone)]
pub struct PlanBoundary {
    /// Its name.
    pub name: String,
    /// What holds on it.
    pub kind: PlanKind,
    /// The vertices of its edges.
    pub edges: Vec<[u32; 2]>,
}

/// What holds on a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanKind {
    /// A datum is prescribed.
    Prescribed(BoundaryKind),
    /// Contact.
    Contact,
    /// Somebody is still to decide.
    Open,
}

impl PlanKind {
    const ALL: [Self; 5] = [
        Self::Prescribed(BoundaryKind::Neumann),
        Self::Prescribed(BoundaryKind::Robin),
        Self::Prescribed(BoundaryKind::Dirichlet),
        Self::Contact,
        Self::Open,
    ];

    /// The class of its line, and the words of the legend.
    fn look(self) -> [&'static str; 2] {
        match self {
            Self::Prescribed(kind) => kind.look(),
            Self::Contact => ["active", "contact"],
            Self::Open => ["limit", "to be filled in"],
        }
    }
}

/// Around the domain: room for names.
const SIDES: f64 = 130.0;
const TOP: f64 = 78.0;
const FOOT: f64 = 84.0;
/// From an edge to its name.
const APART: f64 = 12.0;
/// The part of a normal that points aside, below which an edge counts as flat.
const FLAT: f64 = 0.35;
/// As many materials as there are colours stand in the legend.
const MOST_MATERIALS: usize = 6;

/// The picture; `None` when the vertices span no area.
pub fn plan_file(plan: &Plan) -> Option<String> {
    let view = View::new(&plan.panel.vertices, [SIDES, TOP])?;
    let [across, down] = view.size();
    let size = [2.0 * SIDES + across, TOP + down + FOOT];
    let title = &plan.panel.title;
    let mut svg = Svg::alone(size[0], size[1], &format!("{title}: what stands where"));
    svg.heading(title);
    materials(&mut svg, plan, &view);
    if plan.panel.cells().count() <= MOST_CELLS_WITH_LINES {
        svg.path("grid", &mesh_lines(&plan.panel, &view));
    }
    boundaries(&mut svg, plan, &view);
    names(&mut svg, plan, &view);
    legend(&mut svg, plan, size[1] - 24.0);
    if let Some(note) = view.note() {
        svg.text("tick", [size[0] - 18.0, size[1] - 24.0], Anchor::End, &note);
    }
    Some(svg.finish())
}

fn materials(svg: &mut Svg, plan: &Plan, view: &View) {
    for (at, (_, cells)) in plan.materials.iter().enumerate() {
        let triangles = cells.iter().flat_map(|&cell| triangles(&plan.panel, cell));
        let outlines = around(triangles, |vertex| view.at(plan.panel.vertices[vertex]));
        let mut path = Path::default();
        outlines.iter().for_each(|outline| path.polygon(outline));
        svg.path(&ground(at), &path);
    }
}

/// The class of the area of a material.
fn ground(at: usize) -> String {
    format!("ground-{}", at % MOST_MATERIALS)
}

fn boundaries(svg: &mut Svg, plan: &Plan, view: &View) {
    for kind in PlanKind::ALL {
        for of in plan.boundaries.iter().filter(|of| of.kind == kind) {
            let point = |vertex: u32| plan.panel.vertices[vertex as usize];
            let path = view.lines(of.edges.iter().map(|ends| ends.map(point)));
            svg.explained(kind.look()[0], &path, &format!("{}: {}", of.name, kind.look()[1]));
        }
    }
}

/// Writes the name of each boundary outside of its middle.
fn names(svg: &mut Svg, plan: &Plan, view: &View) {
    let middle = |[a, b]: [u32; 2]| {
        let [a, b] = [a, b].map(|vertex| plan.panel.vertices[vertex as usize]);
        [0, 1].map(|k| 0.5 * (a[k] + b[k]))
    };
    for of in &plan.boundaries {
        let Some(edge) = nearest_to_mean(&of.edges, |&edge| middle(edge)) else { continue };
        let at = view.at(middle(*edge));
        let ends = edge.map(|vertex| view.at(plan.panel.vertices[vertex as usize]));
        let inside = inside(&plan.panel, *edge).map_or(at, |centre| view.at(centre));
        let [x, y] = outward(ends, [at[0] - inside[0], at[1] - inside[1]]);
        // Beside a steep edge the name begins or ends there, above and below a flat one it stands in the middle.
        let anchor = match x {
            x if x < -FLAT => Anchor::End,
            x if x > FLAT => Anchor::Start,
            _ => Anchor::Middle,
        };
        let name = shortened(&of.name, LETTERS, SIDES - APART);
        let place = [at[0] + APART * x, at[1] + (APART + 0.5 * LETTERS * y.abs()) * y + 4.0];
        svg.abridged("name", place, anchor, &name, &of.name);
    }
}

/// The unit normal of an edge, to the side that `away` points to.
fn outward([[ax, ay], [bx, by]]: [[f64; 2]; 2], away: [f64; 2]) -> [f64; 2] {
    let (x, y) = (by - ay, ax - bx);
    let length = x.hypot(y).copysign(x * away[0] + y * away[1]);
    if length == 0.0 { [0.0, 1.0] } else { [x / length, y / length] }
}

/// The centre of the cell behind an edge.
fn inside(panel: &ScenePanel, edge: [u32; 2]) -> Option<[f64; 2]> {
    let cell = panel.cells().position(|cell| edge.iter().all(|vertex| cell.contains(vertex)))?;
    let corners = corners(panel, cell as u32);
    let sum = corners.iter().fold([0.0; 2], |[x, y], &at| {
        let [dx, dy] = panel.vertices[at as usize];
        [x + dx, y + dy]
    });
    Some(sum.map(|sum| sum / corners.len() as f64))
}

/// The kinds of boundaries and, a line above, the materials.
fn legend(svg: &mut Svg, plan: &Plan, y: f64) {
    let is_met = |kind: &PlanKind| plan.boundaries.iter().any(|of| of.kind == *kind);
    let kinds = PlanKind::ALL.into_iter().filter(is_met).map(PlanKind::look);
    row(svg, [MARGIN, y], kinds.map(|[class, words]| (Key::Line(class), words)));
    let grounds: Vec<String> = (0..MOST_MATERIALS).map(ground).collect();
    let materials = grounds.iter().zip(&plan.materials);
    let areas = materials.map(|(class, (name, _))| (Key::Area(class), name.as_str()));
    row(svg, [MARGIN, y - ROW], areas);
}

/// The item whose point is nearest to the mean of all points.
fn nearest_to_mean<T>(items: &[T], point: impl Fn(&T) -> [f64; 2]) -> Option<&T> {
    let sum = items.iter().map(&point).fold([0.0; 2], |[x, y], p| [x + p[0], y + p[1]]);
    let mean = sum.map(|sum| sum / items.len() as f64);
    let distance = |item: &T| {
        let [x, y] = point(item);
        (x - mean[0]).hypot(y - mean[1])
    };
    items.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// The vertices of a cell, triangles first.
fn corners(panel: &ScenePanel, cell: u32) -> &[u32] {
    let cell = cell as usize;
    match panel.triangles.get(cell) {
        Some(corners) => corners,
        None => &panel.quads[cell - panel.triangles.len()],
    }
}

/// A cell cut into triangles.
fn triangles(panel: &ScenePanel, cell: u32) -> impl Iterator<Item = [usize; 3]> {
    let corners: Vec<_> = corners(panel, cell).iter().map(|&at| at as usize).collect();
    (2..corners.len()).map(move |last| [corners[0], corners[last - 1], corners[last]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_names_groups_and_says_what_is_open() {
        let panel = ScenePanel {
            title: "a <plate>".to_owned(),
            vertices: vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]],
            quads: vec![[0, 1, 2, 3]],
            ..ScenePanel::default()
        };
        let side = |name: &str, kind, edge| PlanBoundary {
            name: name.to_owned(),
            kind,
            edges: vec![edge],
        };
        let plan = Plan {
            boundaries: vec![
                side("wall", PlanKind::Prescribed(BoundaryKind::Dirichlet), [3, 0]),
                side("roof", PlanKind::Open, [2, 3]),
            ],
            materials: vec![("sand".to_owned(), vec![0])],
            panel,
        };
        let svg = plan_file(&plan).expect("a picture");
        for words in [
            "a &lt;plate&gt;",
            ">wall</text>",
            ">roof</text>",
            ">sand</text>",
            "Dirichlet",
            "to be filled in",
        ] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(!svg.contains(">contact</text>") && svg.contains("class=\"ground-0\""));
        assert!(plan_file(&Plan::default()).is_none());
    }
}

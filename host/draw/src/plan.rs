//! The plan of a scene as a file of its own: what holds on which part of the boundary, and which material lies where.

use super::lettering::width;
use super::outline::{Segments, rim};
use super::plane::{MOST_CELLS_WITH_LINES, View, mesh_lines};
use super::svg::{Anchor, Path, Svg};
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
    /// The ends of its edges.
    pub edges: Vec<[[f64; 2]; 2]>,
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
const APART: f64 = 14.0;
const LETTERS: f64 = 11.5;

/// The picture; `None` when the vertices span no area.
pub fn plan_file(plan: &Plan) -> Option<String> {
    let view = View::new(&plan.panel.vertices, [SIDES, TOP])?;
    let [across, down] = view.size();
    let size = [2.0 * SIDES + across, TOP + down + FOOT];
    let mut svg = Svg::alone(size[0], size[1], &format!("{}: what stands where", plan.panel.title));
    svg.text("title", [18.0, 28.0], Anchor::Start, &plan.panel.title);
    materials(&mut svg, plan, &view);
    if plan.panel.cells().count() <= MOST_CELLS_WITH_LINES {
        svg.path("grid", &mesh_lines(&plan.panel, &view));
    }
    for (name, cells) in &plan.materials {
        if let Some(middle) = middle(cells.iter().map(|&cell| centre(&plan.panel, cell))) {
            svg.text("name", view.at(middle), Anchor::Middle, name);
        }
    }
    boundaries(&mut svg, plan, &view);
    legend(&mut svg, plan, size[1] - 24.0);
    if let Some(note) = view.note() {
        svg.text("tick", [size[0] - 18.0, size[1] - 24.0], Anchor::End, &note);
    }
    Some(svg.finish())
}

fn materials(svg: &mut Svg, plan: &Plan, view: &View) {
    const COLORS: usize = 6;
    for (at, (_, cells)) in plan.materials.iter().enumerate() {
        let mut segments = Segments::default();
        let triangles = cells.iter().flat_map(|&cell| triangles(&plan.panel, cell));
        rim(triangles).into_iter().for_each(|[a, b]| segments.add([a, a], [b, b]));
        let mut path = Path::default();
        let point = |[vertex, _]: [usize; 2]| view.at(plan.panel.vertices[vertex]);
        segments.outlines(point).iter().for_each(|outline| path.polygon(outline));
        svg.path(&format!("ground-{}", at % COLORS), &path);
    }
}

fn boundaries(svg: &mut Svg, plan: &Plan, view: &View) {
    let [across, down] = view.size();
    let heart = [SIDES + 0.5 * across, TOP + 0.5 * down];
    for kind in PlanKind::ALL {
        for of in plan.boundaries.iter().filter(|of| of.kind == kind) {
            let mut path = Path::default();
            of.edges.iter().for_each(|ends| path.line(&ends.map(|end| view.at(end))));
            svg.explained(kind.look()[0], &path, &format!("{}: {}", of.name, kind.look()[1]));
        }
    }
    for of in &plan.boundaries {
        let middles = of.edges.iter().map(|[a, b]| [0, 1].map(|k| 0.5 * (a[k] + b[k])));
        let Some(middle) = middle(middles) else { continue };
        let at = view.at(middle);
        // Outwards, as far as the middle of the domain tells.
        let way = [(at[0] - heart[0]) / across, (at[1] - heart[1]) / down];
        let (at, anchor) = if way[0].abs() > way[1].abs() {
            let anchor = if way[0] < 0.0 { Anchor::End } else { Anchor::Start };
            ([at[0] + APART * way[0].signum(), at[1] + 4.0], anchor)
        } else {
            ([at[0], at[1] + APART * way[1].signum() + 4.0], Anchor::Middle)
        };
        svg.text("name", at, anchor, &of.name);
    }
}

fn legend(svg: &mut Svg, plan: &Plan, y: f64) {
    const KEY: f64 = 22.0;
    let mut x = 18.0;
    for kind in PlanKind::ALL {
        if plan.boundaries.iter().any(|of| of.kind == kind) {
            let [class, words] = kind.look();
            svg.line(class, [x, y - 4.0], [x + KEY, y - 4.0]);
            svg.text("name", [x + KEY + 6.0, y], Anchor::Start, words);
            x += KEY + 26.0 + width(words, LETTERS);
        }
    }
}

/// Of these points the one nearest to their mean.
fn middle(points: impl Iterator<Item = [f64; 2]> + Clone) -> Option<[f64; 2]> {
    let (count, sum) = points
        .clone()
        .fold((0.0, [0.0; 2]), |(count, [x, y]), p| (count + 1.0, [x + p[0], y + p[1]]));
    let mean = sum.map(|sum| sum / count);
    let distance = |p: &[f64; 2]| (p[0] - mean[0]).hypot(p[1] - mean[1]);
    points.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// The vertices of a cell, triangles first.
fn corners(panel: &ScenePanel, cell: u32) -> &[u32] {
    let cell = cell as usize;
    match panel.triangles.get(cell) {
        Some(corners) => corners,
        None => &panel.quads[cell - panel.triangles.len()],
    }
}

fn centre(panel: &ScenePanel, cell: u32) -> [f64; 2] {
    let corners = corners(panel, cell);
    let sum = corners.iter().fold([0.0; 2], |[x, y], &at| {
        let [dx, dy] = panel.vertices[at as usize];
        [x + dx, y + dy]
    });
    sum.map(|sum| sum / corners.len() as f64)
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
                side(
                    "wall",
                    PlanKind::Prescribed(BoundaryKind::Dirichlet),
                    [[0.0, 0.0], [0.0, 1.0]],
                ),
                side("roof", PlanKind::Open, [[0.0, 1.0], [2.0, 1.0]]),
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

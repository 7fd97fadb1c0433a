//! Meshes drawn at random: grids whose lines, cells and outline are moved.
//!
//! ```text
//!   lines (even or graded) ─► cells (kept, cut, or left out) ─► vertices moved ─► the whole turned and sheared
//! ```
//! The vertices on x = 0 stay there, those of a side stay on it: a jump of A and an exact solution fit.

use std::collections::{BTreeMap, HashMap};

use serde::{Deserialize, Serialize};

use crate::extremes::grid::partition;
use signorini_problem::random::Random;
use signorini_scene::Mesh;
use signorini_scene::mesh::{Curve, Surface};

/// The cells of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    #[default]
    Triangles,
    Quads,
    Both,
}

/// Which part of the rectangle is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outline {
    Whole,
    /// All but the upper right corner.
    Corner,
    /// Two parts, left and right of a strip.
    Apart,
}

/// Which cells belong to which material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regions {
    /// `left` of x = 0 and `right` of it.
    Halves,
    /// `left` below, `right` above.
    Layers,
    /// Each cell by chance.
    Scattered,
}

/// The properties of a mesh that is drawn.
#[derive(Debug, Clone, Copy)]
pub struct MeshPlan {
    pub cells: u32,
    pub kind: Kind,
    pub outline: Outline,
    pub regions: Regions,
    /// How far vertices move, in widths of their cells.
    pub moved: f64,
    /// Whether lines lie closer together on one side.
    pub graded: bool,
    pub split: bool,
    /// The image of a place: (axx x + axy y, ayx x + ayy y).
    pub map: [[f64; 2]; 2],
}

/// A mesh, and of each of its curves the outward normal.
#[derive(Debug, Clone)]
pub struct Drawn {
    pub mesh: Mesh,
    pub normals: Vec<[f64; 2]>,
}

struct Lines {
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Lines {
    fn draw(random: &mut Random, plan: &MeshPlan) -> Self {
        let squares = match plan.kind {
            Kind::Triangles => plan.cells / 2,
            _ => plan.cells,
        };
        let squares = f64::from(squares.max(2));
        let stretch = random.log(0.5, 2.0);
        let half = ((0.5 * squares).sqrt() * stretch).round().clamp(1.0, 100.0);
        let rows = (0.5 * squares / half).round().clamp(1.0, 100.0);
        let [columns, rows] = [2 * half as u32, rows as u32];
        let mut graded = |lines: u32| {
            let growth = if plan.graded { random.signed_log(1.05, 2.0) } else { 1.0 };
            growing(lines, if growth < 0.0 { -1.0 / growth } else { growth })
        };
        let half: Vec<f64> = graded(columns / 2);
        let left = half.iter().rev().map(|x| -x);
        let x = left.chain(half.iter().copied().skip(1)).collect();
        Self { x, y: graded(rows) }
    }

    fn columns(&self) -> usize {
        self.x.len() - 1
    }

    fn rows(&self) -> usize {
        self.y.len() - 1
    }

    fn is_kept(&self, outline: Outline, i: usize, j: usize) -> bool {
        let (half, middle) = (self.columns() / 2, self.rows() / 2);
        match outline {
            Outline::Whole => true,
            Outline::Corner => i < half || j < middle.max(1),
            Outline::Apart => self.columns() < 6 || !(half - 1..=half).contains(&i),
        }
    }

    /// Where vertex i of line j lies.
    fn place(&self, random: &mut Random, plan: &MeshPlan, i: usize, j: usize) -> [f64; 2] {
        let mut step = |lines: &[f64], at: usize| {
            let shift = plan.moved * random.between(-1.0, 1.0);
            match (at.checked_sub(1).and_then(|before| lines.get(before)), lines.get(at + 1)) {
                (Some(before), Some(after)) => shift * (lines[at] - before).min(after - lines[at]),
                _ => 0.0,
            }
        };
        let [x, y] = [step(&self.x, i), step(&self.y, j)];
        let [steep, level] = self.is_outline(plan.outline, i, j);
        [self.x[i] + if steep { 0.0 } else { x }, self.y[j] + if level { 0.0 } else { y }]
    }

    /// Whether a line may be a side, or carry a jump of A: its vertices stay on it.
    fn is_outline(&self, outline: Outline, i: usize, j: usize) -> [bool; 2] {
        let (half, middle) = (self.columns() / 2, self.rows() / 2);
        match outline {
            Outline::Whole => [i == half, false],
            Outline::Corner => [i == half, j == middle.max(1)],
            Outline::Apart => [(half - 1..=half + 1).contains(&i), false],
        }
    }
}

/// 0 to 1 in so many steps, each `growth` times the one before, at most 1e3 in all.
fn growing(steps: u32, growth: f64) -> Vec<f64> {
    let most = 1e3_f64.powf(1.0 / f64::from(steps));
    let growth = growth.clamp(1.0 / most, most);
    partition(&(0..steps).map(|step| growth.powf(f64::from(step))).collect::<Vec<_>>())
}

pub fn draw(random: &mut Random, plan: &MeshPlan) -> Drawn {
    let lines = Lines::draw(random, plan);
    let (columns, rows) = (lines.columns(), lines.rows());
    let places: Vec<[f64; 2]> = (0..=rows)
        .flat_map(|j| (0..=columns).map(move |i| (i, j)))
        .map(|(i, j)| lines.place(random, plan, i, j))
        .collect();
    let (mut triangles, mut quads) = (Vec::new(), Vec::new());
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        if !lines.is_kept(plan.outline, i, j) {
            continue;
        }
        let a = (j * (columns + 1) + i) as u32;
        let above = a + columns as u32 + 1;
        let mut corners = [a, a + 1, above + 1, above];
        corners.rotate_left(random.below(4) as usize);
        let first = match plan.regions {
            Regions::Halves => 2 * i < columns,
            Regions::Layers => 2 * j < rows,
            Regions::Scattered => random.chance(0.5),
        };
        let cut = match plan.kind {
            Kind::Triangles => true,
            Kind::Quads => false,
            Kind::Both => random.chance(0.5),
        };
        let [a, b, c, d] = corners;
        match cut {
            true => triangles.extend([([a, b, c], first), ([a, c, d], first)]),
            false => quads.push((corners, first)),
        }
    }
    Numbering::default().mesh(&lines, plan, &places, &triangles, &quads)
}

/// The vertices that belong to a cell, in the order in which they are met.
#[derive(Default)]
struct Numbering {
    numbers: HashMap<u32, u32>,
    old: Vec<u32>,
}

impl Numbering {
    fn of(&mut self, vertex: u32) -> u32 {
        *self.numbers.entry(vertex).or_insert_with(|| {
            self.old.push(vertex);
            self.old.len() as u32 - 1
        })
    }

    fn mesh(
        mut self,
        lines: &Lines,
        plan: &MeshPlan,
        places: &[[f64; 2]],
        triangles: &[([u32; 3], bool)],
        quads: &[([u32; 4], bool)],
    ) -> Drawn {
        let map = |[x, y]: [f64; 2]| plan.map.map(|[by_x, by_y]| by_x * x + by_y * y);
        let mut mesh = Mesh {
            triangles: triangles.iter().map(|(cell, _)| cell.map(|v| self.of(v))).collect(),
            quads: quads.iter().map(|(cell, _)| cell.map(|v| self.of(v))).collect(),
            ..Mesh::default()
        };
        mesh.vertices = self.old.iter().map(|&vertex| map(places[vertex as usize])).collect();
        let first: Vec<bool> =
            triangles.iter().map(|of| of.1).chain(quads.iter().map(|of| of.1)).collect();
        mesh.surfaces = ["left", "right"].map(|name| surface(name, &first)).into();
        mesh.surfaces.retain(|surface| !surface.cells.is_empty());
        let mut normals = Vec::new();
        for (name, edges) in self.curves(lines, plan, &mesh) {
            let [a, b] = edges[0].map(|vertex: u32| mesh.vertices[vertex as usize]);
            let along = [b[0] - a[0], b[1] - a[1]];
            let length = along[0].hypot(along[1]);
            normals.push([along[1] / length, -along[0] / length]);
            let mut edges: Vec<_> = edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
            edges.sort_unstable();
            mesh.curves.push(Curve { name, edges });
        }
        Drawn { mesh, normals }
    }

    /// The sides with their edges, directed as their cells run, in the order of their places.
    fn curves(&self, lines: &Lines, plan: &MeshPlan, mesh: &Mesh) -> Vec<(String, Vec<[u32; 2]>)> {
        let width = lines.columns() as u32 + 1;
        let at = |vertex: u32| {
            let old = self.old[vertex as usize];
            [old % width, old / width]
        };
        let last = [width - 1, lines.rows() as u32];
        let mut sides: BTreeMap<(&str, u32), Vec<[u32; 2]>> = BTreeMap::new();
        for edge in boundary(mesh) {
            let [a, b] = edge.map(at);
            let same = |axis: usize, line: u32| a[axis] == line && b[axis] == line;
            let key = match () {
                () if same(1, 0) => ("bottom", 0),
                () if same(1, last[1]) => ("top", 0),
                () if same(0, 0) => ("left", 0),
                () if same(0, last[0]) => ("right", 0),
                () if a[0] == b[0] => ("steep", a[0]),
                () => ("level", a[1]),
            };
            sides.entry(key).or_default().push(edge);
        }
        let mut curves = Vec::new();
        for ((name, line), mut edges) in sides {
            edges.sort_by_key(|edge| edge.map(at));
            let name = if line == 0 { name.to_owned() } else { format!("{name}{line}") };
            if plan.split && edges.len() > 1 {
                let rest = edges.split_off(edges.len() / 2);
                curves.push((format!("{name}-rest"), rest));
            }
            curves.push((name, edges));
        }
        curves
    }
}

fn surface(name: &str, first: &[bool]) -> Surface {
    let wanted = name == "left";
    let cells = (0..).zip(first).filter(|(_, is_first)| **is_first == wanted);
    Surface { name: name.to_owned(), cells: cells.map(|(cell, _)| cell).collect() }
}

/// The edges with one cell, directed as it runs.
fn boundary(mesh: &Mesh) -> Vec<[u32; 2]> {
    let mut found: BTreeMap<[u32; 2], Option<[u32; 2]>> = BTreeMap::new();
    for cell in mesh.corners() {
        for (k, &a) in cell.iter().enumerate() {
            let b = cell[(k + 1) % cell.len()];
            let side = found.entry([a.min(b), a.max(b)]);
            side.and_modify(|side| *side = None).or_insert(Some([a, b]));
        }
    }
    found.into_values().flatten().collect()
}

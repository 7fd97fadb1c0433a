//! From the sections of a file to a mesh that keeps its contract.

use super::cells::{self, Resolved};
use super::cursor::{Cursor, Parsed};
use super::groups;
use super::index::NodeIndex;
use super::raw::{Kind, Node, Raw};
use crate::error::InputError;
use crate::mesh::check::{self, Fault};
use crate::mesh::{Curve, Mesh, Surface};

/// How far from their plane vertices may lie, as part of the size of the mesh: what rotations and
/// CAD kernels leave.
const PLANE_TOLERANCE: f64 = 1e-9;

/// Puts the sections together, with everything checked.
pub(super) fn build(cursor: &Cursor, raw: &Raw) -> Parsed<Mesh> {
    let nodes = raw.nodes.as_deref().ok_or_else(|| missing("$Nodes"))?;
    let elements = raw.elements.as_deref().ok_or_else(|| missing("$Elements"))?;
    let index = NodeIndex::new(cursor, nodes)?;
    let resolve = |dimension| {
        let chosen = elements.iter().filter(move |element| element.kind.dimension() == dimension);
        let resolved = chosen.map(|element| Resolved::new(cursor, &index, element));
        resolved.collect::<Parsed<Vec<_>>>()
    };
    let (lines, mut cells) = (resolve(1)?, resolve(2)?);
    if cells.is_empty() {
        let error = InputError::new("the mesh has no triangle and no quad");
        return Err(error.hint("mesh in two dimensions; put the surfaces in a group").into());
    }
    groups::check_room(cursor, raw, lines.iter().chain(&cells).map(|line| line.element))?;
    // As the mesh numbers them: triangles before quads, each kind in the order of the file.
    cells.sort_by_key(|cell| cell.element.kind == Kind::Quad);

    let vertices = Vertices::of(&cells, nodes.len());
    check_plane(cursor, nodes, &vertices.nodes)?;
    cells.iter_mut().try_for_each(|cell| cell.orient(cursor, nodes))?;
    let (distinct, number) = cells::distinct(&cells);
    let mesh = Mesh {
        vertices: vertices.nodes.iter().map(|&n| plane_point(&nodes[n as usize])).collect(),
        triangles: distinct.iter().filter_map(|cell| vertices.corners(cell)).collect(),
        quads: distinct.iter().filter_map(|cell| vertices.corners(cell)).collect(),
        surfaces: surfaces(cursor, raw, &cells, &number)?,
        curves: Vec::new(),
    };
    let edges = check::edges(&mesh).map_err(|fault| {
        let node = |vertex: u32| nodes[vertices.nodes[vertex as usize] as usize].tag;
        describe(cursor, &distinct, fault, node)
    })?;
    let curves = curves(cursor, raw, &lines, &vertices, &edges)?;
    Ok(Mesh { curves, ..mesh })
}

fn missing(section: &str) -> Box<InputError> {
    let error = InputError::new(format!("expected a section {section}, found none"));
    error.hint("save as MSH 4.1, or as 2.2 without parametric coordinates").into()
}

/// The nodes that are corners of cells, numbered from 0 in the order of the file.
struct Vertices {
    /// The node of each vertex.
    nodes: Vec<u32>,
    /// The vertex at each node.
    numbers: Vec<Option<u32>>,
}

impl Vertices {
    fn of(cells: &[Resolved], nodes: usize) -> Self {
        let mut used = vec![false; nodes];
        for &corner in cells.iter().flat_map(Resolved::corners) {
            used[corner as usize] = true;
        }
        let nodes: Vec<_> = (0..).zip(&used).filter(|node| *node.1).map(|node| node.0).collect();
        let mut numbers = vec![None; used.len()];
        for (&node, vertex) in nodes.iter().zip(0..) {
            numbers[node as usize] = Some(vertex);
        }
        Self { nodes, numbers }
    }

    /// The corners of a cell or line as vertices, if it has `N` corners and all are vertices.
    fn corners<const N: usize>(&self, cell: &Resolved) -> Option<[u32; N]> {
        let corners: [u32; N] = cell.corners().try_into().ok()?;
        let vertices = corners.map(|node| self.numbers[node as usize]);
        vertices.iter().all(Option::is_some).then(|| vertices.map(Option::unwrap_or_default))
    }
}

fn plane_point(node: &Node) -> [f64; 2] {
    [node.point[0], node.point[1]]
}

/// All vertices have the same z, up to a part of the extent in x or y.
fn check_plane(cursor: &Cursor, nodes: &[Node], used: &[u32]) -> Parsed<()> {
    let points = || used.iter().map(|&node| &nodes[node as usize]);
    let extent = |axis: usize| {
        let range = |(low, high): (f64, f64), node: &Node| {
            (low.min(node.point[axis]), high.max(node.point[axis]))
        };
        let (low, high) = points().fold((f64::INFINITY, f64::NEG_INFINITY), range);
        high - low
    };
    let tolerance = PLANE_TOLERANCE * extent(0).max(extent(1));
    let Some(first) = points().next() else { return Ok(()) };
    match points().find(|node| (node.point[2] - first.point[2]).abs() > tolerance) {
        None => Ok(()),
        Some(node) => {
            let message = format!(
                "node {} has z = {}, node {} has z = {}, expected a mesh in a plane z = constant",
                node.tag, node.point[2], first.tag, first.point[2]
            );
            let hint = "mesh in the x-y plane, in two dimensions (command line: `-2`)";
            Err(cursor.error(node.at, message).hint(hint).into())
        }
    }
}

/// The physical surfaces; a cell listed twice for the same one, or twice for none, is an error.
fn surfaces(
    cursor: &Cursor,
    raw: &Raw,
    cells: &[Resolved],
    number: &[u32],
) -> Parsed<Vec<Surface>> {
    let mut listed = Vec::with_capacity(cells.len());
    for (place, (cell, &number)) in cells.iter().zip(number).enumerate() {
        match groups::tags(cursor, raw, cell.element)? {
            [] => listed.push((0, number, place)),
            tags => listed.extend(tags.iter().map(|&tag| (tag, number, place))),
        }
    }
    listed.sort_unstable();
    let repeated = |pair: &&[(i32, u32, usize)]| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1);
    if let Some(pair) = listed.windows(2).find(repeated) {
        let [first, again] = [pair[0], pair[1]].map(|(_, _, place)| cells[place].element);
        let message = format!("duplicate cell: {} repeats {}", again.title(), first.title());
        let hint = "remove one (in Gmsh `Coherence Mesh` does)";
        return Err(cursor.error(again.at, message).hint(hint).into());
    }
    let grouped = listed.into_iter().filter(|&(tag, ..)| tag != 0);
    let groups = groups::collect(raw, 2, grouped.map(|(tag, cell, _)| (tag, cell)).collect())?;
    Ok(groups.into_iter().map(|(name, cells)| Surface { name, cells }).collect())
}

/// The physical curves; their lines must be edges of cells.
fn curves(
    cursor: &Cursor,
    raw: &Raw,
    lines: &[Resolved],
    vertices: &Vertices,
    edges: &[[u32; 2]],
) -> Parsed<Vec<Curve>> {
    let mut members = Vec::new();
    for line in lines {
        let tags = groups::tags(cursor, raw, line.element)?;
        let edge = vertices.corners(line).map(|[a, b]: [u32; 2]| [a.min(b), a.max(b)]);
        match edge.filter(|edge| edges.binary_search(edge).is_ok()) {
            Some(edge) => members.extend(tags.iter().map(|&tag| (tag, edge))),
            None if tags.is_empty() => {}
            None => {
                let [a, b, ..] = line.element.nodes;
                let message =
                    format!("{}, nodes {a} and {b}, is no edge of a cell", line.element.title());
                let hint = "mesh the surface beside the curve, or take the curve out of its group";
                return Err(cursor.error(line.element.at, message).hint(hint).into());
            }
        }
    }
    let groups = groups::collect(raw, 1, members)?;
    Ok(groups.into_iter().map(|(name, edges)| Curve { name, edges }).collect())
}

/// A fault of the mesh in the words of the file.
fn describe(
    cursor: &Cursor,
    distinct: &[&Resolved],
    fault: Fault,
    node: impl Fn(u32) -> u64,
) -> Box<InputError> {
    let element = |cell: u32| distinct[cell as usize].element;
    let message =
        fault.describe(|cell| element(cell).title(), |vertex| format!("node {}", node(vertex)));
    cursor.error(element(fault.cell()).at, message).into()
}

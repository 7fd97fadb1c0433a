//! From the lists of a file to a mesh that keeps its contract, whatever the format.
//!
//! ```text
//! Draft: nodes, elements, groups ─► cells ─► sound ─► groups ─► Mesh
//!                               Arrays ──┘
//! ```
//! Points are ignored, lines matter in a physical curve only, vertices without a cell are dropped,
//! clockwise cells are turned round. A cell listed once for each of its physical surfaces is one
//! cell; listed twice for the same one it is an error.

mod cells;
pub(super) mod draft;
pub(super) mod plane;
pub(super) mod sound;

use self::cells::{NodeIndex, Resolved};
use self::draft::{Draft, Element, Kind, Parsed};
use self::sound::{Cells, Sound};
use crate::error::InputError;
use crate::mesh::{Curve, Mesh, Surface};

/// Puts the lists together, with everything checked.
pub(super) fn assemble(draft: &Draft) -> Parsed<Mesh> {
    let index = NodeIndex::new(draft)?;
    let (lines, mut cells) = (resolved(draft, &index, 1)?, resolved(draft, &index, 2)?);
    if cells.is_empty() {
        let error = InputError::new("the mesh has no triangle and no quad");
        return Err(error.hint("mesh in two dimensions; put the surfaces in a group").into());
    }
    check_room(draft, lines.iter().chain(&cells).map(|line| line.element))?;
    // As the mesh numbers them: triangles before quads, each kind in the order of the file.
    cells.sort_by_key(|cell| cell.element.kind == Kind::Quad);

    check_plane(draft, &cells)?;
    let (distinct, number) = cells::distinct(&cells);
    let points: Vec<_> = draft.nodes.iter().map(|node| [node.point[0], node.point[1]]).collect();
    let element = |cell: u32| distinct[cell as usize].element;
    let plane = Cells {
        points: &points,
        triangles: distinct.iter().filter_map(|cell| cell.corners().try_into().ok()).collect(),
        quads: distinct.iter().filter_map(|cell| cell.corners().try_into().ok()).collect(),
        cell: &|cell| element(cell).title(),
        point: &|at| format!("node {}", draft.nodes[at as usize].tag),
    };
    let sound = plane.sound().map_err(|(cell, message)| draft.error(element(cell).at, message))?;
    let surfaces = surfaces(draft, &cells, &number)?;
    let curves = curves(draft, &lines, &sound)?;
    Ok(Mesh { surfaces, curves, ..sound.mesh })
}

fn resolved<'a>(draft: &'a Draft, index: &NodeIndex, dimension: u8) -> Parsed<Vec<Resolved<'a>>> {
    let chosen = draft.elements.iter().filter(|element| element.kind.dimension() == dimension);
    chosen.map(|element| index.resolve(draft, element)).collect()
}

/// All vertices have the same z, up to a part of the extent in x or y.
fn check_plane(draft: &Draft, cells: &[Resolved]) -> Parsed<()> {
    let mut used: Vec<u32> = cells.iter().flat_map(Resolved::corners).copied().collect();
    used.sort_unstable();
    used.dedup();
    let node = |at: u32| &draft.nodes[at as usize];
    let Some(apart) = plane::apart(&used, |at| node(at).point) else { return Ok(()) };
    let said = apart.map(|at| (format!("node {}", node(at).tag), node(at).point[2]));
    let hint = "mesh in the x-y plane, in two dimensions (command line: `-2`)";
    Err(draft.error(node(apart[0]).at, plane::why(said)).hint(hint).into())
}

/// The physical surfaces; a cell listed twice for the same one, or twice for none, is an error.
fn surfaces(draft: &Draft, cells: &[Resolved], number: &[u32]) -> Parsed<Vec<Surface>> {
    let mut listed = Vec::with_capacity(cells.len());
    for (place, (cell, &number)) in cells.iter().zip(number).enumerate() {
        match draft.tags(cell.element) {
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
        return Err(draft.error(again.at, message).hint(hint).into());
    }
    let grouped = listed.into_iter().filter(|&(tag, ..)| tag != 0);
    let groups = collect(draft, 2, grouped.map(|(tag, cell, _)| (tag, cell)).collect())?;
    Ok(groups.into_iter().map(|(name, cells)| Surface { name, cells }).collect())
}

/// The physical curves; their lines must be edges of cells.
fn curves(draft: &Draft, lines: &[Resolved], sound: &Sound) -> Parsed<Vec<Curve>> {
    let mut members = Vec::new();
    for line in lines {
        let tags = draft.tags(line.element);
        let ends = line.corners().try_into().ok();
        match ends.and_then(|ends: [u32; 2]| sound.edge(ends)) {
            Some(edge) => members.extend(tags.iter().map(|&tag| (tag, edge))),
            None if tags.is_empty() => {}
            None => {
                let [a, b, ..] = line.element.nodes;
                let message =
                    format!("{}, nodes {a} and {b}, is no edge of a cell", line.element.title());
                let hint = "mesh the surface beside the curve, or take the curve out of its group";
                return Err(draft.error(line.element.at, message).hint(hint).into());
            }
        }
    }
    let groups = collect(draft, 1, members)?;
    Ok(groups.into_iter().map(|(name, edges)| Curve { name, edges }).collect())
}

/// Refuses elements that are in more groups together than the file has bytes: a few lines may put many elements
/// into many groups, and memory shall stay bounded by the file.
fn check_room<'a>(draft: &Draft, elements: impl Iterator<Item = &'a Element>) -> Parsed<()> {
    let (mut total, room) = (0, draft.length);
    for element in elements {
        total += draft.tags(element).len();
        if total > room {
            let message = format!(
                "up to {} the elements are listed in more than {room} physical groups together",
                element.title()
            );
            let hint = "give an entity one physical group, or a few";
            return Err(draft.error(element.at, message).hint(hint).into());
        }
    }
    Ok(())
}

/// The items of each group under its name, by ascending physical tag; items ascend and come once.
fn collect<T: Ord + Copy>(
    draft: &Draft,
    dimension: u8,
    mut members: Vec<(i32, T)>,
) -> Parsed<Vec<(String, Vec<T>)>> {
    members.sort_unstable();
    members.dedup();
    let of_group = |members: &[(i32, T)]| {
        (name(draft, dimension, members[0].0), members.iter().map(|member| member.1).collect())
    };
    let groups: Vec<_> = members.chunk_by(|a, b| a.0 == b.0).map(of_group).collect();
    unambiguous(&groups, dimension)?;
    Ok(groups)
}

/// The name of a group, or its tag in decimal.
fn name(draft: &Draft, dimension: u8, group: i32) -> String {
    let name = draft.names.get(&(dimension, group));
    name.filter(|name| !name.is_empty()).cloned().unwrap_or_else(|| group.to_string())
}

/// A scene speaks of groups by name: two of the same name are an error.
fn unambiguous<T>(groups: &[(String, T)], dimension: u8) -> Parsed<()> {
    let mut names: Vec<_> = groups.iter().map(|(name, _)| name).collect();
    names.sort_unstable();
    let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) else { return Ok(()) };
    let kind = if dimension == 1 { "curves" } else { "surfaces" };
    let error = InputError::new(format!("two physical {kind} are called `{}`", pair[0]));
    Err(error.hint("give each a name of its own, or make them one").into())
}

//! Parts of a mesh that touch in a vertex alone: each gets one of its own, for u may differ there from one to the other.

use std::collections::{BTreeMap, HashMap};

use super::Topology;
use signorini_scene::mesh::Mesh;

/// The mesh with a vertex for each sector of a pinch; nothing where there is none. `ends` are the ends of each edge.
pub(super) fn parted(mesh: &Mesh, topology: &Topology, ends: &[[u32; 2]]) -> Option<Mesh> {
    let mut pinched = BTreeMap::<u32, Vec<usize>>::new();
    for edge in (0..ends.len()).filter(|&edge| topology.is_outer(edge)) {
        ends[edge].iter().for_each(|&vertex| pinched.entry(vertex).or_default().push(edge));
    }
    // A sector has two sides.
    pinched.retain(|_, sides| sides.len() > 2);
    if pinched.is_empty() {
        return None;
    }
    let (mut parted, mut renamed) = (mesh.clone(), HashMap::new());
    for (vertex, sides) in pinched {
        let mut known = Vec::new();
        for side in sides {
            if known.contains(&side) {
                continue;
            }
            let sector: Vec<_> = topology.sector(ends, vertex, side).collect();
            let is_first = known.is_empty();
            known.extend(sector.iter().map(|(edge, _)| *edge));
            if is_first {
                continue;
            }
            let copy = parted.vertices.len() as u32;
            parted.vertices.push(mesh.vertices[vertex as usize]);
            for (edge, cell) in sector {
                let pair = sorted(ends[edge]);
                rename(renamed.entry(pair).or_insert(pair), vertex, copy);
                if let Some(cell) = cell {
                    match cell.checked_sub(mesh.triangles.len()) {
                        None => rename(&mut parted.triangles[cell], vertex, copy),
                        Some(quad) => rename(&mut parted.quads[quad], vertex, copy),
                    }
                }
            }
        }
    }
    for curve in &mut parted.curves {
        for edge in &mut curve.edges {
            *edge = renamed.get(edge).map_or(*edge, |&pair| sorted(pair));
        }
        curve.edges.sort_unstable();
    }
    Some(parted)
}

fn rename(vertices: &mut [u32], old: u32, new: u32) {
    vertices.iter_mut().filter(|vertex| **vertex == old).for_each(|vertex| *vertex = new);
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

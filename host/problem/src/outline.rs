//! What stands where in a scene, without solving it: groups with their sizes, and what holds each part of the mesh.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use signorini_kernel::mesh::components::Support;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::{Draft, Scene};

use crate::binding::DEFAULT;
use crate::{EdgeKind, Parts, Problem};

/// A scene on its mesh, told in words and sizes.
#[derive(Debug, Clone, Serialize)]
pub struct Outline {
    /// Its boundaries, in the order of the file.
    pub boundaries: Vec<BoundaryGroup>,
    /// Its materials, in the order of the file.
    pub materials: Vec<MaterialGroup>,
    /// The connected parts of the mesh; none where the scene has faults.
    pub parts: Vec<HeldPart>,
}

/// A boundary of the scene.
#[derive(Debug, Clone, Serialize)]
pub struct BoundaryGroup {
    /// Its name.
    pub name: String,
    /// Its kind, where it could be read.
    pub kind: Option<&'static str>,
    /// The length of its edges.
    pub length: f64,
    /// How many edges it has.
    pub edges: usize,
    /// Its edges by their vertices.
    #[serde(skip)]
    pub of: Vec<[u32; 2]>,
}

/// A material of the scene.
#[derive(Debug, Clone, Serialize)]
pub struct MaterialGroup {
    /// Its name.
    pub name: String,
    /// A as the scene writes it, where it could be read: one number or three.
    pub conductivity: Option<Vec<String>>,
    /// The area of its cells.
    pub area: f64,
    /// How many cells it has.
    pub cells: usize,
    /// Its cells, triangles first.
    #[serde(skip)]
    pub of: Vec<u32>,
}

/// A connected part of the mesh.
#[derive(Debug, Clone, Serialize)]
pub struct HeldPart {
    /// How many cells it has.
    pub cells: usize,
    /// A point in it.
    pub near: [f64; 2],
    /// The boundaries that hold it: Dirichlet and Robin ones or, where there are none, contact.
    pub held_by: Vec<String>,
    /// Whether contact alone does.
    pub by_contact_alone: bool,
}

impl Outline {
    /// The groups of a draft on its mesh.
    pub fn of_draft(Draft { scene, open, kinds, .. }: &Draft, mesh: &Mesh) -> Self {
        let is_open = |key: &String| open.contains(key);
        Self {
            boundaries: boundaries(scene, mesh, kinds),
            materials: materials(scene, mesh, is_open),
            parts: Vec::new(),
        }
    }

    /// This outline with the parts of the problem and what holds them.
    #[must_use]
    pub fn with_parts(self, problem: &Problem, parts: &Parts) -> Self {
        Self { parts: held(problem, parts), ..self }
    }
}

fn boundaries(scene: &Scene, mesh: &Mesh, kinds: &[Option<&'static str>]) -> Vec<BoundaryGroup> {
    let named = |name: &str| mesh.curves.iter().find(|curve| curve.name == name);
    let mut rest: BTreeSet<[u32; 2]> = mesh.outer_edges().into_iter().collect();
    for curve in scene.boundaries.iter().filter_map(|boundary| named(&boundary.name.value)) {
        curve.edges.iter().for_each(|edge| {
            rest.remove(edge);
        });
    }
    let groups = scene.boundaries.iter().zip(kinds).map(|(boundary, &kind)| {
        let name = &boundary.name.value;
        let of = match (name == DEFAULT, named(name)) {
            (true, _) => rest.iter().copied().collect(),
            (false, curve) => curve.map_or_else(Vec::new, |curve| curve.edges.clone()),
        };
        BoundaryGroup { name: name.clone(), kind, length: mesh.length(&of), edges: of.len(), of }
    });
    groups.collect()
}

fn materials(scene: &Scene, mesh: &Mesh, is_open: impl Fn(&String) -> bool) -> Vec<MaterialGroup> {
    let named = |name: &str| mesh.surfaces.iter().find(|surface| surface.name == name);
    let mut rest: BTreeSet<u32> = (0..mesh.cells() as u32).collect();
    for surface in scene.materials.iter().filter_map(|material| named(&material.name.value)) {
        surface.cells.iter().for_each(|cell| {
            rest.remove(cell);
        });
    }
    let groups = scene.materials.iter().map(|material| {
        let name = &material.name.value;
        let of: Vec<u32> = match (name == DEFAULT, named(name)) {
            (true, _) => rest.iter().copied().collect(),
            (false, surface) => surface.map_or_else(Vec::new, |surface| surface.cells.clone()),
        };
        let entries = &material.conductivity[..if material.is_scalar { 1 } else { 3 }];
        let written = || entries.iter().map(|entry| entry.value.to_string()).collect();
        let conductivity = (!is_open(&material.name.key)).then(written);
        let area = mesh.area(of.iter().copied());
        MaterialGroup { name: name.clone(), conductivity, area, cells: of.len(), of }
    });
    groups.collect()
}

/// The parts with the boundaries that hold them.
fn held(problem: &Problem, parts: &Parts) -> Vec<HeldPart> {
    let mut cells = BTreeMap::<usize, usize>::new();
    (0..problem.cells()).for_each(|cell| *cells.entry(parts.of_cell(cell)).or_default() += 1);
    let mut by = BTreeMap::<usize, BTreeSet<&str>>::new();
    let transfers = problem.loads.robin.iter().filter(|law| law.coefficient > 0.0);
    let transfers: BTreeSet<usize> = transfers.map(|law| law.edge as usize).collect();
    for edge in 0..problem.ends.len() {
        let part = parts.of_cell(problem.topology.first_side(edge).0);
        let holds = match (problem.kinds[edge], parts.support(part)) {
            (EdgeKind::Dirichlet, Support::Held) => true,
            (EdgeKind::Robin, Support::Held) => transfers.contains(&edge),
            (EdgeKind::Contact, Support::Contact) => true,
            (EdgeKind::Interior | EdgeKind::Neumann, _) | (_, Support::None) => false,
            (EdgeKind::Dirichlet | EdgeKind::Robin, Support::Contact) => false,
            (EdgeKind::Contact, Support::Held) => false,
        };
        if let Some(boundary) = problem.boundary_of(edge).filter(|_| holds) {
            by.entry(part).or_default().insert(&boundary.name.value);
        }
    }
    let part = |(part, cells): (usize, usize)| HeldPart {
        cells,
        near: problem.mesh.vertices[problem.vertices_of(part)[0] as usize],
        held_by: by.get(&part).into_iter().flatten().map(|&name| name.to_owned()).collect(),
        by_contact_alone: parts.support(part) == Support::Contact,
    };
    cells.into_iter().map(part).collect()
}

//! Which names of the scene mean which cells and boundary edges of the mesh.

use std::collections::{HashMap, HashSet};

use super::{EdgeKind, Topology};
use signorini_scene::error::InputError;
use signorini_scene::faults::Faults;
use signorini_scene::mesh::{Curve, Mesh};
use signorini_scene::scene::{Boundary, Located, Scene};

/// The name that covers what no other name does.
pub(super) const DEFAULT: &str = "default";

/// Names resolved to positions in `scene.materials` and `scene.boundaries`.
#[derive(Debug, Clone)]
pub struct Binding {
    /// The material of each cell, triangles first.
    pub materials: Vec<u32>,
    named: HashMap<[u32; 2], u32>,
    /// Edges in two bound curves.
    twice: HashMap<[u32; 2], [u32; 2]>,
    default: Option<u32>,
}

impl Binding {
    /// Resolves the names of `scene` on `mesh`; a name that the mesh lacks, a cell with no material or with two are faults.
    pub(super) fn new(scene: &Scene, mesh: &Mesh, faults: &Faults) -> Self {
        let materials = bind_materials(scene, mesh, faults);
        let mut binding =
            Self { materials, named: HashMap::new(), twice: HashMap::new(), default: None };
        binding.bind_boundaries(scene, mesh, faults);
        binding
    }

    fn bind_boundaries(&mut self, scene: &Scene, mesh: &Mesh, faults: &Faults) {
        for (at, boundary) in scene.boundaries.iter().enumerate() {
            let at = at as u32;
            if boundary.name.value == DEFAULT {
                self.default = Some(at);
                continue;
            }
            let Some(curve) = mesh.curves.iter().find(|curve| curve.name == boundary.name.value)
            else {
                let known = mesh.curves.iter().map(|curve| curve.name.as_str());
                faults.note(unknown(scene, &boundary.name, "physical curve", known));
                continue;
            };
            for &edge in &curve.edges {
                if let Some(other) = self.named.insert(edge, at) {
                    self.twice.insert(edge, [other, at]);
                }
            }
        }
    }

    /// Notes boundary edges that lie in two curves with a condition, one of each such pair.
    pub(super) fn check_once(
        &self,
        scene: &Scene,
        mesh: &Mesh,
        boundary: &[[u32; 2]],
        faults: &Faults,
    ) {
        let mut told = HashSet::new();
        for &ends in boundary {
            let Some(&both) = self.twice.get(&key(ends)) else { continue };
            if !told.insert(both) {
                continue;
            }
            let [first, second] = both.map(|at| &scene.boundaries[at as usize].name);
            let message = format!(
                "the edge {} lies in the physical curves {:?} and {:?}, which both have a condition",
                place(mesh, ends),
                second.value,
                first.value
            );
            faults.note(scene.error(second, message).hint("keep one of the two"));
        }
    }

    /// Notes curves with a condition that have edges between two cells: nothing could act there. `boundary` are
    /// the edges on the boundary.
    pub(super) fn check_outside(
        scene: &Scene,
        mesh: &Mesh,
        boundary: &[[u32; 2]],
        faults: &Faults,
    ) {
        let boundary: HashSet<_> = boundary.iter().copied().map(key).collect();
        for Boundary { name, .. } in &scene.boundaries {
            let named = |curve: &&Curve| name.value != DEFAULT && curve.name == name.value;
            let Some(curve) = mesh.curves.iter().find(named) else { continue };
            let mut inside = curve.edges.iter().filter(|&&edge| !boundary.contains(&key(edge)));
            let Some(&first) = inside.next() else { continue };
            let (count, all) = (1 + inside.count(), curve.edges.len());
            let partly = if count < all { "partly " } else { "" };
            let place = place(mesh, first);
            let message = format!(
                "the physical curve {:?} lies {partly}inside the domain, where no condition acts: {count} of its \
                 {all} edges have cells on both sides, the first {place}",
                curve.name
            );
            let hint = "cut the mesh open along the curve (Gmsh's Crack plugin makes boundary of it), or \
                        remove the table";
            faults.note(scene.error(name, message).hint(hint));
        }
    }

    /// Notes boundary edges that no table covers, the first of each curve.
    pub(super) fn check_covered(
        scene: &Scene,
        mesh: &Mesh,
        uncovered: &[[u32; 2]],
        faults: &Faults,
    ) {
        let mut told = HashSet::new();
        // Where there is no table at all, the reader has said so.
        for &ends in uncovered.iter().filter(|_| !scene.boundaries.is_empty()) {
            let key = key(ends);
            let within = mesh.curves.iter().find(|curve| curve.edges.binary_search(&key).is_ok());
            let name = within.map_or(DEFAULT, |curve| &curve.name);
            if told.insert(name) {
                faults.note(uncovered_in(scene, mesh, within, ends));
            }
        }
    }

    /// Whether a table of the scene names a curve with this edge.
    pub(super) fn is_named(&self, ends: [u32; 2]) -> bool {
        self.named.contains_key(&key(ends))
    }

    /// The boundary that an edge between two vertices belongs to.
    pub fn boundary(&self, ends: [u32; 2]) -> Option<usize> {
        self.named.get(&key(ends)).copied().or(self.default).map(|at| at as usize)
    }

    pub(super) fn kind(
        &self,
        scene: &Scene,
        topology: &Topology,
        edge: usize,
        ends: [u32; 2],
    ) -> EdgeKind {
        let interior = topology.half_edges[edge][1] != u32::MAX;
        match self.boundary(ends).filter(|_| !interior) {
            Some(boundary) => EdgeKind::of(&scene.boundaries[boundary].condition),
            None => EdgeKind::Interior,
        }
    }
}

/// The fault of a boundary edge that no table covers, in the curve that it lies in.
fn uncovered_in(scene: &Scene, mesh: &Mesh, within: Option<&Curve>, ends: [u32; 2]) -> InputError {
    let home = match within {
        Some(curve) => format!("physical curve {:?} of the mesh", curve.name),
        None => "a part of the boundary without a physical curve".to_owned(),
    };
    let curve = within.map_or(DEFAULT, |curve| &curve.name);
    InputError::new(format!(
        "boundary.{curve}: missing; the boundary edge {} lies in {home}, and no [boundary.…] covers it",
        place(mesh, ends)
    ))
    .file(&scene.path)
    .hint(to_add("boundary", curve))
}

/// An edge as curves have it: the lower vertex first.
fn key([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Where an edge lies.
pub(super) fn place(mesh: &Mesh, ends: [u32; 2]) -> String {
    let [a, b] = ends.map(|vertex| mesh.vertices[vertex as usize]);
    format!("({}, {})–({}, {})", a[0], a[1], b[0], b[1])
}

/// The lines to add for `name` in the tables of this kind.
fn to_add(kind: &str, name: &str) -> String {
    match name {
        DEFAULT => format!("add [{kind}.default] for all that is left"),
        name => format!("add [{kind}.{name}], or [{kind}.default] for all that is left"),
    }
}

/// The material of each cell; of a cell with a fault the first one.
fn bind_materials(scene: &Scene, mesh: &Mesh, faults: &Faults) -> Vec<u32> {
    let mut materials = vec![None; mesh.cells()];
    let (mut default, mut twice) = (None, HashSet::new());
    for (at, material) in (0u32..).zip(&scene.materials) {
        if material.name.value == DEFAULT {
            default = Some(at);
            continue;
        }
        let Some(surface) = mesh.surfaces.iter().find(|of| of.name == material.name.value) else {
            let known = mesh.surfaces.iter().map(|surface| surface.name.as_str());
            faults.note(unknown(scene, &material.name, "physical surface", known));
            continue;
        };
        for &cell in &surface.cells {
            if let Some(other) = materials[cell as usize].replace(at)
                && twice.insert([other, at])
            {
                faults.note(two_materials(scene, cell, [other, at]));
            }
        }
    }
    let mut told = HashSet::new();
    for cell in (0..materials.len()).filter(|&cell| materials[cell].or(default).is_none()) {
        let home = mesh.surfaces.iter().find(|s| s.cells.binary_search(&(cell as u32)).is_ok());
        let name = home.map_or(DEFAULT, |surface| &surface.name);
        if told.insert(name) && !scene.materials.is_empty() {
            let message = format!("material.{name}: missing; cell {cell} has no material");
            let fault = InputError::new(message).file(&scene.path);
            faults.note(fault.hint(to_add("material", name)));
        }
    }
    materials.iter().map(|own| own.or(default).unwrap_or(0)).collect()
}

/// The fault of a cell in two surfaces with a material.
fn two_materials(scene: &Scene, cell: u32, both: [u32; 2]) -> InputError {
    let [first, second] = both.map(|at| &scene.materials[at as usize].name);
    let message = format!(
        "cell {cell} lies in the physical surfaces {:?} and {:?}, which both have a material",
        second.value, first.value
    );
    scene.error(second, message).hint("keep one of the two")
}

fn unknown<'n>(
    scene: &Scene,
    name: &Located<String>,
    what: &str,
    known: impl Iterator<Item = &'n str>,
) -> InputError {
    let known: Vec<_> = known.map(|name| format!("{name:?}")).collect();
    let hint = if known.is_empty() {
        format!("the mesh has no {what}; use \"default\" for all of it")
    } else {
        format!("the mesh has {}", known.join(", "))
    };
    let mesh = scene.mesh.value.display();
    scene.error(name, format!("{mesh} has no {what} {:?}", name.value)).hint(hint)
}

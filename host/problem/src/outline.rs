//! What stands where in a scene, without solving it: groups with their sizes, and what holds each part of the mesh.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use signorini_kernel::mesh::components::Support;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::{Boundary, Condition, Datum, Draft, Material, Scene};

use crate::binding::DEFAULT;
use crate::polygon::turn;
use crate::{EdgeKind, Parts, Problem};

/// Characters of a datum that a line has room for.
const LONGEST: usize = 40;

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
    /// What it asks for, with its data as the scene writes them, where they could be read.
    pub law: Option<String>,
    /// The length of its edges.
    pub length: f64,
    /// How many edges it has.
    pub edges: usize,
    /// By how many degrees they turn at most from one to the next, where they look like a curve: what is guaranteed is so for the edges.
    pub turn: Option<f64>,
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
            boundaries: boundaries(scene, mesh, kinds, is_open),
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

fn boundaries(
    scene: &Scene,
    mesh: &Mesh,
    kinds: &[Option<&'static str>],
    is_open: impl Fn(&String) -> bool,
) -> Vec<BoundaryGroup> {
    let names: Vec<&str> = scene.boundaries.iter().map(|of| of.name.value.as_str()).collect();
    let named = |name: &str| Some(&mesh.curves.iter().find(|of| of.name == name)?.edges[..]);
    let all = scene.boundaries.iter().zip(kinds);
    let groups = shared(&names, mesh.outer_edges(), named).into_iter().zip(all);
    let group = |(of, (boundary, &kind)): (Vec<[u32; 2]>, (&Boundary, _))| BoundaryGroup {
        name: boundary.name.value.clone(),
        kind,
        law: kind.filter(|_| !is_open(&boundary.name.key)).map(|_| law(boundary)),
        length: mesh.length(&of),
        edges: of.len(),
        turn: turn(mesh, &of),
        of,
    };
    groups.map(group).collect()
}

/// A condition with its data: "u ≥ 20, σ·n ≥ 0".
fn law(boundary: &Boundary) -> String {
    let said = |of: &Datum| match of.value.to_string() {
        long if long.chars().count() > LONGEST => "…".to_owned(),
        short => short,
    };
    match &boundary.condition {
        Condition::Dirichlet { value } => format!("u = {}", said(value)),
        Condition::Neumann { flux } => format!("σ·n = {}", said(flux)),
        Condition::Robin { coefficient, ambient } => {
            let is_number = coefficient.value.is_constant().is_some();
            let [open, close] = if is_number { ["", ""] } else { ["(", ")"] };
            format!("σ·n = {open}{}{close} ({} − u)", said(coefficient), said(ambient))
        }
        Condition::Contact { gap, flux, limit } => {
            let is_endless = |of: &Datum| of.value.is_constant().is_some_and(f64::is_infinite);
            let side = match [flux, limit].map(is_endless) {
                [false, true] => "≥",
                [true, false] => "≤",
                _ => "against",
            };
            let least = (!is_endless(flux)).then(|| format!(", σ·n ≥ {}", said(flux)));
            let most = (!is_endless(limit)).then(|| format!(", σ·n ≤ {}", said(limit)));
            let ends = [least, most].map(Option::unwrap_or_default).concat();
            // A default stands where the table begins.
            let default = if gap.span == boundary.name.span { " by default" } else { "" };
            format!("u {side} {}{default}{ends}", said(gap))
        }
    }
}

fn materials(scene: &Scene, mesh: &Mesh, is_open: impl Fn(&String) -> bool) -> Vec<MaterialGroup> {
    let names: Vec<&str> = scene.materials.iter().map(|of| of.name.value.as_str()).collect();
    let named = |name: &str| Some(&mesh.surfaces.iter().find(|of| of.name == name)?.cells[..]);
    let groups = shared(&names, 0..mesh.cells() as u32, named).into_iter().zip(&scene.materials);
    let group = |(of, material): (Vec<u32>, &Material)| {
        let entries = &material.conductivity[..if material.is_scalar { 1 } else { 3 }];
        let written = || entries.iter().map(|entry| entry.value.to_string()).collect();
        MaterialGroup {
            name: material.name.value.clone(),
            conductivity: (!is_open(&material.name.key)).then(written),
            area: mesh.area(of.iter().copied()),
            cells: of.len(),
            of,
        }
    };
    groups.map(group).collect()
}

/// What each name has of `all`: that of its group in the mesh, and the default what no other one has.
fn shared<'m, T: Copy + Ord + 'm>(
    names: &[&str],
    all: impl IntoIterator<Item = T>,
    named: impl Fn(&str) -> Option<&'m [T]>,
) -> Vec<Vec<T>> {
    let taken: BTreeSet<T> = names
        .iter()
        .filter(|name| **name != DEFAULT)
        .filter_map(|name| named(name))
        .flatten()
        .copied()
        .collect();
    let rest: Vec<T> = all.into_iter().filter(|item| !taken.contains(item)).collect();
    let of = |&name: &&str| match name {
        DEFAULT => rest.clone(),
        name => named(name).unwrap_or_default().to_vec(),
    };
    names.iter().map(of).collect()
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

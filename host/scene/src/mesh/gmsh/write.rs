//! A mesh as MSH 4.1 in ASCII, with all names, as Gmsh and `super::parse` read it.
//!
//! ```text
//!   groups of a cell ─► class ─► entity of dimension 2     cells of one class that follow each other: a block
//!   groups of an edge ─► class ─► entity of dimension 1    lines for the edges of curves, none for others
//! ```
//! An entity carries physical tags, so every set of groups that some element is in becomes an entity of its own.
//! Physical tags are 1, 2, … in the order of the mesh's groups. Vertices and cells keep their order: what is read
//! back is the same mesh, to the last bit, slits included. All nodes stand in one block of the first surface:
//! Gmsh needs no better place for them.

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use crate::mesh::{Curve, Mesh};

/// The file's text.
///
/// Groups without a cell or an edge are named in it, but belong to no element: who reads it does not find them. A
/// name must have no line break, and none that was read has. Gmsh itself ends a name at the first quote in it.
pub fn text(mesh: &Mesh) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_mesh(&mut text, mesh);
    text
}

fn write_mesh(out: &mut String, mesh: &Mesh) -> fmt::Result {
    let cells = Classes::of(
        mesh.cells(),
        mesh.surfaces.iter().map(|surface| surface.cells.iter().copied()),
    );
    let lines = lines(&mesh.curves);
    let at = |edge: &[u32; 2]| lines.binary_search(edge).map_or(0, |at| at as u32);
    let edges =
        Classes::of(lines.len(), mesh.curves.iter().map(|curve| curve.edges.iter().map(at)));
    out.push_str("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    write_names(out, mesh)?;
    write_entities(out, mesh, [&edges, &cells])?;
    write_nodes(out, &mesh.vertices)?;
    write_elements(out, mesh, &lines, [&edges, &cells])
}

/// The edges of all curves, each once.
fn lines(curves: &[Curve]) -> Vec<[u32; 2]> {
    let mut lines: Vec<_> = curves.iter().flat_map(|curve| &curve.edges).copied().collect();
    lines.sort_unstable();
    lines.dedup();
    lines
}

/// Items by the set of groups that they are in.
struct Classes {
    /// The class of each item.
    of: Vec<u32>,
    /// The physical tags of each class; the first has none.
    tags: Vec<Vec<u32>>,
}

impl Classes {
    /// Every group divides each class in those of its items that it holds and the others.
    fn of(count: usize, groups: impl Iterator<Item = impl Iterator<Item = u32>>) -> Self {
        let mut classes = Self { of: vec![0; count], tags: vec![Vec::new()] };
        for (tag, group) in (1..).zip(groups) {
            let mut inside = BTreeMap::new();
            for item in group {
                let class = &mut classes.of[item as usize];
                *class = *inside.entry(*class).or_insert_with(|| {
                    let mut tags = classes.tags[*class as usize].clone();
                    tags.push(tag);
                    classes.tags.push(tags);
                    classes.tags.len() as u32 - 1
                });
            }
        }
        classes
    }
}

fn write_names(out: &mut String, mesh: &Mesh) -> fmt::Result {
    let curves = (1_u32..).zip(&mesh.curves).map(|(tag, curve)| (1, tag, &curve.name));
    let surfaces = (1_u32..).zip(&mesh.surfaces).map(|(tag, surface)| (2, tag, &surface.name));
    writeln!(out, "$PhysicalNames\n{}", mesh.curves.len() + mesh.surfaces.len())?;
    for (dimension, tag, name) in curves.chain(surfaces) {
        writeln!(out, "{dimension} {tag} \"{name}\"")?;
    }
    out.push_str("$EndPhysicalNames\n");
    Ok(())
}

/// Curves, then surfaces: an entity for each class, with the box of the whole mesh and no boundary.
fn write_entities(out: &mut String, mesh: &Mesh, classes: [&Classes; 2]) -> fmt::Result {
    let [curves, surfaces] = classes.map(|classes| classes.tags.len());
    writeln!(out, "$Entities\n0 {curves} {surfaces} 0")?;
    let end = |axis: usize, least: fn(f64, f64) -> f64| {
        mesh.vertices.iter().map(|vertex| vertex[axis]).reduce(least).unwrap_or_default()
    };
    let [x, y] = [0, 1].map(|axis| end(axis, f64::min));
    let [right, top] = [0, 1].map(|axis| end(axis, f64::max));
    for (entity, tags) in classes.into_iter().flat_map(|classes| (1_u32..).zip(&classes.tags)) {
        write!(out, "{entity} {x:?} {y:?} 0 {right:?} {top:?} 0 {}", tags.len())?;
        tags.iter().try_for_each(|tag| write!(out, " {tag}"))?;
        out.push_str(" 0\n");
    }
    out.push_str("$EndEntities\n");
    Ok(())
}

fn write_nodes(out: &mut String, vertices: &[[f64; 2]]) -> fmt::Result {
    let count = vertices.len();
    writeln!(out, "$Nodes\n1 {count} 1 {count}\n2 1 0 {count}")?;
    (1..=count).try_for_each(|tag| writeln!(out, "{tag}"))?;
    // The shortest digits that are read as the same number.
    vertices.iter().try_for_each(|[x, y]| writeln!(out, "{x:?} {y:?} 0"))?;
    out.push_str("$EndNodes\n");
    Ok(())
}

/// Lines, triangles, quads, numbered in this order.
fn write_elements(
    out: &mut String,
    mesh: &Mesh,
    lines: &[[u32; 2]],
    [edges, cells]: [&Classes; 2],
) -> fmt::Result {
    let (of_triangles, of_quads) = cells.of.split_at(mesh.triangles.len());
    let mut blocks = Blocks::default();
    blocks.write([1, 1], lines, &edges.of)?;
    blocks.write([2, 2], &mesh.triangles, of_triangles)?;
    blocks.write([2, 3], &mesh.quads, of_quads)?;
    let Blocks { blocks, elements, text } = blocks;
    writeln!(out, "$Elements\n{blocks} {elements} 1 {elements}")?;
    out.push_str(&text);
    out.push_str("$EndElements\n");
    Ok(())
}

/// Blocks of elements, which the section's first line counts.
#[derive(Default)]
struct Blocks {
    blocks: usize,
    elements: usize,
    text: String,
}

impl Blocks {
    /// Adds elements of a dimension and a type of Gmsh's, in their order.
    fn write<const N: usize>(
        &mut self,
        [dimension, kind]: [u32; 2],
        elements: &[[u32; N]],
        classes: &[u32],
    ) -> fmt::Result {
        let mut elements = elements.iter();
        for block in classes.chunk_by(|a, b| a == b) {
            self.blocks += 1;
            writeln!(self.text, "{dimension} {} {kind} {}", block[0] + 1, block.len())?;
            for corners in elements.by_ref().take(block.len()) {
                self.elements += 1;
                write!(self.text, "{}", self.elements)?;
                corners.iter().try_for_each(|corner| write!(self.text, " {}", corner + 1))?;
                self.text.push('\n');
            }
        }
        Ok(())
    }
}

//! Edge numbering in fixed memory, for meshes that come without it.
//!
//! Each edge is kept in a linked list at one of its two vertices, the one with fewer cells (the lower
//! one where equal): a fan of any number of cells around one vertex then costs no more than a strip.
//! Found edges are then put into the order of [`crate::mesh::edges`] by a stable counting sort.

use crate::error::{Array, Error};
use crate::index::{Index, read};
use crate::mesh::edges::{Block, EdgeCounts, Edges, endpoints};
use crate::{Mesh, Real};

/// Memory for numbering the edges of a mesh.
#[derive(Debug)]
pub struct NumberingBuffers<'a, I> {
    /// Result, one entry a triangle.
    pub of_triangles: &'a mut [[I; 3]],
    /// Result, one entry a quad.
    pub of_quads: &'a mut [[I; 4]],
    /// Result, one entry an edge; at most one for each half-edge.
    pub half_edges: &'a mut [[I; 2]],
    /// Scratch, at least one entry a vertex: number of sides, first edge of its list.
    pub at_vertex: &'a mut [[I; 2]],
    /// Scratch, at least one entry an edge: next edge of the list, later the new number.
    pub next: &'a mut [I],
}

/// Numbers the edges of `mesh`; `block` tells where a boundary edge, given by its two vertices
/// counterclockwise, belongs (`None`: it has no condition).
///
/// # Errors
/// Edges shared by three cells, overlapping cells, boundary edges without a condition, and buffers
/// that are too short.
pub fn number<'a, R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    buffers: NumberingBuffers<'a, I>,
    mut block: impl FnMut([I; 2]) -> Option<Block>,
) -> Result<Edges<'a, I>, Error> {
    let NumberingBuffers { of_triangles, of_quads, half_edges, at_vertex, next } = buffers;
    let of_triangles = exactly(of_triangles, Array::Triangles, mesh.triangles().len())?;
    let of_quads = exactly(of_quads, Array::Quads, mesh.quads().len())?;
    let at_vertex = exactly(at_vertex, Array::Scratch, mesh.vertices().len())?;
    let found = find(mesh, half_edges, at_vertex, next)?;
    let half_edges = exactly(half_edges, Array::Edges, found)?;
    let next = exactly(next, Array::Scratch, found)?;

    let counts = order(mesh, half_edges, next, &mut block)?;
    relabel(mesh, half_edges, next, of_triangles, of_quads);
    half_edges.fill([I::NONE; 2]);
    let sides = of_triangles.as_flattened().iter().chain(of_quads.as_flattened());
    for (half, edge) in sides.enumerate() {
        if let (Some(pair), Some(half)) = (half_edges.get_mut(edge.at()), I::new(half)) {
            if pair[0] == I::NONE { pair[0] = half } else { pair[1] = half }
        }
    }
    Edges::new(of_triangles, of_quads, half_edges, counts)
}

fn exactly<T>(buffer: &mut [T], of: Array, needed: usize) -> Result<&mut [T], Error> {
    let limit = buffer.len();
    buffer.get_mut(..needed).ok_or(Error::Capacity { of, needed, limit })
}

/// Collects the half-edges of every edge in the order of first sight; returns the number of edges.
fn find<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    half_edges: &mut [[I; 2]],
    at_vertex: &mut [[I; 2]],
    next: &mut [I],
) -> Result<usize, Error> {
    count_sides(mesh, at_vertex);
    let limit = half_edges.len().min(next.len());
    let mut found = 0;
    for half in 0..mesh.half_edges() {
        let [a, b] = endpoints(mesh, half);
        let [sides_a, sides_b] = [a, b].map(|vertex| (read(at_vertex, vertex.at())[0], vertex));
        let owner = if sides_a <= sides_b { a } else { b };
        let index = I::new(half).unwrap_or(I::NONE);
        let mut edge = read(at_vertex, owner.at())[1];
        while edge != I::NONE && !joins(mesh, half_edges, edge, [a, b]) {
            edge = read(next, edge.at());
        }
        if edge != I::NONE {
            close(mesh, half_edges, edge, index, [a, b])?;
            continue;
        }
        let too_many = Error::Capacity { of: Array::Edges, needed: found + 1, limit };
        let (Some(pair), Some(link)) = (half_edges.get_mut(found), next.get_mut(found)) else {
            return Err(too_many);
        };
        let head = at_vertex.get_mut(owner.at()).ok_or(too_many)?;
        *pair = [index, I::NONE];
        *link = head[1];
        head[1] = I::new(found).ok_or(too_many)?;
        found += 1;
    }
    Ok(found)
}

/// Number of sides that touch each vertex (saturating), and an empty list.
fn count_sides<R: Real, I: Index>(mesh: &Mesh<R, I>, at_vertex: &mut [[I; 2]]) {
    at_vertex.fill([I::default(), I::NONE]);
    let corners = mesh.triangles().as_flattened().iter().chain(mesh.quads().as_flattened());
    for vertex in corners {
        if let Some(entry) = at_vertex.get_mut(vertex.at()) {
            entry[0] = I::new(entry[0].at() + 1).unwrap_or(entry[0]);
        }
    }
}

fn joins<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    half_edges: &[[I; 2]],
    edge: I,
    [a, b]: [I; 2],
) -> bool {
    let ends = endpoints(mesh, read(half_edges, edge.at())[0].at());
    ends == [b, a] || ends == [a, b]
}

/// Adds the second half-edge; neighbours run along their common edge in opposite directions.
fn close<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    half_edges: &mut [[I; 2]],
    edge: I,
    half: I,
    ends: [I; 2],
) -> Result<(), Error> {
    let named = ends.map(|vertex| vertex.at() as u32);
    let Some(pair) = half_edges.get_mut(edge.at()) else { return Ok(()) };
    if endpoints(mesh, pair[0].at()) == ends {
        return Err(Error::Overlap(named));
    }
    if pair[1] != I::NONE {
        return Err(Error::SharedByThree(named));
    }
    pair[1] = half;
    Ok(())
}

/// Writes each edge's new number over `next`, stably sorted by block.
fn order<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    half_edges: &[[I; 2]],
    next: &mut [I],
    block: &mut impl FnMut([I; 2]) -> Option<Block>,
) -> Result<EdgeCounts, Error> {
    let mut counts = EdgeCounts::default();
    for (pair, place) in half_edges.iter().zip(next.iter_mut()) {
        let ends = endpoints(mesh, pair[0].at());
        let interior = pair[1] != I::NONE;
        let unbound = Error::NoCondition(ends.map(|vertex| vertex.at() as u32));
        let block = if interior { Block::Free } else { block(ends).ok_or(unbound)? };
        *counts.of(block) += 1;
        *place = I::new(block as usize).unwrap_or(I::NONE);
    }
    let mut position = EdgeCounts {
        free: counts.start(Block::Free),
        contact: counts.start(Block::Contact),
        dirichlet: counts.start(Block::Dirichlet),
    };
    for place in next.iter_mut() {
        let block = match place.at() {
            0 => Block::Free,
            1 => Block::Contact,
            _ => Block::Dirichlet,
        };
        let position = position.of(block);
        *place = I::new(*position).unwrap_or(I::NONE);
        *position += 1;
    }
    Ok(counts)
}

/// Tells the sides of the cells the new number of their edge.
fn relabel<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    half_edges: &[[I; 2]],
    number: &[I],
    of_triangles: &mut [[I; 3]],
    of_quads: &mut [[I; 4]],
) {
    let triangle_sides = 3 * mesh.triangles().len();
    for (pair, &edge) in half_edges.iter().zip(number) {
        for half in pair.iter().filter(|&&half| half != I::NONE) {
            let side = match half.at().checked_sub(triangle_sides) {
                None => of_triangles.as_flattened_mut().get_mut(half.at()),
                Some(rest) => of_quads.as_flattened_mut().get_mut(rest),
            };
            if let Some(side) = side {
                *side = edge;
            }
        }
    }
}

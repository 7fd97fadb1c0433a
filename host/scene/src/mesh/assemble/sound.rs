//! Cells over points: turned round where they are clockwise, without points that no cell has, meeting as the cells of
//! a plane mesh do.

use crate::mesh::shape::{Orientation, orientation};
use crate::mesh::{Mesh, check};

/// Cells over points, by position, with words for what is wrong in them.
pub(in crate::mesh) struct Cells<'a> {
    pub(in crate::mesh) points: &'a [[f64; 2]],
    pub(in crate::mesh) triangles: Vec<[u32; 3]>,
    pub(in crate::mesh) quads: Vec<[u32; 4]>,
    /// The title of a cell, triangles counted first.
    pub(in crate::mesh) cell: &'a dyn Fn(u32) -> String,
    /// The name of a point.
    pub(in crate::mesh) point: &'a dyn Fn(u32) -> String,
}

/// Cells that make a plane mesh.
pub(in crate::mesh) struct Sound {
    /// The mesh, without groups.
    pub(in crate::mesh) mesh: Mesh,
    /// The point of each vertex, ascending.
    pub(in crate::mesh) origins: Vec<u32>,
    /// The vertex at each point.
    numbers: Vec<Option<u32>>,
    edges: Vec<[u32; 2]>,
}

impl Cells<'_> {
    /// Turns, renumbers and checks the cells.
    ///
    /// # Errors
    /// A cell, and why it is none or does not fit the others.
    pub(in crate::mesh) fn sound(self) -> Result<Sound, (u32, String)> {
        let Self { points, mut triangles, mut quads, cell, point } = self;
        let first_quad = triangles.len() as u32;
        let turn = |at: u32, corners: &mut [u32]| {
            turned(points, corners).map_err(|(defect, corner)| {
                let place = corner.map_or_else(String::new, |at| format!(" at {}", point(at)));
                (at, format!("{} {defect}{place}", cell(at)))
            })
        };
        (0..).zip(&mut triangles).try_for_each(|(at, corners)| turn(at, corners))?;
        (first_quad..).zip(&mut quads).try_for_each(|(at, corners)| turn(at, corners))?;

        let mut numbers = vec![None; points.len()];
        let corners = triangles.as_flattened().iter().chain(quads.as_flattened());
        corners.for_each(|&corner| numbers[corner as usize] = Some(0));
        let used = (0..).zip(&numbers).filter_map(|(at, number)| number.map(|_| at));
        let origins: Vec<u32> = used.collect();
        (0..).zip(&origins).for_each(|(vertex, &at)| numbers[at as usize] = Some(vertex));
        let corners = triangles.as_flattened_mut().iter_mut().chain(quads.as_flattened_mut());
        corners.for_each(|corner| *corner = numbers[*corner as usize].unwrap_or_default());

        let vertices = origins.iter().map(|&at| points[at as usize]).collect();
        let mesh = Mesh { vertices, triangles, quads, ..Mesh::default() };
        let vertex = |at: u32| point(origins[at as usize]);
        let edges =
            check::edges(&mesh).map_err(|fault| (fault.cells[0], fault.describe(cell, vertex)))?;
        Ok(Sound { mesh, origins, numbers, edges })
    }
}

impl Sound {
    /// The edge between two points, its lower vertex first, if a cell has it.
    pub(in crate::mesh) fn edge(&self, points: [u32; 2]) -> Option<[u32; 2]> {
        let [a, b] = points.map(|at| self.numbers.get(at as usize).copied().flatten());
        let edge = [a?.min(b?), a?.max(b?)];
        self.edges.binary_search(&edge).is_ok().then_some(edge)
    }
}

/// Turns a clockwise cell round, or says what is wrong with it and at which point.
fn turned(points: &[[f64; 2]], corners: &mut [u32]) -> Result<(), (String, Option<u32>)> {
    let places: Vec<[f64; 2]> = corners.iter().map(|&at| points[at as usize]).collect();
    match orientation(&places) {
        Ok(Orientation::Counterclockwise) => {}
        Ok(Orientation::Clockwise) => corners[1..].reverse(),
        Err(defect) => {
            return Err((defect.to_string(), defect.corner().map(|corner| corners[corner])));
        }
    }
    Ok(())
}

//! A mesh from arrays, as programs hold them: coordinates, cells by kind, named edges and cells.
//!
//! Clockwise cells are turned round and vertices without a cell dropped, as in a file that is read. Errors call cells and vertices by
//! their positions in the arrays.

use super::assemble::plane;
use super::assemble::sound::{Cells, Sound};
use super::{Curve, Mesh, Surface};
use crate::error::{InputError, Result};

/// The arrays that a mesh is made of.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Arrays {
    /// Coordinates of the vertices, in one plane z = constant.
    pub points: Vec<[f64; 3]>,
    /// Vertices of the triangles, in either sense.
    pub triangles: Vec<[u32; 3]>,
    /// Vertices of the quads, in either sense.
    pub quads: Vec<[u32; 4]>,
    /// Names of curves, and the ends of their edges.
    pub curves: Vec<(String, Vec<[u32; 2]>)>,
    /// Names of surfaces, and their cells: triangles first, then quads.
    pub surfaces: Vec<(String, Vec<u32>)>,
}

impl Arrays {
    /// The mesh, and for each of its vertices the position that it had among the points.
    ///
    /// # Errors
    /// Coordinates that are no numbers, positions outside of an array, cells that are not convex or meet as no plane mesh does, edges
    /// that no cell has.
    pub fn mesh(self) -> Result<(Mesh, Vec<u32>)> {
        self.check()?;
        let triangles = self.triangles.len();
        let Self { points, triangles: of_three, quads, curves, surfaces } = self;
        let points: Vec<[f64; 2]> = points.iter().map(|&[x, y, _]| [x, y]).collect();
        let cells = Cells {
            points: &points,
            triangles: of_three,
            quads,
            cell: &|cell| cell_name(triangles, cell),
            point: &|at| format!("vertex {at}"),
        };
        let sound = cells.sound().map_err(|(_, message)| InputError::new(message))?;
        let curves = curves.into_iter().map(|part| curve(part, &sound)).collect::<Result<_>>()?;
        let surfaces = surfaces.into_iter().map(surface).collect();
        Ok((Mesh { surfaces, curves, ..sound.mesh }, sound.origins))
    }

    fn check(&self) -> Result<()> {
        let points = self.points.len();
        if self.triangles.is_empty() && self.quads.is_empty() {
            return Err(InputError::new("the mesh has no cell: expected triangles or quads").into());
        }
        if let Some(at) = self.points.iter().position(|point| point.iter().any(|x| !x.is_finite()))
        {
            let message = format!("point {at} is {:?}, expected numbers", self.points[at]);
            return Err(InputError::new(message).into());
        }
        let outside = |of: &str, vertices: &[u32]| -> Result<()> {
            let Some(vertex) = vertices.iter().find(|&&at| at as usize >= points) else {
                return Ok(());
            };
            let message = format!("{of} has the vertex {vertex}, and there are {points} points");
            Err(InputError::new(message).hint("vertices count from 0").into())
        };
        let cells = self.triangles.iter().map(|of| &of[..]);
        let cells = cells.chain(self.quads.iter().map(|of| &of[..]));
        for (at, cell) in (0..).zip(cells.clone()) {
            outside(&cell_name(self.triangles.len(), at), cell)?;
        }
        let used: Vec<u32> = cells.flatten().copied().collect();
        if let Some(apart) = plane::apart(&used, |at| self.points[at as usize]) {
            let said = apart.map(|at| (format!("point {at}"), self.points[at as usize][2]));
            let hint = "a third column may be left out";
            return Err(InputError::new(plane::why(said)).hint(hint).into());
        }
        let lacking = self.curves.iter().map(|(name, of)| ("curve", name, "edge", of.is_empty()));
        let of_surfaces =
            self.surfaces.iter().map(|(name, of)| ("surface", name, "cell", of.is_empty()));
        if let Some((kind, name, part, _)) = lacking.chain(of_surfaces).find(|of| of.3) {
            let error = InputError::new(format!("{kind} `{name}` has no {part}"));
            return Err(error.hint("leave it out, or name what is in it").into());
        }
        for (name, edges) in &self.curves {
            outside(&format!("curve `{name}`"), edges.as_flattened())?;
        }
        let cells = (self.triangles.len() + self.quads.len()) as u32;
        for (name, inside) in &self.surfaces {
            if let Some(cell) = inside.iter().find(|&&cell| cell >= cells) {
                let message =
                    format!("surface `{name}` has the cell {cell}, and there are {cells} cells");
                let error = InputError::new(message);
                return Err(error.hint("cells count from 0, triangles first").into());
            }
        }
        Ok(())
    }
}

fn cell_name(triangles: usize, cell: u32) -> String {
    match (cell as usize).checked_sub(triangles) {
        None => format!("triangle {cell}"),
        Some(quad) => format!("quad {quad}"),
    }
}

/// The curve of these edges, each of which must be one of a cell's.
fn curve((name, edges): (String, Vec<[u32; 2]>), sound: &Sound) -> Result<Curve> {
    let edge = |&[a, b]: &[u32; 2]| {
        sound.edge([a, b]).ok_or_else(|| {
            let ends = format!("from vertex {a} to vertex {b}");
            let error = InputError::new(format!("curve `{name}`: no cell has the edge {ends}"));
            error.hint("an edge is a pair of vertices of one cell side").into()
        })
    };
    let mut edges = edges.iter().map(edge).collect::<Result<Vec<_>>>()?;
    edges.sort_unstable();
    edges.dedup();
    Ok(Curve { name, edges })
}

fn surface((name, mut cells): (String, Vec<u32>)) -> Surface {
    cells.sort_unstable();
    cells.dedup();
    Surface { name, cells }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Arrays {
        Arrays {
            points: [[9.0, 9.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.5]]
                .map(|[x, y]| [x, y, 3.0])
                .to_vec(),
            triangles: vec![[2, 3, 5]],
            quads: vec![[1, 2, 3, 4]],
            curves: vec![("left".to_owned(), vec![[4, 1], [1, 4]])],
            surfaces: vec![("all".to_owned(), vec![1, 0, 1])],
        }
    }

    #[test]
    fn cells_are_turned_and_lonely_vertices_dropped() {
        let (mesh, origins) = square().mesh().expect("a mesh");
        assert_eq!(origins, [1, 2, 3, 4, 5]);
        assert_eq!((mesh.triangles, mesh.quads), (vec![[1, 4, 2]], vec![[0, 1, 2, 3]]));
        assert_eq!(mesh.curves[0].edges, [[0, 3]]);
        assert_eq!(mesh.surfaces[0].cells, [0, 1]);
        assert_eq!(mesh.vertices[4], [2.0, 0.5]);
    }

    #[test]
    fn any_height_is_that_of_a_plane() {
        let mut arrays = square();
        // The first point is of no cell, and rotations leave noise.
        (arrays.points[0][2], arrays.points[4][2]) = (-70.0, 3.0 + 1e-12);
        let flat = square().points.iter().map(|&[x, y, _]| [x, y, 0.0]).collect();
        assert_eq!(
            arrays.mesh().expect("a mesh"),
            Arrays { points: flat, ..square() }.mesh().expect("a mesh")
        );
    }

    /// Something done to the square, and what is said of it.
    type Case = (fn(&mut Arrays), &'static str);

    #[rustfmt::skip] // A table.
    const WRONG: [Case; 10] = [
        (|of| of.quads[0][2] = 7, "quad 0 has the vertex 7, and there are 6 points"),
        (|of| of.points[3] = [f64::NAN, 0.0, 3.0], "point 3 is [NaN, 0.0, 3.0], expected numbers"),
        (|of| of.points[3][2] = 3.1, "point 3 has z = 3.1, point 2 has z = 3, expected a mesh in a plane z = constant"),
        (|of| of.triangles[0] = [2, 3, 3], "triangle 0 is degenerate: it has no area, or two corners in one place"),
        (|of| of.points[3] = [0.2, 0.2, 3.0], "quad 0 is not convex: it has an angle of more than 180° at vertex 3"),
        (|of| of.triangles.push([1, 2, 5]), "triangle 1 and quad 0 overlap: both lie on the same side of the edge from vertex 1 to vertex 2"),
        (|of| of.curves[0].1.push([1, 3]), "curve `left`: no cell has the edge from vertex 1 to vertex 3"),
        (|of| of.surfaces[0].1.push(2), "surface `all` has the cell 2, and there are 2 cells"),
        (|of| of.curves[0].1.clear(), "curve `left` has no edge"),
        (|of| (of.triangles, of.quads) = Default::default(), "the mesh has no cell: expected triangles or quads"),
    ];

    #[test]
    fn what_is_wrong_is_named_as_it_was_given() {
        for (change, message) in WRONG {
            let mut arrays = square();
            change(&mut arrays);
            assert_eq!(arrays.mesh().expect_err("refused").to_string(), message);
        }
    }
}

//! Point location: which cell of a mesh holds a point, and where in it.
//!
//! The mesh lies in a grid of about as many squares as it has cells. Each square knows the cells whose
//! boxes touch it, so that a point is tried in a handful of cells.

use crate::Problem;
use crate::cell::Cell;
use crate::field::CellField;

/// The cells of a mesh in a grid of squares.
pub struct Search {
    fields: Vec<CellField>,
    low: [f64; 2],
    size: [f64; 2],
    lines: usize,
    squares: Vec<Vec<u32>>,
}

/// A point as the cell it lies in sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocatedPoint {
    /// The cell, triangles first.
    pub cell: u32,
    /// Reference coordinates, as [`crate::quadrature::Point`] has them.
    pub reference: [f64; 3],
}

impl Search {
    /// Sorts the cells of a problem's mesh.
    pub fn new(problem: &Problem) -> Self {
        let cells = problem.cells();
        let field = |cell: usize| CellField::of_sides(problem, cell, [0.0; 4], [0.0; 4]);
        let fields = (0..cells).map(field).collect();
        let of = |k: usize| problem.mesh.vertices.iter().map(move |vertex| vertex[k]);
        let low = [0, 1].map(|k| of(k).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|k| of(k).fold(f64::NEG_INFINITY, f64::max));
        let lines = ((cells as f64).sqrt() as usize).max(1);
        let size = [0, 1].map(|k| (high[k] - low[k]).max(f64::MIN_POSITIVE));
        let squares = vec![Vec::new(); lines * lines];
        let mut search = Self { fields, low, size, lines, squares };
        for cell in 0..cells {
            search.enter(cell);
        }
        search
    }

    /// The cell that holds a point; where boundaries are curved and none does, the middle of the
    /// nearest of those around it. `None`: the mesh has no cells.
    pub fn find(&self, point: [f64; 2]) -> Option<LocatedPoint> {
        let [x, y] = self.square(point);
        let near = &self.squares[y * self.lines + x];
        near.iter().find_map(|&cell| self.within(cell, point)).or_else(|| self.nearest(near, point))
    }

    /// Finds one of many points that follow each other: `last` is where the one before lies.
    pub fn find_near(&self, last: Option<LocatedPoint>, point: [f64; 2]) -> Option<LocatedPoint> {
        last.and_then(|last| self.within(last.cell, point)).or_else(|| self.find(point))
    }

    fn within(&self, cell: u32, point: [f64; 2]) -> Option<LocatedPoint> {
        Some(LocatedPoint { cell, reference: self.fields[cell as usize].locate(point)? })
    }

    fn nearest(&self, near: &[u32], point: [f64; 2]) -> Option<LocatedPoint> {
        let all = 0..self.fields.len() as u32;
        let candidates: Vec<u32> = if near.is_empty() { all.collect() } else { near.to_vec() };
        let distance = |&cell: &u32| {
            let [x, y] = self.fields[cell as usize].middle();
            (x - point[0]).hypot(y - point[1])
        };
        let cell = candidates.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let reference = match self.fields[cell as usize].cell {
            Cell::Triangle(_) => [1.0 / 3.0; 3],
            Cell::Quad(_) => [0.5, 0.5, 0.0],
        };
        Some(LocatedPoint { cell, reference })
    }

    fn enter(&mut self, cell: usize) {
        let lines = self.fields[cell].cell.corners().iter().map(|&corner| self.square(corner));
        let [mut first, mut last] = [[usize::MAX; 2], [0; 2]];
        for at in lines {
            first = [0, 1].map(|k| first[k].min(at[k]));
            last = [0, 1].map(|k| last[k].max(at[k]));
        }
        for y in first[1]..=last[1] {
            for x in first[0]..=last[0] {
                self.squares[y * self.lines + x].push(cell as u32);
            }
        }
    }

    fn square(&self, point: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|k| {
            let line = (point[k] - self.low[k]) / self.size[k] * self.lines as f64;
            (line.max(0.0) as usize).min(self.lines - 1)
        })
    }
}

#[cfg(test)]
mod tests {
    use signorini_tolerances::solve::FOUND;
    use std::f64::consts::PI;

    use super::*;
    use crate::fixtures::{PARABOLA, on_grid};
    use crate::quadrature::gauss;
    use signorini_scene::mesh::structured::{Cells, grid};

    #[test]
    fn points_of_every_cell_are_found_in_it() {
        for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
            let mut mesh = grid(6, cells);
            for [x, y] in &mut mesh.vertices {
                let bend = 0.05 * (PI * *x).sin() * (PI * *y).sin();
                (*x, *y) = (*x + bend, *y + bend);
            }
            let (_, problem) = on_grid(PARABOLA, mesh).unwrap();
            let search = Search::new(&problem);
            let mut last = None;
            for cell in 0..problem.cells() {
                for point in Cell::of(&problem, cell).points(&gauss(3)) {
                    let place = search.find(point.x).unwrap();
                    assert_eq!(place.cell as usize, cell);
                    let apart = place.reference.iter().zip(point.reference);
                    apart.for_each(|(a, b)| FOUND.check("reference coordinates", a - b));
                    last = search.find_near(last, point.x);
                    assert_eq!(last.map(|place| place.cell), Some(place.cell));
                }
            }
        }
    }

    #[test]
    fn a_point_outside_belongs_to_the_nearest_cell() {
        let (_, problem) = on_grid(PARABOLA, grid(2, Cells::Quads)).unwrap();
        let place = Search::new(&problem).find([1.2, 1.1]).unwrap();
        assert_eq!((place.cell, place.reference), (7, [0.5, 0.5, 0.0]));
    }
}

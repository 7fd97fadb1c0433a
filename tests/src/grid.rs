//! Meshes as plain lists, and the structured ones of the verification catalogue.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::field::Point;

/// An edge: its two vertex numbers, the lower one first.
pub type Edge = (u32, u32);

/// The edge between two vertices.
pub fn edge(a: u32, b: u32) -> Edge {
    (a.min(b), a.max(b))
}

/// A mesh. Cells are numbered triangles first, then quads, and listed counterclockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Coordinates of the vertices.
    pub vertices: Vec<Point>,
    /// Vertex numbers of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Vertex numbers of the quadrilaterals.
    pub quads: Vec<[u32; 4]>,
}

/// How the rectangles of a structured grid become cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// Each is cut from its lower left to its upper right corner.
    Triangles,
    /// Each is kept.
    Quads,
    /// Cut and kept ones alternate like the fields of a chequerboard; the lower left one is cut.
    Mixed,
}

impl Grid {
    /// `columns` × `rows` equal rectangles on [x0, x1] × [y0, y1], vertices numbered upwards
    /// column by column.
    pub fn rectangle(lower: Point, upper: Point, columns: u32, rows: u32, cells: Cells) -> Self {
        let at = |k: usize, i: u32, n: u32| {
            let t = f64::from(i) / f64::from(n);
            lower[k] + t * (upper[k] - lower[k])
        };
        let mut grid = Self::default();
        for i in 0..=columns {
            grid.vertices.extend((0..=rows).map(|j| [at(0, i, columns), at(1, j, rows)]));
        }
        for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
            let a = i * (rows + 1) + j;
            let [b, c, d] = [a + rows + 1, a + rows + 2, a + 1];
            let cut = match cells {
                Cells::Triangles => true,
                Cells::Quads => false,
                Cells::Mixed => (i + j).is_multiple_of(2),
            };
            if cut {
                grid.triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                grid.quads.push([a, b, c, d]);
            }
        }
        grid
    }

    /// 2n × n squares on (−1, 1) × (0, 1), the domain of the catalogue.
    pub fn catalogue(n: u32, cells: Cells) -> Self {
        Self::rectangle([-1.0, 0.0], [1.0, 1.0], 2 * n, n, cells)
    }

    /// A copy with every vertex of the inside of (−1, 1) × (0, 1) moved by
    /// 0.05 sin πx sin πy in both coordinates, which is zero on the boundary.
    pub fn moved_smoothly(mut self) -> Self {
        for v in self.vertices.iter_mut().filter(|v| is_inside(**v)) {
            let shift = 0.05 * (PI * v[0]).sin() * (PI * v[1]).sin();
            *v = [v[0] + shift, v[1] + shift];
        }
        self
    }

    /// A copy (n squares over the height 1) with the inner vertices of every other column
    /// of vertices moved up by h/4 and those of the columns between down by h/4: the quads along the
    /// bottom and the top stay trapezoids however fine the mesh; those between are parallelograms.
    pub fn moved_to_trapezoids(mut self, n: u32) -> Self {
        let h = 1.0 / f64::from(n);
        for (k, v) in self.vertices.iter_mut().enumerate().filter(|(_, v)| is_inside(**v)) {
            let column = k / (n as usize + 1);
            v[1] += if column.is_multiple_of(2) { 0.25 * h } else { -0.25 * h };
        }
        self
    }

    /// How many cells there are.
    pub fn cell_count(&self) -> usize {
        self.triangles.len() + self.quads.len()
    }

    /// The vertex numbers of a cell; its edge i runs from entry i to entry i + 1, cyclically.
    pub fn cell(&self, cell: usize) -> &[u32] {
        match self.triangles.get(cell) {
            Some(triangle) => triangle,
            None => &self.quads[cell - self.triangles.len()],
        }
    }

    /// The edges of a cell, in its local order.
    pub fn cell_edges(&self, cell: usize) -> Vec<Edge> {
        let v = self.cell(cell);
        (0..v.len()).map(|i| edge(v[i], v[(i + 1) % v.len()])).collect()
    }

    /// Every edge with the cells (one or two) that it belongs to.
    pub fn edges(&self) -> BTreeMap<Edge, Vec<usize>> {
        let mut edges = BTreeMap::<Edge, Vec<usize>>::new();
        for cell in 0..self.cell_count() {
            for e in self.cell_edges(cell) {
                edges.entry(e).or_default().push(cell);
            }
        }
        edges
    }

    /// The edges of the boundary.
    pub fn boundary(&self) -> Vec<Edge> {
        self.edges().into_iter().filter(|(_, cells)| cells.len() == 1).map(|(e, _)| e).collect()
    }

    /// The end points of an edge.
    pub fn ends(&self, e: Edge) -> [Point; 2] {
        [self.vertices[e.0 as usize], self.vertices[e.1 as usize]]
    }
}

fn is_inside([x, y]: Point) -> bool {
    x.abs() < 1.0 && 0.0 < y && y < 1.0
}

#[cfg(test)]
mod tests {
    use super::{Cells, Grid};

    /// Counts of a 2n × n grid: the unknowns of the method are its edges.
    #[test]
    fn counts_are_those_of_the_formulas() {
        let n = 8;
        for (cells, cell_count, edges) in [
            (Cells::Triangles, 4 * n * n, 6 * n * n + 3 * n),
            (Cells::Quads, 2 * n * n, 4 * n * n + 3 * n),
            (Cells::Mixed, 3 * n * n, 5 * n * n + 3 * n),
        ] {
            let grid = Grid::catalogue(n as u32, cells);
            assert_eq!(grid.cell_count(), cell_count);
            assert_eq!(grid.edges().len(), edges);
            assert_eq!(grid.boundary().len(), 6 * n);
            assert!(grid.edges().values().all(|cells| cells.len() <= 2));
        }
    }
}

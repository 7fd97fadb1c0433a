//! Grids of 2n × n cells on (−1, 1) × (0, 1) whose cells are as bad as a number says.
//!
//! ```text
//!   graded              slivers                collapsed               trapezoids
//!   +-----+-----+       +-----+-----+          +-----+-----+           +-----+-----+
//!   |     |     |       |    /|    /|          |      \    |           |   _-+-_   |
//!   +-----+-----+       | _-' | _-' |          |       \   |           +_-'     `-_+
//!   |     |     |      =+=====+=====+=         |        +--+           | `-_   _-' |
//!   +=====+=====+       +-----+-----+          +--------+--+           +----`+'----+
//! ```

use signorini_scene::Mesh;
use signorini_scene::mesh::Curve;
use signorini_scene::mesh::structured::{Cells, grid};

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    Square,
    /// Rows grow from a height of 1/(n · aspect) at the bottom, each by the same factor.
    Graded {
        /// Width over height of the lowest cells.
        aspect: f64,
    },
    /// Every other row has a height of about 1/(n · aspect), and its upper line is moved by half a cell: angles near
    /// 180° in triangles, oblique needles as quads.
    Slivers {
        aspect: f64,
    },
    /// Every other vertical side of the lines inside moves towards the next, until a width of t/n is left: a
    /// quad with t = 0 is a triangle, with t < 0 it crosses itself.
    Collapsed {
        /// The part that is left of the width.
        left: f64,
    },
    /// Every other column moves down by a quarter of a cell: trapezoids on every grid.
    Trapezoids,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Cells over the height.
    pub n: u32,
    pub cells: Cells,
    pub shape: Shape,
}

impl Grid {
    /// Its mesh, with the curves `bottom`, `right`, `top`, `left`, each from −1 or 0 up.
    pub fn mesh(&self) -> Mesh {
        let mut mesh = grid(self.n, self.cells);
        let columns = 2 * self.n as usize + 1;
        let rows = self.rows();
        for (at, vertex) in mesh.vertices.iter_mut().enumerate() {
            let (i, j) = (at % columns, at / columns);
            *vertex = self.moved(i, j, [vertex[0], rows[j]]);
        }
        mesh.curves = self.sides();
        mesh
    }

    fn rows(&self) -> Vec<f64> {
        let n = f64::from(self.n);
        let heights: Vec<f64> = match self.shape {
            Shape::Graded { aspect } => {
                let growth = growth(1.0 / aspect, self.n);
                (0..self.n).map(|j| growth.powf(f64::from(j)) / (n * aspect)).collect()
            }
            Shape::Slivers { aspect } => {
                (0..self.n).map(|j| if j % 2 == 0 { 1.0 } else { 0.5 / aspect }).collect()
            }
            _ => vec![1.0; self.n as usize],
        };
        partition(&heights)
    }

    /// Where vertex i of line j lies.
    fn moved(&self, i: usize, j: usize, [x, y]: [f64; 2]) -> [f64; 2] {
        let (n, columns) = (f64::from(self.n), 2 * self.n as usize);
        let is_inside = i > 0 && i < columns && j > 0 && j < self.n as usize;
        match self.shape {
            Shape::Slivers { .. } if is_inside && j.is_multiple_of(2) => [x + 0.5 / n, y],
            Shape::Collapsed { left } if is_inside && i % 2 == 1 => [x + (1.0 - left) / n, y],
            Shape::Trapezoids if is_inside && i % 2 == 1 => [x, y - 0.25 / n],
            _ => [x, y],
        }
    }

    fn sides(&self) -> Vec<Curve> {
        let (n, columns) = (self.n, 2 * self.n);
        let vertex = |i: u32, j: u32| j * (columns + 1) + i;
        let along = |j: u32| (0..columns).map(move |i| [vertex(i, j), vertex(i + 1, j)]).collect();
        let up = |i: u32| (0..n).map(move |j| [vertex(i, j), vertex(i, j + 1)]).collect();
        let curve = |name: &str, edges| Curve { name: name.to_owned(), edges };
        vec![
            curve("bottom", along(0)),
            curve("right", up(columns)),
            curve("top", along(n)),
            curve("left", up(0)),
        ]
    }
}

/// The ends of intervals of these widths one after the other, scaled so that they are 0 to 1.
pub(super) fn partition(widths: &[f64]) -> Vec<f64> {
    let total: f64 = widths.iter().sum();
    let sums = widths.iter().scan(0.0, |sum, width| {
        *sum += width;
        Some(*sum / total)
    });
    [0.0].into_iter().chain(sums).collect()
}

/// q with (1 + q + … + q^{n−1}) · `first` = n, by bisection: the heights add up to 1.
fn growth(first: f64, n: u32) -> f64 {
    let sum = |q: f64| (0..n).map(|j| q.powf(f64::from(j))).sum::<f64>() * first;
    let (mut low, mut high) = (1.0, f64::from(n) / first + 1.0);
    for _ in 0..200 {
        let middle = f64::sqrt(low * high);
        *if sum(middle) > f64::from(n) { &mut high } else { &mut low } = middle;
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_scene::mesh;
    use signorini_scene::mesh::gmsh::write;
    use signorini_scene::mesh::shape::{Defect, orientation};
    use signorini_tolerances::lab::ASPECT;

    fn with(shape: Shape) -> Mesh {
        Grid { n: 4, cells: Cells::Quads, shape }.mesh()
    }

    fn corners(mesh: &Mesh, quad: usize) -> [[f64; 2]; 4] {
        mesh.quads[quad].map(|vertex| mesh.vertices[vertex as usize])
    }

    #[test]
    fn a_grid_survives_its_file() {
        let folder = tempfile::tempdir().unwrap();
        for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
            let mesh = Grid { n: 3, cells, shape: Shape::Graded { aspect: 1e5 } }.mesh();
            let path = folder.path().join("grid.msh");
            std::fs::write(&path, write::text(&mesh)).unwrap();
            let read = mesh::read(&path).unwrap();
            assert_eq!(read.vertices, mesh.vertices);
            assert_eq!(
                (read.triangles.len(), read.quads.len()),
                (mesh.triangles.len(), mesh.quads.len())
            );
            let lengths = |mesh: &Mesh| -> Vec<_> {
                mesh.curves.iter().map(|curve| (curve.name.clone(), curve.edges.len())).collect()
            };
            assert_eq!(lengths(&read), lengths(&mesh));
        }
    }

    #[test]
    fn graded_rows_begin_as_flat_as_asked_and_fill_the_height() {
        for aspect in [1.0, 30.0, 1e6] {
            let mesh = with(Shape::Graded { aspect });
            let lowest = mesh.vertices[9][1];
            ASPECT.check(format_args!("{lowest}"), 4.0 * lowest * aspect - 1.0);
            let heights: Vec<f64> = (0..5).map(|j| mesh.vertices[9 * j][1]).collect();
            assert_eq!(heights[4], 1.0);
            assert!(heights.windows(2).all(|pair| pair[0] < pair[1]));
        }
    }

    #[test]
    fn cells_degenerate_where_the_number_says() {
        let defect = |left| orientation(&corners(&with(Shape::Collapsed { left }), 1)).err();
        assert_eq!(defect(1e-6), None);
        assert_eq!(defect(0.0), Some(Defect::Degenerate));
        assert_eq!(defect(-0.1), Some(Defect::SelfCrossing));
        let flat = corners(&with(Shape::Slivers { aspect: 1e6 }), 9);
        assert!(flat[2][1] - flat[1][1] < 1e-6 && flat[2][0] - flat[1][0] == 0.125);
    }
}

//! A start from a coarser mesh: solved there first, and brought to the fine one.

use signorini_kernel::element::{crouzeix_raviart, rannacher_turek};
use signorini_kernel::prolongation::Origin;

use crate::error::{InputError, Result};
use crate::field::CellField;
use crate::problem::Problem;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::solve::{Options, solve};

/// Means of u over the edges of `coarse`.
///
/// # Errors
/// As for [`solve`].
pub fn solved(scene: &Scene, coarse: &Problem) -> Result<Vec<f64>> {
    Ok(solve(scene, coarse, &Options::default())?.u)
}

/// For every edge of `fine` the sides of the coarse cell that its middle lies in.
///
/// # Errors
/// A middle outside the coarse mesh by more than the size of a cell.
pub fn origins<R: Scalar>(fine: &Problem, coarse: &Problem) -> Result<Vec<Origin<R, u32>>> {
    let search = Search::new(coarse);
    (0..fine.ends.len())
        .map(|edge| {
            let [a, b] = fine.segment(edge);
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            search.origin(middle)
        })
        .collect()
}

/// The cells of a mesh in a grid of squares, each square with the cells whose boxes touch it.
struct Search<'p> {
    problem: &'p Problem,
    fields: Vec<CellField>,
    low: [f64; 2],
    size: [f64; 2],
    lines: usize,
    squares: Vec<Vec<u32>>,
}

impl<'p> Search<'p> {
    fn new(problem: &'p Problem) -> Self {
        let nothing = vec![0.0; problem.ends.len()];
        let cells = problem.cells();
        let fields =
            (0..cells).map(|cell| CellField::new(problem, cell, &nothing, &nothing)).collect();
        let of = |k: usize| problem.mesh.vertices.iter().map(move |vertex| vertex[k]);
        let low = [0, 1].map(|k| of(k).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|k| of(k).fold(f64::NEG_INFINITY, f64::max));
        let lines = ((cells as f64).sqrt() as usize).max(1);
        let size = [0, 1].map(|k| (high[k] - low[k]).max(f64::MIN_POSITIVE));
        let mut search =
            Self { problem, fields, low, size, lines, squares: vec![Vec::new(); lines * lines] };
        for cell in 0..cells {
            search.enter(cell);
        }
        search
    }

    fn enter(&mut self, cell: usize) {
        let mesh = &self.problem.mesh;
        let corners = match cell.checked_sub(mesh.triangles.len()) {
            None => mesh.triangles[cell].as_slice(),
            Some(quad) => mesh.quads[quad].as_slice(),
        };
        let lines = corners.iter().map(|&vertex| self.square(mesh.vertices[vertex as usize]));
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

    /// The cell that holds a point; where boundaries are curved, the nearest of those around it.
    fn origin<R: Scalar>(&self, point: [f64; 2]) -> Result<Origin<R, u32>> {
        let [x, y] = self.square(point);
        let near = &self.squares[y * self.lines + x];
        let inside =
            near.iter().find_map(|&cell| Some((cell, self.fields[cell as usize].locate(point)?)));
        match inside {
            Some((cell, reference)) => Ok(self.combine(cell as usize, reference)),
            None => self.nearest(near, point),
        }
    }

    fn nearest<R: Scalar>(&self, near: &[u32], point: [f64; 2]) -> Result<Origin<R, u32>> {
        let all = 0..self.fields.len() as u32;
        let candidates: Vec<u32> = if near.is_empty() { all.collect() } else { near.to_vec() };
        let distance = |&cell: &u32| {
            let [x, y] = self.fields[cell as usize].middle();
            (x - point[0]).hypot(y - point[1])
        };
        let closest = candidates.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(cell) = closest else {
            return Err(InputError::new("--coarse: the mesh has no cells").into());
        };
        let middle = match self.fields[cell as usize] {
            CellField::Triangle(..) => [1.0 / 3.0; 3],
            CellField::Quad(..) => [0.5, 0.5, 0.0],
        };
        Ok(self.combine(cell as usize, middle))
    }

    fn combine<R: Scalar>(&self, cell: usize, reference: [f64; 3]) -> Origin<R, u32> {
        let topology = &self.problem.topology;
        match self.fields[cell] {
            CellField::Triangle(..) => {
                let [a, b, c] = topology.of_triangles[cell];
                let [p, q, r] = crouzeix_raviart::basis(reference).map(R::narrow);
                Origin { edges: [a, b, c, a], weights: [p, q, r, R::ZERO] }
            }
            CellField::Quad(corners, ..) => {
                let edges = topology.of_quads[cell - topology.of_triangles.len()];
                let [x, y, _] = reference;
                let weights = rannacher_turek::place(corners, [x, y]).basis().map(R::narrow);
                Origin { edges, weights }
            }
        }
    }
}

//! From u on one mesh to a start on a finer one.
//!
//! ```text
//!   an edge            the old u_h at its middle, seen from an old cell that holds it
//!   a contact edge     ψ where the old edge touched; else not on the other side of ψ than the old edge
//! ```

use std::cmp::Ordering;

use signorini_problem::Problem;
use signorini_problem::cell::Cell;
use signorini_problem::field::CellField;
use signorini_problem::quadrature::Point;

/// A solution on the old mesh.
pub(super) struct Old<'a> {
    pub problem: &'a Problem,
    /// Means over its edges.
    pub u: &'a [f64],
    /// ψ of a contact edge, in the scalar of u.
    pub gap: &'a dyn Fn(usize) -> f64,
}

impl Old<'_> {
    /// u to begin with on every unknown edge of `problem`; `holder` is the old cell that holds the middle of a side of a cell.
    pub fn carried(&self, problem: &Problem, holder: impl Fn(usize, usize) -> usize) -> Vec<f64> {
        let counts = problem.topology.counts;
        let mut holders = vec![0; counts.unknowns()];
        for cell in 0..problem.cells() {
            for (side, &edge) in problem.topology.edges_of(cell).iter().enumerate() {
                if let Some(known) = holders.get_mut(edge as usize) {
                    *known = holder(cell, side);
                }
            }
        }
        let start = |(edge, &cell): (usize, &usize)| {
            let (u, reference) = self.at(cell, problem.along(edge, 0.5));
            match edge.checked_sub(counts.free) {
                None => u,
                Some(at) => self.on_its_side(cell, reference, u, problem.loads.gap[at]),
            }
        };
        holders.iter().enumerate().map(start).collect()
    }

    /// u_h at a point of a cell, and where in the cell that is. The point lies in the cell, whatever rounding says.
    fn at(&self, cell: usize, x: [f64; 2]) -> (f64, [f64; 3]) {
        let edges = self.problem.topology.edges_of(cell);
        let mut means = [0.0; 4];
        means.iter_mut().zip(edges).for_each(|(mean, &edge)| *mean = self.u[edge as usize]);
        let reference = Cell::of(self.problem, cell).reference(x);
        let field = CellField::of_sides(self.problem, cell, means, [0.0; 4]);
        let u = field.sample(&Point { x, reference, weight: 0.0 }).u;
        let mean = means.iter().sum::<f64>() / edges.len() as f64;
        (if u.is_finite() { u } else { mean }, reference)
    }

    /// `u` at a point of a contact edge of a cell, moved to the side of the `gap` on which the cell's nearest contact edge was.
    fn on_its_side(&self, cell: usize, reference: [f64; 3], u: f64, gap: f64) -> f64 {
        let counts = self.problem.topology.counts;
        let apart = distances(&Cell::of(self.problem, cell), reference);
        let sides = self.problem.topology.edges_of(cell).iter().zip(apart);
        let contact = sides.filter_map(|(&edge, apart)| {
            let at = (edge as usize).checked_sub(counts.free)?;
            (at < counts.contact).then_some((at, apart))
        });
        let nearest = contact.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let side = nearest.map(|(at, _)| self.u[counts.free + at].partial_cmp(&(self.gap)(at)));
        match side {
            None => u,
            Some(Some(Ordering::Greater)) => u.max(gap),
            Some(Some(Ordering::Less)) => u.min(gap),
            Some(_) => gap,
        }
    }
}

/// How far a point of a cell is from each side, in reference coordinates.
fn distances(cell: &Cell, [x, y, z]: [f64; 3]) -> [f64; 4] {
    match cell {
        Cell::Triangle(_) => [z, x, y, f64::INFINITY],
        Cell::Quad(_) => [y, 1.0 - x, 1.0 - y, x],
    }
}

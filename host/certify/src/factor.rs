//! Factors of the cells whose own points do not resolve A, for the kernel's certificate, and what A has above them.

use signorini_bound::certificate::{Above, CURVED, ENTRIES, Factor, GRADIENTS, ON_QUAD};
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::pieces::{PiecePoint, Pieces};

use crate::cell::Cell;
use crate::conductivity::Root;
use crate::triangular::triangular;

/// A gradient with less than this part of itself that is not in those before is in their span.
const IN_SPAN: f64 = 1e-9;

/// F of cell `at` and what A has above it.
pub fn factor(problem: &Problem, at: usize, pieces: &Pieces) -> (Factor<f64>, Above<f64>) {
    let functions = Functions::of(problem, at);
    let (sides, gradients) = match functions.cell {
        Cell::Triangle(_) => (3, GRADIENTS[0]),
        Cell::Quad(_) => (4, GRADIENTS[1]),
    };
    let mut rows = vec![Vec::new(); gradients + sides];
    // √N′∇v and √N∇v.
    let mut above = [vec![Vec::new(); gradients], vec![Vec::new(); gradients]];
    for at in pieces.points(functions.cell) {
        let (root, slopes) = (Root::of(&at.below, at.point.weight.sqrt()), functions.slopes(&at));
        let of_v = slopes.iter().map(|slope| root.gradient(*slope));
        let of_tau = (0..sides).map(|side| root.flux(functions.flux(&at, side)).map(|x| -x));
        rows.iter_mut().zip(of_v.chain(of_tau)).for_each(|(column, row)| column.extend(row));
        for (columns, share) in above.iter_mut().zip([at.share, 1.0]) {
            let weight = at.above.map(|n| (at.point.weight * share * n).sqrt());
            for (column, [x, y]) in columns.iter_mut().zip(&slopes) {
                column.extend([weight[0] * x, weight[1] * y]);
            }
        }
    }
    let rows = triangular(rows);
    (packed(&rows), above.map(|columns| beside(triangular(columns), &rows, gradients)))
}

/// The functions of v and τ on a cell.
struct Functions {
    cell: Cell,
    field: CellField,
    /// The curved function of u_h.
    curved: CellField,
}

impl Functions {
    fn of(problem: &Problem, at: usize) -> Self {
        let cell = Cell::of(problem, at);
        let field = |means: [f64; 4]| match cell {
            Cell::Triangle(corners) => CellField::Triangle(corners, [0.0; 3], [0.0; 3]),
            Cell::Quad(corners) => CellField::Quad(corners, means, [0.0; 4], problem.element),
        };
        Self { cell, field: field([0.0; 4]), curved: field(CURVED) }
    }

    /// Gradients at a point, in the order of the factor's columns.
    fn slopes(&self, at: &PiecePoint) -> Vec<[f64; 2]> {
        let local = self.cell.local(at.point.reference);
        let corners = self.cell.corners().len();
        let mut slopes: Vec<_> = local.vertices[1..corners].iter().map(|of| of.gradient).collect();
        if corners == 4 {
            slopes.extend(local.sides.iter().map(|side| side.bubble().gradient));
            slopes.push(self.curved.sample(&at.point).gradient);
        }
        slopes
    }

    /// The Raviart–Thomas field with the outward flux 1 through a side.
    fn flux(&self, at: &PiecePoint, side: usize) -> [f64; 2] {
        let mut field = self.field;
        match &mut field {
            CellField::Triangle(_, _, fluxes) => fluxes[side] = 1.0,
            CellField::Quad(_, _, fluxes, _) => fluxes[side] = 1.0,
        }
        field.sample(&at.point).flux
    }
}

/// Rows of a triangular factor as the kernel keeps its columns. A row begins where its column does.
fn packed(rows: &[Vec<f64>]) -> Factor<f64> {
    let mut entries = [0.0; ENTRIES];
    for row in rows {
        let Some(at) = row.iter().position(|&entry| entry != 0.0) else { continue };
        for (column, &entry) in row.iter().enumerate().skip(at) {
            entries[column * (column + 1) / 2 + at] = entry;
        }
    }
    entries
}

/// At least the largest |Mv|² for |F (v, 0)| = 1, M having the `rows`: ‖M F⁻¹‖² by Frobenius.
fn beside(rows: Vec<Vec<f64>>, factor: &[Vec<f64>], gradients: usize) -> f64 {
    let own = packed(factor);
    let entry = |row: usize, column: usize| own[column * (column + 1) / 2 + row];
    let size = |column: usize| (0..=column).map(|row| entry(row, column).abs()).sum::<f64>();
    let mut sum = 0.0;
    for row in rows {
        let mut x = [0.0; ON_QUAD];
        for column in 0..gradients {
            if entry(column, column) > IN_SPAN * size(column) {
                let known: f64 = (0..column).map(|at| x[at] * entry(at, column)).sum();
                x[column] = (row[column] - known) / entry(column, column);
                sum += x[column] * x[column];
            }
        }
    }
    sum
}

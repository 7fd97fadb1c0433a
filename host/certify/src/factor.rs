//! Factors of the cells whose own points do not resolve A, for the kernel's certificate.

use signorini_bound::certificate::{Above, ENTRIES, Factor};
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::pieces::Cut;

use crate::admissible::Admissible;

/// A gradient with less than this part of itself that is not in those before is in their span.
const IN_SPAN: f64 = 1e-9;

/// F and M of a cell, and what A has above F.
pub fn factor(cut: &Cut) -> (Factor<f64>, Above<f64>) {
    let [open, beyond] = &cut.above;
    let mut entries = packed(&cut.seen);
    let columns = cut.seen.first().map_or(0, Vec::len);
    let (_, to) = entries.split_at_mut(columns * (columns + 1) / 2);
    to.iter_mut().zip(packed(open)).for_each(|(to, from)| *to = from);
    (entries, [0.0, beside(beyond, &cut.seen, cut.gradients)])
}

/// The coefficients of s and τ on cell `at`.
pub fn coefficients(problem: &Problem, at: usize, of: &Admissible) -> [Vec<f64>; 2] {
    let vertices = problem.vertices_of(at);
    let value = |vertex: u32| of.vertices[vertex as usize];
    let mut v: Vec<_> =
        vertices[1..].iter().map(|&vertex| value(vertex) - value(vertices[0])).collect();
    if vertices.len() == 4 {
        v.extend(problem.topology.edges_of(at).iter().map(|&edge| of.bubbles[edge as usize]));
        v.push(0.0);
    }
    [v, CellField::new(problem, at, of.tau, of.tau).fluxes().to_vec()]
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
fn beside(rows: &[Vec<f64>], factor: &[Vec<f64>], gradients: usize) -> f64 {
    let own = packed(factor);
    let entry = |row: usize, column: usize| own[column * (column + 1) / 2 + row];
    let size = |column: usize| (0..=column).map(|row| entry(row, column).abs()).sum::<f64>();
    let mut sum = 0.0;
    for row in rows {
        let mut x = vec![0.0; gradients];
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

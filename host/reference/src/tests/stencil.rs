//! Crouzeix–Raviart matrices on a square of m × m cells, each cut into two triangles.

use crate::{Factor, Problem, ReferenceError, Solution};

/// The condition on a side of the square.
#[derive(Clone, Copy, PartialEq)]
pub enum Side {
    Contact,
    Dirichlet,
    Neumann,
}

/// An owned problem.
pub struct Stencil {
    pub row_ptr: Vec<u32>,
    pub col_idx: Vec<u32>,
    pub values: Vec<f64>,
    pub load: Vec<f64>,
    pub lower: Vec<f64>,
    pub floating: Vec<bool>,
}

impl Stencil {
    pub fn problem(&self) -> Problem<'_> {
        Problem {
            row_ptr: &self.row_ptr,
            col_idx: &self.col_idx,
            values: &self.values,
            load: &self.load,
            lower: &self.lower,
            spans: &[],
            floating: &self.floating,
        }
    }

    pub fn solve(
        &self,
        factor: &Factor,
        guess: Option<&[bool]>,
    ) -> Result<Solution, ReferenceError> {
        factor.solve_between(&self.load, &self.lower, &[], guess)
    }

    /// From rows of (column, value) with the diagonal first, a load and ψ.
    pub fn from_rows(rows: &[Vec<(u32, f64)>], load: Vec<f64>, lower: Vec<f64>) -> Self {
        let mut row_ptr = vec![0];
        for row in rows {
            row_ptr.push(row_ptr[row_ptr.len() - 1] + row.len() as u32);
        }
        let (col_idx, values) = rows.iter().flatten().copied().unzip();
        Self { row_ptr, col_idx, values, load, lower, floating: Vec::new() }
    }
}

/// Sides in the order bottom, right, top, left; u = 0 on Dirichlet sides. Vertex (i, j) lies at
/// `place(i, j)`, a cell has `coefficient(i, j)`, an edge with midpoint x, y the load
/// `load(x, y)` × the third of its triangles' area and ψ = `gap(x, y)`.
pub fn crouzeix_raviart(
    m: usize,
    sides: [Side; 4],
    place: impl Fn(usize, usize) -> [f64; 2],
    coefficient: impl Fn(usize, usize) -> f64,
    load: impl Fn(f64, f64) -> f64,
    gap: impl Fn(f64, f64) -> f64,
) -> Stencil {
    let horizontal = |i: usize, j: usize| j * m + i;
    let vertical = |i: usize, j: usize| m * (m + 1) + j * (m + 1) + i;
    let diagonal = |i: usize, j: usize| 2 * m * (m + 1) + j * m + i;
    let edges = 3 * m * m + 2 * m;

    let mut side = vec![Side::Neumann; edges];
    for i in 0..m {
        side[horizontal(i, 0)] = sides[0];
        side[vertical(m, i)] = sides[1];
        side[horizontal(i, m)] = sides[2];
        side[vertical(0, i)] = sides[3];
    }
    let mut number = vec![None; edges];
    let mut unknowns = 0;
    for wanted in [Side::Neumann, Side::Contact] {
        for edge in (0..edges).filter(|&edge| side[edge] == wanted) {
            number[edge] = Some(unknowns);
            unknowns += 1;
        }
    }

    let mut rows: Vec<Vec<(u32, f64)>> = (0..unknowns).map(|row| vec![(row as u32, 0.0)]).collect();
    let mut b = vec![0.0; unknowns];
    let mut psi = vec![0.0; unknowns];
    let mut add = |corners: [[f64; 2]; 3], opposite: [usize; 3], a: f64| {
        // ∇φ_i = −2∇λ_i; |T|∇λ_i·∇λ_j = e_i·e_j / (4|T|) with e_i the edge opposite corner i.
        let edge = [0, 1, 2].map(|i| {
            let (p, q) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
            [q[0] - p[0], q[1] - p[1]]
        });
        let area = 0.5 * (edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0]).abs();
        for i in 0..3 {
            let Some(row) = number[opposite[i]] else { continue };
            let (p, q) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
            let (x, y) = (0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]));
            b[row] += load(x, y) * area / 3.0;
            psi[row] = gap(x, y);
            for j in 0..3 {
                let Some(column) = number[opposite[j]] else { continue };
                let value = a * (edge[i][0] * edge[j][0] + edge[i][1] * edge[j][1]) / area;
                match rows[row].iter_mut().find(|entry| entry.0 == column as u32) {
                    Some(entry) => entry.1 += value,
                    None => rows[row].push((column as u32, value)),
                }
            }
        }
    };
    for (i, j) in (0..m).flat_map(|j| (0..m).map(move |i| (i, j))) {
        let [p, q, r, s] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
        let a = coefficient(i, j);
        add([p, q, s], [diagonal(i, j), vertical(i, j), horizontal(i, j)], a);
        add([r, s, q], [diagonal(i, j), vertical(i + 1, j), horizontal(i, j + 1)], a);
    }

    let contact = side.iter().filter(|&&side| side == Side::Contact).count();
    let lower = psi.split_off(unknowns - contact);
    let mut stencil = Stencil::from_rows(&rows, b, lower);
    stencil.floating = vec![!sides.contains(&Side::Dirichlet); contact];
    stencil
}

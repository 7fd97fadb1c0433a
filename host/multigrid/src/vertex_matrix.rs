//! PᵀKP on the vertices: the coarse matrix that takes from the edges what is smooth.
//!
//! ```text
//!   (P v)_E = (v_a + v_b) / 2        on the edge E from a to b
//! ```
//! A conforming function that is affine on edges has these edge means. On triangles PᵀKP is its stiffness matrix. Vertices of
//! edges whose u is given carry 0; they have no row.

use crate::Problem;
use crate::around::Around;
use crate::sectors::part;
use crate::sparse::{RowSum, Sparse};

/// Numbers of the vertices in the order in which edges meet them: what is near in K is near in PᵀKP.
pub(crate) struct Numbering {
    /// The two vertices of each unknown edge; [`Numbering::count`] for those that carry 0.
    pub ends: Vec<[u32; 2]>,
    /// How many carry a value.
    pub count: usize,
    /// The edges at each of these.
    around: Around,
}

impl Numbering {
    pub fn of(problem: &Problem) -> Self {
        let unknowns = problem.unknowns();
        let (edges, given) = problem.ends.split_at(unknowns);
        let mut number = vec![u32::MAX; problem.vertices];
        let mut count = 0;
        let is_given = u32::MAX - 1;
        given.as_flattened().iter().for_each(|&vertex| number[vertex as usize] = is_given);
        for &vertex in edges.as_flattened() {
            if number[vertex as usize] == u32::MAX {
                number[vertex as usize] = count;
                count += 1;
            }
        }
        let ends = edges.iter().map(|pair| pair.map(|vertex| number[vertex as usize]));
        let mut ends: Vec<_> = ends.collect();
        let whole = Around::new(&ends, count as usize);
        let parted = part(problem, &whole, &mut ends, count);
        ends.as_flattened_mut().iter_mut().for_each(|end| *end = parted.min(*end));
        let around = if parted == count { whole } else { Around::new(&ends, parted as usize) };
        Self { ends, count: parted as usize, around }
    }
}

/// The matrix PᵀKP times `scale`, written with the row sums s_i of K:
/// ```text
///   uᵀKu = Σ s_i u_i² − Σ_{i<j} K_ij (u_i − u_j)²,    u_i − u_j = (v_b − v_c) / 2 on edges i = (a, b), j = (a, c)
/// ```
/// so that two sides of a cell that meet make one entry, and opposite ones of a quad three.
pub(crate) fn galerkin(problem: &Problem, numbering: &Numbering, scale: f64) -> Sparse {
    let Numbering { ends, count, around } = numbering;
    let mut row = Row {
        matrix: Sparse::with_columns(*count),
        sum: RowSum::new(*count),
        count: *count as u32,
        diagonal: 0.0,
    };
    row.matrix.entries.reserve(7 * count);
    for vertex in 0..*count as u32 {
        row.diagonal = 0.0;
        for &edge in around.at(vertex) {
            let edge = edge as usize;
            let [a, b] = ends[edge];
            let other = if a == vertex { b } else { a };
            let mut row_sum = 0.0;
            for (column, value) in problem.contact.row(edge) {
                row_sum += value;
                if column != edge {
                    row.couple([vertex, other], ends[column], 0.25 * scale * value);
                }
            }
            row.diagonal += 0.25 * scale * row_sum;
            row.add(other, 0.25 * scale * row_sum);
        }
        let diagonal = row.diagonal;
        row.add(vertex, diagonal);
        row.matrix.end_row();
    }
    row.matrix
}

/// A row of PᵀKP in the making.
struct Row {
    matrix: Sparse,
    sum: RowSum,
    count: u32,
    diagonal: f64,
}

impl Row {
    fn add(&mut self, column: u32, value: f64) {
        if column < self.count {
            self.sum.add(&mut self.matrix, column, value);
        }
    }

    /// What K_ij/4 = `value` of the edges i, from the row's own vertex to another one, and j adds to the row.
    fn couple(&mut self, [own, other]: [u32; 2], [c, d]: [u32; 2], value: f64) {
        // Vertices that carry 0 share a number. Taking two of them for one changes nothing: both add to the diagonal alone.
        if c == own || d == own {
            return;
        }
        self.diagonal -= value;
        if c == other || d == other {
            self.add(if c == other { d } else { c }, value);
        } else {
            self.add(other, -value);
            self.add(c, value);
            self.add(d, value);
        }
    }
}

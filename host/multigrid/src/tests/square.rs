//! A contact problem on the unit square, cut into triangles, assembled by hand.
//!
//! ```text
//!   u = 0 above, contact below, no flux on the sides;   K_T = |T| Gᵀ A G,   G_k = −2 ∇λ_k,   ∇λ_k = n_k / 2|T|
//! ```

use std::collections::HashMap;

use crate::Problem;
use signorini_reference::Problem as Contact;

/// Data of a square of n × n cells, each cut in two.
pub struct Square {
    pub row_ptr: Vec<u32>,
    pub col_idx: Vec<u32>,
    pub values: Vec<f64>,
    pub load: Vec<f64>,
    pub lower: Vec<f64>,
    pub spans: Vec<f64>,
    pub floating: Vec<bool>,
    pub ends: Vec<[u32; 2]>,
    pub vertices: usize,
}

impl Square {
    /// With A = diag(a, 1) and the load f; where it is not `held`, the side above has no flux either.
    pub fn new(n: u32, a: f64, held: bool, f: impl Fn(f64, f64) -> f64) -> Self {
        Self::with(n, |_, _| [a, 1.0], held, f)
    }

    /// The same with A = diag(a, b) of each cell by its middle.
    pub fn with(
        n: u32,
        tensor: impl Fn(f64, f64) -> [f64; 2],
        held: bool,
        f: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let h = 1.0 / f64::from(n);
        let at = |vertex: u32| [f64::from(vertex % (n + 1)) * h, f64::from(vertex / (n + 1)) * h];
        let corners = |cell: u32| {
            let low = cell / n * (n + 1) + cell % n;
            [[low, low + 1, low + n + 2], [low, low + n + 2, low + n + 1]]
        };
        let triangles: Vec<[u32; 3]> = (0..n * n).flat_map(corners).collect();
        let row_of = |vertex: u32| vertex / (n + 1);
        let kind = |[p, q]: [u32; 2]| match (row_of(p), row_of(q)) {
            (0, 0) => 1,
            (p, q) if held && p == n && q == n => 2,
            _ => 0,
        };
        let sides =
            |[p, q, r]: [u32; 3]| [[q, r], [r, p], [p, q]].map(|[p, q]| [p.min(q), p.max(q)]);
        let mut ends: Vec<[u32; 2]> = triangles.iter().flat_map(|&cell| sides(cell)).collect();
        ends.sort_by_key(|&pair| (kind(pair), pair));
        ends.dedup();
        let [free, contact] =
            [0, 1].map(|of| ends.iter().filter(|&&pair| kind(pair) == of).count());
        let number: HashMap<[u32; 2], usize> = ends.iter().copied().zip(0..).collect();
        let unknowns = free + contact;
        let mut rows = vec![Vec::<(usize, f64)>::new(); unknowns];
        let mut load = vec![0.0; unknowns];
        for &cell in &triangles {
            let edges = sides(cell).map(|pair| number[&pair]);
            let [p, q, r] = cell.map(at);
            let along = [[q, r], [r, p], [p, q]].map(|[a, b]| [b[0] - a[0], b[1] - a[1]]);
            let area = 0.5 * h * h;
            let middle = [0, 1].map(|k| (p[k] + q[k] + r[k]) / 3.0);
            let [a, b] = tensor(middle[0], middle[1]);
            for i in (0..3).filter(|&i| edges[i] < unknowns) {
                load[edges[i]] += area / 3.0 * f(middle[0], middle[1]);
                for j in (0..3).filter(|&j| edges[j] < unknowns) {
                    // The gradient is the side turned by a right angle.
                    let value = a * along[i][1] * along[j][1] + b * along[i][0] * along[j][0];
                    rows[edges[i]].push((edges[j], value / area));
                }
            }
        }
        let mut square = Self {
            row_ptr: vec![0],
            col_idx: Vec::new(),
            values: Vec::new(),
            load,
            lower: vec![0.0; contact],
            spans: Vec::new(),
            floating: vec![!held; contact],
            ends,
            vertices: ((n + 1) * (n + 1)) as usize,
        };
        for (row, entries) in rows.into_iter().enumerate() {
            square.push_row(row, &entries);
        }
        square
    }

    /// Adds up the entries of a row, its own first.
    fn push_row(&mut self, row: usize, entries: &[(usize, f64)]) {
        let mut columns: Vec<usize> = entries.iter().map(|entry| entry.0).collect();
        columns.sort_by_key(|&column| (column != row, column));
        columns.dedup();
        for column in columns {
            let values = entries.iter().filter(|entry| entry.0 == column).map(|entry| entry.1);
            self.col_idx.push(column as u32);
            self.values.push(values.sum());
        }
        self.row_ptr.push(self.values.len() as u32);
    }

    pub fn problem(&self) -> Problem<'_> {
        let Self { row_ptr, col_idx, values, load, lower, spans, floating, .. } = self;
        Problem {
            contact: Contact { row_ptr, col_idx, values, load, lower, spans, floating },
            ends: &self.ends,
            vertices: self.vertices,
            given: [0.0; 2],
            loaded: (0..load.len())
                .map(|at| load[at].abs() / values[row_ptr[at] as usize])
                .fold(0.0, f64::max),
        }
    }

    pub fn free(&self) -> usize {
        self.load.len() - self.lower.len()
    }

    /// K times x.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let problem = self.problem();
        let row =
            |at: usize| problem.contact.row(at).map(|(column, value)| value * x[column]).sum();
        (0..self.load.len()).map(row).collect()
    }

    /// The minimiser by projected relaxation, swept until nothing changes any more.
    pub fn relaxed(&self) -> Vec<f64> {
        let (problem, free) = (self.problem(), self.free());
        let mut u = vec![0.0; self.load.len()];
        for _ in 0..200_000 {
            let mut change = 0.0_f64;
            for at in 0..u.len() {
                let diagonal = problem.diagonal(at);
                let mut next = u[at] + 1.8 * problem.residual(at, &u) / diagonal;
                if let Some(contact) = at.checked_sub(free) {
                    let span = self.spans.get(contact).copied().unwrap_or(f64::INFINITY);
                    let [least, most] =
                        [span.min(0.0), span.max(0.0)].map(|end| next + 1.8 * end / diagonal);
                    next = self.lower[contact].clamp(least, most);
                }
                change = change.max((next - u[at]).abs());
                u[at] = next;
            }
            if change < 1e-15 {
                break;
            }
        }
        u
    }
}

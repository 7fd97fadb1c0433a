//! The complementarity residual of an answer, worked out cell by cell in f64: what a status is checked by.
//!
//! ```text
//!   r_E = Σ_T (K_T u)_E + H_E u_E − b_E,    |r_E|/K_EE,    on C |e − x| with e = u_E − ψ_E, v = e − r_E/K_EE and
//!   x = v + l/K_EE where that is positive, v + h/K_EE where that is negative, else 0
//! ```
//! l ≤ h are the ends of the flux less the one that b contains. Where h = ∞ that is |min(e, (r − l)/K)|.

use signorini_kernel::Error as KernelError;

use signorini_problem::{Assembled, Problem};

/// The residual of the equations.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residual {
    /// The largest violation over max(range of u, max |b_E|/K_EE).
    pub scaled: f64,
    /// ε Σ|terms|/K_EE of the same quotient: what rounding alone leaves.
    pub rounding: f64,
}

/// The residual of edge means `u`.
pub fn residual(problem: &Problem, u: &[f64]) -> Result<Residual, KernelError> {
    let assembled = Assembled::<f64>::new(problem)?;
    let counts = problem.topology.counts;
    let edges = counts.edges();
    let mut sums =
        Sums { product: vec![0.0; edges], terms: vec![0.0; edges], diagonal: vec![0.0; edges] };
    let stiffness = assembled.stiffness();
    for (cell, k) in problem.topology.of_triangles.iter().zip(stiffness.triangles) {
        sums.add(cell, u, &[[0, 1], [1, 2], [2, 0]], k);
    }
    for (cell, k) in problem.topology.of_quads.iter().zip(stiffness.quads) {
        const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        sums.add(cell, u, &PAIRS, k);
    }
    for law in &problem.loads.robin {
        let (edge, h) = (law.edge as usize, law.coefficient);
        sums.product[edge] += h * u[edge];
        sums.terms[edge] += (h * u[edge]).abs();
        sums.diagonal[edge] += h;
    }
    let system = assembled.system()?;
    let (mut largest, mut rounding, mut load) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (edge, b) in system.load().iter().enumerate() {
        let k = sums.diagonal[edge];
        let step = (sums.product[edge] - b) / k;
        let contact = edge.checked_sub(counts.free).map(|at| {
            let ends = ends(problem, at).map(|end| end / k);
            left(u[edge] - problem.loads.gap[at], step, ends)
        });
        let [left, end] = contact.unwrap_or([step, 0.0]);
        largest = largest.max(left.abs());
        let terms = (sums.terms[edge] + b.abs()) / k + end.abs();
        rounding = rounding.max(terms * f64::EPSILON);
        load = load.max(b.abs() / k);
    }
    let all = || u.iter().chain(&problem.loads.gap);
    let range = all().fold(f64::NEG_INFINITY, |most, x| most.max(*x))
        - all().fold(f64::INFINITY, |least, x| least.min(*x));
    let scale = range.max(load).max(f64::MIN_POSITIVE);
    Ok(Residual { scaled: largest / scale, rounding: rounding / scale })
}

/// Both ends of the flux of a contact edge, from the one that the load contains.
pub(super) fn ends(problem: &Problem, contact: usize) -> [f64; 2] {
    let span = problem.loads.law().spans().on(contact).length();
    [span.min(0.0), span.max(0.0)]
}

/// The residual of the law from the opening and a step of u, and the end that it is for.
fn left(opening: f64, step: f64, [least, most]: [f64; 2]) -> [f64; 2] {
    let [above, below] = [least, most].map(|end| opening - step + end);
    match (above > 0.0, below < 0.0) {
        (true, _) => [step - least, least],
        (_, true) => [step - most, most],
        _ => [opening, 0.0],
    }
}

struct Sums {
    product: Vec<f64>,
    terms: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Sums {
    /// Rows of K_T add up to 0: (K_T u)_i = Σ_j K_ij (u_j − u_i).
    fn add(&mut self, cell: &[u32], u: &[f64], pairs: &[[usize; 2]], entries: &[f64]) {
        for (&[i, j], k) in pairs.iter().zip(entries) {
            let [i, j] = [i, j].map(|k| cell[k] as usize);
            let flow = k * (u[j] - u[i]);
            self.product[i] += flow;
            self.product[j] -= flow;
            for edge in [i, j] {
                self.terms[edge] += k.abs() * (u[i].abs() + u[j].abs());
                self.diagonal[edge] -= k;
            }
        }
    }
}

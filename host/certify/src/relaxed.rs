//! A better s where the average of u_h is a poor one: sweeps of Gauss–Seidel over the vertices that are neither on D nor on C, and
//! over the bubbles of free edges between quads.
//!
//! gap² is quadratic in each of these values, and what it loses in a step is known. With φ the function of a vertex, −∇·τ = f̄, and
//! τ·n = g on N,
//! ```text
//!   ½ ∂gap²/∂s = ∫A∇s·∇φ − ∫τ·∇φ + ∫_R (τ·n + h (s − u_ext)) φ
//!              = ∫A∇s·∇φ − ∫f̄ φ − ∫_N g φ + ∫_R h (s − u_ext) φ            =: −r,
//!   s ← s + ω r/k,    gap² ← gap² − ω (2 − ω) r²/k,    k = ∫A∇φ·∇φ + ∫_R h φ²,
//! ```
//! since ∫f̄ φ is an mth of a cell's load at each of its m corners, and a third of it for a bubble: τ cancels. What s follows of ψ and
//! u_D stays what it is and counts in ∇s. In a step of time gap² has ∫(f̄ + ∇·τ − c (s − s_old)/dt)² dt/c too: r gains −∫(s − s_old) φ c/dt, k gains
//! ∫φ² c/dt, and τ cancels again. Any s is admissible, whatever these sums round: the kernel bounds the error of what comes out.

use signorini_bound::certificate::{Certificate, LoadCase, is_clear};
use signorini_kernel::Real;

use super::admissible::{Admissible, Chordal};
use super::conductivity::{Conductivity, apply, dot};
use signorini_problem::cell::{Cell, Jet};
use signorini_problem::pieces::PiecePoint;
use signorini_problem::quadrature::{DATA_POINTS, gauss};
use signorini_problem::scalar::Scalar;
use signorini_problem::{EdgeKind, Problem, State};

/// The part of the bound that a first sweep has to gain, or s stays the average.
const FIRST: f64 = 0.05;
/// The part of gap² that a sweep has to gain for another one.
const NEXT: f64 = 1e-3;
/// Sweeps at most.
const MOST: usize = 100;
/// ω of all sweeps but the first.
const OMEGA: f64 = 1.5;

/// Values of s at the vertices, and its bubbles, with a lower bound; nothing where a first sweep gains too little.
pub(super) fn relaxed<R: Scalar>(
    problem: &Problem,
    given: &LoadCase<R, u32>,
    fields: &Admissible,
    certificate: &Certificate<R>,
) -> Option<[Vec<f64>; 2]> {
    let [gap, oscillation, rounding] =
        [certificate.duality_gap, certificate.oscillation, certificate.rounding].map(R::wide);
    let total =
        |square: f64| (square.max(0.0) + oscillation.powi(2)).sqrt() + oscillation + rounding;
    let (mut sum, mut square) = (Quadratic::new(problem, given, fields), gap * gap);
    let mut lost = sum.sweep(1.0, false);
    let gains = total(square - lost) < (1.0 - FIRST) * total(square);
    if !gains {
        return None;
    }
    for at in 1..MOST {
        square -= lost;
        lost = sum.sweep(OMEGA, at % 2 == 1);
        let goes_on = lost > NEXT * square;
        if !goes_on {
            break;
        }
    }
    let bubbles = sum.values.split_off(fields.vertices.len());
    Some([sum.values, bubbles])
}

/// ½ gap² as a function of s at the vertices, and then of its bubbles, one an edge.
struct Quadratic {
    values: Vec<f64>,
    /// −½ ∂gap²/∂s
    residual: Vec<f64>,
    /// Second derivatives: k of each value, 0 where it stays, and those with its neighbours.
    diagonal: Vec<f64>,
    rows: Vec<Vec<(u32, f64)>>,
}

impl Quadratic {
    fn new<R: Scalar>(problem: &Problem, given: &LoadCase<R, u32>, fields: &Admissible) -> Self {
        let values = [fields.vertices, fields.bubbles].concat();
        let none = vec![0.0; values.len()];
        let mut sum = Self {
            residual: none.clone(),
            diagonal: none,
            rows: vec![Vec::new(); values.len()],
            values,
        };
        let rules = [1, 3, DATA_POINTS].map(gauss);
        (0..problem.cells()).for_each(|at| sum.add_cell(problem, fields, at, &rules));
        for record in &problem.loads.neumann {
            for (place, part) in along(problem, record.edge).into_iter().zip([0.5, 0.5, 2.0 / 3.0])
            {
                sum.residual[place as usize] += part * record.flux;
            }
        }
        sum.add_transfer(problem, given, fields);
        sum.add_extensions(problem, given);
        sum.hold(problem);
        sum
    }

    /// Values that stay: those on D and C, and bubbles beside triangles.
    fn hold(&mut self, problem: &Problem) {
        let triangles = 3 * problem.mesh.triangles.len();
        for (edge, (kind, halves)) in
            problem.kinds.iter().zip(&problem.topology.half_edges).enumerate()
        {
            let [a, b, bubble] = along(problem, edge as u32);
            let is_given = matches!(kind, EdgeKind::Contact | EdgeKind::Dirichlet);
            if is_given {
                [a, b].iter().for_each(|&at| self.diagonal[at as usize] = 0.0);
            }
            if is_given || halves.iter().any(|&half| (half as usize) < triangles) {
                self.diagonal[bubble as usize] = 0.0;
            }
        }
    }

    /// Adds ∫A∇φ·∇φ′, and to r the share of the load less ∫A∇s·∇φ.
    fn add_cell(
        &mut self,
        problem: &Problem,
        fields: &Admissible,
        at: usize,
        [one, three, many]: &[Vec<[f64; 2]>; 3],
    ) {
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
        let stored = stored(problem, fields, at);
        let rule = match cell {
            Cell::Triangle(_) if conductivity.is_constant() && stored.is_none() => one,
            // Exact but on a quad that is no parallelogram: there it is as near to the least gap as s has to be.
            _ if conductivity.is_constant() => three,
            _ => many,
        };
        let (s, places) = (fields.chordal(problem, at), places(problem, at));
        let (corners, count) = (problem.vertices_of(at).len(), places.len());
        let (mut k, mut of_s) = ([[0.0; 8]; 8], [0.0; 8]);
        for PiecePoint { point, below: a, .. } in conductivity.points(&cell, rule) {
            let local = cell.local(point.reference);
            let own = s.at(&local);
            let flux = apply(&a, own.gradient);
            let [k_here, change] = stored
                .as_ref()
                .map_or([0.0; 2], |(k, old)| [*k, k * (own.value - old.at(&local).value)]);
            let bubbles = local.sides.iter().map(|side| side.bubble());
            let mut functions = [Jet::default(); 8];
            let all = local.vertices[..corners].iter().copied().chain(bubbles);
            functions.iter_mut().zip(all).for_each(|(to, of)| *to = of);
            let fluxes = functions.map(|of| apply(&a, of.gradient));
            for i in 0..count {
                let of = functions[i];
                of_s[i] += point.weight * (dot(flux, of.gradient) + change * of.value);
                for j in 0..i + 1 {
                    let with = functions[j];
                    let stiff = dot(of.gradient, fluxes[j]);
                    k[i][j] += point.weight * (stiff + k_here * of.value * with.value);
                }
            }
        }
        let load = problem.loads.of_cell(at);
        for (i, &place) in places.iter().enumerate() {
            let part = if i < corners { load / corners as f64 } else { load / 3.0 };
            self.residual[place as usize] += part - of_s[i];
            (0..i + 1).for_each(|j| self.couple(place, places[j], k[i][j]));
        }
    }

    /// Adds ∫_R h φφ′, and to r ∫_R h (u_ext − s) φ.
    fn add_transfer<R: Scalar>(
        &mut self,
        problem: &Problem,
        given: &LoadCase<R, u32>,
        fields: &Admissible,
    ) {
        for (at, record) in problem.loads.robin.iter().enumerate() {
            let (places, points) = (along(problem, record.edge), given.transfer.get(at));
            let edge = record.edge as usize;
            for (at, &[t, weight]) in f64::GAUSS[DATA_POINTS - 1].iter().enumerate() {
                let functions = [1.0 - t, t, 4.0 * t * (1.0 - t)];
                let [a, b] = problem.ends[edge].map(|end| fields.vertices[end as usize]);
                let own = [a, b, fields.bubbles[edge]].into_iter().zip(functions);
                let s: f64 = own.map(|(value, function)| value * function).sum();
                let [h, passing] = match points {
                    Some(points) => {
                        let [h, ambient] = points[at].map(R::wide);
                        [h, h * (ambient - s)]
                    }
                    None => [record.coefficient, record.ambient - record.coefficient * s],
                };
                for i in 0..3 {
                    self.residual[places[i] as usize] += weight * functions[i] * passing;
                    for j in 0..i + 1 {
                        self.couple(places[i], places[j], weight * functions[i] * functions[j] * h);
                    }
                }
            }
        }
    }

    /// Takes ∫A∇v·∇φ from r, v being what s follows of a curve.
    fn add_extensions<R: Scalar>(&mut self, problem: &Problem, given: &LoadCase<R, u32>) {
        let free = problem.topology.counts.free;
        for curved in given.curved {
            let edge = curved.edge as usize;
            let ends = problem.ends[edge].map(|end| R::narrow(self.values[end as usize]));
            let above = |gap: &[R; 2]| [ends[0] - gap[0], ends[1] - gap[1]];
            let gap = edge.checked_sub(free).and_then(|at| given.ends.gap.get(at));
            if gap.is_some_and(|gap| is_clear(above(gap), curved.peak)) {
                continue;
            }
            let cell = problem.topology.first_side(edge).0;
            for (place, coupling) in places(problem, cell).into_iter().zip(curved.coupling) {
                self.residual[place as usize] -= coupling.wide();
            }
        }
    }

    fn couple(&mut self, one: u32, other: u32, k: f64) {
        if one == other {
            self.diagonal[one as usize] += k;
            return;
        }
        for (one, other) in [(one, other), (other, one)] {
            let row = &mut self.rows[one as usize];
            match row.iter_mut().find(|(at, _)| *at == other) {
                Some((_, entry)) => *entry += k,
                None => row.push((other, k)),
            }
        }
    }

    /// A sweep forth or back: what gap² loses.
    fn sweep(&mut self, omega: f64, is_back: bool) -> f64 {
        let (mut lost, count) = (0.0, self.values.len());
        for at in 0..count {
            let at = if is_back { count - 1 - at } else { at };
            let k = self.diagonal[at];
            if k > 0.0 {
                let r = self.residual[at];
                let step = omega * r / k;
                lost += (2.0 - omega) * r * step;
                self.values[at] += step;
                self.residual[at] -= k * step;
                for &(other, k) in &self.rows[at] {
                    self.residual[other as usize] -= k * step;
                }
            }
        }
        lost
    }
}

/// k of a cell in a step of time, and s_old there; nothing where it stores nothing.
fn stored(problem: &Problem, fields: &Admissible, at: usize) -> Option<(f64, Chordal)> {
    let step = problem.loads.step.as_ref()?;
    let content = Some(step.content(at)).filter(|&content| content > 0.0)?;
    let area: f64 = Cell::of(problem, at).points(&gauss(2)).iter().map(|of| of.weight).sum();
    let State { vertices, bubbles, .. } = &step.begin;
    let old = Admissible { vertices, bubbles, ..*fields };
    Some((content / area, old.chordal(problem, at)))
}

/// The places of the functions of a cell: its vertices and, of a quad, the bubbles of its sides.
fn places(problem: &Problem, at: usize) -> Vec<u32> {
    let bubble = |&edge: &u32| problem.mesh.vertices.len() as u32 + edge;
    let is_quad = at >= problem.mesh.triangles.len();
    let edges = if is_quad { problem.topology.edges_of(at) } else { &[] };
    problem.vertices_of(at).iter().copied().chain(edges.iter().map(bubble)).collect()
}

/// The places of both ends of an edge and of its bubble.
fn along(problem: &Problem, edge: u32) -> [u32; 3] {
    let [a, b] = problem.ends[edge as usize];
    [a, b, problem.mesh.vertices.len() as u32 + edge]
}

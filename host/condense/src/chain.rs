//! Values of s on the boundary: u_D on D, ψ + e on C, with e interpolated from the openings.
//!
//! ```text
//!        v_1      v_2      v_3                 openings, means over contact edges
//!     ●───────●───────●───────●
//!   end      inner   inner    D               vertices
//! ```
//! At an inner vertex e is the linear interpolation between the middles of its two edges, at an end of
//! the chain the extrapolation from the first two; where D begins, s = u_D, and what that lies above ψ
//! is the excess of a corner.

use std::collections::{BTreeMap, BTreeSet};

use super::{Corner, Form, Vertex};
use signorini_certify::TermData;
use signorini_certify::ends::of_moved;
use signorini_problem::Problem;

/// Difference that rounding may leave between two expressions for the same value, relative to the largest.
const ROUNDING: f64 = 1e-9;

/// The boundary values of s.
pub(super) struct Chain {
    /// Contact vertices with their places in e.
    pub contact: Vec<(u32, Vertex)>,
    /// ψ at each of them for each pattern.
    pub gap: Vec<Vec<f64>>,
    /// The vertices that were released, and ψ there for each pattern.
    pub released: Vec<(u32, Vec<f64>)>,
    /// Dirichlet vertices and u_D there for each pattern.
    pub dirichlet: BTreeMap<u32, Vec<f64>>,
    /// Where s is off ψ for good.
    pub corners: Vec<Corner>,
    /// The vertex of each corner.
    met: Vec<u32>,
    /// By how much each pattern is moved at vertices where two expressions for one value differ by rounding.
    pub moved: Vec<BTreeMap<u32, f64>>,
    /// Where s − ψ at both ends of each unknown's edge comes from, as [`super::Form::ends`] has it.
    pub ends: Vec<[usize; 2]>,
}

/// The unknowns of the contact edges at a vertex, with ψ of every pattern there.
type Meeting = BTreeMap<u32, Vec<(usize, Vec<f64>)>>;

/// Whether s follows no curve on an edge with these ends: it is free at both.
pub(super) fn is_left_out(ends: [u32; 2], released: &BTreeSet<u32>) -> bool {
    ends.iter().all(|end| released.contains(end))
}

impl Chain {
    /// `edges` holds the contact edge of each unknown, `openings` d_i, the unit of its opening. At vertices that are `released` s
    /// is as free as inside.
    ///
    /// # Errors
    /// A sentence why s cannot be fixed beforehand.
    pub fn new(
        problem: &Problem,
        patterns: &[TermData],
        edges: &[usize],
        openings: &[f64],
        released: &BTreeSet<u32>,
    ) -> Result<Self, String> {
        let dirichlet = given(problem, patterns);
        let meetings = meetings(problem, patterns, edges);
        let mut chain = Self {
            contact: Vec::new(),
            gap: Vec::new(),
            released: Vec::new(),
            dirichlet,
            corners: Vec::new(),
            met: Vec::new(),
            moved: vec![BTreeMap::new(); patterns.len()],
            ends: Vec::new(),
        };
        for (&vertex, meeting) in &meetings {
            let psi = common_gap(problem, patterns, vertex, meeting)?;
            for (j, moved) in chain.moved.iter_mut().enumerate() {
                let off = meeting.iter().map(|(_, other)| (other[j] - psi[j]).abs());
                moved.insert(vertex, off.fold(0.0, f64::max));
            }
            match chain.dirichlet.get(&vertex) {
                Some(given) => {
                    let excess = excess(patterns, given, &psi);
                    for (j, moved) in chain.moved.iter_mut().enumerate() {
                        let dropped = (given[j] - psi[j]) - excess[j];
                        moved.entry(vertex).and_modify(|most| *most += dropped.abs());
                    }
                    let edges = meeting.iter().filter(|_| excess.iter().any(|&part| part != 0.0));
                    let corners = edges.map(|&(edge, _)| Corner {
                        edge,
                        excess: excess.iter().map(|part| part / openings[edge]).collect(),
                        energy: of_moved(problem, &BTreeMap::from([(vertex, openings[edge])])),
                    });
                    chain.corners.extend(corners);
                    chain.met.resize(chain.corners.len(), vertex);
                }
                None if released.contains(&vertex) => chain.released.push((vertex, psi)),
                None => {
                    let place = place(problem, &meetings, vertex, edges, openings)?;
                    chain.contact.push((vertex, place));
                    chain.gap.push(psi);
                }
            }
        }
        chain.ends = chain.places(problem, edges);
        Ok(chain)
    }

    /// Where s − ψ comes from at the ends of each edge.
    fn places(&self, problem: &Problem, edges: &[usize]) -> Vec<[usize; 2]> {
        let free = problem.topology.counts.free;
        let place = |unknown: usize, vertex: u32| {
            let contact = self.contact.iter().position(|&(of, _)| of == vertex);
            let here = |(of, corner): (&u32, &Corner)| *of == vertex && corner.edge == unknown;
            let corner = self.met.iter().zip(&self.corners).position(here);
            contact.or_else(|| Some(self.contact.len() + corner?)).unwrap_or(Form::NOTHING)
        };
        let of_edge = |(unknown, &edge): (usize, &usize)| {
            problem.ends[free + edge].map(|vertex| place(unknown, vertex))
        };
        edges.iter().enumerate().map(of_edge).collect()
    }

    /// The vertices where s is not free.
    pub fn fixed(&self) -> BTreeSet<u32> {
        self.contact
            .iter()
            .map(|(vertex, _)| *vertex)
            .chain(self.dirichlet.keys().copied())
            .collect()
    }
}

fn given(problem: &Problem, patterns: &[TermData]) -> BTreeMap<u32, Vec<f64>> {
    let first = problem.topology.counts.unknowns();
    let mut given = BTreeMap::new();
    for at in 0..problem.topology.counts.dirichlet {
        for (end, vertex) in problem.ends[first + at].into_iter().enumerate() {
            given.insert(vertex, patterns.iter().map(|p| p.ends.given[at][end]).collect());
        }
    }
    given
}

fn meetings(problem: &Problem, patterns: &[TermData], edges: &[usize]) -> Meeting {
    let free = problem.topology.counts.free;
    let mut meetings = Meeting::new();
    for (at, &edge) in edges.iter().enumerate() {
        for (end, vertex) in problem.ends[free + edge].into_iter().enumerate() {
            let psi = patterns.iter().map(|pattern| pattern.ends.gap[edge][end]).collect();
            meetings.entry(vertex).or_default().push((at, psi));
        }
    }
    meetings
}

/// ψ at a vertex, the same from all its contact edges.
fn common_gap(
    problem: &Problem,
    patterns: &[TermData],
    vertex: u32,
    meeting: &[(usize, Vec<f64>)],
) -> Result<Vec<f64>, String> {
    let [x, y] = problem.mesh.vertices[vertex as usize];
    let Some((_, first)) = meeting.first() else { return Ok(Vec::new()) };
    for (_, other) in meeting {
        let pairs = patterns.iter().zip(first.iter().zip(other));
        if pairs.into_iter().any(|(p, (a, b))| (a - b).abs() > ROUNDING * p.ends.scale()) {
            return Err(format!("the gap has a jump at ({x}, {y})"));
        }
    }
    Ok(first.clone())
}

/// u_D − ψ for each pattern; rounding is 0.
fn excess(patterns: &[TermData], given: &[f64], psi: &[f64]) -> Vec<f64> {
    let difference = |(pattern, (given, psi)): (&TermData, (&f64, &f64))| {
        let excess = given - psi;
        if excess.abs() > ROUNDING * pattern.ends.scale() { excess } else { 0.0 }
    };
    patterns.iter().zip(given.iter().zip(psi)).map(difference).collect()
}

/// Where e comes from at a vertex.
fn place(
    problem: &Problem,
    meetings: &Meeting,
    vertex: u32,
    edges: &[usize],
    openings: &[f64],
) -> Result<Vertex, String> {
    let free = problem.topology.counts.free;
    let length = |at: usize| problem.lengths[free + edges[at]];
    let here: Vec<usize> = meetings[&vertex].iter().map(|&(at, _)| at).collect();
    let (edges, weights, beside) = match here[..] {
        [left, right] => {
            let whole = length(left) + length(right);
            ([left, right], [length(right) / whole, length(left) / whole], [left, right])
        }
        [end] => {
            let next = next_along(problem, meetings, vertex, edges, end);
            let slope = next.map_or(0.0, |next| length(end) / (length(end) + length(next)));
            ([end, next.unwrap_or(end)], [1.0 + slope, -slope], [end; 2])
        }
        _ => {
            let [x, y] = problem.mesh.vertices[vertex as usize];
            return Err(format!("more than two contact edges meet at ({x}, {y})"));
        }
    };
    let weights = [0, 1].map(|k| weights[k] * openings[edges[k]]);
    Ok(Vertex { edges, weights, beside })
}

/// The unknown of the contact edge behind that of `end`, seen from `vertex`.
fn next_along(
    problem: &Problem,
    meetings: &Meeting,
    vertex: u32,
    edges: &[usize],
    end: usize,
) -> Option<usize> {
    let ends = problem.ends[problem.topology.counts.free + edges[end]];
    let far = ends.into_iter().find(|&other| other != vertex)?;
    let mut unknowns = meetings.get(&far)?.iter().map(|&(at, _)| at);
    unknowns.find(|&at| at != end)
}

//! Values of s on the boundary: u_D on D, ψ + e on C, with e interpolated from the openings.
//!
//! ```text
//!        v_1      v_2      v_3                 openings, means over contact edges
//!     ●───────●───────●───────●
//!   end      inner   inner    D               vertices
//! ```
//! At an inner vertex e is the linear interpolation between the middles of its two edges, at an end of
//! the chain the extrapolation from the first two; where D begins, s = u_D, and what that lies above ψ
//! is the excess of a corner. Where the gaps of two boundaries differ s starts from a value that meets both ([`super::levels`]),
//! the vertex is an end of the first edge whose ψ that is, and the other edge has a corner. With limits, which
//! know one place for each end of an edge, s has that value for good.

use std::collections::{BTreeMap, BTreeSet};

use super::levels::{level, ranges};
use super::{Corner, Form, Pieces, Vertex};
use signorini_certify::TermData;
use signorini_certify::ends::of_moved;
use signorini_problem::Problem;

/// The boundary values of s.
pub(super) struct Chain {
    /// Contact vertices with their places in e.
    pub contact: Vec<(u32, Vertex)>,
    /// ψ at each of them for each pattern.
    pub gap: Vec<Vec<f64>>,
    /// The vertices that were released, and ψ there for each pattern.
    pub released: Vec<(u32, Vec<f64>)>,
    /// Vertices where s is given, and its value there for each pattern: u_D on D.
    pub given: BTreeMap<u32, Vec<f64>>,
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
    /// Of data whose unknowns have their openings in these units d_i. At vertices that are `released` s is as free as inside, and so it is
    /// between edges that are settled as open.
    ///
    /// # Errors
    /// A sentence why s cannot be fixed beforehand.
    pub fn new(
        pieces: &Pieces,
        openings: &[f64],
        released: &BTreeSet<u32>,
    ) -> Result<Self, String> {
        let Pieces { problem, patterns, edges, settled, .. } = pieces;
        let mut given = given(problem, patterns);
        for &edge in &settled.touching {
            let vertices = problem.ends[problem.topology.counts.free + edge].into_iter();
            for (end, vertex) in vertices.enumerate() {
                let psi = || patterns.iter().map(|pattern| pattern.ends.gap[edge][end]).collect();
                given.entry(vertex).or_insert_with(psi);
            }
        }
        let meetings = meetings(problem, patterns, edges);
        let (ranges, is_limited) =
            (ranges(problem, patterns.len()), !problem.loads.spans.is_empty());
        let mut chain = Self {
            contact: Vec::new(),
            gap: Vec::new(),
            released: Vec::new(),
            given,
            corners: Vec::new(),
            met: Vec::new(),
            moved: vec![BTreeMap::new(); patterns.len()],
            ends: Vec::new(),
        };
        for (&vertex, meeting) in &meetings {
            let start = match chain.given.get(&vertex) {
                Some(given) => given.clone(),
                None => common_gap(problem, patterns, vertex, (meeting, edges), &ranges)?,
            };
            let is_free = !chain.given.contains_key(&vertex) && released.contains(&vertex);
            let corners = chain.corners.len();
            for (edge, psi) in meeting {
                let excess = excess(patterns, &start, psi);
                for (j, moved) in chain.moved.iter_mut().enumerate() {
                    let dropped = ((start[j] - psi[j]) - excess[j]).abs();
                    let most = moved.entry(vertex).or_insert(0.0);
                    *most = most.max(dropped);
                }
                if !is_free && excess.iter().any(|&part| part != 0.0) {
                    let opening = openings[*edge];
                    chain.corners.push(Corner {
                        edge: *edge,
                        excess: excess.iter().map(|part| part / opening).collect(),
                        energy: of_moved(problem, &BTreeMap::from([(vertex, opening)])),
                    });
                }
            }
            chain.met.resize(chain.corners.len(), vertex);
            let differ = chain.corners.len() > corners;
            if is_free {
                chain.released.push((vertex, start));
            } else if differ && is_limited {
                chain.given.entry(vertex).or_insert(start);
            } else if !chain.given.contains_key(&vertex) {
                let own = meeting.iter().position(|(_, psi)| differ && *psi == start);
                let own = own.or(differ.then_some(0));
                let place = place(problem, &meetings, vertex, (edges, openings), own)?;
                chain.contact.push((vertex, place));
                chain.gap.push(start);
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
        self.contact.iter().map(|(vertex, _)| *vertex).chain(self.given.keys().copied()).collect()
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

/// ψ at a vertex, the same from all its contact edges but for rounding; else the value that meets all of them.
fn common_gap(
    problem: &Problem,
    patterns: &[TermData],
    vertex: u32,
    (meeting, edges): (&[(usize, Vec<f64>)], &[usize]),
    ranges: &[[f64; 2]],
) -> Result<Vec<f64>, String> {
    let Some((_, first)) = meeting.first() else { return Ok(Vec::new()) };
    let is_same = |psi: &[f64]| excess(patterns, psi, first).iter().all(|&part| part == 0.0);
    if meeting.iter().all(|(_, psi)| is_same(psi)) {
        return Ok(first.clone());
    }
    let free = problem.topology.counts.free;
    let gaps = meeting.iter().map(|(at, psi)| (problem.asks(free + edges[*at]), &psi[..]));
    level(gaps, ranges).map_err(|_| {
        let [x, y] = problem.mesh.vertices[vertex as usize];
        format!(
            "the gaps of the contact boundaries that meet at ({x}, {y}) differ by what an input without a range changes: \
             which is the larger one is not known beforehand"
        )
    })
}

/// s − ψ for each pattern; rounding is 0.
fn excess(patterns: &[TermData], given: &[f64], psi: &[f64]) -> Vec<f64> {
    let difference = |(pattern, (given, psi)): (&TermData, (&f64, &f64))| {
        let excess = given - psi;
        if excess.abs() > pattern.ends.slack(&pattern.problem) { excess } else { 0.0 }
    };
    patterns.iter().zip(given.iter().zip(psi)).map(difference).collect()
}

/// Where e comes from at a vertex: of two edges with one ψ from both, else from the side of the one of number `own`.
fn place(
    problem: &Problem,
    meetings: &Meeting,
    vertex: u32,
    (edges, openings): (&[usize], &[f64]),
    own: Option<usize>,
) -> Result<Vertex, String> {
    let free = problem.topology.counts.free;
    let length = |at: usize| problem.lengths[free + edges[at]];
    let here: Vec<usize> = meetings[&vertex].iter().map(|&(at, _)| at).collect();
    let from = |end: usize, beside: [usize; 2]| {
        let next = next_along(problem, meetings, vertex, edges, end);
        let slope = next.map_or(0.0, |next| length(end) / (length(end) + length(next)));
        ([end, next.unwrap_or(end)], [1.0 + slope, -slope], beside)
    };
    let (edges, weights, beside) = match (&here[..], own) {
        (&[left, right], None) => {
            let whole = length(left) + length(right);
            ([left, right], [length(right) / whole, length(left) / whole], [left, right])
        }
        (&[left, right], Some(own)) => from(here[own], [left, right]),
        (&[end], _) => from(end, [end; 2]),
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
    // Beyond a vertex where gaps differ s − ψ is another function.
    let there = meetings.get(&far)?;
    let (_, psi) = there.iter().find(|(at, _)| *at == end)?;
    there.iter().find(|(at, other)| *at != end && other == psi).map(|&(at, _)| at)
}

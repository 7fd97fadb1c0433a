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

use super::block::{Block, Functions};
use super::levels::{level, ranges};
use super::{Corner, Form, Pieces, Vertex};
use signorini_certify::TermData;
use signorini_certify::ends::of_moved;
use signorini_problem::Problem;

/// The boundary values of s.
#[derive(Default)]
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

/// The contact edges, in the order of their unknowns.
struct Edges<'e> {
    pieces: &'e Pieces<'e>,
    openings: &'e [f64],
    /// The unknowns at each vertex, with ψ of every pattern there.
    meetings: BTreeMap<u32, Vec<(usize, Vec<f64>)>>,
}

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
        let Pieces { problem, patterns, settled, .. } = pieces;
        let mut given = given(problem, patterns);
        for &edge in &settled.touching {
            let vertices = problem.ends[problem.topology.counts.free + edge].into_iter();
            for (end, vertex) in vertices.enumerate() {
                let psi = || patterns.iter().map(|pattern| pattern.ends.gap[edge][end]).collect();
                given.entry(vertex).or_insert_with(psi);
            }
        }
        let all = Edges::new(pieces, openings);
        let (ranges, is_limited) =
            (ranges(problem, patterns.len()), !problem.loads.spans.is_empty());
        let moved = vec![BTreeMap::new(); patterns.len()];
        let mut chain = Self { given, moved, ..Self::default() };
        for (&vertex, meeting) in &all.meetings {
            let start = match chain.given.get(&vertex) {
                Some(given) => given.clone(),
                None => all.common_gap(vertex, &ranges)?,
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
                chain.contact.push((vertex, all.place(vertex, own)?));
                chain.gap.push(start);
            }
        }
        chain.ends = chain.places(&all);
        Ok(chain)
    }

    /// Where s − ψ comes from at the ends of each edge.
    fn places(&self, edges: &Edges) -> Vec<[usize; 2]> {
        let place = |unknown: usize, vertex: u32| {
            let contact = self.contact.iter().position(|&(of, _)| of == vertex);
            let here = |(of, corner): (&u32, &Corner)| *of == vertex && corner.edge == unknown;
            let corner = self.met.iter().zip(&self.corners).position(here);
            contact.or_else(|| Some(self.contact.len() + corner?)).unwrap_or(Form::NOTHING)
        };
        let of_edge = |unknown| edges.ends(unknown).map(|vertex| place(unknown, vertex));
        (0..edges.openings.len()).map(of_edge).collect()
    }

    /// Which functions of s are not free, of those that these rows are over; a vertex of no cell has no value.
    pub fn fixed(&self, functions: &Functions, blocks: &[Block]) -> Vec<bool> {
        let mut fixed = vec![true; functions.count()];
        let used = blocks.iter().flat_map(|block| &block.functions);
        used.for_each(|&function| fixed[function as usize] = false);
        let known = self.contact.iter().map(|(vertex, _)| vertex).chain(self.given.keys());
        known.for_each(|&vertex| fixed[vertex as usize] = true);
        fixed
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

impl<'e> Edges<'e> {
    fn new(pieces: &'e Pieces<'e>, openings: &'e [f64]) -> Self {
        let mut all = Self { pieces, openings, meetings: BTreeMap::new() };
        for (at, &edge) in pieces.edges.iter().enumerate() {
            for (end, vertex) in all.ends(at).into_iter().enumerate() {
                let psi = pieces.patterns.iter().map(|pattern| pattern.ends.gap[edge][end]);
                all.meetings.entry(vertex).or_default().push((at, psi.collect()));
            }
        }
        all
    }

    /// The number of an edge of the mesh.
    fn edge(&self, unknown: usize) -> usize {
        self.pieces.problem.topology.counts.free + self.pieces.edges[unknown]
    }

    fn ends(&self, unknown: usize) -> [u32; 2] {
        self.pieces.problem.ends[self.edge(unknown)]
    }

    /// ψ at a vertex, the same from all its contact edges but for rounding; else the value that meets all of them.
    fn common_gap(&self, vertex: u32, ranges: &[[f64; 2]]) -> Result<Vec<f64>, String> {
        let (Pieces { problem, patterns, .. }, meeting) = (self.pieces, &self.meetings[&vertex]);
        let Some((_, first)) = meeting.first() else { return Ok(Vec::new()) };
        let is_same = |psi: &[f64]| excess(patterns, psi, first).iter().all(|&part| part == 0.0);
        if meeting.iter().all(|(_, psi)| is_same(psi)) {
            return Ok(first.clone());
        }
        let gaps = meeting.iter().map(|(at, psi)| (problem.asks(self.edge(*at)), &psi[..]));
        level(gaps, ranges).map_err(|_| {
            let [x, y] = problem.mesh.vertices[vertex as usize];
            format!(
                "the gaps of the contact boundaries that meet at ({x}, {y}) differ by what an input without a range changes: \
                 which is the larger one is not known beforehand"
            )
        })
    }

    /// Where e comes from at a vertex: of two edges with one ψ from both, else from the side of the one of number `own`.
    fn place(&self, vertex: u32, own: Option<usize>) -> Result<Vertex, String> {
        let problem = self.pieces.problem;
        let length = |at: usize| problem.lengths[self.edge(at)];
        let here: Vec<usize> = self.meetings[&vertex].iter().map(|&(at, _)| at).collect();
        let from = |end: usize, beside: [usize; 2]| {
            let next = self.next_along(vertex, end);
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
        let weights = [0, 1].map(|k| weights[k] * self.openings[edges[k]]);
        Ok(Vertex { edges, weights, beside })
    }

    /// The unknown of the contact edge behind that of `end`, seen from `vertex`.
    fn next_along(&self, vertex: u32, end: usize) -> Option<usize> {
        let far = self.ends(end).into_iter().find(|&other| other != vertex)?;
        // Beyond a vertex where gaps differ s − ψ is another function.
        let there = self.meetings.get(&far)?;
        let (_, psi) = there.iter().find(|(at, _)| *at == end)?;
        there.iter().find(|(at, other)| *at != end && other == psi).map(|&(at, _)| at)
    }
}

/// s − ψ for each pattern; rounding is 0.
fn excess(patterns: &[TermData], given: &[f64], psi: &[f64]) -> Vec<f64> {
    let difference = |(pattern, (given, psi)): (&TermData, (&f64, &f64))| {
        let excess = given - psi;
        if excess.abs() > pattern.ends.slack(&pattern.problem) { excess } else { 0.0 }
    };
    patterns.iter().zip(given.iter().zip(psi)).map(difference).collect()
}

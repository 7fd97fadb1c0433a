//! Vertices at which edges are hardly coupled: each group of them has a vertex of its own.
//!
//! ```text
//!     stiff │ soft         u_h is nearly constant in each stiff sector. The two may differ, as no edge is in both. A function
//!     ──────v──────        with one value at v is far from that, and conjugate gradients take many steps for each such v:
//!      soft │ stiff        in the matrix of the vertices it is two.
//! ```
//! Slender cells among others do the same as different materials. Edges i and j at v are in one sector where they are sides of a
//! cell and
//! ```text
//!   K_ij² > θ K_ii K_jj
//! ```
//! or where that holds for both with another side of their cell. Edges inside a soft sector then join the stiffest one that they
//! are coupled to.

use crate::Problem;
use crate::around::Around;

/// θ
const TOGETHER: f64 = 0.01;
/// A sector joins another one that is so many times as stiff, where its coupling is more than θ of its own diagonal.
const STIFFER: f64 = 10.0;

/// Vertices with more edges stay whole: the work grows with the cube of their number.
const MOST_EDGES: usize = 100;

/// Gives each stiff sector at a vertex a number of its own, from `vertices` on; `ends` are the numbers of the vertices of the edges,
/// `around` the edges at each. How many there are then.
pub(crate) fn part(
    problem: &Problem,
    around: &Around,
    ends: &mut [[u32; 2]],
    vertices: u32,
) -> u32 {
    let mut count = vertices;
    let diagonal: Vec<f64> = (0..ends.len()).map(|edge| problem.diagonal(edge)).collect();
    let alike: Vec<bool> = (0..ends.len()).map(|edge| is_alike(problem, &diagonal, edge)).collect();
    for vertex in 0..vertices {
        let edges = around.at(vertex);
        if edges.len() > MOST_EDGES || edges.iter().all(|&edge| alike[edge as usize]) {
            continue;
        }
        let edges: Vec<usize> = edges.iter().map(|&edge| edge as usize).collect();
        let sectors = Fan { problem, edges: &edges }.sectors();
        let mut numbered = vec![(sectors[0], vertex)];
        for (&edge, &sector) in edges.iter().zip(&sectors) {
            let known = numbered.iter().find(|of| of.0 == sector).map(|of| of.1);
            let number = known.unwrap_or_else(|| {
                numbered.push((sector, count));
                count += 1;
                count - 1
            });
            ends[edge].iter_mut().filter(|end| **end == vertex).for_each(|end| *end = number);
        }
    }
    count
}

/// Whether the diagonal entries of all sides of an edge's cells are near its own.
fn is_alike(problem: &Problem, diagonal: &[f64], edge: usize) -> bool {
    let own = diagonal[edge];
    problem.contact.row(edge).all(|(side, _)| {
        let other = diagonal[side];
        own.min(other) > TOGETHER * own.max(other)
    })
}

/// The edges at a vertex.
struct Fan<'a> {
    problem: &'a Problem<'a>,
    edges: &'a [usize],
}

/// How two edges of a fan are coupled, directly or by a side between them.
struct Link {
    ends: [usize; 2],
    /// K_ij²/(K_ii K_jj)
    both: f64,
    /// |K_ij|/K_ii
    own: f64,
}

impl Fan<'_> {
    /// A name for the sector of each edge.
    fn sectors(&self) -> Vec<usize> {
        let links: Vec<Link> = (0..self.edges.len()).flat_map(|at| self.links(at)).collect();
        let mut of: Vec<usize> = (0..self.edges.len()).collect();
        for link in links.iter().filter(|link| link.both > TOGETHER) {
            join(&mut of, link.ends);
        }
        while let Some(ends) = self.stiffer(&of, &links) {
            join(&mut of, ends);
        }
        of
    }

    /// Two edges whose sectors are coupled, the second of which is the stiffest that a softer one may join.
    fn stiffer(&self, of: &[usize], links: &[Link]) -> Option<[usize; 2]> {
        let stiffness = |at: usize| {
            let own = self.edges.iter().zip(of).filter(|&(_, &sector)| sector == of[at]);
            own.map(|(&edge, _)| self.problem.diagonal(edge)).fold(0.0, f64::max)
        };
        let soft = links.iter().filter(|link| {
            let [a, b] = link.ends;
            link.own > TOGETHER && of[a] != of[b] && STIFFER * stiffness(a) < stiffness(b)
        });
        let stiffest = soft.max_by(|a, b| stiffness(a.ends[1]).total_cmp(&stiffness(b.ends[1])));
        stiffest.map(|link| link.ends)
    }

    /// The couplings of an edge.
    fn links(&self, at: usize) -> Vec<Link> {
        let mut links = Vec::new();
        for side in self.couplings(self.edges[at]) {
            match self.place(side.0) {
                Some(other) => links.push(Link { ends: [at, other], both: side.1, own: side.2 }),
                None => {
                    let beyond = self.couplings(side.0);
                    let ends = beyond.filter_map(|next| Some((self.place(next.0)?, next)));
                    links.extend(ends.filter(|&(other, _)| other != at).map(|(other, next)| {
                        Link {
                            ends: [at, other],
                            both: side.1.min(next.1),
                            own: side.2.min(next.2),
                        }
                    }));
                }
            }
        }
        links
    }

    /// The place of an edge in the fan.
    fn place(&self, edge: usize) -> Option<usize> {
        self.edges.iter().position(|&own| own == edge)
    }

    /// For each other side j of the cells of edge i: j, K_ij²/(K_ii K_jj), |K_ij|/K_ii.
    fn couplings(&self, i: usize) -> impl Iterator<Item = (usize, f64, f64)> {
        let own = self.problem.diagonal(i);
        let row = self.problem.contact.row(i).filter(move |&(j, _)| j != i);
        row.map(move |(j, value)| {
            (j, value * value / (own * self.problem.diagonal(j)), value.abs() / own)
        })
    }
}

/// Makes one sector of those of two edges.
fn join(of: &mut [usize], [from, to]: [usize; 2]) {
    let (from, to) = (of[from], of[to]);
    of.iter_mut().filter(|sector| **sector == from).for_each(|sector| *sector = to);
}

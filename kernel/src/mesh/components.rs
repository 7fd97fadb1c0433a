//! Connected parts of the domain, and whether each has a solution.
//!
//! A part with a Dirichlet edge always has one, and so has a part where K has more on its diagonal than element matrices
//! ([`crate::mesh::diagonal`]): one with a Robin edge. A part held by contact alone needs loads that push it on:
//! ∫f + ∫g + ∫q < 0 (= 0: not unique, > 0: none). A part held by nothing needs loads in balance, and its solution is
//! determined up to a constant.
//!
//! Where the fluxes of a part's contact edges have two ends, those of all of them together must be able to balance the loads:
//! the sum of b at one end < 0 < that at the other.

use crate::Real;
use crate::error::{Array, Error, same_length};
use crate::flux_range::Spans;
use crate::index::{Index, read};
use crate::mesh::diagonal::DiagonalTerms;
use crate::mesh::edges::{Block, Edges};

/// Support of a connected part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Support {
    /// Nothing: the solution is determined up to a constant.
    #[default]
    None,
    /// Contact edges only: semi-coercive, the loads must push it on.
    Contact,
    /// A Dirichlet edge, or a term on the diagonal: a Robin edge.
    Held,
}

/// Scratch and result, one a cell.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Part<R, I> {
    /// A cell of the same part; after [`examine`] the same one for the whole part.
    pub root: I,
    /// Support of the part (valid at its root).
    pub support: Support,
    balance: R,
    magnitude: R,
}

/// How many connected parts of each kind there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PartCounts {
    /// With a Dirichlet edge or a term on the diagonal.
    pub held: u32,
    /// With contact edges alone.
    pub contact: u32,
    /// Held by nothing.
    pub floating: u32,
}

/// Finds the connected parts and checks that each has a solution.
///
/// `diagonal` is what K has on its diagonal beyond the element matrices, `load` is the assembled b with the `spans` of contact that go with it, `parts` has one entry a
/// cell. Loads count as balanced when their sum is below `slack` times the sum of their sizes: what quadrature and rounding
/// left in them.
///
/// # Errors
/// [`Error::NoSolution`] and [`Error::NotUnique`] name a cell of the part; slices of the wrong
/// length.
pub fn examine<R: Real, I: Index>(
    edges: &Edges<I>,
    diagonal: DiagonalTerms<R, I>,
    (load, spans): (&[R], Spans<R>),
    slack: R,
    parts: &mut [Part<R, I>],
) -> Result<PartCounts, Error> {
    let cells = edges.of_triangles().len() + edges.of_quads().len();
    same_length(Array::Scratch, parts.len(), cells)?;
    same_length(Array::Load, load.len(), edges.counts().unknowns())?;
    join(edges, parts);
    for edge in 0..edges.counts().edges() {
        let support = match edges.counts().block(edge) {
            Block::Dirichlet => Support::Held,
            Block::Contact => Support::Contact,
            Block::Free => Support::None,
        };
        hold(edges, parts, edge, support, read(load, edge));
    }
    diagonal.holding().for_each(|edge| hold(edges, parts, edge, Support::Held, R::ZERO));
    if spans.are_limited() {
        limit(edges, spans, slack, parts)?;
    }
    judge(parts, slack)
}

/// Puts the balance of parts that contact alone holds at the lower end of their fluxes, and refuses what exceeds the upper one.
fn limit<R: Real, I: Index>(
    edges: &Edges<I>,
    spans: Spans<R>,
    slack: R,
    parts: &mut [Part<R, I>],
) -> Result<(), Error> {
    spans.check_length(edges.counts().contact)?;
    let root_of = |parts: &[Part<R, I>], at: usize| {
        let edge = edges.counts().free + at;
        read(parts, cell(edges, read(edges.half_edges(), edge)[0]).at()).root.at()
    };
    for of in 0..parts.len() {
        let Some(part) = parts.get(of).copied() else { break };
        if part.root.at() != of || part.support != Support::Contact {
            continue;
        }
        let (mut least, mut most, mut size) = (part.balance, part.balance, part.magnitude);
        let own = (0..edges.counts().contact).filter(|&at| root_of(parts, at) == of);
        for [down, up] in own.map(|at| spans.on(at).ends()) {
            (least, most) = (least + down, most + up);
            size += if up.finite() { up } else { R::ZERO };
        }
        if most.magnitude() <= slack * size {
            return Err(Error::NotUnique { cell: of });
        }
        if !(most > R::ZERO) {
            return Err(Error::NoSolution { cell: of });
        }
        if let Some(part) = parts.get_mut(of) {
            (part.balance, part.magnitude) = (least, size);
        }
    }
    Ok(())
}

/// Union–find over interior edges, with the path to the root halved on the way.
fn join<R: Real, I: Index>(edges: &Edges<I>, parts: &mut [Part<R, I>]) {
    for (at, part) in parts.iter_mut().enumerate() {
        *part = Part { root: I::new(at).unwrap_or(I::NONE), ..Part::default() };
    }
    for pair in edges.half_edges().iter().filter(|pair| pair[1] != I::NONE) {
        let [a, b] = pair.map(|half| root(parts, cell(edges, half)));
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        if let Some(part) = parts.get_mut(high.at()) {
            part.root = low;
        }
    }
    for at in 0..parts.len() {
        let own = root(parts, I::new(at).unwrap_or(I::NONE));
        if let Some(part) = parts.get_mut(at) {
            part.root = own;
        }
    }
}

fn cell<I: Index>(edges: &Edges<I>, half: I) -> I {
    let at = match edges.side(half.at()) {
        crate::mesh::edges::Side::Triangle(at, _) => at,
        crate::mesh::edges::Side::Quad(at, _) => edges.of_triangles().len() + at,
    };
    I::new(at).unwrap_or(I::NONE)
}

fn root<R: Real, I: Index>(parts: &mut [Part<R, I>], mut at: I) -> I {
    loop {
        let above = read(parts, at.at()).root;
        if above == at || at == I::NONE {
            return at;
        }
        let next = read(parts, above.at()).root;
        if let Some(part) = parts.get_mut(at.at()) {
            part.root = next;
        }
        at = next;
    }
}

fn hold<R: Real, I: Index>(
    edges: &Edges<I>,
    parts: &mut [Part<R, I>],
    edge: usize,
    support: Support,
    load: R,
) {
    let first = cell(edges, read(edges.half_edges(), edge)[0]);
    let root = read(parts, first.at()).root;
    if let Some(part) = parts.get_mut(root.at()) {
        part.support = part.support.max(support);
        part.balance += load;
        part.magnitude += load.magnitude();
    }
}

fn judge<R: Real, I: Index>(parts: &[Part<R, I>], slack: R) -> Result<PartCounts, Error> {
    let mut counts = PartCounts::default();
    let roots = parts.iter().enumerate().filter(|(at, part)| part.root.at() == *at);
    for (cell, part) in roots {
        let balanced = part.balance.magnitude() <= slack * part.magnitude;
        match part.support {
            Support::Held => counts.held += 1,
            Support::Contact if balanced => return Err(Error::NotUnique { cell }),
            Support::Contact if part.balance < R::ZERO => counts.contact += 1,
            Support::None if balanced => counts.floating += 1,
            Support::Contact | Support::None => return Err(Error::NoSolution { cell }),
        }
    }
    Ok(counts)
}

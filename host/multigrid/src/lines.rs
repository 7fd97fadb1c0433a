//! Lines of strongly coupled edges, which are relaxed at once.
//!
//! ```text
//!     ╱│╱│╱│╱│        In slender cells, and where A has a direction, an edge follows two others and hardly the rest. What is smooth
//!     ─┴─┴─┴─┴─       along such a line and not across it is smoothed by no edge alone, and no vertices tell lines apart:
//!     ╱│╱│╱│╱│        v = +1, −1, +1 … on the rows of vertices has mean 0 on each line.
//! ```
//! The next edge of a line is the one that is coupled most, where
//! ```text
//!   K_ij² > θ K_ii K_jj
//! ```
//! It has no other coupling with the line. So K on a line is tridiagonal, and relaxing lines in the place of edges stays symmetric
//! and positive.

use std::collections::VecDeque;
use std::ops::Range;

use crate::Problem;

/// θ. Cells of one shape in an isotropic material stay below: 1/16 where angles are equal, 1/8 where one is right.
const STRONG: f64 = 0.2;
/// No line yet.
const NONE: u32 = u32::MAX;

/// An order of the unknowns in which lines stand together. Contact edges stay in their places and are in no line.
pub(crate) struct Lines {
    /// The unknown at each place.
    pub order: Vec<u32>,
    /// The places of each line of two edges or more.
    pub lines: Vec<Range<usize>>,
}

impl Lines {
    pub fn of(problem: &Problem) -> Self {
        let (n, free) = (problem.unknowns(), problem.contact.free());
        let mut search = Search { problem, of: vec![NONE; n] };
        let (mut order, mut lines) = (Vec::with_capacity(n), Vec::new());
        for first in 0..free {
            if search.of[first] != NONE {
                continue;
            }
            let start = order.len();
            order.extend(search.line(first));
            if order.len() > start + 1 {
                lines.push(start..order.len());
            }
        }
        order.extend(free as u32..n as u32);
        Self { order, lines }
    }
}

/// The line of each edge, as far as it is known, by the edge that it was begun from.
struct Search<'a> {
    problem: &'a Problem<'a>,
    of: Vec<u32>,
}

impl Search<'_> {
    /// The line through an edge, as far as it goes both ways.
    fn line(&mut self, first: usize) -> VecDeque<u32> {
        let number = first as u32;
        let mut line = VecDeque::from([number]);
        self.of[first] = number;
        let mut end = number;
        while let Some(next) = self.next(end, number) {
            line.push_back(next);
            end = next;
        }
        end = number;
        while let Some(next) = self.next(end, number) {
            line.push_front(next);
            end = next;
        }
        line
    }

    /// Takes the next edge into the line that ends at edge `end`.
    fn next(&mut self, end: u32, number: u32) -> Option<u32> {
        let end = end as usize;
        let Self { problem, of } = self;
        let is_free = |at: usize| at < problem.contact.free() && of[at] == NONE;
        let ends_nowhere_else =
            |at: usize| problem.contact.row(at).all(|(side, _)| side == end || of[side] != number);
        let strong = problem.contact.row(end).filter_map(|(at, value)| {
            let coupling = value * value / problem.diagonal(at);
            let is_strong = coupling > STRONG * problem.diagonal(end);
            (is_strong && is_free(at) && ends_nowhere_else(at)).then_some((at, coupling))
        });
        let (next, _) = strong.max_by(|a, b| a.1.total_cmp(&b.1))?;
        self.of[next] = number;
        Some(next as u32)
    }
}

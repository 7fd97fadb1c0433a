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
            match search.line(first as u32) {
                Some(line) => {
                    order.extend(line);
                    lines.push(start..order.len());
                }
                None => order.push(first as u32),
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
    /// The line through an edge, as far as it goes both ways; nothing where no edge follows it.
    fn line(&mut self, first: u32) -> Option<VecDeque<u32>> {
        self.of[first as usize] = first;
        let second = self.next(first, first)?;
        let mut line = VecDeque::from([first, second]);
        while let Some(next) = self.next(line[line.len() - 1], first) {
            line.push_back(next);
        }
        while let Some(next) = self.next(line[0], first) {
            line.push_front(next);
        }
        Some(line)
    }

    /// Takes the next edge into the line that ends at edge `end`.
    fn next(&mut self, end: u32, line: u32) -> Option<u32> {
        let (Self { problem, of }, end) = (self, end as usize);
        let threshold = STRONG * problem.diagonal(end);
        let is_free = |at: usize| at < problem.contact.free() && of[at] == NONE;
        let ends_nowhere_else =
            |at: usize| problem.contact.row(at).all(|(side, _)| side == end || of[side] != line);
        let strong = problem.contact.row(end).filter_map(|(at, value)| {
            let (square, own) = (value * value, problem.diagonal(at));
            let is_strong = square > threshold * own;
            (is_strong && is_free(at) && ends_nowhere_else(at)).then_some((at, square / own))
        });
        let (next, _) = strong.max_by(|a, b| a.1.total_cmp(&b.1))?;
        of[next] = line;
        Some(next as u32)
    }
}

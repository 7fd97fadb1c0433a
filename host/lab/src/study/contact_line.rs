//! The contact boundary as one line: its edges in the order in which one walks along them.

use std::collections::HashMap;

use signorini_problem::Problem;

/// A contact edge on the line.
#[derive(Debug, Clone, Copy)]
pub struct LineEdge {
    /// Its position among the contact edges.
    pub contact: usize,
    /// Whether it is walked against its direction.
    pub reversed: bool,
    /// Arc length where it begins.
    pub start: f64,
}

/// Orders the contact edges by arc length; separate pieces of the boundary follow one another.
pub fn walk(problem: &Problem) -> Vec<LineEdge> {
    let counts = problem.topology.counts;
    let ends = |contact: usize| problem.ends[counts.free + contact];
    let mut at_vertex: HashMap<u32, Vec<usize>> = HashMap::new();
    for contact in 0..counts.contact {
        ends(contact).iter().for_each(|&v| at_vertex.entry(v).or_default().push(contact));
    }
    // Pieces with two ends are begun at the end from which the domain lies on the left.
    let is_end = |contact: &usize| at_vertex[&ends(*contact)[0]].len() == 1;
    let all = 0..counts.contact;
    let starts = all.clone().filter(is_end).chain(all);
    let mut used = vec![false; counts.contact];
    let mut line = Vec::new();
    let mut length = 0.0;
    for first in starts {
        let mut from = ends(first)[0];
        let mut next = Some(first).filter(|&first| !used[first]);
        while let Some(contact) = next {
            used[contact] = true;
            let reversed = ends(contact)[0] != from;
            line.push(LineEdge { contact, reversed, start: length });
            length += problem.lengths[counts.free + contact];
            from = ends(contact)[usize::from(!reversed)];
            next = at_vertex[&from].iter().copied().find(|&other| !used[other]);
        }
    }
    line
}

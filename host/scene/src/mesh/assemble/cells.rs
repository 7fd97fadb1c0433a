//! The cells among the elements: corners resolved, from the tag of a node to its place in the file, and each cell once.

use super::draft::{Draft, Element, Parsed};

/// Nodes by tag, ascending. Tags may be sparse; where they are consecutive, as Gmsh writes them,
/// the place is known without a search.
pub(super) struct NodeIndex {
    sorted: Vec<(u64, u32)>,
}

impl NodeIndex {
    /// Sorts the nodes; a tag that comes twice is an error.
    pub(super) fn new(draft: &Draft) -> Parsed<Self> {
        let mut sorted: Vec<_> = draft.nodes.iter().map(|node| node.tag).zip(0..).collect();
        sorted.sort_unstable();
        match sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            None => Ok(Self { sorted }),
            Some(pair) => {
                let (tag, again) = pair[1];
                let at = draft.nodes[again as usize].at;
                Err(draft.error(at, format!("node {tag} is listed twice")).into())
            }
        }
    }

    fn get(&self, tag: u64) -> Option<u32> {
        let offset = tag.checked_sub(self.sorted.first()?.0)?;
        let guess = usize::try_from(offset).ok().and_then(|offset| self.sorted.get(offset));
        if let Some(&(_, place)) = guess.filter(|node| node.0 == tag) {
            return Some(place);
        }
        let found = self.sorted.binary_search_by_key(&tag, |node| node.0).ok()?;
        Some(self.sorted[found].1)
    }

    /// The element with the places of its nodes, which must all be there and differ.
    pub(super) fn resolve<'a>(&self, draft: &Draft, element: &'a Element) -> Parsed<Resolved<'a>> {
        let mut corners = [0; 4];
        let tags = &element.nodes[..element.kind.corners()];
        for (k, &tag) in tags.iter().enumerate() {
            let problem = match self.get(tag) {
                None => "which is not in the file",
                Some(_) if tags[..k].contains(&tag) => "and that twice",
                Some(place) => {
                    corners[k] = place;
                    continue;
                }
            };
            let message = format!("{} has the corner node {tag}, {problem}", element.title());
            return Err(draft.error(element.at, message).into());
        }
        Ok(Resolved { element, corners })
    }
}

/// An element with the places of its nodes in the file.
pub(super) struct Resolved<'a> {
    pub(super) element: &'a Element,
    corners: [u32; 4],
}

impl Resolved<'_> {
    pub(super) fn corners(&self) -> &[u32] {
        &self.corners[..self.element.kind.corners()]
    }

    /// The corners in ascending order.
    fn key(&self) -> [u32; 4] {
        let mut key = [u32::MAX; 4];
        key[..self.corners().len()].copy_from_slice(self.corners());
        key.sort_unstable();
        key
    }
}

/// The cells without repetition, in order, and for each cell its number among them.
///
/// Strictly convex cells with the same corners are the same cell.
pub(super) fn distinct<'c, 'a>(cells: &'c [Resolved<'a>]) -> (Vec<&'c Resolved<'a>>, Vec<u32>) {
    let mut sorted: Vec<_> = cells.iter().map(Resolved::key).zip(0u32..).collect();
    sorted.sort_unstable();
    let mut first = vec![0; cells.len()];
    for equal in sorted.chunk_by(|a, b| a.0 == b.0) {
        for &(_, cell) in equal {
            first[cell as usize] = equal[0].1;
        }
    }
    let mut distinct = Vec::with_capacity(cells.len());
    let mut number = vec![0; cells.len()];
    for (cell, &first) in first.iter().enumerate() {
        if first as usize == cell {
            number[cell] = distinct.len() as u32;
            distinct.push(&cells[cell]);
        } else {
            number[cell] = number[first as usize];
        }
    }
    (distinct, number)
}

//! From the tag of a node to its place in the file.

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

    /// The places of the element's nodes, which must all be there and differ.
    pub(super) fn resolve(&self, draft: &Draft, element: &Element) -> Parsed<[u32; 4]> {
        let mut places = [0; 4];
        let tags = &element.nodes[..element.kind.corners()];
        for (k, &tag) in tags.iter().enumerate() {
            let problem = match self.get(tag) {
                None => "which is not in the file",
                Some(_) if tags[..k].contains(&tag) => "and that twice",
                Some(place) => {
                    places[k] = place;
                    continue;
                }
            };
            let message = format!("{} has the corner node {tag}, {problem}", element.title());
            return Err(draft.error(element.at, message).into());
        }
        Ok(places)
    }
}

//! Which cells are refined where some are marked: the least set that leaves one hanging node a side.
//!
//! ```text
//!   ┌───────┬───┬───┐     Refining x halves its sides. A half of a halved edge is halved with it only
//!   │       │ x │   │     once the cell y at the whole edge is refined too: rule 1.
//!   │   y   ├───┼───┤     A cell with a node in every side is refined: that gives no neighbour a node
//!   │       │   │   │     more, and quads stay quads: rule 2.
//!   └───────┴───┴───┘
//! ```
//! Each cell is refined once at most and asks its neighbours alone: the time is that of the cells refined.
//! No rule speaks of vertices: edges suffice for shapes, since closure sees nothing but one cell.

use super::forest::{Forest, NONE};

/// Which cells of the forest to refine, those marked among them.
pub(super) fn with_neighbours(forest: &Forest, marked: Vec<bool>) -> Vec<bool> {
    let halved = (0..forest.edges.len() as u32).map(|edge| forest.edges.halves(edge).is_some());
    let waiting = (0..).zip(&marked).filter(|(_, marked)| **marked).map(|(cell, _)| cell).collect();
    let halved = halved.collect();
    let mut spread = Spread { forest, sharing: forest.sharing(), halved, refined: marked, waiting };
    while let Some(cell) = spread.waiting.pop() {
        forest.sides(cell).iter().for_each(|&side| spread.halve(side));
    }
    spread.refined
}

struct Spread<'a> {
    forest: &'a Forest,
    /// The cells at each edge.
    sharing: Vec<[u32; 2]>,
    /// Which edges are halved, or will be.
    halved: Vec<bool>,
    /// Which cells are refined.
    refined: Vec<bool>,
    /// The cells of them whose sides are not halved yet.
    waiting: Vec<u32>,
}

impl Spread<'_> {
    fn halve(&mut self, edge: u32) {
        if std::mem::replace(&mut self.halved[edge as usize], true) {
            return;
        }
        if let Some(whole) = self.forest.edges.whole(edge) {
            self.at(whole).for_each(|cell| self.refine(cell));
        }
        for cell in self.at(edge) {
            if self.forest.sides(cell).iter().all(|&side| self.halved[side as usize]) {
                self.refine(cell);
            }
        }
    }

    fn refine(&mut self, cell: u32) {
        if !std::mem::replace(&mut self.refined[cell as usize], true) {
            self.waiting.push(cell);
        }
    }

    fn at(&self, edge: u32) -> impl Iterator<Item = u32> + use<> {
        self.sharing[edge as usize].into_iter().filter(|&cell| cell != NONE)
    }
}

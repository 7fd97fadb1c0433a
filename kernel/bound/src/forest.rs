//! A spanning forest of the cells: the way on which what is out of balance leaves the domain.
//!
//! Every cell has a *parent* side: the first step of its cheapest way to a root, a boundary edge whose
//! flux may change. A step costs what leaving through a cell does to the error bound, 1/α with
//! α = ½ tr A, so that the way leads around soft cells. The forest belongs to the mesh and to A: it is
//! found once, by Dijkstra's method with a binary heap in fixed memory.

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::mesh::edges::Edges;

/// Memory for [`grow`]; every array has one entry a cell, triangles first.
#[derive(Debug)]
pub struct ForestBuffers<'a, R, I> {
    /// Becomes the cells, roots before leaves.
    pub order: &'a mut [I],
    /// Becomes the half-edge through which each cell's surplus leaves.
    pub parent: &'a mut [I],
    /// Becomes the place of each cell in `order`.
    pub place: &'a mut [I],
    /// Scratch: the cost of each cell's way.
    pub distance: &'a mut [R],
}

/// Cells in order and the parent side of each (borrowed, validated).
#[derive(Debug, Clone, Copy)]
pub struct Forest<'a, I> {
    order: &'a [I],
    parent: &'a [I],
    place: &'a [I],
}

impl<'a, I: Index> Forest<'a, I> {
    /// Takes a forest found elsewhere.
    ///
    /// # Errors
    /// Lengths that do not match, a cell that is missing, a parent that is no side of its cell, a cell
    /// that stands before the one that its parent side leads to.
    pub fn new(
        edges: &Edges<I>,
        order: &'a [I],
        parent: &'a [I],
        place: &'a [I],
    ) -> Result<Self, Error> {
        for array in [order, parent, place] {
            same_length(Array::Scratch, array.len(), edges.cells())?;
        }
        for (cell, (parent, at)) in parent.iter().zip(place).enumerate() {
            let wrong = Error::OutOfRange { of: Array::Scratch, at: cell };
            let own = read(order, at.at()).at() == cell && at.at() < order.len();
            let side = edges.cell_of(parent.at()) == Some(cell);
            let next = edges.beyond(parent.at());
            let earlier = next.is_none_or(|next| read(place, next.1) < *at);
            if !(own && side && earlier) {
                return Err(wrong);
            }
        }
        Ok(Self { order, parent, place })
    }

    /// Cell and parent side (a half-edge), leaves before roots.
    pub fn from_leaves(&self) -> impl Iterator<Item = (usize, usize)> + use<'a, I> {
        let parent = self.parent;
        self.order.iter().rev().map(move |cell| (cell.at(), read(parent, cell.at()).at()))
    }

    /// Cell and parent side, roots before leaves.
    pub fn from_roots(&self) -> impl Iterator<Item = (usize, usize)> + use<'a, I> {
        let parent = self.parent;
        self.order.iter().map(move |cell| (cell.at(), read(parent, cell.at()).at()))
    }

    /// The half-edge through which a cell's surplus leaves.
    pub fn parent(&self, cell: usize) -> usize {
        read(self.parent, cell).at()
    }

    /// The cells, roots before leaves.
    pub fn order(&self) -> &'a [I] {
        self.order
    }

    /// The place of a cell in the order.
    pub fn place(&self, cell: usize) -> usize {
        read(self.place, cell).at()
    }
}

/// Finds the cheapest ways: `cost` of passing a cell, positive; `is_root` of a boundary edge.
///
/// # Errors
/// Arrays of the wrong length; [`Error::NoWayOut`] for a part of the domain without a root.
pub fn grow<'a, R: Real, I: Index>(
    edges: &Edges<I>,
    cost: impl Fn(usize) -> R,
    is_root: impl Fn(usize) -> bool,
    buffers: ForestBuffers<'a, R, I>,
) -> Result<Forest<'a, I>, Error> {
    let ForestBuffers { order, parent, place, distance } = buffers;
    for length in [order.len(), parent.len(), place.len(), distance.len()] {
        same_length(Array::Scratch, length, edges.cells())?;
    }
    parent.fill(I::NONE);
    place.fill(I::NONE);
    distance.fill(R::ONE / R::ZERO);
    let mut search = Search { heap: Heap { order, place, size: 0 }, parent, distance, done: 0 };
    for (edge, pair) in edges.half_edges().iter().enumerate() {
        if pair[1] == I::NONE && is_root(edge) {
            search.relax(edges, pair[0], R::ZERO, &cost);
        }
    }
    while let Some(cell) = search.finish_nearest() {
        for half in edges.sides_of(cell) {
            if let Some((beyond, _)) = edges.beyond(half) {
                let so_far = read(search.distance, cell);
                search.relax(edges, beyond, so_far, &cost);
            }
        }
    }
    let unreached = search.parent.iter().position(|&half| half == I::NONE);
    let Search { heap: Heap { order, place, .. }, parent, .. } = search;
    match unreached {
        Some(cell) => Err(Error::NoWayOut { cell }),
        None => Ok(Forest { order, parent, place }),
    }
}

struct Search<'a, R, I> {
    heap: Heap<'a, I>,
    parent: &'a mut [I],
    distance: &'a mut [R],
    done: usize,
}

/// A binary heap of cells by distance, kept backwards from the end of `order`; the finished cells
/// stand at its front, and both together are never more than there are cells.
struct Heap<'a, I> {
    order: &'a mut [I],
    place: &'a mut [I],
    size: usize,
}

impl<R: Real, I: Index> Search<'_, R, I> {
    /// Offers the cell of `half` a way that leaves through `half` and costs `beyond` from there.
    fn relax(&mut self, edges: &Edges<I>, half: I, beyond: R, cost: &impl Fn(usize) -> R) {
        let Some(cell) = edges.cell_of(half.at()) else { return };
        let length = beyond + cost(cell);
        let finished = self.heap.is_finished(cell, self.done);
        if finished || !(length < read(self.distance, cell)) {
            return;
        }
        write(self.distance, cell, length);
        write(self.parent, cell, half);
        let at = match self.heap.find(cell) {
            Some(at) => at,
            None => self.heap.append(cell),
        };
        self.heap.rise(at, self.distance);
    }

    fn finish_nearest(&mut self) -> Option<usize> {
        let cell = self.heap.pop(self.distance)?;
        self.heap.finish(cell, self.done);
        self.done += 1;
        Some(cell)
    }
}

impl<I: Index> Heap<'_, I> {
    fn slot(&self, at: usize) -> usize {
        self.order.len() - 1 - at
    }

    fn cell(&self, at: usize) -> usize {
        read(self.order, self.slot(at)).at()
    }

    fn set(&mut self, at: usize, cell: usize) {
        let slot = self.slot(at);
        write(self.order, slot, I::new(cell).unwrap_or(I::NONE));
        write(self.place, cell, I::new(slot).unwrap_or(I::NONE));
    }

    fn is_finished(&self, cell: usize, done: usize) -> bool {
        read(self.place, cell).at() < done
    }

    /// Where a cell stands in the heap.
    fn find(&self, cell: usize) -> Option<usize> {
        let place = read(self.place, cell);
        if place == I::NONE { None } else { self.order.len().checked_sub(1 + place.at()) }
    }

    fn append(&mut self, cell: usize) -> usize {
        self.size += 1;
        self.set(self.size - 1, cell);
        self.size - 1
    }

    fn finish(&mut self, cell: usize, done: usize) {
        write(self.order, done, I::new(cell).unwrap_or(I::NONE));
        write(self.place, cell, I::new(done).unwrap_or(I::NONE));
    }

    fn rise<R: Real>(&mut self, mut at: usize, distance: &[R]) {
        let cell = self.cell(at);
        while at > 0 {
            let above = self.cell((at - 1) / 2);
            if !(read(distance, cell) < read(distance, above)) {
                break;
            }
            self.set(at, above);
            at = (at - 1) / 2;
        }
        self.set(at, cell);
    }

    fn pop<R: Real>(&mut self, distance: &[R]) -> Option<usize> {
        self.size = self.size.checked_sub(1)?;
        let (nearest, last) = (self.cell(0), self.cell(self.size));
        let mut at = 0;
        while 2 * at + 1 < self.size {
            let (left, right) = (2 * at + 1, 2 * at + 2);
            let of = |place: usize| read(distance, self.cell(place));
            let below = if right < self.size && of(right) < of(left) { right } else { left };
            if !(of(below) < read(distance, last)) {
                break;
            }
            let cell = self.cell(below);
            self.set(at, cell);
            at = below;
        }
        if self.size > 0 {
            self.set(at, last);
        }
        Some(nearest)
    }
}

//! Packed cells: mesh and element matrices in the order in which the error bound walks over them.
//!
//! ```text
//!   K without its diagonal | α | 1/α | 1/(4 det A) | edges | vertices | number, signs, parent
//! ```
//! Cells stand from the leaves of the forest to its roots, and each is turned so that the side through
//! which its surplus leaves comes last: a walk needs neither an order nor a parent, and what belongs to
//! a cell lies together. Like packed rows they cost memory, and a certificate half of its time.
//!
//! Means at vertices are weighted by α = ½ tr A, so that the stiff cell decides there, means on edges
//! by 1/α, so that the soft one does: without weights a jump of 10⁴ in A costs a factor of 12 in the
//! bound, and 10 to 40 where the solver was cut off.

use crate::edges::Edges;
use crate::element::entry;
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::forest::Forest;
use crate::index::{Index, read, write};
use crate::mesh::Mesh;
use crate::real::Real;
use crate::stiffness::Stiffness;

/// One packed cell, as memory that the caller owns; its contents are the business of [`Cells`].
#[derive(Debug, Clone, Copy)]
pub struct Cell<R, I, const SIDES: usize, const ENTRIES: usize> {
    pub(crate) k: [R; ENTRIES],
    pub(crate) alpha: R,
    pub(crate) softness: R,
    /// Of triangles: 1/(4 det A).
    pub(crate) compliance: R,
    pub(crate) edges: [I; SIDES],
    pub(crate) vertices: [I; SIDES],
    pub(crate) number: I,
    /// Bit k: edge k is directed out of this cell.
    outward: u8,
    /// The side that stands last, as the mesh numbers it.
    parent: u8,
    /// Another side that leads towards a root, or the last one again.
    second: u8,
}

/// A packed triangle.
pub type Triangle<R, I> = Cell<R, I, 3, 3>;
/// A packed quad.
pub type Quad<R, I> = Cell<R, I, 4, 6>;

impl<R: Real, I: Index, const SIDES: usize, const ENTRIES: usize> Cell<R, I, SIDES, ENTRIES> {
    /// A cell of zeros.
    pub const EMPTY: Self = Self {
        k: [R::ZERO; ENTRIES],
        alpha: R::ZERO,
        softness: R::ZERO,
        compliance: R::ZERO,
        edges: [I::FIRST; SIDES],
        vertices: [I::FIRST; SIDES],
        number: I::FIRST,
        outward: 0,
        parent: 0,
        second: 0,
    };

    /// The numbers at these places.
    #[inline(always)]
    pub(crate) fn pick(places: &[I; SIDES], numbers: &[R]) -> [R; SIDES] {
        places.map(|place| read(numbers, place.at()))
    }

    /// Values along the edges as values out of the cell, or back.
    #[inline(always)]
    pub(crate) fn turned(&self, along: [R; SIDES]) -> [R; SIDES] {
        let mut bit = 1;
        along.map(|flux| {
            let out = if self.outward & bit != 0 { flux } else { -flux };
            bit <<= 1;
            out
        })
    }

    /// ∫τ·n over the sides, outward; `tau` has one value an edge along its direction.
    #[inline(always)]
    pub fn outward(&self, tau: &[R]) -> [R; SIDES] {
        self.turned(Self::pick(&self.edges, tau))
    }

    /// Balances the cell through its last side and returns ∫τ·n over all sides. Where another side leads
    /// towards a root too, it takes half of the surplus: flows that spread cost less.
    #[inline(always)]
    pub fn settle(&self, load: R, tau: &mut [R]) -> [R; SIDES] {
        let mut out = self.outward(tau);
        let second = usize::from(self.second);
        if second + 1 < SIDES {
            let surplus = out.iter().fold(-load, |rest, &flux| rest - flux);
            let flux = read(&out, second) + R::HALF * surplus;
            self.send(second, flux, &mut out, tau);
        }
        let others = out.iter().take(SIDES - 1);
        let rest = others.fold(-load, |rest, &flux| rest - flux);
        self.send(SIDES - 1, rest, &mut out, tau);
        out
    }

    #[inline(always)]
    fn send(&self, side: usize, flux: R, out: &mut [R; SIDES], tau: &mut [R]) {
        write(out, side, flux);
        let along = self.outward & (1 << side) != 0;
        write(tau, read(&self.edges, side).at(), if along { flux } else { -flux });
    }

    /// What belongs to the sides (or vertices), in the order of the mesh.
    pub(crate) fn as_in_mesh(&self, packed: [R; SIDES]) -> [R; SIDES] {
        let mut unpacked = packed;
        unpacked.rotate_right((usize::from(self.parent) + 1) % SIDES);
        unpacked
    }

    /// Fills in everything but numbers of the material; `half` is the first half-edge.
    fn place(&mut self, edges: &Edges<I>, half: usize, parent: usize, corners: &[I; SIDES]) {
        self.parent = parent as u8;
        self.outward = 0;
        for k in 0..SIDES {
            let side = (parent + 1 + k) % SIDES;
            let edge = edges.edge_of(half + side);
            write(&mut self.edges, k, I::new(edge).unwrap_or(I::NONE));
            write(&mut self.vertices, k, read(corners, side));
            let along = read(edges.half_edges(), edge)[0].at() == half + side;
            self.outward |= u8::from(along) << k;
        }
    }

    /// Finds the other side behind which the cell nearest to a root lies.
    fn find_second(&mut self, edges: &Edges<I>, half: usize, own: usize, forest: &Forest<I>) {
        let mut nearest = forest.place(own);
        self.second = (SIDES - 1) as u8;
        for k in 0..SIDES - 1 {
            let side = (usize::from(self.parent) + 1 + k) % SIDES;
            let place = edges.beyond(half + side).map(|(_, cell)| forest.place(cell));
            if let Some(place) = place.filter(|&place| place < nearest) {
                (nearest, self.second) = (place, k as u8);
            }
        }
    }

    fn set_material(&mut self, number: usize, alpha: R, compliance: R) {
        self.number = I::new(number).unwrap_or(I::NONE);
        (self.alpha, self.softness, self.compliance) = (alpha, R::ONE / alpha, compliance);
    }
}

/// Memory for [`pack`].
#[derive(Debug)]
pub struct CellBuffers<'a, R, I> {
    /// One entry a triangle.
    pub triangles: &'a mut [Triangle<R, I>],
    /// One entry a quad.
    pub quads: &'a mut [Quad<R, I>],
    /// Becomes 1/Σα of the cells at each vertex.
    pub of_vertices: &'a mut [R],
    /// Becomes 1/Σ(1/α) of the cells of each edge.
    pub of_edges: &'a mut [R],
}

/// All cells from leaves to roots, and the weights of means (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Cells<'a, R, I> {
    pub(crate) triangles: &'a [Triangle<R, I>],
    pub(crate) quads: &'a [Quad<R, I>],
    pub(crate) of_vertices: &'a [R],
    pub(crate) of_edges: &'a [R],
    /// The numbers of the cells, roots first: which kind is next in a mixed mesh.
    order: &'a [I],
}

/// A cell of either kind.
#[derive(Debug, Clone, Copy)]
pub enum Either<'a, R, I> {
    /// A triangle.
    Triangle(&'a Triangle<R, I>),
    /// A quad.
    Quad(&'a Quad<R, I>),
}

impl<'a, R: Real, I: Index> Cells<'a, R, I> {
    /// Takes cells that [`pack`] packed by this forest, with the weights that it found.
    ///
    /// # Errors
    /// Another number of cells than the forest has.
    pub fn new(
        triangles: &'a [Triangle<R, I>],
        quads: &'a [Quad<R, I>],
        of_vertices: &'a [R],
        of_edges: &'a [R],
        forest: &Forest<'a, I>,
    ) -> Result<Self, Error> {
        let order = forest.order();
        same_length(Array::Triangles, triangles.len() + quads.len(), order.len())?;
        Ok(Self { triangles, quads, of_vertices, of_edges, order })
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.triangles.len() + self.quads.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Every cell, leaves before roots.
    pub fn from_leaves(&self) -> impl Iterator<Item = Either<'a, R, I>> + use<'a, R, I> {
        let mut triangles = self.triangles.iter();
        let mut quads = self.quads.iter();
        let count = self.triangles.len();
        self.order.iter().rev().filter_map(move |number| {
            if number.at() < count {
                triangles.next().map(Either::Triangle)
            } else {
                quads.next().map(Either::Quad)
            }
        })
    }
}

/// Packs the cells; `alpha` holds ½ tr A of every cell, triangles first, or nothing where it is the
/// same everywhere, `compliance` 1/(4 det A) of every triangle (of its mean, where A varies).
///
/// # Errors
/// Arrays of the wrong length.
pub fn pack<'a, R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    alpha: &[R],
    compliance: &[R],
    forest: &Forest<'a, I>,
    buffers: CellBuffers<'a, R, I>,
) -> Result<Cells<'a, R, I>, Error> {
    let CellBuffers { triangles, quads, of_vertices, of_edges } = buffers;
    let (t, q) = (mesh.triangles().len(), mesh.quads().len());
    same_length(Array::Triangles, edges.of_triangles().len(), t)?;
    same_length(Array::Quads, edges.of_quads().len(), q)?;
    same_length(Array::Triangles, triangles.len(), t)?;
    same_length(Array::Quads, quads.len(), q)?;
    same_length(Array::Stiffness, stiffness.triangles.len(), t)?;
    same_length(Array::Stiffness, stiffness.quads.len(), q)?;
    same_length(Array::Coefficients, compliance.len(), t)?;
    same_length_or_empty(Array::Coefficients, alpha.len(), t + q)?;
    same_length(Array::Vertices, of_vertices.len(), mesh.vertices().len())?;
    same_length(Array::Edges, of_edges.len(), edges.counts().edges())?;
    let alpha = |cell: usize| alpha.get(cell).copied().unwrap_or(R::ONE);
    let (mut to_triangles, mut to_quads) = (triangles.iter_mut(), quads.iter_mut());
    for (number, parent) in forest.from_leaves() {
        if number < t {
            let Some(cell) = to_triangles.next() else { break };
            let half = 3 * number;
            cell.place(edges, half, parent.wrapping_sub(half), &read(mesh.triangles(), number));
            cell.k = read(stiffness.triangles, number);
            cell.k.rotate_left((parent.wrapping_sub(half) + 1) % 3);
            cell.find_second(edges, half, number, forest);
            cell.set_material(number, alpha(number), read(compliance, number));
        } else {
            let Some(cell) = to_quads.next() else { break };
            let half = 3 * t + 4 * (number.wrapping_sub(t));
            cell.place(
                edges,
                half,
                parent.wrapping_sub(half),
                &read(mesh.quads(), number.wrapping_sub(t)),
            );
            cell.k = turned(
                &read(stiffness.quads, number.wrapping_sub(t)),
                parent.wrapping_sub(half) + 1,
            );
            // On quads that costs up to 1.4 times more: halves go sideways.
            cell.second = 3;
            cell.set_material(number, alpha(number), R::ZERO);
        }
    }
    let cells = Cells { triangles, quads, of_vertices: &[], of_edges: &[], order: forest.order() };
    weigh(&cells, of_vertices, of_edges);
    Ok(Cells { of_vertices, of_edges, ..cells })
}

/// The element matrix of a quad whose side `first` is called 0.
fn turned<R: Real>(k: &[R; 6], first: usize) -> [R; 6] {
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    pairs.map(|(i, j)| read(k, entry(4, (i + first) % 4, (j + first) % 4)))
}

fn weigh<R: Real, I: Index>(cells: &Cells<R, I>, of_vertices: &mut [R], of_edges: &mut [R]) {
    of_vertices.fill(R::ZERO);
    of_edges.fill(R::ZERO);
    let mut add = |vertices: &[I], edges: &[I], alpha: R, softness: R| {
        let of = |place: &I, sums: &mut [R], weight: R| {
            let sum = read(sums, place.at()) + weight;
            write(sums, place.at(), sum);
        };
        vertices.iter().for_each(|vertex| of(vertex, of_vertices, alpha));
        edges.iter().for_each(|edge| of(edge, of_edges, softness));
    };
    cells.triangles.iter().for_each(|c| add(&c.vertices, &c.edges, c.alpha, c.softness));
    cells.quads.iter().for_each(|c| add(&c.vertices, &c.edges, c.alpha, c.softness));
    let sums = of_vertices.iter_mut().chain(of_edges);
    sums.filter(|sum| **sum > R::ZERO).for_each(|sum| *sum = R::ONE / *sum);
}

//! Packed cells: mesh and element matrices in the order in which the error bound walks over them.
//!
//! ```text
//!   K without its diagonal | signs of the sides | α | 1/α | 1/(4 det A) | ... | edges | vertices | number
//! ```
//! Cells stand from the leaves of the forest to its roots, and each is turned so that the side through
//! which its surplus leaves comes last: a walk needs neither an order nor a parent, and what belongs to
//! a cell lies together. Like packed rows they cost memory, and halve the time of a certificate.
//!
//! A triangle is also mirrored, where needed, so that the side before the last leads towards a root too:
//! half of the surplus leaves there, and flows that spread cost less.
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
    /// 1 where an edge is directed out of this cell, else −1.
    signs: [R; SIDES],
    pub(crate) alpha: R,
    pub(crate) softness: R,
    /// Of triangles: 1/(4 det A).
    pub(crate) compliance: R,
    /// Of triangles: the same times Σ|K|.
    pub(crate) doubt: R,
    /// What the side before the last takes of the surplus: ½ or 0.
    spread: R,
    pub(crate) edges: [I; SIDES],
    pub(crate) vertices: [I; SIDES],
    pub(crate) number: I,
    /// The side that stands last, as the mesh numbers it.
    parent: u8,
    mirrored: bool,
}

/// A packed triangle.
pub type Triangle<R, I> = Cell<R, I, 3, 3>;
/// A packed quad.
pub type Quad<R, I> = Cell<R, I, 4, 6>;

/// The numbers at these places; `None` where a (never validated) one points outside.
#[inline(always)]
pub(crate) fn pick<R: Real, I: Index, const N: usize>(
    places: &[I; N],
    numbers: &[R],
) -> Option<[R; N]> {
    let mut picked = [R::ZERO; N];
    for (value, place) in picked.iter_mut().zip(places) {
        *value = *numbers.get(place.at())?;
    }
    Some(picked)
}

impl<R: Real, I: Index, const SIDES: usize, const ENTRIES: usize> Cell<R, I, SIDES, ENTRIES> {
    /// A cell of zeros.
    pub const EMPTY: Self = Self {
        k: [R::ZERO; ENTRIES],
        signs: [R::ZERO; SIDES],
        alpha: R::ZERO,
        softness: R::ZERO,
        compliance: R::ZERO,
        doubt: R::ZERO,
        spread: R::ZERO,
        edges: [I::FIRST; SIDES],
        vertices: [I::FIRST; SIDES],
        number: I::FIRST,
        parent: 0,
        mirrored: false,
    };

    /// Values along the edges as values out of the cell, or back.
    #[inline(always)]
    pub(crate) fn turned(&self, mut along: [R; SIDES]) -> [R; SIDES] {
        along.iter_mut().zip(self.signs).for_each(|(flux, sign)| *flux *= sign);
        along
    }

    /// ∫τ·n over the sides, outward; `tau` has one value an edge along its direction.
    #[inline(always)]
    pub fn outward(&self, tau: &[R]) -> Option<[R; SIDES]> {
        Some(self.turned(pick(&self.edges, tau)?))
    }

    /// Balances the cell through its last side and returns ∫τ·n over all sides.
    #[inline(always)]
    pub fn settle(&self, load: R, tau: &mut [R]) -> Option<[R; SIDES]> {
        let mut out = self.outward(tau)?;
        let surplus = out.iter().fold(-load, |rest, &flux| rest - flux);
        *out.get_mut(SIDES - 2)? += self.spread * surplus;
        let others = out.iter().take(SIDES - 1);
        *out.get_mut(SIDES - 1)? = others.fold(-load, |rest, &flux| rest - flux);
        for side in [SIDES - 2, SIDES - 1] {
            *tau.get_mut(self.edges.get(side)?.at())? = *out.get(side)? * *self.signs.get(side)?;
        }
        Some(out)
    }

    /// What belongs to the sides, in the order of the mesh.
    pub(crate) fn sides_in_mesh(&self, mut packed: [R; SIDES]) -> [R; SIDES] {
        if self.mirrored {
            packed.swap(0, 1);
        }
        self.turned_back(packed)
    }

    /// What belongs to the vertices, in the order of the mesh.
    pub(crate) fn vertices_in_mesh(&self, mut packed: [R; SIDES]) -> [R; SIDES] {
        if self.mirrored {
            packed.swap(0, 2);
        }
        self.turned_back(packed)
    }

    fn turned_back(&self, mut packed: [R; SIDES]) -> [R; SIDES] {
        packed.rotate_right((usize::from(self.parent) + 1) % SIDES);
        packed
    }

    /// Fills in edges, vertices and signs, from the first half-edge and the side of the parent.
    fn place(&mut self, edges: &Edges<I>, half: usize, parent: usize, corners: &[I; SIDES]) {
        (self.parent, self.mirrored, self.spread) = (parent as u8, false, R::ZERO);
        for k in 0..SIDES {
            let side = (parent + 1 + k) % SIDES;
            let edge = edges.edge_of(half + side);
            write(&mut self.edges, k, I::new(edge).unwrap_or(I::NONE));
            write(&mut self.vertices, k, read(corners, side));
            let along = read(edges.half_edges(), edge)[0].at() == half + side;
            write(&mut self.signs, k, if along { R::ONE } else { -R::ONE });
        }
    }

    fn set_material(&mut self, number: usize, alpha: R) {
        self.number = I::new(number).unwrap_or(I::NONE);
        (self.alpha, self.softness) = (alpha, R::ONE / alpha);
    }
}

impl<R: Real, I: Index> Triangle<R, I> {
    /// Mirrors the cell, where needed, so that its middle side leads towards a root, if one does.
    fn find_second(&mut self, edges: &Edges<I>, own: usize, forest: &Forest<I>) {
        let behind = |k: usize| {
            let side = (usize::from(self.parent) + 1 + k) % 3;
            edges.beyond(3 * own + side).map(|(_, cell)| forest.place(cell))
        };
        let nearer = |place: Option<usize>| place.filter(|&place| place < forest.place(own));
        let (first, second) = (nearer(behind(0)), nearer(behind(1)));
        self.mirrored = match (first, second) {
            (Some(first), Some(second)) => first < second,
            (first, _) => first.is_some(),
        };
        self.spread = if first.or(second).is_some() { R::HALF } else { R::ZERO };
        if self.mirrored {
            // Vertex k + 2 stays opposite of side k, and K_ij goes with the sides.
            self.edges.swap(0, 1);
            self.signs.swap(0, 1);
            self.vertices.swap(0, 2);
            self.k.swap(1, 2);
        }
    }

    /// K in the order of the mesh.
    pub(crate) fn stiffness_in_mesh(&self) -> [R; 3] {
        let mut k = self.k;
        if self.mirrored {
            k.swap(1, 2);
        }
        self.turned_back(k)
    }

    fn set_compliance(&mut self, compliance: R) {
        let size = self.k.iter().fold(R::ZERO, |sum, entry| sum + entry.magnitude());
        (self.compliance, self.doubt) = (compliance, compliance * size);
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
    /// Becomes 1/Σ(1/α) of the cells of each edge, but 0 on N and R.
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
            cell.find_second(edges, number, forest);
            cell.set_material(number, alpha(number));
            cell.set_compliance(read(compliance, number));
        } else {
            // Halves that go sideways cost quads up to 1.4 times more: no second side there.
            let Some(cell) = to_quads.next() else { break };
            let (quad, half) = (number - t, 3 * t + 4 * (number - t));
            cell.place(edges, half, parent.wrapping_sub(half), &read(mesh.quads(), quad));
            cell.k = turned(&read(stiffness.quads, quad), parent.wrapping_sub(half) + 1);
            cell.set_material(number, alpha(number));
        }
    }
    let cells = Cells { triangles, quads, of_vertices: &[], of_edges: &[], order: forest.order() };
    weigh(&cells, of_vertices, of_edges);
    // What the cells say of the flux through N and R does not count: the conditions decide.
    let free = of_edges.iter_mut().zip(edges.half_edges()).take(edges.counts().free);
    free.filter(|(_, pair)| pair[1] == I::NONE).for_each(|(weight, _)| *weight = R::ZERO);
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

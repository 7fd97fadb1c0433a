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

mod pack;

pub use pack::{CellBuffers, pack};

use crate::forest::Forest;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::{Index, Real};

/// One packed cell, as [`pack`] fills it in and `signorini bake` writes it down.
#[derive(Debug, Clone, Copy)]
pub struct Cell<R, I, const SIDES: usize, const ENTRIES: usize> {
    /// The element matrix without its diagonal.
    pub k: [R; ENTRIES],
    /// 1 where an edge is directed out of this cell, else −1.
    pub signs: [R; SIDES],
    /// α = ½ tr A, the cell's weight in means at vertices.
    pub alpha: R,
    /// 1/α
    pub softness: R,
    /// Of triangles: 1/(4 det A).
    pub compliance: R,
    /// Of triangles: the same times Σ|K|.
    pub uncertainty: R,
    /// Part of the surplus that leaves by the side before the last: ½ or 0.
    pub spread: R,
    /// The edges of its sides.
    pub edges: [I; SIDES],
    /// Its vertices.
    pub vertices: [I; SIDES],
    /// Its number in the mesh, triangles first.
    pub number: I,
    /// The side that stands last, as the mesh numbers it.
    pub parent: u8,
    /// Whether the sides run clockwise.
    pub mirrored: bool,
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
        uncertainty: R::ZERO,
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

    /// Values of the sides, in the order of the mesh.
    pub(crate) fn sides_in_mesh(&self, mut packed: [R; SIDES]) -> [R; SIDES] {
        if self.mirrored {
            packed.swap(0, 1);
        }
        self.turned_back(packed)
    }

    /// Values of the vertices, in the order of the mesh.
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
}

impl<R: Real, I: Index> Quad<R, I> {
    /// Values of the vertices, as [`pack`] turned them: quads are not mirrored.
    pub(crate) fn packed(&self, mut in_mesh: [R; 4]) -> [R; 4] {
        in_mesh.rotate_left((usize::from(self.parent) + 1) % 4);
        in_mesh
    }
}

impl<R: Real, I: Index> Triangle<R, I> {
    /// K in the order of the mesh.
    pub(crate) fn stiffness_in_mesh(&self) -> [R; 3] {
        let mut k = self.k;
        if self.mirrored {
            k.swap(1, 2);
        }
        self.turned_back(k)
    }
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

    /// Takes cells and weights that [`pack`] found on the host, for a `static`. `order` lists the cells from
    /// roots to leaves; it may be empty where all are triangles with constant A.
    pub const fn baked(
        triangles: &'a [Triangle<R, I>],
        quads: &'a [Quad<R, I>],
        of_vertices: &'a [R],
        of_edges: &'a [R],
        order: &'a [I],
    ) -> Self {
        Self { triangles, quads, of_vertices, of_edges, order }
    }

    /// The packed triangles.
    pub fn triangles(&self) -> &'a [Triangle<R, I>] {
        self.triangles
    }

    /// The packed quads.
    pub fn quads(&self) -> &'a [Quad<R, I>] {
        self.quads
    }

    /// The weights of means at vertices and of means on edges.
    pub fn weights(&self) -> [&'a [R]; 2] {
        [self.of_vertices, self.of_edges]
    }

    /// The numbers of the cells, roots first.
    pub fn order(&self) -> &'a [I] {
        self.order
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

//! A guaranteed bound of the error, from any iterate: how wrong the answer can be.
//!
//! For any s in H¹ with s = u_D on D and s ≥ ψ on C, and any τ in H(div) with ∇·τ + f = 0, τ·n = g on
//! N and τ·n ≥ q on C,
//! ```text
//!   gap² = ‖A^½∇s − A^{−½}τ‖² + 2∫_C (τ·n − q)(s − ψ) + ∫_R (τ·n + h(s − u_ext))²/h
//!        = ‖A^½∇(u − s)‖² + ‖A^{−½}(σ − τ)‖² + ∫_R h(u − s)² + ∫_R ((σ − τ)·n)²/h
//!          + 2∫_C [(σ·n − q)(s − ψ) + (τ·n − q)(u − ψ)],          every term ≥ 0:
//! ```
//! an identity without an unknown constant. s comes from [`crate::conforming`], τ from
//! [`crate::equilibrium`]; f, g and q are there means over cells and edges, and what they leave out,
//! the oscillation, is a number of the caller's: total = osc + √(gap² + osc²) + rounding.
//!
//! ## What rounding may do
//!
//! The bound is a statement about numbers that were computed, so it must hold for those:
//! * s and τ are *defined* by the floating-point numbers at vertices and on edges.
//! * The walk leaves ∇·τ + f = ρ/|T| with |ρ| of a few ε times the terms of a cell. Sending each ρ
//!   along the forest to its root changes ‖A^{−½}τ‖ by at most [`Ground::reach`] Σ|ρ|.
//! * The small difference A∇s − τ is formed from large terms M: its error, at most 8 ε M, goes through
//!   the same quadratic form, and the root of the sum is added.
//! * Data are rounded once when they are stored: a boundary value moves by ε|u_D|, and the energy of
//!   such a ripple on the cells along the boundary is added too.
//!
//! All of it is [`Certificate::rounding`]: 1e−15 of the solution in `f64`, 1e−6 in `f32`.

mod boundary;
mod metric;
mod quad;
mod sum;
mod triangle;

pub use boundary::Curved;
pub use metric::{Metric, POINTS, of_quad, of_triangle};

use crate::assembly::CellLoads;
use crate::boundary::Boundary;
use crate::conforming::{self, VertexBuffers, VertexData};
use crate::edges::Edges;
use crate::equilibrium::{self, Cell, Iterate};
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::forest::Forest;
use crate::index::{Index, read, write};
use crate::mesh::Mesh;
use crate::real::Real;
use crate::stiffness::Stiffness;
use sum::Sum;

/// What stays from one certificate to the next: mesh, A and the ways out (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Ground<'a, R, I> {
    /// The mesh; of its coordinates nothing is read.
    pub mesh: Mesh<'a, R, I>,
    /// Its numbered edges.
    pub edges: Edges<'a, I>,
    /// Element matrices.
    pub stiffness: Stiffness<'a, R>,
    /// A in reference coordinates.
    pub metric: Metric<'a, R>,
    /// ½ tr A of every cell, triangles first, or nothing where it is the same everywhere.
    pub alpha: &'a [R],
    /// The way on which surplus leaves.
    pub forest: Forest<'a, I>,
    /// The largest ‖A^{−½}·‖ of a flux that brings 1 from a cell to its root: [`reach`].
    pub reach: R,
}

/// Loads and boundary data of one tick (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Given<'a, R, I> {
    /// ∫_T f of every cell.
    pub loads: CellLoads<'a, R>,
    /// Conditions on the boundary edges.
    pub boundary: Boundary<'a, R, I>,
    /// ψ and u_D at the ends of edges.
    pub ends: VertexData<'a, R>,
    /// Edges on which ψ or u_D is not affine.
    pub curved: &'a [Curved<R, I>],
    /// Of each transfer law ∫h and u_ext at the 8 Gauss points of its edge, or nothing where both are
    /// constant along every edge.
    pub transfer: &'a [[[R; 2]; 8]],
    /// What f, g and q leave out: √Σ_T (osc_T + Σ_{E⊂∂T} osc_E)².
    pub oscillation: R,
}

/// Memory for [`certify`].
#[derive(Debug)]
pub struct Buffers<'a, R> {
    /// Becomes s at the vertices.
    pub vertices: &'a mut [R],
    /// Scratch, one entry a vertex.
    pub weights: &'a mut [R],
    /// Becomes the bubbles of s, one entry an edge; may be empty where there are no quads.
    pub bubbles: &'a mut [R],
    /// Becomes τ: ∫_E τ·n of every edge, along its direction.
    pub tau: &'a mut [R],
    /// Becomes each cell's part of gap², with that of its boundary edges; may be empty.
    pub indicators: &'a mut [R],
}

/// How wrong (s, τ) can be, in the energy norm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Certificate<R> {
    /// The root of gap²: the bound where f, g and q have no oscillation.
    pub gap: R,
    /// ‖A^{−½}(τ − σ_h)‖: what more sweeps would remove.
    pub algebraic: R,
    /// What was given as oscillation.
    pub oscillation: R,
    /// What rounding can have hidden.
    pub rounding: R,
    /// oscillation + √(gap² + oscillation²) + rounding: never less than the error.
    pub total: R,
}

/// What can be said of an iterate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict<R> {
    /// Its error is at most the total of this.
    Certified(Certificate<R>),
    /// No bound: only contact edges can take the surplus of a part, and this one would be pulled at.
    Pulled {
        /// The edge.
        edge: usize,
    },
    /// No bound: the numbers overflow.
    NotFinite,
}

impl<R: Real> Verdict<R> {
    /// The certificate, where there is one.
    pub fn certificate(&self) -> Option<&Certificate<R>> {
        match self {
            Self::Certified(certificate) => Some(certificate),
            Self::Pulled { .. } | Self::NotFinite => None,
        }
    }
}

/// Bounds the error of an iterate.
///
/// # Errors
/// Arrays of the wrong length.
pub fn certify<R: Real, I: Index>(
    ground: &Ground<R, I>,
    given: &Given<R, I>,
    iterate: Iterate<R>,
    buffers: Buffers<R>,
) -> Result<Verdict<R>, Error> {
    let Ground { mesh, edges, stiffness, alpha, .. } = ground;
    let Buffers { vertices, weights, bubbles, tau, indicators } = buffers;
    same_length_or_empty(Array::Scratch, indicators.len(), edges.cells())?;
    same_length_or_empty(Array::Robin, given.transfer.len(), given.boundary.robin().len())?;
    same_length(Array::Fluxes, tau.len(), edges.counts().edges())?;
    let values = VertexBuffers { values: vertices, weights };
    let (u, lower) = (iterate.u, iterate.lower);
    conforming::fill(mesh, edges, alpha, u, lower, given.ends, values)?;
    conforming::bubbles(mesh, edges, u, lower, given.ends, vertices, bubbles)?;
    equilibrium::agree(edges, *stiffness, alpha, &given.boundary, given.loads, iterate, tau)?;
    let s = Continuous { vertices, bubbles };
    let mut parts = over_cells(ground, given, u, s, tau, indicators);
    if let Some(edge) = equilibrium::pulled(edges, &given.boundary, tau) {
        return Ok(Verdict::Pulled { edge });
    }
    boundary::add(ground, given, s, tau, indicators, &mut parts);
    Ok(parts.conclude(ground.reach, given.oscillation))
}

/// The function s: vertex values and bubbles of edges.
#[derive(Debug, Clone, Copy)]
struct Continuous<'a, R> {
    vertices: &'a [R],
    bubbles: &'a [R],
}

impl<R: Real> Continuous<'_, R> {
    fn at<I: Index, const N: usize>(&self, vertices: &[I; N]) -> [R; N] {
        vertices.map(|vertex| read(self.vertices, vertex.at()))
    }

    fn on<I: Index, const N: usize>(&self, edges: &[I; N]) -> [R; N] {
        edges.map(|edge| read(self.bubbles, edge.at()))
    }
}

/// One cell's share of everything.
#[derive(Debug, Clone, Copy)]
struct Share<R> {
    /// ‖A^½∇s − A^{−½}τ‖²
    gap: R,
    /// ‖A^{−½}(τ − σ_h)‖²
    algebraic: R,
    /// The square of what rounding can have done to the root of `gap`.
    rounding: R,
    /// |∫f| + Σ|τ|, the terms of the balance.
    terms: R,
}

/// Sums over the mesh.
#[derive(Debug, Clone, Copy, Default)]
struct Parts<R> {
    gap: Sum<R>,
    algebraic: Sum<R>,
    rounding: R,
    /// What rounding can have done to `gap` itself.
    direct: R,
    terms: R,
}

impl<R: Real> Parts<R> {
    #[inline(always)]
    fn add(&mut self, share: Share<R>) {
        self.gap.add(share.gap);
        self.algebraic.add(share.algebraic);
        self.rounding += share.rounding;
        self.terms += share.terms;
    }

    fn conclude(&self, reach: R, oscillation: R) -> Verdict<R> {
        let gap = self.gap.value().or_larger(R::ZERO).rounded_sqrt();
        let few = R::from_count(16) * R::EPSILON;
        let unbalanced = R::TWO * R::EPSILON * self.terms;
        let lifted = (gap * gap + self.direct).rounded_sqrt().or_larger(gap) - gap;
        let rounding = self.rounding.rounded_sqrt() + lifted + reach * unbalanced + few * gap;
        let both = (gap * gap + oscillation * oscillation).rounded_sqrt();
        let certificate = Certificate {
            gap,
            algebraic: self.algebraic.value().or_larger(R::ZERO).rounded_sqrt(),
            oscillation,
            rounding,
            // √(gap²) under- or overflows before gap does.
            total: oscillation + both.or_larger(gap) + rounding,
        };
        let known = certificate.total.finite() && certificate.algebraic.finite();
        if known { Verdict::Certified(certificate) } else { Verdict::NotFinite }
    }
}

/// The walk over the cells from the leaves: balances each and takes its share.
fn over_cells<R: Real, I: Index>(
    ground: &Ground<R, I>,
    given: &Given<R, I>,
    u: &[R],
    s: Continuous<R>,
    tau: &mut [R],
    indicators: &mut [R],
) -> Parts<R> {
    let (edges, loads) = (&ground.edges, given.loads);
    let (halves, triangles) = (edges.half_edges(), edges.of_triangles().len());
    let mut parts = Parts::default();
    for (cell, parent) in ground.forest.from_leaves() {
        let share = if let Some(sides) = edges.of_triangles().get(cell) {
            let load = read(loads.triangles, cell);
            let out = Cell::new(3 * cell, *sides).settle(halves, parent, load, tau);
            let means = sides.map(|edge| read(u, edge.at()));
            let k = read(ground.stiffness.triangles, cell);
            let at = s.at(&read(ground.mesh.triangles(), cell));
            triangle::share(ground.metric.of_triangle(cell), &k, at, out, means, load)
        } else {
            let at = cell - triangles;
            let (sides, load) = (read(edges.of_quads(), at), read(loads.quads, at));
            let first = 3 * triangles + 4 * at;
            let out = Cell::new(first, sides).settle(halves, parent, load, tau);
            let means = sides.map(|edge| read(u, edge.at()));
            let k = read(ground.stiffness.quads, at);
            let corners = s.at(&read(ground.mesh.quads(), at));
            let metric = ground.metric.of_quad(cell, &k);
            quad::share(metric, &k, corners, s.on(&sides), out, means, load)
        };
        write(indicators, cell, share.gap);
        parts.add(share);
    }
    parts
}

/// The largest ‖A^{−½}·‖ of a flux that brings 1 from a cell along the forest to its root;
/// `way` is scratch with one entry a cell.
///
/// # Errors
/// A scratch of the wrong length.
pub fn reach<R: Real, I: Index>(
    edges: &Edges<I>,
    stiffness: Stiffness<R>,
    metric: Metric<R>,
    forest: &Forest<I>,
    way: &mut [R],
) -> Result<R, Error> {
    same_length(Array::Scratch, way.len(), edges.cells())?;
    let energy = |cell: usize, through: &dyn Fn(usize) -> R| {
        let sides = edges.sides_of(cell);
        if sides.len() == 3 {
            let out = [0, 1, 2].map(|k| through(sides.start + k));
            let k = read(stiffness.triangles, cell);
            triangle::energy(metric.of_triangle(cell), &k, out)
        } else {
            let out = [0, 1, 2, 3].map(|k| through(sides.start + k));
            let k = read(stiffness.quads, cell - edges.of_triangles().len());
            quad::energy(metric.of_quad(cell, &k), out)
        }
    };
    let mut farthest = R::ZERO;
    for (cell, parent) in forest.from_roots() {
        let on = match edges.beyond(parent) {
            None => R::ZERO,
            Some((entry, next)) => {
                let leaves = forest.parent(next);
                let passing = |half: usize| match half {
                    _ if half == entry.at() => -R::ONE,
                    _ if half == leaves => R::ONE,
                    _ => R::ZERO,
                };
                read(way, next) + energy(next, &passing)
            }
        };
        write(way, cell, on);
        let leaving = |half: usize| if half == parent { R::ONE } else { R::ZERO };
        farthest = farthest.or_larger(on + energy(cell, &leaving));
    }
    Ok(farthest.rounded_sqrt())
}

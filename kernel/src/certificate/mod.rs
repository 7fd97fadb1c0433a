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
//! * The small difference A∇s − τ is formed from large terms: its error, at most 2 ε times their sum,
//!   goes through the same quadratic form, and the root of the sum is added.
//! * Data are rounded once when they are stored: a boundary value moves by ε|u_D|, and the energy of
//!   such a ripple on the cells along the boundary is added too.
//!
//! * Squares of numbers near the smallest normal one are lost: a root of that number is added.
//!
//! All of it is [`Certificate::rounding`]: on well-shaped cells about 1e−12 of the solution in `f64` and 1e−4 in
//! `f32`, more where u is large against its changes or cells are thin.

mod boundary;
mod metric;
mod quad;
mod sum;
mod triangle;

pub use boundary::Curved;
pub use metric::{Metric, POINTS, of_quad, of_triangle};

use crate::assembly::CellLoads;
use crate::averages;
use crate::boundary::Boundary;
use crate::cells::{Cells, Either, Quad, Triangle, pick};
use crate::conforming::{self, VertexData};
use crate::edges::Edges;
use crate::equilibrium::{self, Iterate};
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::forest::Forest;
use crate::index::{Index, read, write};
use crate::mesh::Mesh;
use crate::real::Real;
use crate::stiffness::Stiffness;
use quad::Values;
use sum::Sum;

/// What stays from one certificate to the next: mesh, A and the ways out (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Ground<'a, R, I> {
    /// The mesh; of its coordinates nothing is read.
    pub mesh: Mesh<'a, R, I>,
    /// Its numbered edges.
    pub edges: Edges<'a, I>,
    /// Element matrices in the order of the mesh, from which a tick lays out its rows.
    pub stiffness: Stiffness<'a, R>,
    /// Cells with their element matrices, from leaves to roots.
    pub cells: Cells<'a, R, I>,
    /// A in reference coordinates where it varies inside a cell.
    pub metric: Metric<'a, R>,
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
    /// ‖A^{−½}(τ − σ_h)‖, with ∫_R ((τ − σ_h)·n)²/h where there is a Robin boundary: what more sweeps
    /// would remove.
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
    let Ground { mesh, edges, cells, .. } = ground;
    let Buffers { vertices, bubbles, tau, indicators } = buffers;
    let (u, lower) = (iterate.u, iterate.lower);
    same_length(Array::Triangles, cells.triangles.len(), edges.of_triangles().len())?;
    same_length(Array::Quads, cells.quads.len(), edges.of_quads().len())?;
    same_length_or_empty(Array::Scratch, indicators.len(), edges.cells())?;
    same_length_or_empty(Array::Robin, given.transfer.len(), given.boundary.robin().len())?;
    averages::fill(cells, given.loads, u, vertices, tau)?;
    conforming::impose(mesh, edges, u, lower, given.ends, vertices)?;
    conforming::bubbles(mesh, edges, u, lower, given.ends, vertices, bubbles)?;
    equilibrium::impose(edges, &given.boundary, iterate, tau);
    let s = Continuous { vertices, bubbles };
    let mut parts = over_cells(ground, given, u, s, tau, indicators);
    if let Some(edge) = equilibrium::pulled(edges, &given.boundary, tau) {
        return Ok(Verdict::Pulled { edge });
    }
    boundary::add(ground, given, u, s, tau, indicators, &mut parts);
    Ok(parts.conclude(cells.len(), ground.reach, given.oscillation))
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
    /// The quadratic form of `gap` with all terms of A∇s − τ added up instead of cancelling.
    doubt: R,
    /// (∫f)² + Στ², the terms of the balance.
    terms: R,
}

/// Sums over the mesh.
#[derive(Debug, Clone, Copy, Default)]
struct Parts<R> {
    gap: Sum<R>,
    algebraic: R,
    doubt: R,
    /// The square of what storing the data has done.
    ripple: R,
    /// What rounding can have done to `gap` itself.
    direct: R,
    terms: R,
}

impl<R: Real> Parts<R> {
    #[inline(always)]
    fn add(&mut self, share: Share<R>) {
        self.gap.add(share.gap);
        self.algebraic += share.algebraic;
        self.doubt += share.doubt;
        self.terms += share.terms;
    }

    /// `cells`: how many there are.
    fn conclude(&self, cells: usize, reach: R, oscillation: R) -> Verdict<R> {
        let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
        let gap = root(self.gap.value());
        let times = |count: u32| R::from_count(count) * R::EPSILON;
        // A difference of 4 terms, each rounded 4 times: half an ε of each, and (Σ|x|)² ≤ 4 Σx².
        let doubt = times(4) * root(self.doubt);
        // A sum of 4 terms at most, and of all cells (Σ|ρ|)² ≤ cells · Σρ².
        let unbalanced = times(2) * root(R::from_count(cells as u32) * self.terms);
        let lifted = root(gap * gap + self.direct).or_larger(gap) - gap;
        // Squares below the smallest normal number are lost, some in every cell.
        let lost = (R::ONE + reach) * root(R::from_count(16 * cells as u32) * R::TINY);
        let rounding =
            doubt + reach * unbalanced + root(self.ripple) + lifted + lost + times(16) * gap;
        let both = root(gap * gap + oscillation * oscillation);
        let certificate = Certificate {
            gap,
            algebraic: root(self.algebraic),
            oscillation,
            rounding,
            // √(gap²) underflows before gap does.
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
    let cells = &ground.cells;
    if cells.quads.is_empty() && ground.metric.place.is_empty() && indicators.is_empty() {
        return over_triangles(cells.triangles, given.loads.triangles, u, s.vertices, tau);
    }
    let mut parts = Parts::default();
    for cell in cells.from_leaves() {
        let (number, share) = match cell {
            Either::Triangle(cell) => {
                let load = read(given.loads.triangles, cell.number.at());
                (cell.number, of_triangle_cell(ground.metric, cell, s, u, load, tau))
            }
            Either::Quad(cell) => {
                let number = cell.number.at().wrapping_sub(cells.triangles.len());
                let load = read(given.loads.quads, number);
                (cell.number, of_quad_cell(ground.metric, cell, s, u, load, tau))
            }
        };
        let Some(share) = share else { break };
        write(indicators, number.at(), share.gap);
        parts.add(share);
    }
    parts
}

/// The same for triangles with constant A alone, without indicators: the loop of a control loop. A
/// function of its own, with few slices, keeps its pointers in registers.
#[inline(never)]
fn over_triangles<R: Real, I: Index>(
    cells: &[Triangle<R, I>],
    loads: &[R],
    u: &[R],
    vertices: &[R],
    tau: &mut [R],
) -> Parts<R> {
    let mut parts = Parts::default();
    for cell in cells {
        let load = read(loads, cell.number.at());
        let Some(out) = cell.settle(load, tau) else { break };
        let (s, means) = (pick(&cell.vertices, vertices), pick(&cell.edges, u));
        let (Some(s), Some(means)) = (s, means) else { break };
        parts.add(triangle::share(cell, s, out, means, load));
    }
    parts
}

fn of_triangle_cell<R: Real, I: Index>(
    metric: Metric<R>,
    cell: &Triangle<R, I>,
    s: Continuous<R>,
    u: &[R],
    load: R,
    tau: &mut [R],
) -> Option<Share<R>> {
    let out = cell.settle(load, tau)?;
    let (s, u) = (pick(&cell.vertices, s.vertices)?, pick(&cell.edges, u)?);
    Some(match metric.varying(cell.number.at()) {
        None => triangle::share(cell, s, out, u, load),
        Some(points) => {
            let (k, s) = (cell.stiffness_in_mesh(), cell.vertices_in_mesh(s));
            let [out, u] = [out, u].map(|packed| cell.sides_in_mesh(packed));
            triangle::share_at_points(points, &k, s, out, u, load)
        }
    })
}

fn of_quad_cell<R: Real, I: Index>(
    metric: Metric<R>,
    cell: &Quad<R, I>,
    s: Continuous<R>,
    u: &[R],
    load: R,
    tau: &mut [R],
) -> Option<Share<R>> {
    let out = cell.settle(load, tau)?;
    let (corners, u) = (pick(&cell.vertices, s.vertices)?, pick(&cell.edges, u)?);
    let bubbles = pick(&cell.edges, s.bubbles)?;
    Some(match metric.varying(cell.number.at()) {
        None => quad::share(cell, Values { corners, bubbles }, out, u, load),
        Some(points) => {
            let difference = cell.sides_in_mesh(quad::difference(cell, out, u, load));
            let (corners, bubbles) = (cell.vertices_in_mesh(corners), cell.sides_in_mesh(bubbles));
            let out = cell.sides_in_mesh(out);
            quad::share_at_points(points, Values { corners, bubbles }, out, difference, load)
        }
    })
}

/// The largest ‖A^{−½}·‖ of a flux that brings 1 from a cell along the forest to its root;
/// `way` is scratch with one entry a cell.
///
/// # Errors
/// A scratch of the wrong length.
pub fn reach<R: Real, I: Index>(
    edges: &Edges<I>,
    cells: &Cells<R, I>,
    metric: Metric<R>,
    forest: &Forest<I>,
    way: &mut [R],
) -> Result<R, Error> {
    same_length(Array::Scratch, way.len(), edges.cells())?;
    way.fill(R::ZERO);
    // From the leaves: a cell does not know yet what its way costs, so each writes what passing it from
    // each side costs into the cell on that side; then from the roots these costs add up.
    for cell in cells.from_leaves() {
        let (number, of_cell) = match cell {
            Either::Triangle(cell) => (cell.number.at(), cell.edges.as_slice()),
            Either::Quad(cell) => (cell.number.at(), cell.edges.as_slice()),
        };
        let last = of_cell.len() - 1;
        for half in edges.sides_of(number) {
            let Some((entry, behind)) = edges.beyond(half) else { continue };
            let edge = edges.edge_of(half);
            let packed = of_cell.iter().position(|other| other.at() == edge);
            if forest.parent(behind) != entry.at() || packed == Some(last) {
                continue;
            }
            let through = |k: usize| match k {
                _ if Some(k) == packed => -R::ONE,
                _ if k == last => R::ONE,
                _ => R::ZERO,
            };
            write(way, behind, energy(metric, cell, through));
        }
    }
    for (number, parent) in forest.from_roots() {
        if let Some((_, next)) = edges.beyond(parent) {
            let sum = read(way, number) + read(way, next);
            write(way, number, sum);
        }
    }
    let mut farthest = R::ZERO;
    for cell in cells.from_leaves() {
        let (number, last) = match cell {
            Either::Triangle(cell) => (cell.number, 2),
            Either::Quad(cell) => (cell.number, 3),
        };
        let out = |k: usize| if k == last { R::ONE } else { R::ZERO };
        farthest = farthest.or_larger(read(way, number.at()) + energy(metric, cell, out));
    }
    Ok(farthest.rounded_sqrt())
}

/// ‖A^{−½}·‖² of the field with these outward fluxes through the packed sides of a cell.
fn energy<R: Real, I: Index>(metric: Metric<R>, cell: Either<R, I>, out: impl Fn(usize) -> R) -> R {
    match cell {
        Either::Triangle(cell) => {
            let points = metric.varying(cell.number.at());
            triangle::energy(cell, points, [0, 1, 2].map(out))
        }
        Either::Quad(cell) => {
            let points = metric.varying(cell.number.at());
            quad::energy(cell, points, [0, 1, 2, 3].map(out))
        }
    }
}

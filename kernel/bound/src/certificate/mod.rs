//! A guaranteed bound of the error, from any iterate: how wrong the answer can be.
//!
//! For any s in H¹ with s = u_D on D and s ≥ ψ on C, and any τ in H(div) with ∇·τ + f = 0, τ·n = g on
//! N and τ·n ≥ q on C,
//! ```text
//!   gap² = ‖A^½∇s − A^{−½}τ‖² + 2∫_C (τ·n − q)(s − ψ) + ∫_R (τ·n + h(s − u_ext))²/h
//!        = ‖A^½∇(u − s)‖² + ‖A^{−½}(σ − τ)‖² + ∫_R h(u − s)² + ∫_R ((σ − τ)·n)²/h
//!          + 2∫_C [(σ·n − q)(s − ψ) + (τ·n − q)(u − ψ)],          every term ≥ 0:
//! ```
//! an identity without an unknown constant. Where the flux on C has two ends, lo ≤ τ·n ≤ hi, s may be below ψ where hi is
//! finite, the contact term is 2∫_C (τ·n − lo)(s − ψ)⁺ + (hi − τ·n)(ψ − s)⁺, and each of the last two terms is the same of
//! (σ, s) and (τ, u). s comes from [`crate::conforming`], τ from
//! [`crate::equilibrium`]; f, g and q are there means over cells and edges, and what they leave out,
//! the oscillation, is a number of the caller's: total = osc + √(gap² + osc²) + rounding.
//!
//! The identity is about s and τ. The function u_h of the edge means is another one, discontinuous, and by the
//! triangle inequality
//! ```text
//!   of_u = total + ‖A^½∇_h(s − u_h)‖ ≥ ‖A^½∇_h(u − u_h)‖.
//! ```
//!
//! ## What rounding may do
//!
//! The bound is a statement about numbers that were computed, so it must hold for those:
//! * s and τ are *defined* by the floating-point numbers at vertices and on edges.
//! * The walk leaves ∇·τ + f = ρ/|T| with |ρ| of a few ε times the terms of a cell. Sending each ρ
//!   along the forest to its root changes ‖A^{−½}τ‖ by at most [`Stability::largest`] Σ|ρ|, and by [`Stability::weighed`] times a
//!   sum in which each ρ counts as its cell conducts; the smaller of both is added.
//! * The small difference A∇s − τ is formed from large terms: its error, at most 2 ε times their sum,
//!   goes through the same quadratic form, and the root of the sum is added.
//! * Data are rounded once when they are stored: a boundary value moves by ε|u_D|, and the energy of
//!   such a perturbation on the cells along the boundary is added too.
//!
//! * Squares of numbers near the smallest normal one are lost: a root of that number is added.
//!
//! * Element matrices are rounded once. What that hides, where shape and A are oblique together, is a share of all that is
//!   drawn from them: [`Stability::oblique`] of the bound is added.
//!
//! All of it is [`Certificate::rounding`]: on well-shaped cells about 1e−12 of the solution in `f64` and 1e−4 in
//! `f32`, more where u is large against its changes or cells are thin.

mod boundary;
mod change;
mod extension;
mod factor;
mod in_step;
mod metric;
mod motion;
mod moving;
mod parts;
mod quad;
mod stability;
mod step;
mod stored;
mod transfer;
mod triangle;
mod walk;

pub use extension::{Curved, is_clear};
pub use factor::{Above, ENTRIES, Factor};
pub use in_step::WAYS;
pub use metric::{Metric, POINTS, of_quad, of_triangle};
pub use motion::openings;
pub use signorini_kernel::verdict::{Certificate, Verdict};
pub use stability::stability;
pub use step::{Handed, Judged, certify_step, certify_step_with};
pub use stored::{Step, StoredCell};
pub use transfer::TransferForms;

use quad::Values;

use crate::averages;
use crate::cells::{Cells, Quad, pick};
use crate::conforming::{self, VertexData};
use crate::equilibrium::{self, Iterate};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::error::{Array, Error, same_length, same_length_or_empty};
use signorini_kernel::index::{Index, read};
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::storage::Storage;
use signorini_kernel::{Mesh, Real};

/// Cost of surplus in the cells. With w_T = ‖A^{−½}·‖ of the flux that brings 1 from cell T along the forest to its
/// root, surplus ρ_T in every cell takes Σ w_T |ρ_T| at most: no more than either of
/// ```text
///   largest · Σ|ρ_T|        weighed · Σ √d_T |ρ_T|,     d_T the factor of a flux's square in the uncertainty, about 1/A.
/// ```
/// Where conductivities jump, the second knows that large fluxes stand beside small w_T.
///
/// Where shape and A of a cell are oblique together, the entries of its element matrix cancel in det A. Rounded, they carry ε
/// times κ = (terms of det A, added up)/(det A) of the cell's energy, which each step of the bound sees: all of it is less than
/// 64 ε κ of the bound.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stability<R> {
    /// max w_T
    pub largest: R,
    /// max w_T/√d_T
    pub weighed: R,
    /// 64 ε max κ
    pub oblique: R,
}

/// Data that stay from one certificate to the next: mesh, A and the ways out (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Discretization<'a, R, I> {
    /// The mesh; of its coordinates nothing is read.
    pub mesh: Mesh<'a, R, I>,
    /// Its numbered edges.
    pub edges: Edges<'a, I>,
    /// Element matrices in the order of the mesh, from which a tick lays out its rows.
    pub stiffness: Stiffness<'a, R>,
    /// Cells with their element matrices, from leaves to roots.
    pub cells: Cells<'a, R, I>,
    /// A in reference coordinates where it varies inside a cell, and the distortions of quads.
    pub metric: Metric<'a, R>,
    /// Largest effect of rounding: [`stability`].
    pub stability: Stability<R>,
}

/// Loads and boundary data of one tick (borrowed).
#[derive(Debug, Clone, Copy, Default)]
pub struct LoadCase<'a, R, I> {
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
    /// Transfer edges whose 8 points do not see h: one record of all, or none.
    pub forms: &'a [TransferForms<'a, R, I>],
    /// Part of f, g and q that their means leave out: √Σ_T (osc_T + Σ_{E⊂∂T} osc_E)².
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

/// Bounds the error of an iterate.
///
/// # Errors
/// Arrays of the wrong length.
// Inlined, and what it alone calls: behind so many checks the compiler takes it for code that hardly runs, and keeps it apart.
#[inline(always)]
pub fn certify<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    iterate: Iterate<R>,
    buffers: Buffers<R>,
) -> Result<Verdict<R>, Error> {
    certify_with(discretization, given, iterate, buffers, |_, _| ())
}

/// Bounds the error with what `moved` makes of s at the vertices and of its bubbles: on D and C they have to stay.
///
/// # Errors
/// As for [`certify`].
#[inline(always)]
pub fn certify_with<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    iterate: Iterate<R>,
    buffers: Buffers<R>,
    moved: impl FnOnce(&mut [R], &mut [R]),
) -> Result<Verdict<R>, Error> {
    let Discretization { edges, cells, .. } = discretization;
    let mut buffers = buffers;
    admissible(discretization, (given, None), iterate, &mut buffers, moved)?;
    let Buffers { vertices, bubbles, tau, indicators } = buffers;
    equilibrium::impose(edges, &given.boundary, iterate, tau);
    let s = Continuous { vertices, bubbles };
    let mut parts = walk::over_cells(discretization, given, iterate.u, s, tau, indicators);
    if let Some(edge) = equilibrium::pulled(edges, &given.boundary, tau) {
        return Ok(Verdict::Pulled { edge });
    }
    boundary::add(discretization, given, iterate, (s, tau), indicators, &mut parts, |_, _, _| ());
    parts.perturbation += boundary::perturbation(discretization, given, iterate.law, s);
    let missed = discretization.metric.missed;
    Ok(parts.conclude(cells.len(), (discretization.stability, missed), given.oscillation))
}

/// Fills s, and τ with the means of fluxes over the cells of each edge, in a step with what these store.
#[inline(always)]
fn admissible<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    (given, stored): (&LoadCase<R, I>, Option<Storage<R>>),
    iterate: Iterate<R>,
    buffers: &mut Buffers<R>,
    moved: impl FnOnce(&mut [R], &mut [R]),
) -> Result<(), Error> {
    let Discretization { mesh, edges, cells, .. } = discretization;
    let Buffers { vertices, bubbles, tau, indicators } = buffers;
    let (u, law) = (iterate.u, iterate.law);
    same_length(Array::Triangles, cells.triangles.len(), edges.of_triangles().len())?;
    same_length(Array::Quads, cells.quads.len(), edges.of_quads().len())?;
    same_length_or_empty(Array::Scratch, indicators.len(), edges.cells())?;
    same_length_or_empty(Array::Robin, given.transfer.len(), given.boundary.robin().len())?;
    let distortions = discretization.metric.distortions;
    averages::fill(cells, (given.loads, stored), distortions, u, vertices, tau)?;
    if law.is_limited() {
        let gap = given.ends.gap;
        conforming::relax_to_gap(mesh, edges, discretization.stiffness, u, law, gap, vertices);
    }
    conforming::impose(mesh, edges, u, law, given.ends, vertices)?;
    conforming::bubbles(mesh, edges, u, law, given.ends, vertices, bubbles)?;
    moved(vertices, bubbles);
    Ok(())
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

    /// The same on a quad, as it is packed.
    #[inline(always)]
    fn in_quad<I: Index>(&self, cell: &Quad<R, I>) -> Option<Values<R>> {
        let corners = pick(&cell.vertices, self.vertices)?;
        Some(Values { corners, bubbles: pick(&cell.edges, self.bubbles)? })
    }
}

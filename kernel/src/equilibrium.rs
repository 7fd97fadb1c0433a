//! A flux that is admissible, from one that is not yet: the equilibrated τ of the error bound.
//!
//! The fluxes of the cells, formula (15), balance every cell but disagree across an edge while the
//! solver has not converged. τ has one value an edge and satisfies, up to rounding,
//! ```text
//!   Σ_i τ_i = −∫_T f on every cell,    τ = ∫g on N,    τ ≥ ∫q on C,    τ = ∫q where u > ψ.
//! ```
//! In two steps: one value an edge, and then a walk over the cells from the leaves of a forest to its
//! roots that hands each cell's surplus on through its parent side. Inside, the two sides of an edge
//! are weighted by 1/α, so that the soft cell decides: at jumps of 10⁴ plain means cost a factor
//! of 10 to 40 in the bound.

use crate::assembly::CellLoads;
use crate::boundary::Boundary;
use crate::edges::{Block, Edges};
use crate::error::{Array, Error, same_length, same_length_or_empty};
use crate::forest::Forest;
use crate::index::{Index, read};
use crate::real::Real;

/// Outward fluxes through the sides of all cells, as [`crate::flux::of_triangles`] and
/// [`crate::flux::of_quads`] fill them (borrowed).
#[derive(Debug)]
pub struct CellFluxes<'a, R> {
    /// Through the sides of each triangle.
    pub triangles: &'a mut [[R; 3]],
    /// Through the sides of each quad.
    pub quads: &'a mut [[R; 4]],
}

impl<R: Real> CellFluxes<'_, R> {
    /// The flux through a half-edge.
    pub fn through(&self, half_edge: usize) -> R {
        match half_edge.checked_sub(3 * self.triangles.len()) {
            None => read(self.triangles.as_flattened(), half_edge),
            Some(rest) => read(self.quads.as_flattened(), rest),
        }
    }

    fn set(&mut self, half_edge: usize, flux: R) {
        let place = match half_edge.checked_sub(3 * self.triangles.len()) {
            None => self.triangles.as_flattened_mut().get_mut(half_edge),
            Some(rest) => self.quads.as_flattened_mut().get_mut(rest),
        };
        if let Some(place) = place {
            *place = flux;
        }
    }
}

/// What became of the surplus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Balance {
    /// τ is admissible.
    Admissible,
    /// Nothing but contact edges can take the surplus of a part, and at this one it leaves less than
    /// q: the loads pull, or the iterate is too far off. There is no bound.
    PullsOnContact {
        /// The edge.
        edge: usize,
    },
}

/// The iterate whose fluxes are equilibrated.
#[derive(Debug, Clone, Copy)]
pub struct Iterate<'a, R> {
    /// Means of u, one an edge.
    pub u: &'a [R],
    /// Means of ψ, one a contact edge.
    pub lower: &'a [R],
}

/// Turns `fluxes` into τ; `softness` is 1/α of every cell, positive, triangles first.
///
/// # Errors
/// Arrays of the wrong length.
pub fn equilibrate<R: Real, I: Index>(
    edges: &Edges<I>,
    forest: &Forest<I>,
    softness: &[R],
    boundary: &Boundary<R, I>,
    loads: CellLoads<R>,
    iterate: Iterate<R>,
    fluxes: &mut CellFluxes<R>,
) -> Result<Balance, Error> {
    let (triangles, quads) = (edges.of_triangles().len(), edges.of_quads().len());
    same_length(Array::Coefficients, softness.len(), edges.cells())?;
    same_length(Array::Unknowns, iterate.u.len(), edges.counts().edges())?;
    same_length(Array::LowerBounds, iterate.lower.len(), edges.counts().contact)?;
    same_length(Array::Fluxes, fluxes.triangles.len(), triangles)?;
    same_length(Array::Fluxes, fluxes.quads.len(), quads)?;
    same_length_or_empty(Array::CellLoads, loads.triangles.len(), triangles)?;
    same_length_or_empty(Array::CellLoads, loads.quads.len(), quads)?;
    agree(edges, softness, boundary, iterate, fluxes);
    walk(edges, forest, loads, fluxes);
    Ok(judge(edges, boundary, fluxes))
}

/// One value an edge.
fn agree<R: Real, I: Index>(
    edges: &Edges<I>,
    softness: &[R],
    boundary: &Boundary<R, I>,
    iterate: Iterate<R>,
    fluxes: &mut CellFluxes<R>,
) {
    let counts = edges.counts();
    for (at, pair) in edges.half_edges().iter().enumerate() {
        let [first, second] = pair.map(Index::at);
        let own = fluxes.through(first);
        if pair[1] != I::NONE {
            let soft = |half| edges.cell_of(half).map_or(R::ZERO, |cell| read(softness, cell));
            let (here, beyond) = (soft(first), soft(second));
            let mean = (own * here - fluxes.through(second) * beyond) / (here + beyond);
            fluxes.set(first, mean);
            fluxes.set(second, -mean);
            continue;
        }
        match counts.block(at) {
            Block::Free => fluxes.set(first, R::ZERO),
            Block::Contact => {
                let contact = at - counts.free;
                let given = boundary.contact_flux(contact);
                let open = read(iterate.u, at) > read(iterate.lower, contact);
                fluxes.set(first, if open { given } else { own.or_larger(given) });
            }
            Block::Dirichlet => {}
        }
    }
    let first = |edge: I| read(edges.half_edges(), edge.at())[0].at();
    for record in boundary.neumann() {
        let half = first(record.edge);
        fluxes.set(half, fluxes.through(half) + record.flux);
    }
    for record in boundary.robin() {
        let half = first(record.edge);
        let law = record.ambient - record.coefficient * read(iterate.u, record.edge.at());
        fluxes.set(half, fluxes.through(half) + law);
    }
}

/// Hands each cell's surplus on through its parent side.
fn walk<R: Real, I: Index>(
    edges: &Edges<I>,
    forest: &Forest<I>,
    loads: CellLoads<R>,
    fluxes: &mut CellFluxes<R>,
) {
    let triangles = edges.of_triangles().len();
    for (cell, parent) in forest.from_leaves() {
        let load = match cell.checked_sub(triangles) {
            None => read(loads.triangles, cell),
            Some(quad) => read(loads.quads, quad),
        };
        let others = edges.sides_of(cell).filter(|&half| half != parent);
        let out = others.fold(-load, |rest, half| rest - fluxes.through(half));
        fluxes.set(parent, out);
        if let Some((beyond, _)) = edges.beyond(parent) {
            fluxes.set(beyond.at(), -out);
        }
    }
}

/// Contact edges may have taken a surplus; they must not be pulled at.
fn judge<R: Real, I: Index>(
    edges: &Edges<I>,
    boundary: &Boundary<R, I>,
    fluxes: &CellFluxes<R>,
) -> Balance {
    let counts = edges.counts();
    let pulled = (0..counts.contact).find(|&contact| {
        let half = read(edges.half_edges(), counts.free + contact)[0].at();
        !(fluxes.through(half) >= boundary.contact_flux(contact))
    });
    match pulled {
        Some(contact) => Balance::PullsOnContact { edge: counts.free + contact },
        None => Balance::Admissible,
    }
}

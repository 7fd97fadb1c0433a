//! What rounding does to loads that a target adds up, where inputs may cancel what the scene states.
//!
//! A load Σ p_j L_j of m terms is off by at most ½(m + 2) ε Σ|p_j L_j|: each is narrowed, multiplied and added. As a change of the data
//! this moves u, with m ≥ 2 where anything can cancel, by
//! ```text
//!   Σ_T reach_T δ_T + Σ_E (reach_T + off_E) δ_E + Σ_R min(reach_T + off_E, 1/√H) δ_R + (Σ_R H δu_ext²)^½
//! ```
//! in ‖A^½∇·‖. Here reach_T brings 1 from a cell to where it can leave, or be stored; off_E is what a mean along
//! an edge differs from that in its cell, H the least ∫h. The last sum is of u_ext at points, where these stand beside ∫h u_ext.
//! The kernel's own allowance knows only the sum of the terms, which may be a small difference. Ends of a flux that cross by rounding
//! have gone to their mean, which is a load of the same kind.

use signorini_kernel::mesh::boundary::Robin;

use signorini_certify::oscillation::off_mean;
use signorini_certify::{Certifier, TermData};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Problem, TransferPattern};

use super::pattern::fluxes;

/// What a load of 1 that is not there costs.
#[derive(Debug)]
pub(super) struct Reach<'a> {
    /// With the least ∫h.
    least: &'a Problem,
    /// In each cell.
    of_cells: Vec<f64>,
}

/// Numbers ≥ 0 by place: of cells, Neumann records, contact fluxes, spans, and ∫h u_ext of transfer laws.
type Places = [Vec<f64>; 5];

/// Some of the [`Places`].
const CONTACT: usize = 2;
const AMBIENT: usize = 4;

impl<'a> Reach<'a> {
    /// Where `certifier` balances the mesh of `least` at the cost `largest` of the farthest cell.
    pub fn new<R: Scalar>(least: &'a Problem, certifier: &Certifier<R>, largest: R) -> Self {
        let stored = |cell: usize| 1.0 / least.loads.content(cell).sqrt();
        let costs: Vec<f64> = (0..least.cells()).map(stored).collect();
        let way = largest.wide()
            + match certifier.hands_on() {
                true => 0.0,
                false => {
                    costs.iter().filter(|cost| cost.is_finite()).fold(0.0, |a: f64, b| a.max(*b))
                }
            };
        Self { least, of_cells: costs.into_iter().map(|cost| cost.min(way)).collect() }
    }

    fn of_edge(&self, edge: usize) -> f64 {
        let (cell, _) = self.least.topology.first_side(edge);
        self.of_cells[cell] + off_mean(self.least, edge)
    }

    fn of_places(&self, neumann: &[u32]) -> Places {
        let counts = self.least.topology.counts;
        let contact: Vec<f64> =
            (counts.free..counts.unknowns()).map(|edge| self.of_edge(edge)).collect();
        let of_law = |law: &Robin<f64, u32>| {
            self.of_edge(law.edge as usize).min(1.0 / law.coefficient.sqrt())
        };
        [
            self.of_cells.clone(),
            neumann.iter().map(|&edge| self.of_edge(edge as usize)).collect(),
            contact.clone(),
            contact,
            self.least.loads.robin.iter().map(of_law).collect(),
        ]
    }

    /// By how much each term of the data, base first, may move u for each unit of its input.
    pub fn lost(&self, parts: &[TermData], neumann: &[u32], epsilon: f64) -> Vec<f64> {
        let mut amounts: Vec<Places> = parts.iter().map(|part| amounts(part, neumann)).collect();
        self.add_products(parts, &mut amounts);
        let (costs, most) = (self.of_places(neumann), self.most_transfer(parts));
        let share = |kind: usize, at: usize| {
            let acts = |of: &&Places| of[kind].get(at).is_some_and(|&amount| amount > 0.0);
            let terms = amounts.iter().filter(acts).count();
            if terms < 2 { 0.0 } else { 0.5 * (terms + 2) as f64 * epsilon }
        };
        let of_term = |(part, of): (&TermData, &Places)| {
            let of_kind = |kind: usize| {
                let places = of[kind].iter().zip(&costs[kind]).enumerate();
                let acts = places.filter(|(_, (amount, _))| **amount > 0.0);
                acts.map(|(at, (amount, cost))| share(kind, at) * amount * cost).sum::<f64>()
            };
            let along = part.transfer.iter().zip(&most).enumerate().map(|(at, (points, most))| {
                let ambient = points.iter().fold(0.0, |most: f64, [_, u]| most.max(u.abs()));
                most * (share(AMBIENT, at) * ambient).powi(2)
            });
            (0..of.len()).map(of_kind).sum::<f64>() + along.sum::<f64>().sqrt()
        };
        let mut lost: Vec<f64> = parts.iter().zip(&amounts).map(of_term).collect();
        if let (Some(first), Some(base)) = (lost.first_mut(), parts.first()) {
            *first += settled(base, &costs[CONTACT]);
        }
        lost
    }

    /// Adds what coefficients within their ranges make of u_ext: p_c ∫π u₀ counts for the coefficient, p_c p_a ∫π w for u_ext.
    fn add_products(&self, parts: &[TermData], amounts: &mut [Places]) {
        for (input, of, most) in self.coefficients(parts) {
            for (term, products) in &of.ambient {
                let (to, factor) = if *term == 0 { (input, 1.0) } else { (*term, most) };
                let sums = amounts[to][AMBIENT].iter_mut().zip(products);
                sums.for_each(|(sum, product)| *sum += factor * product.abs());
            }
        }
    }

    /// The most that |E| h may be along each transfer edge, all its terms added up.
    fn most_transfer(&self, parts: &[TermData]) -> Vec<f64> {
        let largest =
            |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, |a: f64, b| a.max(b.abs()));
        let base = parts.iter().take(1).flat_map(|part| &part.transfer);
        let mut most: Vec<f64> =
            base.map(|points| largest(&mut points.iter().map(|[h, _]| *h))).collect();
        for (_, of, factor) in self.coefficients(parts) {
            let added = of.points.iter().map(|points| largest(&mut points.iter().copied()));
            most.iter_mut().zip(added).for_each(|(most, added)| *most += factor * added);
        }
        most
    }

    /// The terms that change a coefficient, with the largest |p|.
    fn coefficients<'p>(
        &self,
        parts: &'p [TermData],
    ) -> impl Iterator<Item = (usize, &'p TransferPattern, f64)> {
        let inputs = self.least.scene.inputs.iter();
        let most = inputs.map(|input| input.interval().map(f64::abs)).map(|[a, b]| a.max(b));
        let terms = parts.iter().enumerate().skip(1).zip(most.collect::<Vec<_>>());
        terms.filter_map(|((at, part), most)| Some((at, part.coefficient.as_ref()?, most)))
    }
}

/// What ends of contact fluxes that have gone to their mean cost, see [`Loads::moved`](signorini_problem::Loads).
fn settled(base: &TermData, costs: &[f64]) -> f64 {
    let ends = base.spans.iter().zip(costs).filter(|(span, _)| **span == 0.0);
    base.loads().moved * ends.map(|(_, cost)| cost).sum::<f64>()
}

/// The loads of a term.
fn amounts(part: &TermData, neumann: &[u32]) -> Places {
    let size = |all: Vec<f64>| {
        // A span that is ∞ stays it.
        let known = all.into_iter().map(|load| if load.is_finite() { load.abs() } else { 0.0 });
        known.collect::<Vec<_>>()
    };
    let loads = part.loads();
    [
        size([&loads.triangles[..], &loads.quads].concat()),
        size(fluxes(neumann, part)),
        size(loads.contact_flux.clone()),
        size(part.spans.clone()),
        size(loads.robin.iter().map(|law| law.ambient).collect()),
    ]
}

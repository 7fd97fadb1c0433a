//! What rounding does to loads that a target adds up, where inputs may cancel what the scene states.
//!
//! A load Σ p_j L_j of m terms is off by at most ½(m + 2) ε Σ|p_j L_j|: each is narrowed, multiplied and added. As a change of the data
//! this moves u, with m ≥ 2 where anything can cancel, by
//! ```text
//!   Σ_T reach_T δ_T + Σ_E reach_E δ_E + Σ_R min(reach_R, 1/√H) δ_R + (Σ_R H δu_ext²)^½
//! ```
//! in ‖A^½∇·‖, with what a load of 1 costs by [`signorini_certify::reach`] and H the least ∫h. The last sum is of u_ext at points, where
//! these stand beside ∫h u_ext. Products p_c p_a of a coefficient and u_ext are terms of their own, rounded once more. The kernel's own
//! allowance knows only the sum of the terms, which may be a small difference.

use signorini_kernel::mesh::boundary::Robin;

use signorini_certify::TermData;
use signorini_certify::reach::Reach;
use signorini_problem::{Problem, TransferPattern};

use super::pattern::fluxes;

/// Numbers ≥ 0 by place: of cells, Neumann records, contact fluxes, spans, and ∫h u_ext of transfer laws.
type Places = [Vec<f64>; 5];

/// The last of the [`Places`].
const AMBIENT: usize = 4;

/// By how much rounding in a scalar with this `epsilon` may move u in each term of the data, base first, for each unit of its input. The
/// problem has the `least` ∫h; `neumann` are the edges with a record of their flux.
pub(super) fn lost(
    least: &Problem,
    reach: &Reach,
    parts: &[TermData],
    neumann: &[u32],
    epsilon: f64,
) -> Vec<f64> {
    let of_inputs = coefficients(least, parts);
    let mut amounts: Vec<Places> = parts.iter().map(|part| amounts(part, neumann)).collect();
    let mut counts = counts(&amounts);
    for (input, of, most) in &of_inputs {
        for (term, products) in &of.ambient {
            // p_c ∫π u₀ counts for the coefficient, p_c p_a ∫π w for u_ext.
            let (to, factor) = if *term == 0 { (*input, 1.0) } else { (*term, *most) };
            for (at, product) in products.iter().enumerate().filter(|(_, product)| **product != 0.0)
            {
                amounts[to][AMBIENT][at] += factor * product.abs();
                counts[AMBIENT][at] += 2.0;
            }
        }
    }
    let (costs, most) = (costs(least, reach, neumann), most_transfer(parts, &of_inputs));
    let share = |kind: usize, at: usize| match counts[kind][at] {
        terms if terms < 2.0 => 0.0,
        terms => 0.5 * (terms + 2.0) * epsilon,
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
    parts.iter().zip(&amounts).map(of_term).collect()
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

/// How many terms act at each place.
fn counts(amounts: &[Places]) -> Places {
    let mut counts = Places::default();
    for (kind, counts) in counts.iter_mut().enumerate() {
        for of in amounts {
            counts.resize(counts.len().max(of[kind].len()), 0.0);
            let acting = counts.iter_mut().zip(&of[kind]).filter(|(_, amount)| **amount > 0.0);
            acting.for_each(|(count, _)| *count += 1.0);
        }
    }
    counts
}

/// What a load of 1 that is not there costs at each place.
fn costs(least: &Problem, reach: &Reach, neumann: &[u32]) -> Places {
    let contact: Vec<f64> = reach.of_contact().collect();
    let of_law =
        |law: &Robin<f64, u32>| reach.of_edge(law.edge as usize).min(1.0 / law.coefficient.sqrt());
    [
        reach.of_cells().to_vec(),
        neumann.iter().map(|&edge| reach.of_edge(edge as usize)).collect(),
        contact.clone(),
        contact,
        least.loads.robin.iter().map(of_law).collect(),
    ]
}

/// A term that changes a coefficient, what it adds, and the largest |p|.
type OfCoefficient<'a> = (usize, &'a TransferPattern, f64);

fn coefficients<'a>(problem: &Problem, parts: &'a [TermData]) -> Vec<OfCoefficient<'a>> {
    let most = problem.scene.inputs.iter().map(|input| {
        let [a, b] = input.interval().map(f64::abs);
        a.max(b)
    });
    let terms = parts.iter().enumerate().skip(1).zip(most);
    terms.filter_map(|((at, part), most)| Some((at, part.coefficient.as_ref()?, most))).collect()
}

/// The most that |E| h may be along each transfer edge, all its terms added up.
fn most_transfer(parts: &[TermData], of_inputs: &[OfCoefficient]) -> Vec<f64> {
    let largest = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, |a: f64, b| a.max(b.abs()));
    let base = parts.iter().take(1).flat_map(|part| &part.transfer);
    let mut most: Vec<f64> =
        base.map(|points| largest(&mut points.iter().map(|[h, _]| *h))).collect();
    for (_, of, factor) in of_inputs {
        let added = of.points.iter().map(|points| largest(&mut points.iter().copied()));
        most.iter_mut().zip(added).for_each(|(most, added)| *most += factor * added);
    }
    most
}

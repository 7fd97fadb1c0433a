//! Curved edges as functions of the inputs: linear parts, and the energy by polarisation.
//!
//! The energy of Σ p_j w_j is Σ p_j² E_j + Σ_{i<j} p_i p_j (E_ij − E_i − E_j), with E_ij that of w_i + w_j.

use std::collections::{BTreeMap, BTreeSet};

use signorini_bound::certificate;
use signorini_device::full::{CurvedPart, Product};

use signorini_certify::TermData;
use signorini_certify::curved::{Curved, may_be_cleared};
use signorini_certify::term::curved_pair;
use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::scene::term::Term;

/// A curved edge that inputs bend, owned.
#[derive(Debug, Clone)]
pub(super) struct Bent<R> {
    pub edge: u32,
    pub parts: Vec<CurvedPart<R>>,
    pub energy: Vec<Product<R>>,
}

type Edges<R> = (Vec<certificate::Curved<R, u32>>, Vec<Bent<R>>);

/// The curved edges: as records where no input bends an edge, else all of them as sums.
pub(super) fn bent<R: Scalar>(problem: &Problem, parts: &[TermData]) -> Result<Edges<R>> {
    let bends: Vec<Term> =
        (0..parts.len()).filter(|&term| !parts[term].curved.is_empty()).collect();
    if bends.iter().all(|&term| term == 0) {
        let records = parts.iter().flat_map(|part| &part.curved);
        return Ok((records.map(|of| of.narrowed()).collect(), Vec::new()));
    }
    let mut edges = BTreeMap::new();
    for &term in &bends {
        for of in &parts[term].curved {
            let bent = at(&mut edges, of.edge);
            let [mean, peak] = [of.mean, of.peak].map(R::narrow);
            let coupling = of.coupling.map(R::narrow);
            bent.parts.push(CurvedPart { input: term as u16, mean, peak, coupling });
            add(bent, [term; 2], of.energy);
        }
    }
    for (place, &i) in bends.iter().enumerate() {
        for &j in &bends[place + 1..] {
            let [first, second] = [i, j].map(|term| &parts[term].curved);
            let together = curved_pair(problem, [i, j])?;
            // Where one takes back what the other bends, both together have no record.
            let all = first.iter().chain(second).chain(&together).map(|of| of.edge);
            for edge in all.collect::<BTreeSet<u32>>() {
                let alone = energy(first, edge) + energy(second, edge);
                add(at(&mut edges, edge), [i, j], energy(&together, edge) - alone);
            }
        }
    }
    let may = may_be_cleared(problem, edges.keys().map(|&edge| edge as usize));
    for (bent, may) in edges.values_mut().zip(may) {
        if !may {
            bent.parts.iter_mut().for_each(|part| part.peak = R::INFINITY);
        }
    }
    Ok((Vec::new(), edges.into_values().collect()))
}

fn at<R>(edges: &mut BTreeMap<u32, Bent<R>>, edge: u32) -> &mut Bent<R> {
    edges.entry(edge).or_insert_with(|| Bent { edge, parts: Vec::new(), energy: Vec::new() })
}

fn add<R: Scalar>(bent: &mut Bent<R>, [i, j]: [Term; 2], weight: f64) {
    if weight != 0.0 {
        bent.energy.push(Product { inputs: [i as u16, j as u16], weight: R::narrow(weight) });
    }
}

fn energy(records: &[Curved], edge: u32) -> f64 {
    records.iter().find(|record| record.edge == edge).map_or(0.0, |record| record.energy)
}

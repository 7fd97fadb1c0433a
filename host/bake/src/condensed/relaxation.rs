//! The relaxation factor of a condensed problem, found by trying.

use signorini_condense::CondensedModel;

/// Sweeps after which a factor counts as no good.
const MOST: u32 = 400;
/// The sum of changes at which a trial ends, relative to the largest b_i.
const SMALL: f64 = 1e-6;

/// The ω with which sweeps from a cold start at the default inputs end first, `diagonal` being the largest entry on that
/// of the matrix: less than 2 over that.
pub(super) fn best_omega(condensate: &CondensedModel, diagonal: f64) -> f64 {
    let load = condensate.load_of(&condensate.defaults);
    let trial = |omega: f64| (sweeps(condensate, &load, omega), omega);
    let trials = (0..20).map(|step| trial((1.0 + 0.05 * f64::from(step)) / diagonal));
    let fewest = trials.min_by_key(|(sweeps, _)| *sweeps);
    fewest.map_or(1.0 / diagonal, |(_, omega)| omega)
}

fn sweeps(condensate: &CondensedModel, load: &[f64], omega: f64) -> u32 {
    let n = condensate.contact;
    let size = load.iter().fold(0.0, |most: f64, b| most.max(b.abs()));
    let mut x = vec![0.0; n];
    for sweep in 1..MOST {
        let mut moved = 0.0;
        for i in 0..n {
            let row = &condensate.matrix[i * n..(i + 1) * n];
            let product: f64 = row.iter().zip(&x).map(|(entry, x)| entry * x).sum();
            let next = (x[i] - omega * (product - load[i])).max(0.0);
            moved += (next - x[i]).abs();
            x[i] = next;
        }
        if moved <= SMALL * size {
            return sweep;
        }
    }
    MOST
}

//! Weights that keep to what contact leaves of them, and what is left on C nevertheless.

use std::collections::BTreeMap;

use super::contact::ContactEdge;
use super::dual::Weights;
use super::goal::Goal;
use signorini_problem::{EdgeKind, Problem};

/// Terms that the contact edges add to {…}.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Left {
    /// The least c on either side: below 0 and above.
    pub part: [f64; 2],
    /// Terms that are bounded without one.
    pub loose: [f64; 2],
}

/// Moves z at the vertices of C to within `part` of what s leaves. Where edges ask for different values of a vertex it takes the
/// least or the largest of them. Whether they do.
pub(super) fn keep(
    problem: &Problem,
    goal: &Goal,
    edges: &[ContactEdge],
    part: f64,
    takes_least: bool,
    weights: &mut Weights,
) -> bool {
    let mut differ = false;
    let mut asked = BTreeMap::<u32, ([f64; 2], [f64; 2])>::new();
    for of in edges {
        let value = goal.value_on(problem, of.edge);
        weights.bubbles[of.edge] = 0.0;
        for (vertex, clear) in problem.ends[of.edge].into_iter().zip(of.clear) {
            let all = ([f64::NEG_INFINITY, f64::INFINITY], [f64::INFINITY, f64::NEG_INFINITY]);
            let ([low, high], [least, most]) = asked.entry(vertex).or_insert(all);
            let reach = if clear > 0.0 { part * clear } else { 0.0 };
            (*low, *high) = (low.max(value - reach), high.min(value + reach));
            (*least, *most) = (least.min(value), most.max(value));
        }
    }
    for edge in (0..problem.kinds.len()).filter(|&at| problem.kinds[at] == EdgeKind::Dirichlet) {
        for vertex in &problem.ends[edge] {
            asked.remove(vertex);
        }
    }
    for (vertex, ([low, high], [least, most])) in asked {
        let z = &mut weights.vertices[vertex as usize];
        differ |= low > high;
        *z = match low <= high {
            true => z.clamp(low, high),
            false if takes_least => least,
            false => most,
        };
    }
    differ
}

/// Weights that are left on C.
pub(super) fn left(
    problem: &Problem,
    goal: &Goal,
    edges: &[ContactEdge],
    weights: &Weights,
) -> Left {
    let mut sum = Left::default();
    for of in edges {
        let value = goal.value_on(problem, of.edge);
        let z = problem.ends[of.edge].map(|vertex| weights.vertices[vertex as usize] - value);
        let density = problem.lengths[of.edge] * goal.density_on(problem, of.edge);
        sum.add_flux(of, weights.tau[of.edge] - density);
        match z.iter().zip(of.clear).any(|(&z, clear)| z != 0.0 && clear == 0.0) {
            true => sum.add_loose(of, z),
            false => sum.add_values(of, z),
        }
    }
    sum
}

impl Left {
    /// −∫ζ′ (u − ψ)
    fn add_flux(&mut self, of: &ContactEdge, flux: f64) {
        if flux == 0.0 {
            return;
        }
        // Where u is above ψ alone, a positive ζ′ makes it smaller.
        self.widen(of.may, flux, flux.abs() / of.room);
        self.drop(flux.abs() * of.dropped[0]);
    }

    fn drop(&mut self, by: f64) {
        self.loose = [self.loose[0] - by, self.loose[1] + by];
    }

    /// ∫(σ − τ)·n z′ within the part of s − ψ.
    fn add_values(&mut self, of: &ContactEdge, z: [f64; 2]) {
        for (z, clear) in z.into_iter().zip(of.clear).filter(|(z, _)| *z != 0.0) {
            self.widen(of.may, -z, z.abs() / clear);
        }
        self.drop(z.into_iter().fold(0.0, |most: f64, z| most.max(z.abs())) * of.dropped[1]);
    }

    /// By a weight that lowers what is above and raises what is below, as far as either may be; the other way round where it is negative.
    fn widen(&mut self, [below, above]: [bool; 2], weight: f64, part: f64) {
        let lowers = (weight > 0.0 && above) || (weight < 0.0 && below);
        let raises = (weight < 0.0 && above) || (weight > 0.0 && below);
        for (most, is_widened) in self.part.iter_mut().zip([lowers, raises]) {
            *most = if is_widened { most.max(part) } else { *most };
        }
    }

    /// ∫(σ − τ)·n z′ by the range of σ·n, for z′ with these values at the ends.
    fn add_loose(&mut self, of: &ContactEdge, z: [f64; 2]) {
        let mean = |sign: f64| z.iter().map(|z| 0.5 * (sign * z).max(0.0)).sum::<f64>();
        let times = |left: f64, mean: f64| if mean == 0.0 { 0.0 } else { left * mean };
        let ([least, most], [up, down]) = (of.left, [mean(1.0), mean(-1.0)]);
        self.loose[0] += times(least, up) - times(most, down);
        self.loose[1] += times(most, up) - times(least, down);
    }
}

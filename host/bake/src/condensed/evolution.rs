//! The bound of the evolution of a condensed model as the target has it.

use signorini_contact::sides::ON_GAP;
use signorini_contact::steps::evolution::Evolution;
use signorini_kernel::evolution::Rates;

use super::bound::Columns;
use crate::narrow::narrow;
use signorini_certify::evolution::rates;
use signorini_condense::{EvolutionForms, SteppedModel};
use signorini_problem::scalar::Scalar;

/// Roundings of a term of the start, and of its shape.
pub(super) const ROUNDINGS: f64 = 4.0;

/// The arrays of [`Evolution`], and what is carried at the start.
#[derive(Debug, Clone)]
pub(super) struct Evolving<R> {
    pub residual: Columns<R>,
    pub motion: Columns<R>,
    ends: Vec<[u16; 2]>,
    scale: Vec<R>,
    length: R,
    rates: Rates<R>,
    pub begin: [R; 2],
}

impl<R: Scalar> Evolving<R> {
    /// Narrows the forms of a model in steps. Terms of its start are rounded with numbers of these `sizes`: s is off by what that
    /// makes of it.
    pub fn new(of: &EvolutionForms, stepped: &SteppedModel, sizes: &[f64]) -> Self {
        let ([residual, motion], model) = (&of.lost, &stepped.model);
        let columns = |factor, lost: &Vec<f64>| Columns::new(factor, lost, lost.len());
        let end = |at: usize| u16::try_from(at).unwrap_or(ON_GAP);
        let scale = model.multiplier.iter().map(|m| m / model.energy_unit);
        let up = |x: f64| R::narrow(x * (1.0 + 2.0 * R::EPSILON.wide()));
        let carried = of.start.carried();
        let length = R::narrow(of.length);
        let motion: Columns<R> = columns(&of.motion, motion);
        let moved = motion.norms.iter().zip(sizes);
        let moved: f64 = moved.map(|(norm, size)| norm.wide() * size).sum();
        let bound = carried.bound + ROUNDINGS * R::EPSILON.wide() * moved / of.start.rate.sqrt();
        Self {
            residual: columns(&of.residual, residual),
            motion,
            ends: of.ends.iter().map(|ends| ends.map(end)).collect(),
            scale: narrow(&scale.collect::<Vec<_>>()),
            length,
            rates: rates(of.start.rate, length.wide()),
            begin: [up(bound), up(carried.before).or_smaller(R::ONE)],
        }
    }

    /// How the kernel has it.
    pub fn view(&self) -> Evolution<'_, R> {
        Evolution {
            length: self.length,
            rates: self.rates,
            residual: self.residual.view(),
            motion: self.motion.view(),
            ends: &self.ends,
            scale: &self.scale,
        }
    }
}

//! The bound of the evolution on this machine: [`signorini_kernel::evolution::Rates`], whose exponential is worked out here.

use serde::{Deserialize, Serialize};
use signorini_kernel::evolution::{Carried, PHI, Rates, THETA};
use signorini_problem::scalar::Scalar;

pub use signorini_kernel::evolution::StepTerms;

/// The constants of steps of `length` for the decay rate λ, rounded up in `R`.
pub fn rates<R: Scalar>(rate: f64, length: f64) -> Rates<R> {
    let up = |x: f64| R::narrow(x * (1.0 + 2.0 * R::EPSILON.wide()));
    let exponent = 2.0 * THETA * rate * length;
    Rates {
        fading: up((-exponent).exp()).or_smaller(R::ONE),
        reach: up(-(-exponent).exp_m1() / (2.0 * THETA * rate)),
        softness: up(rate.sqrt().recip()),
        of_energy: up((THETA * rate / PHI).sqrt()),
        of_square: up(0.5 / (1.0 - THETA - PHI)),
        seconds: R::narrow(0.5 / (THETA * rate)),
    }
}

/// What is carried: B, and what it began with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evolution {
    /// λ
    pub rate: f64,
    /// B
    bound: f64,
    /// What of the weights falls before the start.
    before: f64,
}

impl Evolution {
    /// From a steady state whose bound is `total`, or from a stated u with ‖c^½(u − s)‖ = `error`; `rate` is λ. Nothing where λ is 0.
    pub fn begin(rate: f64, total: Option<f64>, error: f64) -> Option<Self> {
        let (bound, before) = match total {
            // The mean reaches back before the start, where the steady state stood.
            Some(total) => (((1.0 + PHI / THETA) / rate).sqrt() * total, 0.0),
            None => (error, 1.0),
        };
        (rate > 0.0 && bound.is_finite()).then_some(Self { rate, bound, before })
    }

    /// In a unit of energy norms.
    #[must_use]
    pub fn in_unit(self, unit: f64) -> Self {
        Self { bound: self.bound / unit, ..self }
    }

    /// As the kernel carries it.
    pub fn carried(&self) -> Carried<f64> {
        Carried { bound: self.bound, before: self.before }
    }

    /// Takes in a step, by the best of the ways to balance it. ∞ from a step without terms on.
    pub fn advance(&mut self, terms: &[StepTerms<f64>]) {
        let length = terms.first().map_or(0.0, |terms| terms.length);
        let terms: Vec<_> = terms.iter().copied().map(Some).collect();
        let Carried { bound, before } = rates(self.rate, length).advance(self.carried(), &terms);
        (self.bound, self.before) = (bound, before);
    }

    /// The root of the mean of G² with weights that fade by e^{−2θλt} into the past, at most; ∞ where a step had no bound.
    pub fn energy(&self) -> f64 {
        rates(self.rate, 0.0).energy(self.carried())
    }

    /// ‖c^½(u − s)‖ at the end of the last step, at most; ∞ where a step had no bound.
    pub fn distance(&self) -> f64 {
        self.bound
    }

    /// ‖c^½(u − s)‖ at most where a controller's window has this energy and reaches back so far, `since` a stated start or, where
    /// there is none, a steady one: B from what [`Rates::energy`] makes of it.
    pub fn distance_of([energy, seconds]: [f64; 2], since: Option<f64>) -> f64 {
        /// Room for rounding in f32.
        const UP: f64 = 1.0 + 1e-5;
        let weights = since.map_or(1.0, |time| -(-time / seconds).exp_m1());
        energy * (2.0 * PHI * seconds * weights).sqrt() * UP
    }

    /// The energy and how far back it reaches.
    pub fn window(&self) -> [f64; 2] {
        [self.energy(), self.seconds()]
    }

    /// Whether every step so far had a bound.
    pub fn is_finite(&self) -> bool {
        self.bound.is_finite()
    }

    /// How far back the mean reaches, in the unit of time: 1/(2θλ).
    pub fn seconds(&self) -> f64 {
        0.5 / (THETA * self.rate)
    }
}

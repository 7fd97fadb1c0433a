//! The bound of the evolution: one number that is carried from step to step.
//!
//! A tick holds f, g, q, limits, u_ext and h at their values, and lets u_D and ψ go linearly from those of the last tick. u is exact in
//! continuous time, s linear between ticks, E = ‖c^½(u − s)‖ and G² = ‖A^½∇(u − s)‖² + ∫_R h(u − s)². With the terms of a step
//! ```text
//!   ζ² = mean over the step of ‖A^½∇s − A^{−½}τ‖² + ∫_R …       ct = mean of ½ of the terms of contact at both ends
//!   o: oscillation of data, and R′ or nothing of it              ρ = ‖c^{−½}R̄‖, or ‖c^{−½}R‖
//!   γ = η²/(2(1 − θ − φ)) + 2ct,     (η, r) = (ζ + o + ρ/√λ, 0) or (ζ + o, ρ)
//!   B_n = dt r + (e^{−2θλdt} B² + dt γ)^½ ≥ (E² + 2φ∫e^{−2θλ(t_n − t)} G² dt)^½
//! ```
//! for any admissible s and τ, however they were found; the least of all is taken. λ is guaranteed (`signorini_solve::decay`).

use serde::{Deserialize, Serialize};
use signorini_bound::certificate::Residual;
use signorini_problem::scalar::Scalar;

/// How fast the past fades, in parts of λ.
const THETA: f64 = 0.1;

/// The part of the energy's mean.
const PHI: f64 = 0.45;

/// Terms of one step, for one way to balance its cells.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepTerms {
    /// dt
    pub length: f64,
    /// ζ² for s at the beginning of the step, in the mean of the step, and at its end.
    pub distance: [f64; 3],
    /// ct at both ends.
    pub contact: [f64; 2],
    /// The part of o that data vary by, with what rounding may hide.
    pub oscillation: f64,
    /// The part of o that s changes by inside cells.
    pub inside: f64,
    /// ‖c^{−½}R̄‖ and ‖c^{−½}R′‖
    pub residual: [f64; 2],
}

impl StepTerms {
    /// Of squared distances for s at the beginning, in the middle and at the end, and of terms of contact at both ends.
    pub(super) fn new<R: Scalar>(
        length: f64,
        (residual, oscillation): (&Residual<R>, R),
        distance: [R; 3],
        contact: [R; 2],
    ) -> Self {
        let root = |square: R| square.wide().max(0.0).sqrt();
        let [begin, middle, end] = distance.map(|square| square.wide().max(0.0));
        // The square of an affine function of time: Simpson's rule is exact.
        let mean = (begin + 4.0 * middle + end) / 6.0;
        Self {
            length,
            distance: [begin, mean, end],
            contact: contact.map(|term| 0.5 * term.wide()),
            oscillation: oscillation.wide(),
            inside: root(residual.loose),
            residual: [residual.mean, residual.rest].map(|square| root(square) / length.sqrt()),
        }
    }
}

/// What is carried: B, and what it began with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evolution {
    rate: f64,
    bound: f64,
    /// Whether the mean reaches back before the start, where the steady state stood.
    was_steady: bool,
    elapsed: f64,
}

impl Evolution {
    /// From a steady state whose bound is `total`, or from a stated u with ‖c^½(u − s)‖ = `error`; `rate` is λ. Nothing where λ is 0.
    pub fn begin(rate: f64, total: Option<f64>, error: f64) -> Option<Self> {
        let bound = match total {
            Some(total) => ((1.0 + PHI / THETA) / rate).sqrt() * total,
            None => error,
        };
        let was_steady = total.is_some();
        (rate > 0.0 && bound.is_finite()).then_some(Self { rate, bound, was_steady, elapsed: 0.0 })
    }

    /// In a unit of energy norms.
    #[must_use]
    pub fn in_unit(self, unit: f64) -> Self {
        Self { bound: self.bound / unit, ..self }
    }

    /// Takes in a step, by the best of the ways to balance it. ∞ from a step without terms on.
    pub fn advance(&mut self, terms: &[StepTerms]) {
        let bounds = terms.iter().map(|terms| self.after(terms));
        self.bound = bounds.fold(f64::INFINITY, f64::min);
        self.elapsed += terms.first().map_or(0.0, |terms| terms.length);
    }

    fn after(&self, terms: &StepTerms) -> f64 {
        let StepTerms { length: dt, distance, contact, oscillation, inside, residual } = *terms;
        let fading = (-2.0 * THETA * self.rate * dt).exp();
        let with = |beside: f64, r: f64| {
            let gamma = |square: f64, ct: f64| {
                let eta = square.sqrt() + oscillation + beside;
                eta * eta / (2.0 * (1.0 - THETA - PHI)) + 2.0 * ct
            };
            let [begin, of_step, end] = distance;
            let plainly = dt * gamma(of_step, 0.5 * (contact[0] + contact[1]));
            // γ is convex in time: where it has long faded its largest value counts.
            let most = gamma(begin, contact[0]).max(gamma(end, contact[1]));
            let faded = (1.0 - fading) / (2.0 * THETA * self.rate) * most;
            dt * r + (fading * self.bound * self.bound + plainly.min(faded)).max(0.0).sqrt()
        };
        let [mean, rest] = residual;
        let (weak, all) = (self.rate.sqrt(), mean.hypot(rest));
        let ways = [(inside + mean / weak, 0.0), (inside, mean), (all / weak, 0.0), (0.0, all)];
        ways.map(|(beside, r)| with(beside, r)).into_iter().fold(f64::INFINITY, f64::min)
    }

    /// The root of the mean of G² with weights that fade by e^{−2θλt} into the past, at most; ∞ where a step had no bound.
    pub fn energy(&self) -> f64 {
        let weights = match self.was_steady {
            true => 1.0,
            false => 1.0 - (-2.0 * THETA * self.rate * self.elapsed).exp(),
        };
        self.bound * (THETA * self.rate / (PHI * weights)).sqrt()
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

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
//! for any admissible s and τ, however they were found; the least of all is taken. λ is guaranteed by the host.
//!
//! Rounding: what it hides in the terms of a step is in their oscillation. All that the formula adds up is not negative, and B² is
//! multiplied, added to and rooted once: it loses 2ε of itself at most in a step, and 16ε of γ. Both are added, and the constants are
//! rounded up. Where 2θλdt is not far above that, in f32 below λdt of 1e−5, B grows by it.

use crate::Real;

/// How fast the past fades, in parts of λ: θ.
pub const THETA: f64 = 0.1;

/// The part of the energy's mean: φ.
pub const PHI: f64 = 0.45;

/// Constants of steps of one length, each rounded up; the caller has the exponential.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rates<R> {
    /// e^{−2θλdt}
    pub fading: R,
    /// (1 − e^{−2θλdt})/(2θλ)
    pub reach: R,
    /// λ^{−½}
    pub softness: R,
    /// (θλ/φ)^½
    pub of_energy: R,
    /// 1/(2(1 − θ − φ))
    pub of_square: R,
    /// 1/(2θλ), how far back the mean of the energy reaches, in the unit of time.
    pub seconds: R,
}

/// What is carried from step to step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Carried<R> {
    /// B
    pub bound: R,
    /// The part of the weights that falls before the start: 0 where the steady state stood there, of whose mean B knows.
    pub before: R,
}

/// Terms of one step, for one way to balance its cells.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepTerms<R> {
    /// dt
    pub length: R,
    /// ζ² for s at the beginning of the step, in the mean of the step, and at its end.
    pub distance: [R; 3],
    /// ct at both ends.
    pub contact: [R; 2],
    /// The part of o that data vary by, with what rounding may hide.
    pub oscillation: R,
    /// The part of o that s changes by inside cells.
    pub inside: R,
    /// ‖c^{−½}R̄‖ and ‖c^{−½}R′‖
    pub residual: [R; 2],
}

impl<R: Real> StepTerms<R> {
    /// Of squared distances for s at the beginning, in the middle and at the end, of terms of contact at both ends, and of Σ‖R̄‖²/k,
    /// Σ‖R′‖²/k and Σ‖R′‖²/(π²α/h²).
    pub fn new(
        length: R,
        ([mean, rest, loose], oscillation): ([R; 3], R),
        distance: [R; 3],
        contact: [R; 2],
    ) -> Self {
        let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
        let [begin, middle, end] = distance.map(|square| square.or_larger(R::ZERO));
        // The square of an affine function of time: Simpson's rule is exact.
        let of_step = (begin + R::from_count(4) * middle + end) / R::from_count(6);
        let of_time = root(length);
        Self {
            length,
            distance: [begin, of_step, end],
            contact: contact.map(|term| R::HALF * term),
            oscillation,
            inside: root(loose),
            residual: [mean, rest].map(|square| root(square) / of_time),
        }
    }
}

impl<R: Real> Rates<R> {
    /// What is carried on from a step, by the best of the ways to balance it. ∞ from a step without terms on.
    pub fn advance(&self, carried: Carried<R>, terms: &[Option<StepTerms<R>>]) -> Carried<R> {
        let bounds = terms.iter().flatten().map(|terms| self.after(carried.bound, terms));
        let before = self.fading * carried.before * (R::ONE + R::TWO * R::EPSILON);
        Carried {
            bound: bounds.fold(R::INFINITY, R::or_smaller),
            before: before.or_smaller(R::ONE),
        }
    }

    fn after(&self, bound: R, terms: &StepTerms<R>) -> R {
        let StepTerms { length: dt, distance, contact, oscillation, inside, residual } = *terms;
        let up = |epsilons: u32| R::ONE + R::from_count(epsilons) * R::EPSILON;
        let with = |beside: R, r: R| {
            let gamma = |square: R, ct: R| {
                let eta = square.rounded_sqrt() + oscillation + beside;
                (self.of_square * eta * eta + R::TWO * ct) * up(16)
            };
            let [begin, of_step, end] = distance;
            let plainly = dt * gamma(of_step, R::HALF * (contact[0] + contact[1]));
            // γ is convex in time: where it has long faded its largest value counts.
            let most = gamma(begin, contact[0]).or_larger(gamma(end, contact[1]));
            let added = plainly.or_smaller(self.reach * most);
            let square = self.fading * (bound * bound) + added;
            (dt * r + square.or_larger(R::ZERO).rounded_sqrt()) * up(2)
        };
        let [mean, rest] = residual;
        let all = (mean * mean + rest * rest).rounded_sqrt() * up(2);
        let weak = |rho: R| rho * self.softness;
        let ways =
            [(inside + weak(mean), R::ZERO), (inside, mean), (weak(all), R::ZERO), (R::ZERO, all)];
        ways.into_iter().map(|(beside, r)| with(beside, r)).fold(R::INFINITY, R::or_smaller)
    }

    /// The root of the mean of G² with weights that fade by e^{−2θλt} into the past, at most; ∞ where a step had no bound.
    pub fn energy(&self, carried: Carried<R>) -> R {
        let weights = (R::ONE - carried.before).or_larger(R::ZERO).rounded_sqrt();
        carried.bound * self.of_energy / weights * (R::ONE + R::from_count(4) * R::EPSILON)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rates(rate: f64, length: f64) -> Rates<f64> {
        let exponent = 2.0 * THETA * rate * length;
        Rates {
            fading: (-exponent).exp(),
            reach: -(-exponent).exp_m1() / (2.0 * THETA * rate),
            softness: rate.sqrt().recip(),
            of_energy: (THETA * rate / PHI).sqrt(),
            of_square: 0.5 / (1.0 - THETA - PHI),
            seconds: 0.5 / (THETA * rate),
        }
    }

    fn narrowed(of: &Rates<f64>) -> Rates<f32> {
        let up = |x: f64| {
            let near = x as f32;
            if f64::from(near) < x { near.next_up() } else { near }
        };
        Rates {
            fading: up(of.fading),
            reach: up(of.reach),
            softness: up(of.softness),
            of_energy: up(of.of_energy),
            of_square: up(of.of_square),
            seconds: up(of.seconds),
        }
    }

    /// Terms that f32 holds, some with a residual that is best taken over λ and some with one that is not.
    fn terms(at: u32, length: f32) -> [StepTerms<f32>; 2] {
        let part = |salt: u32| {
            let mixed =
                (at * 2 + salt).wrapping_mul(0x9e37_79b9).rotate_left(13).wrapping_mul(0x85eb_ca6b);
            (mixed >> 8) as f32 / 16_777_216.0
        };
        [0, 1].map(|way| StepTerms {
            length,
            distance: [part(way), part(way + 7), part(way + 13)],
            contact: [0.1 * part(way + 19), 0.1 * part(way + 23)],
            oscillation: 0.01 * part(way + 29),
            inside: 0.1 * part(way + 31),
            residual: [part(way + 37), part(way + 41)],
        })
    }

    fn wide(of: &StepTerms<f32>) -> StepTerms<f64> {
        StepTerms {
            length: of.length.into(),
            distance: of.distance.map(f64::from),
            contact: of.contact.map(f64::from),
            oscillation: of.oscillation.into(),
            inside: of.inside.into(),
            residual: of.residual.map(f64::from),
        }
    }

    /// In f32 B and the energy are never below what the formula gives, and near it where the past fades faster than it is rounded.
    #[test]
    fn rounding_is_counted_in_either_scalar() {
        for (rate, length, near) in [(1.0, 1e-4, 1.1), (3.0, 0.25, 1.001), (0.1, 16.0, 1.001)] {
            let exact = rates(rate, length);
            let short = narrowed(&exact);
            let mut known = Carried { bound: 0.0, before: 1.0 };
            let mut found = Carried { bound: 0.0_f32, before: 1.0 };
            for at in 0..5000 {
                let terms = terms(at, length as f32);
                known = exact.advance(known, &terms.each_ref().map(|of| Some(wide(of))));
                found = short.advance(found, &terms.map(Some));
                let [bound, energy] = [found.bound, short.energy(found)].map(f64::from);
                assert!(
                    bound >= known.bound && bound <= near * known.bound,
                    "{at}: {bound} {known:?}"
                );
                assert!(energy >= exact.energy(known), "{at}: {energy}");
            }
            assert!(found.before >= known.before as f32);
        }
    }

    /// B² falls by e^{−2θλdt} a step where nothing is wrong, and a step without terms leaves no bound.
    #[test]
    fn the_past_fades_and_no_terms_are_no_bound() {
        let of = rates(2.0, 0.5);
        let quiet = StepTerms { length: 0.5, ..StepTerms::default() };
        let first = Carried { bound: 3.0, before: 0.0 };
        let next = of.advance(first, &[Some(quiet)]);
        assert!((next.bound - 3.0 * (-0.1_f64).exp()).abs() < 1e-14, "{next:?}");
        assert_eq!(of.advance(first, &[]).bound, f64::INFINITY);
    }
}

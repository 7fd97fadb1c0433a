//! How far an output may be from its value for the exact solution, in its own unit.
//!
//! An output is linear in u or σ, and what the error bound leaves of it is
//! ```text
//!   |J(exact) − J(answer)| ≤ w_total · total + w_algebraic · algebraic + w_of_u · of_u,
//! ```
//! whose weights the host finds once: norms of functions that tell this output from all others. They hold for all inputs and on
//! whatever sides the contact edges are. Where a bound is as large as its algebraic part nothing is said of σ_h. What the sum of an
//! output rounds is not in it.
//!
//! In a condensed model the tick's own s and τ tell more. The middle Σ of τ and A∇s is known but for the inputs p, the openings x
//! and the corrections d, of which the output of Σ is a sum ([`Midpoint`]). The exact flux σ is as near to it as
//! ```text
//!   ‖A^{−½}(σ − Σ)‖ ≤ M,    M² = ½ total² − ¼ distance²        (Prager and Synge, with contact)
//! ```
//! which is half of the total where no contact is paid for.

use signorini_kernel::Real;
use signorini_kernel::index::read;
use signorini_kernel::report::Report;
use signorini_kernel::verdict::Certificate;

/// The weights of one output: units of it over those of the bound; infinite where there is no interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputWeights<R> {
    /// Of the total: how far s and τ are from the solution.
    pub total: R,
    /// Of the square of the total.
    pub square: R,
    /// Of the algebraic part: how far σ_h is from τ.
    pub algebraic: R,
    /// Of the bound for u_h.
    pub of_u: R,
}

impl<R: Real> OutputWeights<R> {
    /// Of an output without an interval.
    pub const NONE: Self =
        Self { total: R::INFINITY, square: R::ZERO, algebraic: R::INFINITY, of_u: R::INFINITY };

    /// How far the output may be off; ∞ without a bound.
    ///
    /// ```
    /// use signorini_kernel::verdict::{Certificate, Verdict};
    /// use signorini_device::intervals::OutputWeights;
    /// use signorini_kernel::report::{Ended, Report};
    ///
    /// let weights = OutputWeights { total: 2.0, square: 0.0, algebraic: 1.0, of_u: 0.0 };
    /// let certificate = Certificate { total: 0.1, algebraic: 0.02, ..Certificate::default() };
    /// let verdict = Verdict::Certified(certificate);
    /// let (ended, figures) = (Ended::Exact, ());
    /// let report = Report { ended, exchanges: 0, sweeps: 0, active: 3, verdict, figures };
    /// assert_eq!(weights.plus_minus(&report), 0.22);
    /// assert_eq!(OutputWeights::NONE.plus_minus(&report), f64::INFINITY);
    /// ```
    #[inline(always)]
    pub fn plus_minus(&self, report: &Report<R>) -> R {
        report.certificate().map_or(R::INFINITY, |bound| self.within(bound))
    }

    /// How far the output may be off within this bound.
    #[inline(always)]
    pub fn within(&self, bound: &Certificate<R>) -> R {
        let is_told = self.algebraic == R::ZERO || bound.algebraic < bound.total;
        if !is_told || self.total == R::INFINITY {
            return R::INFINITY;
        }
        let total = (self.total + self.square * bound.total) * bound.total;
        total + self.algebraic * bound.algebraic + self.of_u * bound.of_u
    }
}

/// An output of the middle between τ and A∇s, and how far that of the exact solution may be from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Midpoint<'a, R> {
    /// Of each number of the tick's combination (p, x, d): its factor, and how far that may be off. Where an input changes a transfer
    /// coefficient, at both ends of its range, else only once.
    pub columns: [&'a [[R; 2]]; 2],
    /// Which number of the combination that input is.
    pub input: usize,
    /// Its least value, and 1 over the length of its range.
    pub range: [R; 2],
    /// ‖A^{−½}ζ − A^½∇z‖ of the two functions that weigh errors in this output.
    pub apart: R,
    /// The part c of what contact leaves that they take, below and above: c K/2 at most, where K of 2M² is a matter of contact.
    pub part: [R; 2],
    /// ‖A^½∇z‖ + ‖A^{−½}ζ‖
    pub sizes: R,
    /// Of the total: what loads may miss.
    pub loads: R,
    /// Of the distance of τ from A∇s: how much of it counts.
    pub distance: R,
    /// What the law of contact keeps it above.
    pub least: R,
}

impl<R: Real> Midpoint<'_, R> {
    /// Of an output without one.
    pub const NONE: Self = Self {
        columns: [&[]; 2],
        input: 0,
        range: [R::ZERO; 2],
        apart: R::INFINITY,
        part: [R::ZERO; 2],
        sizes: R::ZERO,
        loads: R::ZERO,
        distance: R::ZERO,
        least: R::NEG_INFINITY,
    };

    /// Where the output lies for the exact solution; `None` for an output without a midpoint, or of another model's numbers.
    ///
    /// ```
    /// use signorini_device::intervals::Midpoint;
    /// use signorini_kernel::verdict::Certificate;
    ///
    /// let columns: [&[_]; 2] = [&[[3.0, 0.0], [0.5, 0.0]], &[]];
    /// let of = Midpoint { columns, apart: 2.0, ..Midpoint::NONE };
    /// // M = 0.5 where all of the total is distance, and 0.707 where nothing is known of it.
    /// let bound = Certificate { total: 1.0, distance: 1.0, ..Certificate::default() };
    /// let ends = |of: Midpoint<f64>| of.between(&[1.0, 4.0], &bound).unwrap_or_default();
    /// let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).abs().max((b - d).abs()) < 1e-3;
    /// assert!(near(ends(Midpoint { distance: 1.0, ..of }), [4.0, 6.0]));
    /// assert!(near(ends(of), [3.586, 6.414]));
    /// assert_eq!(of.between(&[1.0], &bound), None);
    /// ```
    pub fn between(&self, combination: &[R], bound: &Certificate<R>) -> Option<[R; 2]> {
        let [first, second] = self.columns;
        let is_of_it = |columns: &[[R; 2]]| columns.len() == combination.len();
        if first.is_empty() || !is_of_it(first) || !(second.is_empty() || is_of_it(second)) {
            return None;
        }
        let [mut value, mut doubt] = sum(first, combination);
        if !second.is_empty() {
            let [at_most, doubt_at_most] = sum(second, combination);
            let [least, over_length] = self.range;
            let share = (read(combination, self.input) - least) * over_length;
            value += share * (at_most - value);
            doubt += doubt_at_most;
        }
        let distance = self.distance * bound.distance;
        let square = R::HALF * bound.total * bound.total - R::QUARTER * distance * distance;
        let middle = square.or_larger(R::ZERO).rounded_sqrt();
        let admissible = bound.oscillation + bound.rounding + (R::ONE + R::HALF) * bound.algebraic;
        let rest = doubt + self.sizes * admissible + self.loads * bound.total;
        let [below, above] = self.part.map(|part| self.farthest(middle, part) + rest);
        let ends = [(value - below).or_larger(self.least), value + above];
        ends.iter().all(|end| end.finite()).then_some(ends)
    }

    /// The largest apart · √(M² − k) + part · k for 0 ≤ k ≤ M².
    fn farthest(&self, middle: R, part: R) -> R {
        match R::TWO * part * middle > self.apart {
            true => part * middle * middle + self.apart * self.apart / (R::from_count(4) * part),
            false => self.apart * middle,
        }
    }
}

/// Σ of factors times numbers, and how far it may be off: what is known of the factors, and an ε of every partial sum. The constant
/// comes last, since a zero of u that is far away stands in it.
fn sum<R: Real>(columns: &[[R; 2]], combination: &[R]) -> [R; 2] {
    let terms = columns.iter().zip(combination).rev();
    terms.fold([R::ZERO; 2], |[value, doubt], ([factor, off], number)| {
        let value = value + *factor * *number;
        [value, doubt + *off * number.magnitude() + R::EPSILON * value.magnitude()]
    })
}

/// Where each output lies: by its midpoint, or else within what its weights say; infinite without a bound.
#[inline(always)]
pub fn between<R: Real, const N: usize>(
    (midpoints, weights): (&[Midpoint<R>; N], &[OutputWeights<R>; N]),
    values: &[R; N],
    combination: &[R],
    report: &Report<R>,
) -> [[R; N]; 2] {
    let (mut least, mut most) = ([R::NEG_INFINITY; N], [R::INFINITY; N]);
    let ends = least.iter_mut().zip(&mut most);
    for (((least, most), value), (of, weights)) in
        ends.zip(values).zip(midpoints.iter().zip(weights))
    {
        let bound = report.certificate();
        let around = || {
            let by = weights.plus_minus(report);
            [*value - by, *value + by]
        };
        [*least, *most] =
            bound.and_then(|bound| of.between(combination, bound)).unwrap_or_else(around);
    }
    [least, most]
}

/// How far each output may be off.
#[inline(always)]
pub fn plus_minus<R: Real, const N: usize>(
    weights: &[OutputWeights<R>; N],
    report: &Report<R>,
) -> [R; N] {
    core::array::from_fn(|at| weights.get(at).map_or(R::INFINITY, |of| of.plus_minus(report)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_kernel::report::Ended;
    use signorini_kernel::verdict::Verdict;

    fn report(verdict: Verdict<f32>) -> Report<f32> {
        Report { ended: Ended::Settled, exchanges: 0, sweeps: 7, active: 0, verdict, figures: () }
    }

    #[test]
    fn nothing_is_guaranteed_without_a_bound() {
        let weights = OutputWeights { total: 1.0, square: 0.0, algebraic: 0.0, of_u: 0.0 };
        let all = plus_minus(&[weights, OutputWeights::NONE], &report(Verdict::Unavailable));
        assert_eq!(all, [f32::INFINITY; 2]);
    }

    #[test]
    fn an_algebraic_part_that_is_cut_off_tells_nothing() {
        let certificate =
            Certificate { total: 2.0, algebraic: 2.0, of_u: 3.0, ..Certificate::default() };
        let report = report(Verdict::Certified(certificate));
        let weights = OutputWeights { total: 1.0, square: 0.0, algebraic: 0.5, of_u: 0.0 };
        assert_eq!(weights.plus_minus(&report), f32::INFINITY);
        let of_fluxes_on_contact = OutputWeights { algebraic: 0.0, ..weights };
        assert_eq!(of_fluxes_on_contact.plus_minus(&report), 2.0);
        let of_u = OutputWeights { total: 0.0, square: 0.25, algebraic: 0.0, of_u: 2.0 };
        assert_eq!(of_u.plus_minus(&report), 7.0);
    }
}

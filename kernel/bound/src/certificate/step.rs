//! The bound of a step in time.
//!
//! The step from w = s_old is k(u − w) − ∇·(A∇u) = f with k = c/dt. For admissible s and any τ that meets the boundary conditions let
//! R = f − k(s − w) + ∇·τ, with mean R̄ on each cell and R′ = R − R̄. Where c > 0, completing the square gives
//! ```text
//!   gap² + Σ‖R̄‖²/k + Σ‖R′‖²/k ≥ combined² + 2∫_C […],
//!   combined² = ‖A^½∇(u − s)‖² + ∫k(u − s)² + ‖A^{−½}(σ − τ)‖² + ∫_R […],
//! ```
//! with gap and the terms of C and R as in the steady problem ([`super`]). Any part of R′ may go to the oscillation instead, where each
//! cell pays (‖R′‖²/(k + π²α/h²))^½: the least total of some such parts is taken. What f varies by in a cell is the caller's oscillation,
//! as ever.
//!
//! A cell may keep what it lacks of balance: that is R̄. Or it hands it on along the forest, as in the steady problem, of which a
//! cell that stores nothing has to hand on all. One walk does both ([`WAYS`]): each has a τ of its own, s and all that it changes by
//! are the same. The caller takes the lesser total.
//!
//! The bound is about this one step, whose start w is s of the step before, not about the evolution, of which [`Judged`] has the terms.

use super::in_step::{Fields, OfStep, WAYS, Way};
use super::motion::Motion;
use super::parts::Parts;
use super::stored::{Inside, Means, Step};
use super::{Buffers, Continuous, Discretization, LoadCase, Verdict, admissible, boundary};
use crate::equilibrium::{self, Iterate};
use signorini_kernel::error::{Array, Error, same_length, same_length_or_empty};
use signorini_kernel::evolution::StepTerms;
use signorini_kernel::{Index, Real};

/// What is known of a step by one way to balance its cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged<R> {
    /// The bound of the step.
    pub verdict: Verdict<R>,
    /// Its terms in the bound of the evolution, where there is a bound.
    pub terms: Option<StepTerms<R>>,
}

/// Memory of the second way.
#[derive(Debug)]
pub struct Handed<'a, R> {
    /// Becomes its τ; empty where no cell may hand anything on, of which way nothing is known then.
    pub tau: &'a mut [R],
    /// Becomes its indicators; may be empty.
    pub indicators: &'a mut [R],
}

/// Bounds the error of an iterate of `step` by each way to balance its cells; `buffers` are of the first.
///
/// # Errors
/// Arrays of the wrong length.
pub fn certify_step<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    (given, step): (&LoadCase<R, I>, &Step<R>),
    iterate: Iterate<R>,
    buffers: (Buffers<R>, Handed<R>),
) -> Result<[Judged<R>; WAYS], Error> {
    certify_step_with(discretization, (given, step), iterate, buffers, |_, _| ())
}

/// Bounds the error of a step with what `moved` makes of s, as [`certify_with`](super::certify_with) does.
///
/// # Errors
/// As for [`certify_step`].
pub fn certify_step_with<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    (given, step): (&LoadCase<R, I>, &Step<R>),
    iterate: Iterate<R>,
    (mut buffers, handed): (Buffers<R>, Handed<R>),
    moved: impl FnOnce(&mut [R], &mut [R]),
) -> Result<[Judged<R>; WAYS], Error> {
    let Discretization { edges, .. } = discretization;
    same_length(Array::Storage, step.cells.len(), edges.cells())?;
    same_length(Array::Vertices, step.vertices.len(), buffers.vertices.len())?;
    same_length(Array::Contact, step.openings.len(), given.ends.gap.len())?;
    same_length_or_empty(Array::Fluxes, handed.tau.len(), buffers.tau.len())?;
    admissible(discretization, (given, Some(step.storage)), iterate, &mut buffers, moved)?;
    let Buffers { vertices, bubbles, tau, indicators } = buffers;
    equilibrium::impose(edges, &given.boundary, iterate, tau);
    handed.tau.iter_mut().zip(tau.iter()).for_each(|(to, &from)| *to = from);
    let s = Continuous { vertices, bubbles };
    let perturbation = boundary::perturbation(discretization, given, iterate.law, s);
    let of_step = OfStep { discretization, given, step, iterate, s, perturbation };
    let mut fields = [(tau, indicators), (handed.tau, handed.indicators)];
    let (ways, inside) = of_step.walk(&mut fields);
    let ([kept, mut handed], [of_kept, of_handed]) = (ways, fields);
    handed.parts.take_rest(&kept.parts);
    let (kept, algebraic) = of_step.judge(kept, &inside, of_kept);
    if of_handed.0.is_empty() {
        return Ok([kept, Judged { verdict: Verdict::NotAsked, terms: None }]);
    }
    // What is handed on stays in τ however long sweeps go on: they remove what fluxes lack without it.
    handed.algebraic = Some(algebraic);
    Ok([kept, of_step.judge(handed, &inside, of_handed).0])
}

impl<R: Real, I: Index> OfStep<'_, R, I> {
    /// What is known by one way, and its algebraic part.
    #[inline(never)]
    fn judge(
        &self,
        way: Way<R>,
        inside: &Inside<R>,
        (tau, indicators): Fields<R>,
    ) -> (Judged<R>, R) {
        let Self { discretization, given, step, iterate, s, perturbation } = *self;
        let (edges, missed) = (&discretization.edges, discretization.metric.missed);
        let Way { mut parts, means, mut earlier, algebraic } = way;
        let mut end = parts.distance();
        let pulled = equilibrium::pulled(edges, &given.boundary, tau);
        let begin = Continuous { vertices: step.vertices, bubbles: step.bubbles };
        let motion = Motion { begin, end: s, tau };
        let along = |law: (usize, &_), vertices, at_end| {
            end.add(at_end);
            motion.add_transfer(given, law, vertices, &mut earlier);
        };
        let contact =
            boundary::add(discretization, given, iterate, (s, tau), indicators, &mut parts, along);
        parts.perturbation += perturbation;
        let of_kept = parts.algebraic;
        parts.algebraic = algebraic.unwrap_or(parts.algebraic);
        let verdict = match pulled {
            Some(edge) => Verdict::Pulled { edge },
            None => conclude(discretization, given.oscillation, parts, (&means, inside)),
        };
        let terms = verdict.certificate().map(|certificate| {
            let [begin, middle] = earlier;
            let distance = [begin, middle, end].map(|of| of.square(missed));
            let before = motion.contact(discretization, given, iterate.law, step.openings);
            // What rounding leaves of a cell's balance may stay in a step, and not in all of them.
            let lasting = parts.unbalanced(discretization.cells.len(), discretization.stability);
            let oscillation = given.oscillation + certificate.rounding + lasting;
            let residual = [means.mean, inside.rest, inside.loose];
            StepTerms::new(step.length, (residual, oscillation), distance, [before, contact])
        });
        (Judged { verdict, terms }, of_kept)
    }
}

/// The least total of those where no, some or all quarters of R′ are in the storage, and the rest in the oscillation.
fn conclude<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    oscillation: R,
    mut parts: Parts<R>,
    (means, inside): (&Means<R>, &Inside<R>),
) -> Verdict<R> {
    let (cells, missed) = (discretization.cells.len(), discretization.metric.missed);
    let stability = discretization.stability;
    // s is moved by rounding of its data, in the norm of the storage too.
    let moved = R::TWO * R::EPSILON;
    parts.perturbation += moved * moved * inside.size;
    parts.gap.add(means.mean);
    let root = |square: R| square.or_larger(R::ZERO).rounded_sqrt();
    // What rounding leaves of a cell's balance may leave along the forest, or stay.
    let staying = R::from_count(8) * R::EPSILON * root(means.terms);
    let unbalanced = parts.unbalanced(cells, stability).or_smaller(staying);
    let shed = root(inside.shed);
    let with = |quarters: u32| {
        let share = R::QUARTER * R::from_count(quarters);
        let mut parts = parts;
        parts.gap.add(share * share * inside.rest);
        let oscillation = oscillation + (R::ONE - share) * shed;
        parts.conclude_with(cells, (stability, missed), oscillation, unbalanced)
    };
    let total = |of: &Verdict<R>| of.certificate().map_or(R::INFINITY, |of| of.total);
    let lesser = |a, b| if total(&b) < total(&a) { b } else { a };
    (1..=4).map(with).fold(with(0), lesser)
}

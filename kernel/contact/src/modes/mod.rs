//! A condensed model for every value of one transfer coefficient.
//!
//! The coefficient of one boundary is the least one and t times a pattern. With the modes of that boundary, which the host
//! has diagonalised, matrix and loads follow by one division a mode:
//! ```text
//!   g_k = t/(1 + t ν_k)       S(t) = S + Σ_k g_k α_k α_kᵀ,     B(t) p = B p − Σ_k α_k g_k (β_k·p)
//!   y_k = g_k (β_k·p + α_k·x)      ‖A^½∇s − A^{−½}τ‖² + … = U² (‖F z‖² + t ‖F_π z‖²),   z = (p, y, x, d)
//! ```
//! So the amplitudes y are inputs of the model with t = 0: its columns of loads are α there, outputs and F have a column for
//! each. S(t) is worked out anew where t is not that of the last tick; its diagonal is 1 or more.
//!
//! ```text
//!   ModalStorage::set: inputs ─► t ─► load B(t) p, and where t has changed S(t)
//!   Modal::tick:       Method on S(t) ─► x ─► y ─► certificate
//! ```
//! Rounding: y are exact by definition, as p and x are. The flux through the boundary is not quite that of its law then: what
//! this costs is counted in the norms of F_π's columns, and what S(t) is off in what the certificate is told of S.

mod storage;

pub use storage::{ArrayModalStorage, ModalMemory, ModalStorage};

use super::Condensed;
use super::candidate::Candidate;
use super::factor::{Factor, Norm};
use super::method::Method;
use super::outputs::dot;
use crate::dense::blocks::{Block, padded};
use crate::dense::outer::{add_outer, without_positive};
use crate::dense::ranges::Given;
use crate::dense::sizes;
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, all_finite, same_length};
use signorini_kernel::index::read;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Report;
use signorini_kernel::verdict::Verdict;

/// A condensed model with the modes of its coefficient (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Modal<'a, R> {
    /// The model where t = 0. Its inputs are those of the scene, then y; where its exchanges begin is not read.
    pub model: Condensed<'a, R>,
    /// The place of the coefficient among the inputs, the constant first.
    pub input: usize,
    /// The coefficient where t = 0, as the sum of two numbers: the first is as near to it as one can be.
    pub origin: [R; 2],
    /// t of a unit of the coefficient: a power of two.
    pub per_unit: R,
    /// ν_k
    pub compliance: &'a [R],
    /// β_k, a number for each input of the scene, the constant first.
    pub of_inputs: &'a [R],
    /// F_π; nothing without a certificate.
    pub laws: Option<Factor<'a, R>>,
    /// Whether entries of S(t) off the diagonal are above 0 by rounding alone, if at all: they become 0.
    pub is_monotone: bool,
}

impl<R: Real> Modal<'_, R> {
    /// Solves on `at`, the model that [`ModalStorage::set`] has left with its memory, and bounds the error.
    ///
    /// # Errors
    /// As for [`Condensed::tick`].
    pub fn tick<M: Method<R>, F: FnMut() -> u32>(
        &self,
        at: &Condensed<R>,
        method: &mut M,
        deadline: &mut Deadline<F>,
        memory: &mut ModalMemory<R>,
    ) -> Result<Report<R>, Error> {
        let ModalMemory { shared, inputs, t } = memory;
        let matrix = at.matrix()?;
        let spans = at.spans.of(shared.load.len(), &shared.spans);
        let given = Given::between(shared.load, spans, &[]);
        let progress = method.solve(&matrix, given, shared.iterate.reborrow(), deadline)?;
        at.clamp(&matrix, given, &mut shared.iterate)?;
        let x = at.unpadded(shared.iterate.x);
        self.set_amplitudes(*t, x, inputs)?;
        let residual = at.unpadded(shared.iterate.residual);
        let answer = Candidate { inputs, x, residual, ranges: given.ranges };
        let verdict = match (&at.certificate, &self.laws) {
            (Some(form), Some(laws)) => {
                let whole =
                    |own, z: &[R], sum: &mut [R]| with_laws(own, *t, form.norm(laws, x, z, sum)?);
                form.certify_with(&answer, shared.combination, shared.sum, whole)?
            }
            _ if at.has_bound => Verdict::NotAsked,
            _ => Verdict::Unavailable,
        };
        Ok(progress.report(x, verdict))
    }

    /// Fills `load` with B(t)p and the front of `all` with p, whose amplitudes mean nothing yet; returns t.
    fn combine(&self, inputs: &[R], all: &mut [R], load: &mut [R]) -> Result<R, Error> {
        all_finite(Array::Load, inputs)?;
        same_length(Array::Load, all.len(), inputs.len() + self.compliance.len())?;
        let t = self.change(inputs);
        let (given, amplitudes) = all.split_at_mut_checked(inputs.len()).unwrap_or_default();
        given.iter_mut().zip(inputs).for_each(|(given, &input)| *given = input);
        let betas = self.of_inputs.chunks_exact(inputs.len().max(1));
        for ((y, beta), &nu) in amplitudes.iter_mut().zip(betas).zip(self.compliance) {
            *y = -gain(t, nu) * dot(beta, inputs);
        }
        self.model.combine(all, load)?;
        if self.model.contact > 0 {
            self.enlarge(t, inputs.len(), sizes::room(sizes::of_load(load)?), all);
        }
        self.model.check_magnitude(all, load)?;
        Ok(t)
    }

    /// Amplitudes as large as any x allows that is no larger than `room`.
    fn enlarge(&self, t: R, given: usize, room: R, all: &mut [R]) {
        let amplitudes = all.iter_mut().skip(given);
        for ((y, alpha), &nu) in amplitudes.zip(self.alphas(given)).zip(self.compliance) {
            let size = alpha.iter().fold(R::ZERO, |sum, entry| sum + entry.magnitude());
            *y = y.magnitude() + gain(t, nu) * (size * room);
        }
    }

    /// y_k = g_k (β_k·p + α_k·x)
    fn set_amplitudes(&self, t: R, x: &[R], all: &mut [R]) -> Result<(), Error> {
        let count = all.len().saturating_sub(self.compliance.len());
        same_length(Array::Coefficients, self.of_inputs.len(), count * self.compliance.len())?;
        let (inputs, amplitudes) = all.split_at_mut_checked(count).unwrap_or_default();
        let betas = self.of_inputs.chunks_exact(count.max(1));
        let modes = betas.zip(self.alphas(count)).zip(self.compliance);
        for (y, ((beta, alpha), &nu)) in amplitudes.iter_mut().zip(modes) {
            *y = gain(t, nu) * (dot(beta, inputs) + dot(alpha, x));
        }
        Ok(())
    }

    /// α_k; without contact they are empty.
    fn alphas(&self, given: usize) -> impl Iterator<Item = &[R]> {
        let length = padded(self.model.contact);
        let of_modes = self.model.load.get(given * length..).unwrap_or_default();
        (0..self.compliance.len())
            .map(move |k| of_modes.get(k * length..(k + 1) * length).unwrap_or_default())
    }

    /// t of these inputs.
    fn change(&self, inputs: &[R]) -> R {
        let [near, rest] = self.origin;
        (read(inputs, self.input) - near - rest) * self.per_unit
    }

    /// S(t)
    fn matrix(&self, t: R, given: usize, blocks: &mut [Block<R>]) -> Result<(), Error> {
        same_length(Array::MatrixValues, blocks.len(), self.model.matrix.len())?;
        blocks.copy_from_slice(self.model.matrix);
        let length = padded(self.model.contact);
        let columns = self.model.load.get(given * length..).unwrap_or_default();
        add_outer(blocks, self.model.contact, columns, |k| gain(t, read(self.compliance, k)))?;
        if self.is_monotone {
            without_positive(blocks);
        }
        Ok(())
    }
}

/// t/(1 + tν)
fn gain<R: Real>(t: R, nu: R) -> R {
    t / (R::ONE + t * nu)
}

/// (own² + t laws²)^½. Next to the least coefficient the rounding of its range may leave t below 0.
fn with_laws<R: Real>(own: Norm<R>, t: R, laws: Norm<R>) -> Result<Norm<R>, Error> {
    let root = t.or_larger(R::ZERO).rounded_sqrt();
    let more = root * laws.value;
    let value = (own.value * own.value + more * more).rounded_sqrt().or_larger(own.value);
    // Few roundings, t's own among them, and squares that underflow.
    let few = R::from_count(8) * R::EPSILON * value + (R::from_count(4) * R::TINY).rounded_sqrt();
    let rounding = own.rounding + root * laws.rounding * (R::ONE + R::from_count(4) * R::EPSILON);
    Ok(Norm { value, rounding: rounding + few })
}

#[cfg(test)]
mod tests {
    use super::*;

    const EPSILON: f64 = f64::EPSILON;

    /// (3² + 4·2²)^½ = 5 at t = 4.
    #[test]
    fn laws_are_added_as_squares_and_their_rounding_as_it_is() -> Result<(), Error> {
        let of = |of_own, t, of_laws| {
            let own = Norm { value: 3.0, rounding: of_own };
            with_laws(own, t, Norm { value: 2.0, rounding: of_laws })
        };
        let of_sum = 40.0 * EPSILON;
        assert_eq!(of(0.0, 4.0, 0.0)?, Norm { value: 5.0, rounding: of_sum });
        assert_eq!(of(1.0, 4.0, 0.0)?.rounding, 1.0 + of_sum);
        let both = of(1.0, 4.0, 0.5)?.rounding;
        assert!((both - (2.0 + 44.0 * EPSILON)).abs() <= 2.0 * EPSILON, "{both}");
        // t below 0, by rounding, is 0.
        assert_eq!(of(1.0, -0.25, 0.5)?, Norm { value: 3.0, rounding: 1.0 + 24.0 * EPSILON });
        Ok(())
    }

    /// Squares that underflow are counted: (4 · TINY)^½.
    #[test]
    fn next_to_0_underflow_is_counted() -> Result<(), Error> {
        let nothing = Norm { value: 0.0, rounding: 0.0 };
        let lost = (4.0 * <f64 as Real>::TINY).sqrt();
        let found = with_laws(nothing, 1.0, nothing)?;
        assert!(found.value == 0.0 && (found.rounding / lost - 1.0).abs() < 1e-12, "{found:?}");
        Ok(())
    }
}

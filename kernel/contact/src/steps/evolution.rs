//! The bound of the evolution of a condensed model ([`signorini_kernel::evolution`]), carried from step to step.
//!
//! A state that nothing changes leaves no R = f̄ − k(s − s_old) + ∇·τ, so that R is linear in what a step changes, as s − s_old is:
//! ```text
//!   w = (p − p⁻, x − x⁻, y⁻, d − d⁻),    ∫R²/k = U² ‖F_R w‖²,    ‖A^½∇(s − s_old)‖² + ∫_R h (s − s_old)² = U² ‖F_M w‖² = m²
//! ```
//! The certificate knows a² + ∫R²/k, a being the distance of s and τ at the end of the step. With the τ of the step, s is no farther than
//! a + m at its beginning, and a + m/2 in its middle. All of R counts in the norm of what is stored. Contact adds at the end what it adds
//! to the certificate, and at the beginning what this tick's τ makes of the last s − ψ.
//!
//! What mends τ changes both a and R by its energy at most. What rounding hides in the certificate may be in each of the terms.

use super::super::Condensed;
use super::super::candidate::Candidate;
use super::super::certificate::Form;
use super::super::factor::Factor;
use super::super::sides::ON_GAP;
use signorini_kernel::Real;
use signorini_kernel::error::Error;
use signorini_kernel::evolution::{Carried, Rates, StepTerms};
use signorini_kernel::index::read;
use signorini_kernel::verdict::Certificate;

/// What the bound of the evolution takes beside the form of a step (borrowed). Columns of factors stand for w.
#[derive(Debug, Clone, Copy)]
pub struct Evolution<'a, R> {
    /// dt
    pub length: R,
    /// How fast the past fades.
    pub rates: Rates<R>,
    /// F_R
    pub residual: Factor<'a, R>,
    /// F_M
    pub motion: Factor<'a, R>,
    /// For both ends of every contact edge its number among the vertices; from there on that of a corner; or [`ON_GAP`].
    pub ends: &'a [[u16; 2]],
    /// U / d_i: values of s − ψ, in the unit of U, times this are in that of 1/r_i.
    pub scale: &'a [R],
}

/// What a step begins from (borrowed).
#[derive(Debug, Clone, Copy)]
pub(super) struct Past<'t, R> {
    /// p⁻ without the constant.
    pub inputs: &'t [R],
    /// x⁻
    pub openings: &'t [R],
    /// d⁻
    pub corrections: &'t [R],
}

impl<R: Real> Evolution<'_, R> {
    /// 2ct with this tick's τ, whose r may be off by `uncertainty`, and what the last tick has left of s − ψ; nothing where s is on a side that there is not.
    pub(super) fn contact_before(
        &self,
        form: &Form<R>,
        (answer, uncertainty): (&Candidate<R>, R),
        past: &Past<R>,
    ) -> Option<R> {
        let mut sum = R::ZERO;
        for (edge, ends) in self.ends.iter().enumerate() {
            let ends = ends.map(|end| self.excess(form, (edge, end), past));
            sum += form.charge(edge, answer, ends, uncertainty)?;
        }
        let terms = R::from_count(self.ends.len() as u32 + 8);
        Some(sum * (R::ONE + terms * R::EPSILON))
    }

    /// The last s − ψ at an end of an edge in the unit of 1/r, and what rounding may hide of it.
    fn excess(&self, form: &Form<R>, (edge, end): (usize, u16), past: &Past<R>) -> [R; 2] {
        let place = usize::from(end);
        if end == ON_GAP {
            return [R::ZERO; 2];
        }
        if let Some(vertex) = form.vertices.get(place) {
            let [left, right] = vertex.terms(past.openings);
            let opening = (left + right) + read(past.corrections, place);
            return [opening * read(self.scale, edge), R::ZERO];
        }
        let corner = form.corners.get(place - form.vertices.len());
        corner.map_or([R::ZERO; 2], |corner| corner.before(past.inputs))
    }

    /// What is carried on from a step with this certificate; w is `changes`.
    pub(super) fn advance(
        &self,
        carried: Carried<R>,
        (model, certificate): (&Condensed<R>, Option<&Certificate<R>>),
        contact: [Option<R>; 2],
        changes: &[R],
        sum: &mut [R],
    ) -> Carried<R> {
        let terms = match (&model.certificate, certificate, contact) {
            (Some(form), Some(of), [Some(begin), Some(end)]) => {
                self.terms(form.unit, of, [begin, end], changes, sum).ok()
            }
            _ => None,
        };
        self.rates.advance(carried, &[terms])
    }

    /// Terms of the step in the unit of energy.
    fn terms(
        &self,
        unit: R,
        of: &Certificate<R>,
        contact: [R; 2],
        changes: &[R],
        sum: &mut [R],
    ) -> Result<StepTerms<R>, Error> {
        let [gap, algebraic, oscillation, hidden] =
            [of.duality_gap, of.algebraic, of.oscillation, of.rounding].map(|part| part / unit);
        let count = self.residual.norms.len();
        let sum = sum.get_mut(..count).unwrap_or_default();
        let residual = self.residual.norm(changes, sum)?;
        let motion = self.motion.norm(changes, sum)?;
        let of_motion = motion.value + motion.rounding;
        let known = residual.value - (residual.rounding + algebraic + hidden);
        let known = known.or_larger(R::ZERO);
        let most = residual.value + residual.rounding + algebraic + hidden;
        let up = R::ONE + R::from_count(8) * R::EPSILON;
        // A difference of squares: what rounding hides in the larger one belongs into it.
        let most_gap = gap + hidden;
        let square = most_gap * most_gap * up - contact[1] - known * known;
        let end = square.or_larger(R::ZERO).rounded_sqrt() * up;
        let middle = end + R::HALF * of_motion;
        let begin = end + of_motion;
        Ok(StepTerms::new(
            self.length,
            ([most * most, R::ZERO, R::ZERO], oscillation + hidden),
            [begin * begin, middle * middle, end * end],
            contact,
        ))
    }
}

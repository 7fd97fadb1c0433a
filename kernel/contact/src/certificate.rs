//! The error bound of a condensed answer, from forms that the host has baked.
//!
//! The pair (s, τ) of `signorini_bound::certificate` is linear in the inputs p, the openings x and a correction d:
//! ```text
//!   τ        the flux of u, in balance on every cell: the free unknowns were eliminated exactly
//!   s = Σ …  on contact vertices ψ + e,  e = E x + d ≥ 0,  elsewhere the best continuous function for it
//!   ‖A^½∇s − A^{−½}τ‖ = U ‖F (p, x, d)‖,           U the unit of energy
//! ```
//! E interpolates the openings of edges at their ends; d takes e back to 0 beside edges that touch, where
//! (τ·n − q)(s − ψ) would cost dearly, and where extrapolation fell below 0.
//!
//! What keeps τ from being admissible is r = Sx − b: it must be 0 on open edges and not negative on those
//! that touch. Fluxes w_i that bring 1 in through contact edge i and out elsewhere mend it, and
//! ```text
//!   ‖A^{−½} Σ δ_i w_i‖ ≤ U · stability · ‖δ‖
//! ```
//! is added to the first part. The function of the edge means, u_h, is off by ‖A^½∇_h(s − u_h)‖ more, which is a form
//! of the same numbers: [`Certificate::of_u`].
//!
//! Mended so, τ·n = q or s = ψ all along C, but where a Dirichlet value above ψ
//! ends a touching edge. Fluxes with a limit are mended into their range, and s may cross ψ (`price`).
//!
//! Rounding: p and x are exact by definition. F, S and B were rounded once, and products with them
//! are off by a few ε of their terms; so are the sums over edges and inputs that are left, the oscillation
//! among them. All of it is in [`Certificate::rounding`].

mod places;
mod price;

pub use places::{Corner, Vertex};

use super::candidate::Candidate;
use super::factor::{Factor, Norm};
use super::sides::Sides;
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::read;
use signorini_kernel::verdict::{Certificate, Verdict};

/// The baked forms (borrowed). Columns of F stand for the inputs, the openings, then d.
#[derive(Debug, Clone, Copy)]
pub struct Form<'a, R> {
    /// F
    pub factor: Factor<'a, R>,
    /// J with ‖A^½∇_h(s − u_h)‖ = U ‖J (p, x, d)‖; nothing where ‖F (p, x, d)‖ is never less: on triangles with
    /// constant A, where A∇u_h is the constant part of the flux.
    pub jump: Option<Factor<'a, R>>,
    /// Contact vertices, in the order of d.
    pub vertices: &'a [Vertex<R>],
    /// Corners.
    pub corners: &'a [Corner<'a, R>],
    /// The ends of contact edges, where a flux has a limit.
    pub sides: Sides<'a, R>,
    /// √λ_max of the energies of the mending fluxes w_i.
    pub stability: R,
    /// Where contact alone holds one part of the domain: the physical flux of a unit of r_i on each contact edge of it,
    /// 0 on the others. What is mended then leaves through its edge that is pressed most. Empty elsewhere.
    pub floating: &'a [R],
    /// The oscillation of each input's pattern, in the unit of energy.
    pub oscillation: &'a [R],
    /// max_i Σ_j |S_ij|
    pub row_sum: R,
    /// max_i |B_ij| of each input's pattern.
    pub largest_load: &'a [R],
    /// U
    pub unit: R,
}

impl<R: Real> Form<'_, R> {
    /// Bounds the error; where there is no bound it says why: numbers that overflow, a Dirichlet value below the
    /// gap, a floating domain that is pressed nowhere.
    ///
    /// `z` and `sum` are scratch, one number for each column of F.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn certify(
        &self,
        answer: &Candidate<R>,
        z: &mut [R],
        sum: &mut [R],
    ) -> Result<Verdict<R>, Error> {
        self.certify_with(answer, z, sum, |norm, _, _| Ok(norm))
    }

    /// Certifies with the value that `whole` makes of ‖F (p, x, d)‖, given z and scratch: that of all forms there are.
    pub(super) fn certify_with(
        &self,
        answer: &Candidate<R>,
        z: &mut [R],
        sum: &mut [R],
        whole: impl FnOnce(Norm<R>, &[R], &mut [R]) -> Result<Norm<R>, Error>,
    ) -> Result<Verdict<R>, Error> {
        let Candidate { inputs, x, residual, ranges } = *answer;
        same_length(Array::Load, self.oscillation.len(), inputs.len())?;
        same_length(Array::Load, self.largest_load.len(), inputs.len())?;
        same_length(Array::Contact, residual.len(), x.len())?;
        let columns = inputs.len() + x.len() + self.vertices.len();
        same_length(Array::Scratch, z.len(), columns)?;
        self.lay_out(answer, z);
        let norm = whole(self.norm(&self.factor, x, z, sum)?, z, sum)?;
        let uncertainty = self.uncertainty(answer);
        let mended = match ranges.are_limited() {
            true => self.mend_within(answer, uncertainty),
            false => self.mend(x, residual, uncertainty),
        };
        let Some(mended) = mended else { return Ok(Verdict::Unpressed) };
        let Some([corner, misplaced]) = self.contact(answer, z, uncertainty)? else {
            return Ok(Verdict::BelowGap);
        };
        // Everything in the unit of energy, until the end: squares stay within the scalar's range.
        let algebraic = self.stability * mended.known;
        let first = norm.value + algebraic;
        let gap = (first * first + corner).rounded_sqrt().or_larger(first);
        let all = R::from_count(x.len() as u32).rounded_sqrt();
        let hidden =
            norm.rounding + self.stability * (all * uncertainty + mended.hidden) + misplaced;
        let sizes = self.oscillation.iter().zip(inputs);
        let oscillation = sizes.fold(R::ZERO, |sum, (&o, p)| sum + o * p.magnitude());
        // Sums of so many terms at most, none of which is negative.
        let terms = R::from_count((x.len() + inputs.len() + 32) as u32);
        let rounding = hidden + terms * R::HALF * R::EPSILON * (gap + oscillation);
        let both = (gap * gap + oscillation * oscillation).rounded_sqrt().or_larger(gap);
        let total = oscillation + both + rounding;
        let jump = match &self.jump {
            Some(factor) => self.norm(factor, x, z, sum)?,
            None => norm,
        };
        let of_u = total + (jump.value + jump.rounding) * (R::ONE + R::TWO * R::EPSILON);
        // What curved data leave out of s may be in it, and fluxes are mended.
        let distance = norm.value - (norm.rounding + algebraic + oscillation + rounding);
        let distance = distance.or_larger(R::ZERO);
        let [gap, algebraic, oscillation, rounding, total, of_u, distance] =
            [gap, algebraic, oscillation, rounding, total, of_u, distance]
                .map(|part| self.unit * part);
        // Next to underflow products are off by more than a part of themselves.
        let [rounding, total, of_u] = [rounding, total, of_u].map(|part| part + R::TINY);
        let certificate = Certificate {
            duality_gap: gap,
            algebraic,
            oscillation,
            rounding,
            total,
            of_u,
            distance,
        };
        let known = of_u.finite() && algebraic.finite();
        Ok(if known { Verdict::Certified(certificate) } else { Verdict::NotFinite })
    }

    /// The norm of a form, with what the rounding of e = E x + d can do to it.
    pub(super) fn norm(
        &self,
        factor: &Factor<R>,
        x: &[R],
        z: &[R],
        sum: &mut [R],
    ) -> Result<Norm<R>, Error> {
        let norm = factor.norm(z, sum)?;
        Ok(Norm { rounding: norm.rounding + self.nudged(factor, x), ..norm })
    }

    /// `z` = (p, x, d)
    fn lay_out(&self, answer: &Candidate<R>, z: &mut [R]) {
        let Candidate { inputs, x, .. } = *answer;
        let given = inputs.iter().chain(x);
        z.iter_mut().zip(given).for_each(|(z, &given)| *z = given);
        let corrections = z.iter_mut().skip(inputs.len() + x.len());
        if answer.ranges.are_limited() {
            let first = inputs.len() + x.len();
            for (at, (d, vertex)) in corrections.zip(self.vertices).enumerate() {
                let [left, right] = vertex.terms(x);
                let square = || self.factor.square(first + at);
                let at = (vertex, x);
                *d = price::correction(self.sides.baked(), answer.ranges, at, left + right, square);
            }
            return;
        }
        for (d, vertex) in corrections.zip(self.vertices) {
            let [left, right] = vertex.terms(x);
            let opening = left + right;
            let touches = vertex.beside.iter().any(|&edge| read(x, usize::from(edge)) == R::ZERO);
            *d = if touches || opening < R::ZERO { -opening } else { R::ZERO };
        }
    }

    /// Largest effect of the rounding of e = E x + d on the norm of a form.
    fn nudged(&self, factor: &Factor<R>, x: &[R]) -> R {
        let first = factor.norms.len().saturating_sub(self.vertices.len());
        let columns = factor.norms.iter().skip(first).zip(self.vertices);
        let sum = columns.fold(R::ZERO, |sum, (&norm, vertex)| {
            let [left, right] = vertex.terms(x);
            sum + (left.magnitude() + right.magnitude()) * norm
        });
        // Vertices that are moved towards ψ are rounded once more.
        let ulps = if self.sides.are_limited() { R::TWO + R::TWO } else { R::TWO };
        ulps * R::EPSILON * sum
    }

    /// By how much an entry of r can be off: by rounding, and where ends of its range have moved.
    pub(super) fn uncertainty(&self, answer: &Candidate<R>) -> R {
        let Candidate { inputs, x, ranges, .. } = *answer;
        let size = |x: R| if ranges.are_limited() { x.magnitude() } else { x };
        let largest = x.iter().fold(R::ZERO, |most, &x| most.or_larger(size(x)));
        let loads = self.largest_load.iter().zip(inputs);
        let loads = loads.fold(R::ZERO, |sum, (&b, p)| sum + b * p.magnitude());
        let terms = R::from_count((x.len() + inputs.len() + 4) as u32);
        let sizes = self.row_sum * largest + loads + self.spans(answer);
        terms * R::HALF * R::EPSILON * sizes + ranges.moved()
    }

    /// ‖δ‖: by how much r has to change so that open edges balance and touching ones are pressed; `None` where no edge bears it.
    fn mend(&self, x: &[R], residual: &[R], uncertainty: R) -> Option<Mended<R>> {
        let amount = |x: R, r: R| if x > R::ZERO || r < R::ZERO { -r } else { R::ZERO };
        let amounts = x.iter().zip(residual).map(|(&x, &r)| amount(x, r));
        let square = amounts.clone().fold(R::ZERO, |sum, amount| sum + amount * amount);
        if self.floating.is_empty() {
            return Some(Mended { known: square.rounded_sqrt(), hidden: R::ZERO });
        }
        let mut pressed = (R::ZERO, R::ONE);
        for ((&x, &r), &flux) in x.iter().zip(residual).zip(self.floating) {
            if x == R::ZERO && r * flux > pressed.0 {
                pressed = (r * flux, flux);
            }
        }
        let fluxes = amounts.zip(self.floating);
        let total = fluxes.fold(R::ZERO, |sum, (amount, &flux)| sum + amount * flux);
        let hidden = self.floating.iter().fold(R::ZERO, |sum, &flux| sum + flux * uncertainty);
        let (total, hidden) = (total.magnitude() / pressed.1, R::TWO * hidden / pressed.1);
        let bears = pressed.0 / pressed.1 > total + hidden;
        bears.then(|| Mended { known: (square + total * total).rounded_sqrt(), hidden })
    }

    /// What contact adds to the square, and what rounding of u_D − ψ costs; nothing where a Dirichlet value is on a side that there is not.
    pub(super) fn contact(
        &self,
        answer: &Candidate<R>,
        z: &[R],
        uncertainty: R,
    ) -> Result<Option<[R; 2]>, Error> {
        match answer.ranges.are_limited() {
            true => self.price(answer, z, uncertainty),
            false => self.corners(answer, uncertainty),
        }
    }

    /// 2∫_C (τ·n − q)(s − ψ), and what rounding of u_D − ψ costs.
    fn corners(&self, answer: &Candidate<R>, uncertainty: R) -> Result<Option<[R; 2]>, Error> {
        let (mut sum, mut misplaced) = (R::ZERO, R::ZERO);
        for corner in self.corners {
            let [excess, slack] = corner.at(answer.inputs)?;
            misplaced += slack * corner.energy;
            if !(excess >= -slack) {
                return Ok(None);
            }
            let edge = usize::from(corner.edge);
            if read(answer.x, edge) == R::ZERO {
                let flux = read(answer.residual, edge).or_larger(R::ZERO) + R::TWO * uncertainty;
                sum += flux * (excess.or_larger(R::ZERO) + slack);
            }
        }
        Ok(Some([sum, misplaced]))
    }
}

/// ‖δ‖, and what rounding adds beside √n times the uncertainty of an entry.
pub(super) struct Mended<R> {
    pub known: R,
    pub hidden: R,
}

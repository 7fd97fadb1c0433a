//! Whether fluxes within their ranges can balance the loads of a part that contact alone holds.
//!
//! ```text
//!   Σ_i b_i < 0, each contact flux at its least        Σ_i b_i > 0, each at its greatest
//! ```
//! b being the loads of the part on the mesh. A constant costs no energy there: of the solution u, tested with 1, Σ b is what
//! the multipliers of the least fluxes carry with the opposite sign, and some of them do. So there is no solution beyond
//! either line, and on it any constant may be added to one (`mesh::components` in the kernel judges a mesh in the same way). Both sums are linear in the inputs. The host has added
//! them up, with the sizes of their terms.

use crate::outputs::dot;
use signorini_kernel::Real;
use signorini_kernel::error::Error;

/// A part that contact alone holds (borrowed); a number for each input, the constant first.
#[derive(Debug, Clone, Copy)]
pub struct Balance<'a, R> {
    /// A cell of the part.
    pub cell: usize,
    /// Σ b with all contact fluxes at their least; empty where one has no end there.
    pub least: &'a [R],
    /// Σ b with all of them at their greatest; empty where one has no end there.
    pub greatest: &'a [R],
    /// The rounding of either sum, for a unit of each input.
    pub slack: &'a [R],
}

impl<R: Real> Balance<'_, R> {
    /// `Ok` where there is one solution for these inputs.
    ///
    /// # Errors
    /// [`Error::NoSolution`], or [`Error::NotUnique`] where the loads balance by themselves up to rounding.
    pub fn check(&self, inputs: &[R]) -> Result<(), Error> {
        let cell = self.cell;
        let terms = self.slack.iter().zip(inputs);
        let slack = terms.fold(R::ZERO, |sum, (&slack, &p)| sum + slack * p.magnitude());
        for (of, sign) in [(self.least, R::ONE), (self.greatest, -R::ONE)] {
            let beyond = sign * dot(of, inputs);
            if of.is_empty() || beyond < -slack {
                continue;
            }
            let is_rounding = beyond <= slack;
            return Err(if is_rounding {
                Error::NotUnique { cell }
            } else {
                Error::NoSolution { cell }
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Σ b = −1 + p at the least fluxes, and 3 more at the greatest; 2⁻²⁰ of |1| + |p| is rounding.
    const UNIT: f64 = 1.0 / (1 << 20) as f64;
    const ONE_END: Balance<f64> =
        Balance { cell: 7, least: &[-1.0, 1.0], greatest: &[], slack: &[UNIT, UNIT] };
    const TWO_ENDS: Balance<f64> = Balance { greatest: &[2.0, 1.0], ..ONE_END };

    const NONE: Result<(), Error> = Err(Error::NoSolution { cell: 7 });
    const MANY: Result<(), Error> = Err(Error::NotUnique { cell: 7 });

    #[test]
    fn loads_have_to_push_onto_the_contact() {
        let at = |p: f64| ONE_END.check(&[1.0, p]);
        assert_eq!([-1e300, -3.0, 0.0, 0.999].map(at), [Ok(()); 4]);
        assert_eq!([1.001, 2.0, 1e300].map(at), [NONE; 3]);
    }

    #[test]
    fn within_rounding_nothing_holds_the_level() {
        // |1| + |p| is 2 where Σ b = 0.
        let steps = [-2.5, -1.5, 0.0, 1.5, 2.5];
        let at = |steps: f64| ONE_END.check(&[1.0, 1.0 + steps * UNIT]);
        assert_eq!(steps.map(at), [Ok(()), MANY, MANY, MANY, NONE]);
    }

    #[test]
    fn fluxes_with_two_ends_carry_no_more_than_both() {
        let at = |p: f64| TWO_ENDS.check(&[1.0, p]);
        assert_eq!(
            [-2.5, -2.0, -1.5, 0.5, 1.0, 1.5].map(at),
            [NONE, MANY, Ok(()), Ok(()), MANY, NONE]
        );
        let from_above = Balance { least: &[], ..TWO_ENDS };
        assert_eq!([-2.5, -2.0, 1.5].map(|p| from_above.check(&[1.0, p])), [NONE, MANY, Ok(())]);
    }

    #[test]
    fn what_is_no_number_is_no_balance() {
        assert_eq!(ONE_END.check(&[1.0, f64::NAN]), NONE);
        assert_eq!(ONE_END.check(&[f64::INFINITY, f64::INFINITY]), NONE);
    }
}

//! Discs where kinks and jumps are resolved on the region itself: beside a kink the continuation is that of one branch.

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;
use super::continuation::{Disc, Discs};
use super::form::Form;
use super::interval::Interval;
use super::numbers::Forms;

/// The values on the region, and those of their continuation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Branch {
    pub form: Form,
    pub disc: Disc,
}

/// Discs with forms beside them.
pub(super) struct Branches(pub Forms, pub Discs);

impl Numbers for Branches {
    type Number = Branch;

    fn constant(&self, value: f64) -> Branch {
        Branch { form: self.0.constant(value), disc: self.1.constant(value) }
    }

    fn unary(&self, operation: Unary, a: Branch) -> Branch {
        let form = self.0.unary(operation, a.form);
        let disc = match (operation, a.form.range()) {
            (Unary::Abs, Interval { low, .. }) if low >= 0.0 => a.disc,
            (Unary::Abs, Interval { high, .. }) if high <= 0.0 => {
                self.1.unary(Unary::Negate, a.disc)
            }
            (Unary::Sign, _) if form.is_constant() => self.1.constant(form.range().low),
            _ => self.1.unary(operation, a.disc),
        };
        Branch { form, disc }
    }

    fn binary(&self, operation: Binary, a: Branch, b: Branch) -> Branch {
        let form = self.0.binary(operation, a.form, b.form);
        let Interval { low, high } = match operation {
            // One that is no number passes on.
            _ if !form.is_defined() => Interval::ALL,
            Binary::Max => a.form.minus(&b.form).range(),
            Binary::Min => b.form.minus(&a.form).range(),
            _ => Interval::ALL,
        };
        let disc = if low >= 0.0 {
            a.disc
        } else if high <= 0.0 {
            b.disc
        } else {
            self.1.binary(operation, a.disc, b.disc)
        };
        Branch { form, disc }
    }
}

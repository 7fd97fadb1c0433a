//! What the report of a controller holds, as lines of a journal.

use signorini_board::journal::{Bits, Journal};
use signorini_kernel::report::{Ended, Report};
use signorini_kernel::verdict::{Certificate, Verdict};

/// A report whose figures can be told.
pub trait Figures {
    /// A line for each.
    fn tell(&self, journal: &mut Journal);
}

impl<R: Bits> Figures for Report<R> {
    fn tell(&self, journal: &mut Journal) {
        journal.text(match self.ended {
            Ended::Exact => "exact",
            Ended::Accurate => "accurate",
            Ended::Settled => "settled",
            Ended::OutOfSweeps => "out of sweeps",
            Ended::OutOfTime => "out of time",
            Ended::NotFinite => "not finite",
        });
        journal.count("exchanges", self.exchanges);
        journal.count("sweeps", self.sweeps);
        journal.count("active", self.active);
        self.verdict.tell(journal);
    }
}

impl<R: Bits> Figures for Verdict<R> {
    fn tell(&self, journal: &mut Journal) {
        match self {
            Self::Certified(certificate) => certificate.tell(journal),
            Self::Pulled { edge } => journal.count("pulled", *edge as u32),
            Self::Unpressed => journal.text("no bound: unpressed"),
            Self::BelowGap => journal.text("no bound: below the gap"),
            Self::Unavailable => journal.text("no bound: unavailable"),
            Self::NotFinite => journal.text("no bound: not finite"),
            Self::NotAsked => journal.text("no bound: not asked"),
        }
    }
}

impl<R: Bits> Figures for Certificate<R> {
    fn tell(&self, journal: &mut Journal) {
        journal.scalar("gap", self.duality_gap);
        journal.scalar("algebraic", self.algebraic);
        journal.scalar("oscillation", self.oscillation);
        journal.scalar("rounding", self.rounding);
        journal.scalar("total", self.total);
        journal.scalar("of u", self.of_u);
    }
}

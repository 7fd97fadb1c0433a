//! What the reports of the kernel's models hold, as lines of a journal.

use signorini_board::journal::{Bits, Journal};
use signorini_kernel::certificate::Verdict;
use signorini_kernel::tick::{Ended, Report};

/// A report whose figures can be told.
pub trait Figures {
    /// A line for each.
    fn tell(&self, journal: &mut Journal);
}

impl<R: Bits> Figures for Report<R> {
    fn tell(&self, journal: &mut Journal) {
        let ended = match self.ended {
            Ended::Accurate => "accurate",
            Ended::Settled => "settled",
            Ended::OutOfSweeps => "out of sweeps",
            Ended::OutOfTime => "out of time",
            Ended::NotFinite => "not finite",
        };
        journal.text(ended);
        journal.count("sweeps", self.sweeps);
        journal.count("active", self.active);
        journal.count("changes", self.changes);
        journal.scalar("residual", self.residual);
        journal.scalar("force", self.force);
        journal.scalar("omega", self.omega);
        self.verdict.tell(journal);
    }
}

impl<R: Bits> Figures for Verdict<R> {
    fn tell(&self, journal: &mut Journal) {
        match self {
            Self::Certified(certificate) => {
                journal.scalar("gap", certificate.gap);
                journal.scalar("algebraic", certificate.algebraic);
                journal.scalar("oscillation", certificate.oscillation);
                journal.scalar("rounding", certificate.rounding);
                journal.scalar("total", certificate.total);
            }
            Self::Pulled { edge } => journal.count("pulled", *edge as u32),
            Self::NotFinite => journal.text("no bound: not finite"),
        }
    }
}

//! What the reports of the kernel's models hold, as lines of a journal.

use signorini_board::journal::{Bits, Journal};
use signorini_kernel::certificate::{Certificate, Verdict};
use signorini_kernel::condensed;
use signorini_kernel::condensed::method;
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
            Self::Certified(certificate) => certificate.tell(journal),
            Self::Pulled { edge } => journal.count("pulled", *edge as u32),
            Self::NotFinite => journal.text("no bound: not finite"),
            Self::NotAsked => journal.text("no bound: not asked"),
        }
    }
}

impl<R: Bits> Figures for Certificate<R> {
    fn tell(&self, journal: &mut Journal) {
        journal.scalar("gap", self.gap);
        journal.scalar("algebraic", self.algebraic);
        journal.scalar("oscillation", self.oscillation);
        journal.scalar("rounding", self.rounding);
        journal.scalar("total", self.total);
    }
}

impl<R: Bits> Figures for condensed::Report<R> {
    fn tell(&self, journal: &mut Journal) {
        journal.text(match self.ended {
            method::Ended::Exact => "exact",
            method::Ended::Converged => "converged",
            method::Ended::OutOfWork => "out of work",
        });
        journal.count("pivots", self.pivots);
        journal.count("sweeps", self.sweeps);
        journal.count("active", self.active);
        match &self.certificate {
            Some(certificate) => certificate.tell(journal),
            None => journal.text("no bound"),
        }
    }
}

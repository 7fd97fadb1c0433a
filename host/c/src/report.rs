//! The report of a tick, as C reads it.

use crate::scene::{Answer, Outputs, Scalar};
use signorini_device::kernel::report::{self, Ended};
use signorini_device::kernel::verdict::{Certificate, Verdict};

/// `NAME_report` of the header, field by field.
#[repr(C)]
pub struct Report {
    status: i32,
    bounded: i32,
    exchanges: u32,
    sweeps: u32,
    active: u32,
    pulled: u32,
    bound: Scalar,
    gap: Scalar,
    algebraic: Scalar,
    oscillation: Scalar,
    rounding: Scalar,
    of_u: Scalar,
    distance: Scalar,
    plus_minus: Outputs,
}

/// Where there is no bound.
const NONE: Certificate<Scalar> = Certificate {
    duality_gap: Scalar::INFINITY,
    algebraic: Scalar::INFINITY,
    oscillation: Scalar::INFINITY,
    rounding: Scalar::INFINITY,
    total: Scalar::INFINITY,
    of_u: Scalar::INFINITY,
    distance: 0.0,
};

impl Report {
    /// That of an answer.
    pub fn new(answer: &Answer) -> Self {
        let report = &answer.report;
        let bound = report.certificate().copied().unwrap_or(NONE);
        let pulled = match report.verdict {
            Verdict::Pulled { edge } => edge as u32,
            _ => 0,
        };
        Self {
            status: report.ended.code(),
            bounded: report.verdict.code(),
            exchanges: report.exchanges,
            sweeps: report.sweeps,
            active: report.active,
            pulled,
            bound: bound.total,
            gap: bound.duality_gap,
            algebraic: bound.algebraic,
            oscillation: bound.oscillation,
            rounding: bound.rounding,
            of_u: bound.of_u,
            distance: bound.distance,
            plus_minus: answer.plus_minus(),
        }
    }

    /// The answer that this is a report of, as far as intervals of its outputs need it.
    pub fn answer(&self, outputs: Outputs) -> Answer {
        let certificate = Certificate {
            duality_gap: self.gap,
            algebraic: self.algebraic,
            oscillation: self.oscillation,
            rounding: self.rounding,
            total: self.bound,
            of_u: self.of_u,
            distance: self.distance,
        };
        let certified = Verdict::Certified(certificate);
        let is_bounded = self.bounded == certified.code();
        let verdict = if is_bounded { certified } else { Verdict::Unavailable };
        let (ended, exchanges, sweeps, active) = (Ended::Exact, 0, 0, 0);
        Answer {
            outputs,
            report: report::Report { ended, exchanges, sweeps, active, verdict, figures: () },
        }
    }
}

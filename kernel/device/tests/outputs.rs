//! Outputs of a full model at the end of the range: finite, or said not to be.

use crate::numbering::SIDES;
use crate::owned::{TickArrays, of_full};
use crate::plate::foundation::Foundation;
use signorini_bound::certificate::Verdict;
use signorini_device::full::{Contribution, DataMemory, Functional};
use signorini_device::tick::{CertifiedSweeps, Deadline, Ended, Limits, Progress, Report};
use signorini_kernel::{Error, Libm};

/// A tick of the plate with a bound or without, and the outputs that it leaves.
fn tick<const N: usize>(
    outputs: &[Functional<f64, u16>; N],
    has_bound: bool,
) -> Result<(Report<f64>, [f64; N]), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let full = foundation.full(outputs, has_bound)?;
    let edges = &full.discretization.edges;
    let mut arrays = TickArrays::new(edges, foundation.plate.vertices.len());
    let (mut progress, mut found) = (Progress::NONE, [0.0; N]);
    let memory = of_full(arrays.memory(edges)?, DataMemory::default(), &mut progress);
    let (limits, never) = (Limits::default(), &mut Deadline::never());
    let report =
        full.tick(&[], CertifiedSweeps(Libm), (None, limits), never, memory, &mut found)?;
    Ok((report, found))
}

/// A probe of u on the last edge, where u = 0.9 is given, with this weight twice.
fn probe(foundation: &Foundation, weight: f64) -> Result<[Contribution<f64, u16>; 2], Error> {
    let at = foundation.plate.edges()?.counts().edges() as u16 - 1;
    Ok([(); 2].map(|()| Contribution { at, weight }))
}

#[test]
fn an_output_that_overflows_ends_its_tick() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    for (weight, ended) in [(1.0, Ended::Settled), (1e308, Ended::NotFinite)] {
        let probe = probe(&foundation, weight)?;
        // Whichever comes last.
        for outputs in [
            [Functional::Probe(&probe), Functional::Force(&[])],
            [Functional::Force(&[]), Functional::Probe(&probe)],
        ] {
            let (report, found) = tick(&outputs, true)?;
            assert_eq!(report.ended, ended, "{weight:e}: {found:?}");
            let is_finite = found.iter().all(|output| output.is_finite());
            assert_eq!(is_finite, ended == Ended::Settled, "{weight:e}: {found:?}");
            // u itself is sound, and so is what bounds its error.
            assert!(report.verdict.certificate().is_some(), "{report:?}");
        }
    }
    Ok(())
}

#[test]
fn an_infinite_bound_is_none_and_ends_nothing() -> Result<(), Error> {
    let (report, found) = tick(&[Functional::Bound, Functional::Force(&[])], false)?;
    assert_eq!((report.ended, report.verdict), (Ended::Settled, Verdict::Unavailable));
    assert_eq!(found, [f64::INFINITY, 0.0]);
    Ok(())
}

//! Reports of condensed ticks: their ends, reasons for no bound, and the effect of a reset.

use crate::memory::{Draw, bare};
use crate::strip::Strip;
use signorini_bound::certificate::Verdict;
use signorini_contact::Condensed;
use signorini_contact::dense::blocks::{count, padded};
use signorini_contact::dense::tableau::InitialTableau;
use signorini_contact::method::Sweeps;
use signorini_contact::storage::{ArrayStorage, ArrayTableauStorage};
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::{Ended, Report};
use signorini_tolerances::kernel::CONDENSED;

const EDGES: usize = 32;
/// Blocks of a tableau of so many, [`count`].
const BLOCKS: usize = 10;
const SWEEPS: Sweeps<f64> = Sweeps { omega: 1.0, tolerance: 1e-12, most: 4 };

/// A controller's memory.
struct Memory {
    storage: ArrayStorage<f64, EDGES, 0>,
    tableau: ArrayTableauStorage<f64, EDGES, BLOCKS>,
}

impl Memory {
    fn new() -> Self {
        assert_eq!(BLOCKS, count(EDGES));
        Self { storage: ArrayStorage::zeros(), tableau: ArrayTableauStorage::zeros() }
    }

    /// A tick with time for so many exchanges and sweeps together, and x.
    fn tick(
        &mut self,
        model: &Condensed<f64>,
        steps: u32,
    ) -> Result<(Report<f64>, Vec<f64>), Error> {
        let mut left = steps;
        let remaining = || {
            let now = left;
            left = left.saturating_sub(1);
            now
        };
        let deadline = &mut Deadline { remaining, sweep: 1, certificate: 0 };
        let mut method = self.tableau.method(model, 100, SWEEPS)?;
        let mut memory = self.storage.memory(model);
        let report = model.tick(&[1.0], &mut method, deadline, &mut memory)?;
        Ok((report, memory.iterate.x.to_vec()))
    }
}

/// Lends a model of the strip without a form; all of it touches in the beginning.
fn with_model<T>(
    has_bound: bool,
    then: impl FnOnce(&Condensed<f64>) -> Result<T, Error>,
) -> Result<T, Error> {
    let strip = Strip::<f64>::new(EDGES);
    let load = strip.load(0.1, &mut Draw(5));
    assert_eq!(load.len(), padded(EDGES));
    then(&Condensed {
        contact: EDGES,
        matrix: strip.blocks(),
        start: InitialTableau { blocks: strip.blocks(), exchanged: &[false; EDGES] },
        load: &load,
        has_bound,
        ..bare()
    })
}

#[test]
fn the_clock_ends_exchanges_and_the_next_ticks_go_on() -> Result<(), Error> {
    with_model(true, |model| {
        let (exact, expected) = Memory::new().tick(model, u32::MAX)?;
        assert_eq!((exact.ended, exact.sweeps), (Ended::Exact, 0));
        assert!(exact.exchanges > 6, "{exact:?}");
        let (mut memory, mut exchanges) = (Memory::new(), 0);
        for tick in 0.. {
            let (report, x) = memory.tick(model, 3)?;
            exchanges += report.exchanges;
            assert!(report.exchanges <= 3 && x.iter().all(|x| *x >= 0.0), "{report:?}");
            if report.ended == Ended::Exact {
                assert!(tick >= 2 && exchanges >= exact.exchanges, "{tick}");
                CONDENSED.check_each("openings", &x, &expected);
                break;
            }
            assert_eq!((report.ended, report.sweeps), (Ended::OutOfTime, 0), "{tick}");
            assert!(tick < 32);
        }
        Ok(())
    })
}

#[test]
fn the_clock_ends_sweeps_too() -> Result<(), Error> {
    with_model(true, |model| {
        let mut storage = ArrayStorage::<f64, EDGES, 0>::zeros();
        let mut left = 7;
        let remaining = || {
            left -= 1;
            left
        };
        let deadline = &mut Deadline { remaining, sweep: 2, certificate: 1 };
        let mut sweeps = Sweeps { most: 100, ..SWEEPS };
        let report = model.tick(&[1.0], &mut sweeps, deadline, &mut storage.memory(model))?;
        assert_eq!((report.ended, report.sweeps, report.exchanges), (Ended::OutOfTime, 4, 0));
        Ok(())
    })
}

#[test]
fn a_report_without_a_bound_says_why() -> Result<(), Error> {
    for (has_bound, expected) in [(true, Verdict::NotAsked), (false, Verdict::Unavailable)] {
        let report = with_model(has_bound, |model| Memory::new().tick(model, u32::MAX))?.0;
        assert_eq!((report.verdict, report.certificate()), (expected, None));
    }
    Ok(())
}

#[test]
fn after_a_reset_the_next_tick_is_the_first() -> Result<(), Error> {
    with_model(true, |model| {
        let mut memory = Memory::new();
        let first = memory.tick(model, u32::MAX)?;
        let second = memory.tick(model, u32::MAX)?;
        assert_ne!(first.0.exchanges, second.0.exchanges);
        memory.storage.reset();
        memory.tableau.reset();
        assert_eq!(memory.tick(model, u32::MAX)?, first);
        Ok(())
    })
}

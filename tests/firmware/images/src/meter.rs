//! What a piece of work costs, as a line that `cargo xtask cost` reads.
//!
//! ```text
//!   f32 triangles | sweep | unknown | 8975 392 68      in all, units that share it, bytes of stack
//! ```

use core::hint::black_box;

use signorini_kernel::Error;

use crate::board::clock::{Clock, UNIT};
use crate::board::{self, stack};
use crate::journal::Journal;

/// Repetitions of a stage in one count.
const TIMES: u32 = 20;
/// Printed where the counter goes round; whoever reads the lines refuses it.
const TOO_LONG: u32 = u32::MAX;
/// Bytes of stack that are watched.
const DEPTH: u32 = 8192;

/// A counter and where its counts go.
pub struct Meter<'a, 'j> {
    clock: Clock,
    journal: &'a mut Journal<'j>,
    kind: &'static str,
}

/// Counts, prints and ends; with a failure where there is no clock or a stage refuses.
pub fn run(count: impl FnOnce(&mut Meter) -> Result<(), Error>) -> ! {
    let Some(clock) = Clock::start() else { board::end(false) };
    board::run(|journal| {
        if count(&mut Meter { clock, journal, kind: "" }).is_err() {
            board::end(false);
        }
    })
}

impl Meter<'_, '_> {
    /// What the next counts are of.
    pub fn kind(&mut self, kind: &'static str) -> &mut Self {
        self.kind = kind;
        self
    }

    /// Prints what `work` costs, by how many units it is shared, and how much stack it takes.
    ///
    /// # Errors
    /// Those of `work`.
    pub fn count(
        &mut self,
        stage: &str,
        unit: &str,
        units: usize,
        mut work: impl FnMut() -> Result<(), Error>,
    ) -> Result<(), Error> {
        work()?;
        let mut repeated = || {
            // Just seen to succeed.
            let _ = black_box(work());
        };
        // What is too long for the counter twenty times over needs no finer grain than once.
        let often = self.clock.measure(TIMES, &mut repeated).map(|counts| counts * UNIT / TIMES);
        let once = || self.clock.measure(1, &mut repeated).map(|counts| counts * UNIT);
        let total = often.or_else(once).unwrap_or(TOO_LONG);
        let mut last = Ok(());
        let bytes = stack::depth(DEPTH, || last = work());
        self.journal.row(&[self.kind, "|", stage, "|", unit, "|"], &[total, units as u32, bytes]);
        last
    }
}

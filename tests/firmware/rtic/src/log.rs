//! What the tick counts.

use signorini_device::tick::Ended;

use crate::budget::{BUDGET, PERIOD};
use crate::plant::Answer;

/// When a tick was where, in counts since it was due.
#[derive(Clone, Copy, Default)]
pub struct Times {
    /// It looked at the clock for the last time before the answer.
    pub looked: u32,
    /// The answer was there.
    pub answered: u32,
    /// All was done.
    pub ended: u32,
}

/// What happened so far.
#[derive(Clone, Copy)]
pub struct Log {
    /// Ticks done.
    pub ticks: u32,
    /// Ticks that ended when the next one was due already.
    pub misses: u32,
    /// Ticks that ended because the answer was as good as it has to be.
    pub accurate: u32,
    /// Ticks that ended because more sweeps would have bought nothing.
    pub settled: u32,
    /// Ticks that the deadline ended.
    pub cut: u32,
    /// Ticks that had done all the sweeps allowed.
    pub spent: u32,
    /// Sweeps in all.
    pub sweeps: u32,
    /// The longest tick.
    pub longest: u32,
    /// What the tick that had least left before the next one was due.
    pub reserve: u32,
    /// The longest from the last look at the clock to the answer: a certificate and the report.
    pub unwatched: u32,
    /// The longest from the end of the budget to the answer.
    pub overshoot: u32,
    /// Answers overwritten before they were read: the lower task gets too little time.
    pub unread: u32,
}

impl Log {
    /// No ticks.
    pub const EMPTY: Self = Self {
        ticks: 0,
        misses: 0,
        accurate: 0,
        settled: 0,
        cut: 0,
        spent: 0,
        sweeps: 0,
        longest: 0,
        reserve: PERIOD,
        unwatched: 0,
        overshoot: 0,
        unread: 0,
    };

    /// Counts a tick and its answer.
    pub fn include(&mut self, answer: &Answer, times: Times) {
        self.ticks += 1;
        self.sweeps += answer.sweeps;
        match answer.ended {
            Ended::Exact | Ended::Settled => self.settled += 1,
            Ended::OutOfTime => self.cut += 1,
            Ended::OutOfSweeps => self.spent += 1,
            Ended::Accurate => self.accurate += 1,
            // No answer: the sums of the others show it.
            Ended::NotFinite => {}
        }
        self.misses += u32::from(times.ended >= PERIOD);
        self.longest = self.longest.max(times.ended);
        self.reserve = self.reserve.min(PERIOD.saturating_sub(times.ended));
        self.unwatched = self.unwatched.max(times.answered.saturating_sub(times.looked));
        self.overshoot = self.overshoot.max(times.answered.saturating_sub(BUDGET));
    }
}

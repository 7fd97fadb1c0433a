//! What the tick counts, and the verdict on the run.

use signorini_board::journal::Journal;
use signorini_device::tick::Ended;

use crate::clock::INSTRUCTIONS;
use crate::costs::{BUDGET, Costs};
use crate::plant::{Answer, PERIOD};

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
    misses: u32,
    /// Ticks that ended because the answer was as good as it has to be, or more sweeps would have bought nothing.
    accurate: u32,
    /// Ticks that the deadline ended.
    cut: u32,
    /// Ticks that had done all the sweeps allowed.
    spent: u32,
    /// Sweeps in all.
    sweeps: u32,
    /// Answers overwritten before they were read: the lower task gets too little time.
    pub unread: u32,
    /// The longest tick.
    longest: u32,
    /// The longest from the last look at the clock to the answer: a certificate and the report.
    unwatched: u32,
    /// The longest from the end of the budget to the answer.
    overshoot: u32,
}

impl Log {
    /// No ticks.
    pub const EMPTY: Self = Self {
        ticks: 0,
        misses: 0,
        accurate: 0,
        cut: 0,
        spent: 0,
        sweeps: 0,
        unread: 0,
        longest: 0,
        unwatched: 0,
        overshoot: 0,
    };

    /// Counts a tick and its answer.
    pub fn include(&mut self, answer: &Answer, times: Times) {
        self.ticks += 1;
        self.sweeps += answer.report.sweeps;
        match answer.report.ended {
            Ended::Accurate | Ended::Exact | Ended::Settled => self.accurate += 1,
            Ended::OutOfTime => self.cut += 1,
            Ended::OutOfSweeps => self.spent += 1,
            // No answer: the sum of the others shows it.
            Ended::NotFinite => {}
        }
        self.misses += u32::from(times.ended >= PERIOD);
        self.longest = self.longest.max(times.ended);
        self.unwatched = self.unwatched.max(times.answered.saturating_sub(times.looked));
        self.overshoot = self.overshoot.max(times.answered.saturating_sub(BUDGET));
    }

    /// Prints everything, and whether the run was good: no miss, no answer that is wrong or that nobody read, no tick that ended
    /// otherwise than it should, and costs that the deadlines were told.
    pub fn tell(&self, wrong: u32, costs: &Costs, journal: &mut Journal) -> bool {
        journal.count("ticks", self.ticks);
        journal.count("misses", self.misses);
        journal.count("accurate", self.accurate);
        journal.count("cut", self.cut);
        journal.count("spent", self.spent);
        journal.count("sweeps", self.sweeps);
        journal.count("unread", self.unread);
        journal.count("wrong", wrong);
        let mut instructions = |name, counts| journal.count(name, counts * INSTRUCTIONS);
        instructions("sweep, instructions", costs.sweep);
        instructions("longest tick, instructions", self.longest);
        instructions("longest from last look to answer, instructions", self.unwatched);
        instructions("longest past the budget, instructions", self.overshoot);
        let ended = self.accurate + self.cut + self.spent;
        let whole = self.misses == 0 && self.unread == 0 && wrong == 0 && ended == self.ticks;
        whole && self.overshoot == 0 && costs.are_covered(self.unwatched)
    }
}

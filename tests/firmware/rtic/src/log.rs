//! What the tick hands down, what it counts, and the verdict on both.

use crate::console::{end, line};
use crate::plant::{COLUMNS, MINIMUM};

/// The result of one tick.
#[derive(Clone, Copy)]
pub struct Answer {
    /// Power of the heater in W/m.
    pub force: f32,
    /// Temperatures of the heated segments in °C.
    pub surface: [f32; COLUMNS],
}

impl Answer {
    /// Finite, and nowhere too cold: a solve that was cut short has to keep this too.
    pub fn is_usable(&self) -> bool {
        self.force.is_finite() && self.surface.iter().all(|&u| u.is_finite() && u >= MINIMUM)
    }
}

/// What happened so far.
#[derive(Clone, Copy, Default)]
pub struct Log {
    /// Ticks done.
    pub ticks: u32,
    /// Ticks that ended when the next one was due already.
    pub misses: u32,
    /// Ticks whose budget ended before the solve did.
    pub cut: u32,
    /// Sweeps in all.
    pub sweeps: u32,
    /// The longest tick in counts of SysTick.
    pub longest: u32,
    /// Answers overwritten before they were read: the lower task gets too little time.
    pub unread: u32,
}

impl Log {
    /// Prints the counts and the last answer; success is a run without a miss, without an answer that
    /// nobody read, and without any of the `wrong` ones that are not usable.
    pub fn report(&self, last: &Answer, wrong: u32) -> ! {
        line::<10>("ticks", self.ticks);
        line::<10>("misses", self.misses);
        line::<10>("cut", self.cut);
        line::<10>("sweeps", self.sweeps);
        line::<10>("longest", self.longest);
        line::<10>("unread", self.unread);
        line::<10>("wrong", wrong);
        line::<16>("force", last.force.to_bits());
        end(self.misses == 0 && self.unread == 0 && wrong == 0)
    }
}

//! The verdict: on every answer, and on the run.

use signorini_bound::certificate::Certificate;
use signorini_kernel::{Libm, Math};

use crate::budget::Costs;
use crate::clock::INSTRUCTIONS;
use crate::console::{end, line};
use crate::log::Log;
use crate::plant::{Answer, MINIMUM};

/// What the answers were like.
#[derive(Clone, Copy)]
pub struct Judge {
    /// Answers that are not to be used.
    wrong: u32,
    /// The largest bound of the error, in thousandths of the energy norm.
    worst: u32,
    /// The sum of the same.
    sum: u32,
}

impl Judge {
    /// No answers.
    pub const NEW: Self = Self { wrong: 0, worst: 0, sum: 0 };

    /// Finite, nowhere too cold, and with a bound of its error: one that was cut short has to keep
    /// this too.
    pub fn include(&mut self, answer: &Answer) {
        let feasible = answer.surface.iter().all(|&u| u.is_finite() && u >= MINIMUM);
        // The wind never rests, so heat flows.
        let sound = answer.force.is_finite() && answer.energy > 0.0;
        match answer.verdict.certificate() {
            Some(bound) if feasible && sound && bound.total.is_finite() => {
                let thousandths = relative(bound, answer.energy);
                self.worst = self.worst.max(thousandths);
                self.sum += thousandths;
            }
            _ => self.wrong += 1,
        }
    }

    /// Prints everything and ends. A good run has no miss, no answer that is wrong or that nobody
    /// read, no tick that ended otherwise than it should, and costs that the deadlines were told.
    pub fn conclude(&self, log: &Log, costs: &Costs, last: &Answer) -> ! {
        let ended = log.accurate + log.settled + log.cut + log.spent;
        show(log);
        line::<10>("sweep, instructions", costs.sweep * INSTRUCTIONS);
        line::<10>("wrong", self.wrong);
        line::<10>("worst bound, thousandths", self.worst);
        line::<10>("mean bound, thousandths", self.sum / log.ticks.max(1));
        line::<16>("force", last.force.to_bits());
        let whole = log.misses == 0 && log.unread == 0 && self.wrong == 0 && ended == log.ticks;
        end(whole && log.overshoot == 0 && costs.are_covered(log.unwatched))
    }
}

/// The bound in thousandths of the energy norm.
fn relative(bound: &Certificate<f32>, energy: f32) -> u32 {
    (1000.0 * bound.total / Libm::sqrt(energy)) as u32
}

fn show(log: &Log) {
    line::<10>("ticks", log.ticks);
    line::<10>("misses", log.misses);
    line::<10>("accurate", log.accurate);
    line::<10>("settled", log.settled);
    line::<10>("cut", log.cut);
    line::<10>("spent", log.spent);
    line::<10>("sweeps", log.sweeps);
    line::<10>("unread", log.unread);
    line::<10>("longest tick, instructions", log.longest * INSTRUCTIONS);
    line::<10>("smallest reserve, instructions", log.reserve * INSTRUCTIONS);
    line::<10>("longest from last look to answer, instructions", log.unwatched * INSTRUCTIONS);
    line::<10>("longest past the budget, instructions", log.overshoot * INSTRUCTIONS);
}

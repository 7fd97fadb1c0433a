//! The verdict: on every answer, and on the run.

use signorini_kernel::report::Ended;

use crate::budget::{BUDGET, Costs, PERIOD};
use crate::clock::INSTRUCTIONS;
use crate::console::{end, line};
use crate::scene::{Answer, Inputs, Outputs};

/// What a tick leaves in the mailbox; times in counts since it was due.
#[derive(Clone, Copy)]
pub struct Record {
    pub inputs: Inputs,
    pub answer: Answer,
    /// From the last look at the clock to the answer.
    pub unwatched: u32,
    /// When the answer was there.
    pub answered: u32,
    /// When all was done.
    pub ended: u32,
    /// Answers before this one that nobody has read.
    pub unread: u32,
}

/// A mat: its nominal power in W/m and its name.
const MATS: [(&str, f32); 3] = [("nose", 96.0), ("middle", 64.0), ("aft", 54.0)];

/// °C that the mats hold.
const KEPT: f32 = 2.0;

/// What happened so far.
pub struct Judge {
    costs: Costs,
    ticks: u32,
    misses: u32,
    unread: u32,
    wrong: u32,
    accurate: u32,
    cut: u32,
    sweeps: u32,
    /// Ticks in which a part of each mat was saturated, and in which none was.
    saturated: [u32; 3],
    held: u32,
    worst: f32,
    longest: u32,
    unwatched: u32,
    overshoot: u32,
}

impl Judge {
    /// Before the first tick.
    pub const fn new(costs: Costs) -> Self {
        Self {
            costs,
            ticks: 0,
            misses: 0,
            unread: 0,
            wrong: 0,
            accurate: 0,
            cut: 0,
            sweeps: 0,
            saturated: [0; 3],
            held: 0,
            worst: 0.0,
            longest: 0,
            unwatched: 0,
            overshoot: 0,
        }
    }

    /// Ticks so far, those whose answers nobody has read among them.
    pub fn ticks(&self) -> u32 {
        self.ticks
    }

    /// Counts a tick and its answer. One that was cut short has to have a bound too, and powers that its supplies can give.
    pub fn include(&mut self, record: &Record) {
        let Record { inputs, answer, unwatched, answered, ended, unread } = *record;
        let report = &answer.report;
        self.ticks += 1 + unread;
        self.unread += unread;
        self.sweeps += report.sweeps;
        self.accurate += u32::from(matches!(report.ended, Ended::Accurate | Ended::Settled));
        self.cut += u32::from(report.ended == Ended::OutOfTime);
        self.misses += u32::from(ended >= PERIOD);
        self.longest = self.longest.max(ended);
        self.unwatched = self.unwatched.max(unwatched);
        self.overshoot = self.overshoot.max(answered.saturating_sub(BUDGET));
        let sound = self.take_mats(&inputs, &answer.outputs);
        match report.verdict.certificate() {
            Some(bound) if sound && bound.total.is_finite() => {
                self.worst = self.worst.max(bound.total);
            }
            _ => self.wrong += 1,
        }
    }

    /// Whether each mat gives what its supply allows, and is warm enough where it is not saturated.
    fn take_mats(&mut self, inputs: &Inputs, outputs: &Outputs) -> bool {
        let Outputs { nose_power, middle_power, aft_power, .. } = *outputs;
        let power = [nose_power, middle_power, aft_power];
        let short = [outputs.nose_saturated, outputs.middle_saturated, outputs.aft_saturated];
        let skin = [outputs.nose_skin, outputs.middle_skin, outputs.aft_skin];
        let supply = [inputs.nose_supply, inputs.middle_supply, inputs.aft_supply];
        let mut sound = true;
        let own = self.saturated.iter_mut().zip(MATS);
        let found = power.into_iter().zip(short).zip(skin.into_iter().zip(supply));
        for ((ticks, (_, nominal)), ((power, short), (skin, supply))) in own.zip(found) {
            let most = nominal * supply;
            let slack = 1e-4 * most;
            let warm = short > 0.0 || skin >= KEPT - 1e-3;
            sound &= power >= -slack && power <= most + slack && warm;
            *ticks += u32::from(short > 0.0);
        }
        self.held += u32::from(short.iter().all(|&length| length == 0.0));
        sound
    }

    /// Prints everything and ends. A good run has no miss, no answer that is wrong or that nobody read, costs that the
    /// deadlines were told, and has seen every mat saturated and all of them hold.
    pub fn conclude(&self, last: &Record) -> ! {
        self.show();
        let Outputs { nose_power, middle_power, aft_power, .. } = last.answer.outputs;
        for ((name, _), power) in MATS.into_iter().zip([nose_power, middle_power, aft_power]) {
            crate::console::text(name);
            line::<10>(", mW/m at last", (1000.0 * power) as u32);
        }
        let seen = self.held > 0 && self.saturated.iter().all(|&ticks| ticks > 0);
        let whole = self.misses == 0 && self.unread == 0 && self.wrong == 0 && seen;
        end(whole && self.overshoot == 0 && self.costs.are_covered(self.unwatched))
    }

    fn show(&self) {
        line::<10>("ticks", self.ticks);
        line::<10>("misses", self.misses);
        line::<10>("accurate", self.accurate);
        line::<10>("cut", self.cut);
        line::<10>("sweeps", self.sweeps);
        line::<10>("unread", self.unread);
        line::<10>("wrong", self.wrong);
        line::<10>("ticks in which all mats hold", self.held);
        for ((name, _), ticks) in MATS.iter().zip(self.saturated) {
            crate::console::text(name);
            line::<10>(" saturated in ticks", ticks);
        }
        line::<10>("worst bound, thousandths", (1000.0 * self.worst) as u32);
        line::<10>("sweep, instructions", self.costs.sweep * INSTRUCTIONS);
        line::<10>("longest tick, instructions", self.longest * INSTRUCTIONS);
        line::<10>("longest from last look to answer, instructions", self.unwatched * INSTRUCTIONS);
        line::<10>("longest past the budget, instructions", self.overshoot * INSTRUCTIONS);
    }
}

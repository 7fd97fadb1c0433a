//! The baked anti-icing slab that stores heat, `meshes/scenes/antiicing-warm.toml`, on a flight from cold. A tick is a step of a
//! second. A simple controller switches the mats by what the model says of their skins.
//!
//! `signorini bake --full` has written all of the model: this program knows names of inputs and outputs, and how long a
//! sweep takes. `cargo xtask boards` compares what it says with `tests/firmware/antiicing.txt`; with `--bless` the inputs that it
//! flew become `tests/firmware/logs/flight.csv`.

mod flight;

// What `mod scene;` is to a user's own module.
include!(concat!(env!("OUT_DIR"), "/module.rs"));

use signorini_board::journal::Journal;
use signorini_device::tick::{Deadline, Limits};
use signorini_kernel::Error;
use signorini_kernel::report::Report;

use flight::Flight;
pub use flight::TICKS;
pub use scene::{Controller as Memory, LIMITS};
use scene::{INPUTS, Inputs, Outputs};

/// A sweep of this scene: 14 400 instructions on a Cortex-M4F are 360 counts, with the search for ω now and then. Every run counts
/// it before the first tick (`Costs::measure`), and fails where it is more.
pub const SWEEP: u32 = 365;

/// Certificates of a step, the bound of the evolution, the outputs and the report: 1 688 360 instructions are 42 209 counts. Every
/// tick counts them, from the last look at the clock to the answer.
pub const CERTIFICATE: u32 = 42_500;

/// From one tick to the next, 3.2 million instructions instead of a second: so short that the deadline ends some ticks.
pub const PERIOD: u32 = 80_000;

/// The result of one tick.
#[derive(Clone, Copy)]
pub struct Answer {
    /// What the controller says of it.
    pub report: Report<f32>,
    inputs: Inputs,
    outputs: Outputs,
}

/// The slab and its flight.
pub struct Plant {
    controller: &'static mut Memory,
    flight: Flight,
    inputs: Inputs,
}

impl Plant {
    /// On the ground.
    pub fn new(controller: &'static mut Memory) -> Result<Self, Error> {
        Ok(Self { controller, flight: Flight::START, inputs: Inputs::DEFAULT })
    }

    /// Reads air and supplies.
    pub fn advance(&mut self) -> Result<(), Error> {
        if self.flight.is_on_ground() {
            // Costs were counted by ticks, and each was a step.
            self.controller.reset();
        }
        self.inputs = self.flight.next();
        Ok(())
    }

    /// The answer to them, from where the last one was. Inputs outside their ranges are refused; those of the flight are clamped
    /// to them.
    pub fn answer(
        &mut self,
        limits: Limits<f32>,
        deadline: &mut Deadline<impl FnMut() -> u32>,
    ) -> Result<Answer, Error> {
        let answer = self.controller.tick_within(self.inputs, limits, deadline)?;
        self.flight.switch(&answer.outputs);
        Ok(Answer { report: answer.report, inputs: self.inputs, outputs: answer.outputs })
    }
}

/// A mat: its nominal power in W/m and its name.
const MATS: [(&str, f32); 3] = [("nose", 96.0), ("middle", 64.0), ("aft", 54.0)];

/// °C that the mats hold.
const KEPT: f32 = 2.0;

/// What happened so far.
pub struct Judge {
    /// Ticks in which a part of each mat was saturated, and in which none was.
    saturated: [u32; 3],
    held: u32,
    worst: f32,
    /// The inputs of each tick.
    flown: [[f32; INPUTS]; TICKS as usize],
    ticks: usize,
}

impl Judge {
    /// Before the first tick.
    pub const NEW: Self = Self {
        saturated: [0; 3],
        held: 0,
        worst: 0.0,
        flown: [[0.0; INPUTS]; TICKS as usize],
        ticks: 0,
    };

    /// Whether an answer has a bound, and powers that its supplies can give: one that was cut short has to, too.
    pub fn is_sound(&mut self, answer: &Answer) -> bool {
        if let Some(flown) = self.flown.get_mut(self.ticks) {
            *flown = answer.inputs.to_array();
        }
        self.ticks += 1;
        let sound = self.take_mats(&answer.inputs, &answer.outputs);
        let bound = answer.report.verdict.certificate().filter(|bound| bound.total.is_finite());
        let Some(bound) = bound.filter(|_| sound) else { return false };
        self.worst = self.worst.max(bound.total);
        true
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

    /// Prints what the mats did; whether every mat was seen saturated and all of them hold.
    pub fn tell(&self, last: &Answer, journal: &mut Journal) -> bool {
        journal.count("ticks in which all mats hold", self.held);
        for ((name, _), ticks) in MATS.iter().zip(self.saturated) {
            (journal.0)(name);
            journal.count(" saturated in ticks", ticks);
        }
        journal.count("worst bound, thousandths", (1000.0 * self.worst) as u32);
        let Outputs { nose_power, middle_power, aft_power, .. } = last.outputs;
        for ((name, _), power) in MATS.into_iter().zip([nose_power, middle_power, aft_power]) {
            (journal.0)(name);
            journal.count(", mW/m at last", (1000.0 * power) as u32);
        }
        for (tick, inputs) in (1..).zip(&self.flown) {
            (journal.0)("@ flown ");
            journal.record(tick, inputs.iter().copied());
        }
        self.held > 0 && self.saturated.iter().all(|&ticks| ticks > 0)
    }
}

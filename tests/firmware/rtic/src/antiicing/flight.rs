//! Stands in for air data, bus voltages and the switches of the mats: 20 minutes from a cold stand, with a climb, a cruise in
//! gusts with a generator out for a while, and a descent.

use signorini_board::draw::Draw;

use super::scene::{Inputs, Outputs};

/// Ticks of the flight, of a second each.
pub const TICKS: u32 = 1200;
/// Ticks at which the climb ends, and the descent begins and ends.
const CLIMBED: u32 = 300;
const DESCENDS: u32 = 850;
const DOWN: u32 = 1150;
/// Ticks within which one of two generators is out.
const OUT: core::ops::Range<u32> = 550..700;

/// °C of a mat's skin below which it is switched to full power, and above which to the least.
pub const BAND: [f32; 2] = [0.5, 1.5];
/// The least part of its power that a supply gives.
const LEAST: f32 = Inputs::RANGES[2][0];

/// The flight, tick after tick.
pub struct Flight {
    tick: u32,
    draw: Draw,
    gust: f32,
    /// Whether each mat has full power.
    full: [bool; 3],
}

impl Flight {
    /// On the ground.
    pub const START: Self = Self { tick: 0, draw: Draw::from_seed(1), gust: 0.0, full: [true; 3] };

    /// Whether no tick has passed.
    pub fn is_on_ground(&self) -> bool {
        self.tick == 0
    }

    /// The inputs of the next tick.
    pub fn next(&mut self) -> Inputs {
        let height = height(self.tick);
        self.gust = 0.9 * self.gust + 4.0 * (self.draw.part() - 0.5);
        let voltage = if OUT.contains(&self.tick) { 0.55 } else { 1.0 };
        let [nose_supply, middle_supply, aft_supply] = self.full.map(|full| {
            let drawn = voltage * (1.0 + 0.04 * (self.draw.part() - 0.5));
            if full { drawn } else { LEAST }
        });
        self.tick += 1;
        let (airspeed, ambient) = (12.0 + 58.0 * height + self.gust, -10.0 - 22.0 * height);
        let inputs = Inputs { airspeed, ambient, nose_supply, middle_supply, aft_supply };
        inputs.clamped()
    }

    /// Switches the mats by what their skins are now: each on below its band and off above it.
    pub fn switch(&mut self, outputs: &Outputs) {
        let skins = [outputs.nose_skin, outputs.middle_skin, outputs.aft_skin];
        for (full, skin) in self.full.iter_mut().zip(skins) {
            *full = skin < BAND[usize::from(*full)];
        }
    }
}

/// 0 on the ground, 1 at cruise.
fn height(tick: u32) -> f32 {
    let part = |ticks: u32, of: u32| ticks as f32 / of as f32;
    match tick {
        ..CLIMBED => part(tick, CLIMBED),
        CLIMBED..DESCENDS => 1.0,
        DESCENDS..DOWN => part(DOWN - tick, DOWN - DESCENDS),
        _ => 0.0,
    }
}

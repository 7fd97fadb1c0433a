//! Stands in for air data and bus voltages: a climb, a cruise in gusts with a generator out for a while, a descent.

use signorini_board::draw::Draw;

use super::scene::Inputs;

/// Ticks of the flight.
pub const TICKS: u32 = 600;
/// Ticks at which the climb ends, and the descent begins and ends.
const CLIMBED: u32 = 150;
const DESCENDS: u32 = 425;
const DOWN: u32 = 575;
/// Ticks within which one of two generators is out.
const OUT: core::ops::Range<u32> = 275..350;

/// The flight, tick after tick.
pub struct Flight {
    tick: u32,
    draw: Draw,
    gust: f32,
}

impl Flight {
    /// On the ground.
    pub const START: Self = Self { tick: 0, draw: Draw::from_seed(1), gust: 0.0 };

    /// The inputs of the next tick.
    pub fn next(&mut self) -> Inputs {
        let height = height(self.tick);
        self.gust = 0.9 * self.gust + 4.0 * (self.draw.part() - 0.5);
        let voltage = if OUT.contains(&self.tick) { 0.55 } else { 1.0 };
        let mut supply = || voltage * (1.0 + 0.04 * (self.draw.part() - 0.5));
        let (nose_supply, middle_supply, aft_supply) = (supply(), supply(), supply());
        self.tick += 1;
        let (airspeed, ambient) = (12.0 + 58.0 * height + self.gust, 6.0 - 38.0 * height);
        let inputs = Inputs { airspeed, ambient, nose_supply, middle_supply, aft_supply };
        inputs.clamped()
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

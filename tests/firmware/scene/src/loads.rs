//! The inputs of every tick, the same on every machine.
//!
//! The first tick has the defaults. Of four others two are drawn evenly from the ranges and two are corners of them, one
//! after the other. An input without a range stays within a tenth of its default, or within ±0.1 where that is 0.

use crate::scene::{INPUTS, Inputs, Scalar};

/// Ticks that are played, the first included.
pub const TICKS: usize = 101;

/// Marsaglia's xorshift of 32 bits: never 0, a period of 2³² − 1.
struct Xorshift(u32);

impl Xorshift {
    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    /// Evenly from [0, 1), in steps that both scalars hold.
    fn part(&mut self) -> Scalar {
        const STEP: Scalar = 1.0 / (1 << 24) as Scalar;
        (self.next() >> 8) as Scalar * STEP
    }
}

/// A value of `tick` for an input.
fn value(tick: u32, part: Scalar, default: Scalar, [lo, hi]: [Scalar; 2]) -> Scalar {
    if !(lo.is_finite() && hi.is_finite()) {
        let unit = if default == 0.0 { 1.0 } else { default };
        return default + unit * (0.2 * part - 0.1);
    }
    match tick % 4 {
        0 | 1 => lo + (hi - lo) * part,
        _ if part < 0.5 => lo,
        _ => hi,
    }
}

/// The inputs, tick after tick, without an end.
pub fn loads() -> impl Iterator<Item = Inputs> {
    let mut random = Xorshift(0x5169_0e1d);
    (0..).map(move |tick| {
        if tick == 0 {
            return Inputs::DEFAULT;
        }
        let mut values: [Scalar; INPUTS] = Inputs::DEFAULT.to_array();
        for (value, range) in values.iter_mut().zip(Inputs::RANGES) {
            *value = self::value(tick, random.part(), *value, range);
        }
        Inputs::from_array(values).clamped()
    })
}

//! The inputs of every tick, the same on every machine.
//!
//! The first tick has the defaults. In the others each input is drawn evenly from within a tenth of its
//! default, or from ±0.1 where that is 0.

use crate::scene::{INPUTS, Inputs, Scalar};

/// Ticks, the first included.
pub const TICKS: u32 = 101;

/// Marsaglia's xorshift of 32 bits: never 0, a period of 2³² − 1.
struct Xorshift(u32);

impl Xorshift {
    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    /// Evenly from [−0.1, 0.1), in steps that both scalars hold.
    fn tenth(&mut self) -> Scalar {
        const STEP: Scalar = 0.2 / (1 << 24) as Scalar;
        (self.next() >> 8) as Scalar * STEP - 0.1
    }
}

/// The inputs, tick after tick.
pub fn loads() -> impl Iterator<Item = Inputs> {
    let mut random = Xorshift(0x5169_0e1d);
    (0..TICKS).map(move |tick| {
        if tick == 0 {
            return Inputs::DEFAULT;
        }
        let mut values: [Scalar; INPUTS] = Inputs::DEFAULT.to_array();
        for value in &mut values {
            let part = random.tenth();
            *value = if *value == 0.0 { part } else { *value + *value * part };
        }
        Inputs::from_array(values)
    })
}

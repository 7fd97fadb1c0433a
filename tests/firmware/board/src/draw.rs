//! Random numbers, the same bits on every machine: Marsaglia's xorshift of 32 bits, never 0, with a period of 2³² − 1.

/// The generator.
#[derive(Debug, Clone)]
pub struct Draw(u32);

impl Draw {
    /// That of the inputs which the peers of `cargo xtask peers` are given: one for every input but the constant, in order.
    pub const fn new() -> Self {
        Self::from_seed(0x2545_f491)
    }

    /// From a seed other than 0.
    pub const fn from_seed(seed: u32) -> Self {
        Self(seed)
    }

    /// The next bits.
    pub fn bits(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    /// Uniform in [0, 1), by the upper 24 bits; exact in f32.
    pub fn part(&mut self) -> f32 {
        (self.bits() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Uniform in [−1, 1), by the upper 24 bits; exact in f32.
    pub fn uniform(&mut self) -> f32 {
        ((self.bits() >> 8) as i32 - (1 << 23)) as f32 * (1.0 / 8_388_608.0)
    }
}

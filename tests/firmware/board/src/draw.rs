//! Random inputs, the same bits as those that the peers of `cargo xtask peers` are given.

/// Uniform in [−1, 1): xorshift32 and its upper 24 bits; exact in f32.
///
/// A tick takes one for every input but the constant, in order.
#[derive(Debug, Clone)]
pub struct Draw(u32);

impl Draw {
    /// The first of all.
    pub const fn new() -> Self {
        Self(0x2545_f491)
    }

    /// The next number.
    pub fn uniform(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        ((self.0 >> 8) as i32 - (1 << 23)) as f32 * (1.0 / 8_388_608.0)
    }
}

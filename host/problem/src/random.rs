//! Random numbers for scenes that are drawn: equal seeds give equal scenes on every machine.

/// The generator splitmix64: a counter, scrambled.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// Equal seeds give equal numbers.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Case `number` of a run, whose numbers do not depend on those of other cases.
    pub fn of_case(seed: u64, number: u32) -> Self {
        let mut own = Self(seed ^ u64::from(number).wrapping_mul(0xd605_bbb5_8c8a_bc2d));
        Self(own.bits())
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number of [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + unit * (high - low)
    }

    /// A number of [low, high) whose logarithm is uniform.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// A number of [`Self::log`] with either sign.
    pub fn signed_log(&mut self, low: f64, high: f64) -> f64 {
        let sign = if self.chance(0.5) { 1.0 } else { -1.0 };
        sign * self.log(low, high)
    }

    /// A number of 0..n.
    pub fn below(&mut self, n: u32) -> u32 {
        (self.bits() % u64::from(n.max(1))) as u32
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    /// One of several.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len() as u32) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_reproducible_and_differ() {
        let numbers = |seed, case| {
            let mut random = Random::of_case(seed, case);
            (0..4).map(|_| random.bits()).collect::<Vec<_>>()
        };
        assert_eq!(numbers(1, 7), numbers(1, 7));
        assert_ne!(numbers(1, 7), numbers(1, 8));
        assert_ne!(numbers(1, 7), numbers(2, 7));
    }

    #[test]
    fn numbers_stay_in_their_range() {
        let mut random = Random::of_case(3, 0);
        for _ in 0..1000 {
            assert!((2.0..3.0).contains(&random.between(2.0, 3.0)));
            assert!((1e-10..1e10).contains(&random.log(1e-10, 1e10)));
            assert!(random.below(5) < 5);
        }
    }
}

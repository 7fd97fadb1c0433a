//! What stays of a model that steps in time: plain numbers under a seal, for a file or a battery-backed memory.
//!
//! Which numbers these are is said where the model's memory is. Whoever restores a state goes on with the bits of whoever saved it.

use signorini_kernel::{Error, Real};

/// A state with room for `N` numbers: those that one tick of its model hands on to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct State<R, const N: usize> {
    /// Of which scene it is.
    scene: u64,
    checksum: u64,
    numbers: [R; N],
}

impl<R: Real, const N: usize> State<R, N> {
    /// Seals these numbers.
    pub(crate) fn seal(scene: u64, numbers: [R; N]) -> Self {
        Self { scene, checksum: checksum(scene, &numbers), numbers }
    }

    /// Its numbers, where it is a state of `scene` as it was sealed.
    ///
    /// # Errors
    /// [`Error::ForeignState`], [`Error::DamagedState`].
    pub(crate) fn open(&self, scene: u64) -> Result<&[R], Error> {
        if self.scene != scene {
            return Err(Error::ForeignState);
        }
        let is_whole = self.checksum == checksum(scene, &self.numbers);
        if is_whole { Ok(&self.numbers) } else { Err(Error::DamagedState) }
    }
}

/// The checksum of a [`State`] of `scene` with these numbers: FNV-1a over the scene, the kind of numbers, and the bits of all, by words.
pub fn checksum<R: Real>(scene: u64, numbers: &[R]) -> u64 {
    let words = numbers.iter().map(|number| number.as_bits());
    let first = 0xcbf2_9ce4_8422_2325;
    [scene, size_of::<R>() as u64].into_iter().chain(words).fold(first, |sum, word| {
        // Each step is one-to-one in the word; the rotation lets high bits reach low ones.
        (sum ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29)
    })
}

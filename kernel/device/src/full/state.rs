//! What stays of a model that steps in time: plain numbers under a seal, for a file or a battery-backed memory.
//!
//! ```text
//!   u │ s │ its bubbles │ openings │ B │ search for ω │ contact edges that were active        hash of the scene, checksum of all
//! ```
//! Rows, loads and fluxes are not among them: the next tick makes its own. Whoever restores a state goes on with the bits of whoever
//! saved it.

use super::{Lengths, Numbers};
use crate::tick::Progress;
use signorini_kernel::{Error, Real};

/// The numbers that a search for ω leaves.
const OF_SEARCH: usize = 5;

/// A state with room for `N` numbers: those that [`Lengths::handed_on`] tells.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct State<R, const N: usize> {
    /// Of which scene it is.
    scene: u64,
    checksum: u64,
    numbers: [R; N],
}

impl Lengths {
    /// How many numbers one tick hands on to the next: the room of a [`State`].
    pub const fn handed_on(&self) -> usize {
        let [u, vertices, bubbles] = self.numbers.begin;
        let of_bound = self.numbers.openings + self.numbers.carried;
        u + vertices + bubbles + of_bound + OF_SEARCH + self.active
    }
}

impl<R: Real, const N: usize> State<R, N> {
    /// Seals what a tick has left. Before the first one all are 0: the state at the start.
    pub(super) fn seal(
        scene: u64,
        progress: &Progress<R>,
        numbers: &Numbers<&[R]>,
        active: &[u8],
    ) -> Self {
        let mut state = Self { scene, checksum: 0, numbers: [R::ZERO; N] };
        let Numbers { begin: [u, vertices, bubbles], openings, carried, .. } = numbers;
        let (search, has_begun) = (progress.numbers(), progress.has_begun());
        let arrays = [u, vertices, bubbles, openings, carried, &search[..]];
        let flags = active.iter().map(|&flag| if flag == 0 { R::ZERO } else { R::ONE });
        let all = arrays.into_iter().flatten().copied().chain(flags);
        if has_begun {
            state.numbers.iter_mut().zip(all).for_each(|(to, from)| *to = from);
        }
        state.checksum = state.sum();
        state
    }

    /// Puts everything in its place again, of a state that is that of `scene` as it was sealed.
    ///
    /// # Errors
    /// [`Error::ForeignState`], [`Error::DamagedState`]: nothing has changed then.
    pub(super) fn open(
        &self,
        scene: u64,
        numbers: Numbers<&mut [R]>,
        active: &mut [u8],
    ) -> Result<Progress<R>, Error> {
        let Numbers { begin: [u, vertices, bubbles], openings, carried, .. } = numbers;
        let arrays = [u, vertices, bubbles, openings, carried];
        let length: usize = arrays.iter().map(|array| array.len()).sum();
        if self.scene != scene || N != length + OF_SEARCH + active.len() {
            return Err(Error::ForeignState);
        }
        if self.checksum != self.sum() {
            return Err(Error::DamagedState);
        }
        let mut from = self.numbers.iter().copied();
        for (to, from) in arrays.into_iter().flatten().zip(from.by_ref()) {
            *to = from;
        }
        let mut search = [R::ZERO; OF_SEARCH];
        search.iter_mut().zip(from.by_ref()).for_each(|(to, from)| *to = from);
        active.iter_mut().zip(from).for_each(|(to, from)| *to = u8::from(from != R::ZERO));
        Ok(Progress::of_numbers(search))
    }

    /// FNV-1a over the scene, the kind of numbers, and the bits of all, by words.
    fn sum(&self) -> u64 {
        let words = self.numbers.iter().map(|number| number.as_bits());
        let first = 0xcbf2_9ce4_8422_2325;
        [self.scene, size_of::<Self>() as u64].into_iter().chain(words).fold(first, |sum, word| {
            // Each step is one-to-one in the word; the rotation lets high bits reach low ones.
            (sum ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29)
        })
    }
}

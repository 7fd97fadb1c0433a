//! The memory of one controller, as C owns it: it may be copied, kept over a reset, and put elsewhere.

use core::mem::{align_of, size_of};

use crate::scene::{Controller, MODEL, SCENE_HASH, Scalar};
use signorini_device::codes::Refusal;

/// What tells an initialised state from any other bytes. Each of its bytes is checked, as each of the controller's is.
#[repr(C)]
struct Header {
    /// Which controller it is of.
    identity: u64,
    /// [`SEALED`] where the checksum is that of the state.
    seal: u64,
    /// Of all that follows the header, and the culprit.
    checksum: u32,
    /// The number of what the last call was refused for.
    culprit: u32,
}

/// Header and controller.
#[repr(C, align(8))]
pub struct State {
    header: Header,
    controller: Controller,
}

// C sees an array of `uint64_t`.
const _: () = assert!(align_of::<State>() == 8 && size_of::<State>().is_multiple_of(8));

/// Bytes as they may stand in memory by chance are hardly these.
const SEALED: u64 = 0x5ea1_ed00_c0de_57a7;

/// A hash of scene, model, scalar, version and size: a state of another controller has another one.
const IDENTITY: u64 = {
    let scene = fold(0xcbf2_9ce4_8422_2325, &SCENE_HASH.to_le_bytes());
    let model = fold(fold(scene, MODEL.as_bytes()), env!("CARGO_PKG_VERSION").as_bytes());
    let sizes = [size_of::<State>() as u64, size_of::<Scalar>() as u64, size_of::<usize>() as u64];
    let model = fold(model, &sizes[0].to_le_bytes());
    fold(fold(model, &sizes[1].to_le_bytes()), &sizes[2].to_le_bytes())
};

/// FNV-1a.
const fn fold(mut hash: u64, bytes: &[u8]) -> u64 {
    let mut at = 0;
    while at < bytes.len() {
        hash = (hash ^ bytes[at] as u64).wrapping_mul(0x0000_0100_0000_01b3);
        at += 1;
    }
    hash
}

impl State {
    /// Makes `this` a state before the first tick, and seals it.
    ///
    /// The controller is written by itself: it is zeros, which take no room in flash, and the header is not.
    ///
    /// # Safety
    /// There is room for a state, whose bytes may be any.
    pub unsafe fn begin(this: *mut Self) -> Refusal {
        // SAFETY: the caller's; what stood there is not read.
        let state = unsafe {
            (&raw mut (*this).controller).write(const { Controller::new() });
            (&raw mut (*this).header).write(Header {
                identity: IDENTITY,
                seal: 0,
                checksum: 0,
                culprit: 0,
            });
            &mut *this
        };
        state.seal()
    }

    /// Whether this is a state of this controller.
    pub fn is_own(&self) -> bool {
        self.header.identity == IDENTITY
    }

    /// The controller.
    pub fn controller(&self) -> &Controller {
        &self.controller
    }

    /// The controller, about to change, and the seal that is broken by it.
    pub fn open(&mut self) -> (&mut Controller, Seal) {
        let seal = Seal(core::mem::take(&mut self.header.seal));
        (&mut self.controller, seal)
    }

    /// Puts a seal back: the controller has not changed after all.
    pub fn close(&mut self, seal: Seal) {
        self.header.seal = seal.0;
    }

    /// Keeps the number of what a call was refused for; a state that is sealed stays so.
    pub fn blame(&mut self, culprit: usize) {
        let before = self.header.culprit;
        self.header.culprit = culprit as u32;
        self.header.checksum ^= before ^ self.header.culprit;
    }

    /// The number of what the last refused call was refused for.
    pub fn culprit(&self) -> u32 {
        self.header.culprit
    }

    /// Forgets all ticks.
    pub fn reset(&mut self) -> Refusal {
        self.open().0.reset();
        self.seal()
    }

    /// Puts the checksum in its place.
    pub fn seal(&mut self) -> Refusal {
        // SAFETY: it is one.
        self.header.checksum = unsafe { sum(self) } ^ self.header.culprit;
        self.header.seal = SEALED;
        Refusal::Ok
    }

    /// Whether this is a state of this controller, and the one that was sealed.
    ///
    /// # Safety
    /// `this` can be read; its bytes may be any.
    pub unsafe fn check(this: *const Self) -> Refusal {
        // SAFETY: the caller's; numbers of any bits are numbers, and no reference to the controller is made.
        let Header { identity, seal, checksum, culprit } =
            unsafe { (&raw const (*this).header).read() };
        if identity != IDENTITY {
            Refusal::ForeignState
        } else if seal != SEALED {
            Refusal::UnsealedState
        // SAFETY: the caller's.
        } else if checksum ^ culprit != unsafe { sum(this) } {
            Refusal::DamagedState
        } else {
            Refusal::Ok
        }
    }
}

/// What a state had for a seal.
pub struct Seal(u64);

/// FNV-1a by words of 32 bits over all that follows the header: each step is one-to-one in the word and in what stood before, so
/// that a change of bits within one word never stays hidden, and any other does with a probability of 2⁻³².
///
/// # Safety
/// `state` can be read.
#[inline(never)]
unsafe fn sum(state: *const State) -> u32 {
    // SAFETY: inside of the state.
    let words = unsafe { state.cast::<u32>().add(size_of::<Header>() / 4) };
    let count = (size_of::<State>() - size_of::<Header>()) / 4;
    let mut sum = 0x811c_9dc5_u32;
    for at in 0..count {
        // SAFETY: inside of the state. Volatile, since bytes between its fields have some value too.
        let word = unsafe { words.add(at).read_volatile() };
        sum = (sum ^ word).wrapping_mul(0x0100_0193);
    }
    sum
}

// No byte is left out.
const _: () = assert!(size_of::<Header>() == core::mem::offset_of!(State, controller));

//! The memory of one controller, as C owns it: it may be copied, kept over a reset, and put elsewhere.

use core::mem::{align_of, size_of};

use crate::scene::{Controller, MODEL, SCENE_HASH, Scalar};
use signorini_kernel::device::codes::Refusal;

/// What tells an initialised state from any other bytes.
#[repr(C)]
struct Header {
    /// Which controller it is of.
    identity: u64,
    /// [`SEALED`] where the checksum is that of the controller.
    seal: u32,
    /// Of the controller's bytes.
    checksum: u32,
    /// The number of what the last call was refused for.
    culprit: u32,
    unused: u32,
}

/// Header and controller.
#[repr(C, align(8))]
pub struct State {
    header: Header,
    controller: Controller,
}

// C sees an array of `uint64_t`.
const _: () = assert!(align_of::<State>() == 8 && size_of::<State>() % 8 == 0);

/// Bytes as they may stand in memory by chance are hardly these.
const SEALED: u32 = 0x5ea1_ed00;

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
    /// Before the first tick; not sealed yet.
    pub const NEW: Self = Self {
        header: Header { identity: IDENTITY, seal: 0, checksum: 0, culprit: 0, unused: 0 },
        controller: Controller::new(),
    };

    /// The controller, about to change; none where this is no state of it.
    pub fn open(&mut self) -> Option<&mut Controller> {
        if self.header.identity != IDENTITY {
            return None;
        }
        self.header.seal = 0;
        Some(&mut self.controller)
    }

    /// Keeps the number of what a call was refused for.
    pub fn blame(&mut self, culprit: usize) {
        self.header.culprit = culprit as u32;
    }

    /// The number of what the last refused call was refused for.
    pub fn culprit(&self) -> u32 {
        self.header.culprit
    }

    /// Puts the checksum in its place.
    pub fn seal(&mut self) -> Refusal {
        if self.header.identity != IDENTITY {
            return Refusal::ForeignState;
        }
        self.header.checksum = self.checksum();
        self.header.seal = SEALED;
        Refusal::Ok
    }

    /// Whether this is a state of this controller, and the one that was sealed.
    ///
    /// # Safety
    /// `this` can be read; its bytes may be any.
    pub unsafe fn check(this: *const Self) -> Refusal {
        // SAFETY: the caller's; numbers of any bits are numbers, and no reference to the controller is made.
        let (identity, seal, checksum) = unsafe {
            let header = &raw const (*this).header;
            ((*header).identity, (*header).seal, (*header).checksum)
        };
        if identity != IDENTITY {
            Refusal::ForeignState
        } else if seal != SEALED {
            Refusal::UnsealedState
        // SAFETY: the caller's.
        } else if checksum != sum(unsafe { &raw const (*this).controller }) {
            Refusal::DamagedState
        } else {
            Refusal::Ok
        }
    }

    fn checksum(&self) -> u32 {
        sum(&raw const self.controller)
    }
}

/// FNV-1a by words of 32 bits: each step is one-to-one in the word and in what stood before, so that a change of bits within one
/// word never stays hidden, and any other does with a probability of 2⁻³².
fn sum(controller: *const Controller) -> u32 {
    let words = controller.cast::<u32>();
    let count = size_of::<Controller>() / 4;
    let mut sum = 0x811c_9dc5_u32;
    for at in 0..count {
        // SAFETY: inside of the controller. Volatile, since bytes between its fields have some value too.
        let word = unsafe { words.add(at).read_volatile() };
        sum = (sum ^ word).wrapping_mul(0x0100_0193);
    }
    sum
}

// No byte is left out.
const _: () = assert!(size_of::<Controller>() % 4 == 0 && align_of::<Controller>() % 4 == 0);

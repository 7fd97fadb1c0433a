//! Lengths and bytes of owned memory, beside what the compiler says of the types.

use signorini_contact::dense::blocks::{SIDE, count, padded};
use signorini_device::full::{ArrayStorage, Lengths, Numbers};
use signorini_device::sparse::{self, storage};
use signorini_kernel::Error;
use signorini_kernel::error::Array;

/// Each a power of two, so that their sum tells which of them it has.
const POWERS: Numbers<usize> = Numbers {
    load: 1,
    u: 1 << 1,
    tau: 1 << 2,
    vertices: 1 << 3,
    bubbles: 1 << 4,
    triangles: 1 << 5,
    quads: 1 << 6,
    contact_flux: 1 << 7,
    gap: 1 << 8,
    gap_ends: 1 << 9,
    dirichlet: 1 << 10,
    dirichlet_ends: 1 << 11,
    transfer: 1 << 12,
    spans: 1 << 13,
    begin: [1 << 14, 1 << 15, 1 << 16],
    openings: 1 << 17,
    carried: 1 << 18,
    diagonal: 1 << 19,
    handed: 1 << 20,
};

const LENGTHS: Lengths =
    Lengths { rows: 100, active: 200, numbers: POWERS, neumann: 300, robin: 400, curved: 500 };

#[test]
fn all_arrays_count_once() {
    assert_eq!(POWERS.sum(), (1 << 21) - 1);
}

/// The type has three lengths of 64 bits here where the target has 32, and is aligned.
#[test]
fn bytes_are_those_of_the_type() {
    type Own = ArrayStorage<
        f32,
        u16,
        4,
        { LENGTHS.rows },
        { (1 << 21) - 1 },
        { LENGTHS.active },
        { LENGTHS.neumann },
        { LENGTHS.robin },
        { LENGTHS.curved },
    >;
    let (found, expected) = (LENGTHS.bytes::<f32, u16, 4>(), size_of::<Own>());
    assert!((12..17).contains(&(expected - found)), "{found} of {expected}");
}

#[test]
fn exchanges_have_room_for_whole_blocks() -> Result<(), Error> {
    const CONTACT: usize = 2 * SIDE + 1;
    const EXPECTED: [usize; 3] = [6, 6 * 3 * SIDE, 2 * 3 * SIDE];
    assert_eq!(storage::lengths(CONTACT), EXPECTED);
    assert_eq!([count(CONTACT), padded(CONTACT)], [6, 3 * SIDE]);
    type Own = sparse::ArrayStorage<f64, { EXPECTED[0] }, { EXPECTED[1] }, { EXPECTED[2] }>;
    assert_eq!(storage::bytes::<f64>(CONTACT), size_of::<Own>());
    let mut own = Own::zeros();
    assert_eq!(own.memory::<f64>(CONTACT)?.load.len(), 3 * SIDE);
    let refused = own.memory::<f64>(SIDE).map(|_| ());
    let (of, found, expected) = (Array::Scratch, 2 * 3 * SIDE, 2 * SIDE);
    assert_eq!(refused, Err(Error::Length { of, found, expected }));
    Ok(())
}

//! The state of a controller that steps in time, byte for byte as firmware has it.
//!
//! ```text
//!   hash of the scene, 8 bytes │ checksum, 8 bytes │ numbers │ zeros up to a multiple of 8 bytes          least byte first
//! ```

use signorini_device::checksum;
use signorini_kernel::Error;
use signorini_problem::scalar::Scalar;

/// The bytes of numbers that belong to `scene`.
pub(crate) fn bytes<R: Scalar>(scene: u64, numbers: &[R]) -> Vec<u8> {
    let mut bytes = [scene, checksum(scene, numbers)].map(u64::to_le_bytes).concat();
    let of_number = |number: &R| number.as_bits().to_le_bytes().into_iter().take(size_of::<R>());
    bytes.extend(numbers.iter().flat_map(of_number));
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

/// The numbers of bytes that belong to `scene`.
///
/// # Errors
/// [`Error::ForeignState`] of another scene, [`Error::DamagedState`] where bytes have changed.
pub(crate) fn numbers<R: Scalar>(scene: u64, bytes: &[u8]) -> Result<Vec<R>, Error> {
    let (head, rest) = bytes.as_chunks::<8>().0.split_at_checked(2).ok_or(Error::ForeignState)?;
    let [of, sum] = [head[0], head[1]].map(u64::from_le_bytes);
    if of != scene {
        return Err(Error::ForeignState);
    }
    let rest = rest.as_flattened();
    let mut numbers: Vec<R> = match size_of::<R>() {
        4 => rest.as_chunks().0.iter().map(|&x| R::narrow(f32::from_le_bytes(x).into())).collect(),
        _ => rest.as_chunks().0.iter().map(|&x| R::narrow(f64::from_le_bytes(x))).collect(),
    };
    // An odd count of f32 is followed by four bytes that are none.
    if checksum(scene, &numbers) != sum && size_of::<R>() == 4 {
        numbers.pop();
    }
    if checksum(scene, &numbers) == sum { Ok(numbers) } else { Err(Error::DamagedState) }
}

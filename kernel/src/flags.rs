//! Flags that outlive a tick, as bytes: memory may have lost bits since, after a brown-out for example.
//!
//! ```text
//!   state: bytes of any bits ─► restored ─► bool, for one tick
//! ```
//! A `bool` that is neither 0 nor 1 may be anything to a compiler, an index beyond an array among it. So the memory of a
//! controller has none.

/// The flags that these bytes stand for, each by its lowest bit.
#[allow(unsafe_code)]
pub fn restored(bytes: &mut [u8]) -> &mut [bool] {
    const ONES: u32 = 0x0101_0101;
    let (words, rest) = bytes.as_chunks_mut::<4>();
    words.iter_mut().for_each(|word| *word = (u32::from_ne_bytes(*word) & ONES).to_ne_bytes());
    rest.iter_mut().for_each(|byte| *byte &= 1);
    // SAFETY: a bool is a byte, every one is 0 or 1, and bools are what is written through this.
    unsafe { &mut *(core::ptr::from_mut(bytes) as *mut [bool]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_byte_is_a_flag() {
        for count in [0, 1, 7, 8, 9, 19] {
            for byte in 0..=u8::MAX {
                let mut all = [byte; 19];
                let (bytes, _) = all.split_at_mut(count);
                let flags = restored(bytes);
                assert!(flags.len() == count && flags.iter().all(|flag| *flag == (byte % 2 == 1)));
                flags.iter_mut().for_each(|flag| *flag = !*flag);
                assert!(bytes.iter().all(|other| *other == 1 - byte % 2));
            }
        }
    }
}

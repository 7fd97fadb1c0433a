//! A matrix in blocks that follows a number: S + Σ_k g_k α_k α_kᵀ, two terms a pass.

use super::blocks::{Block, count, groups, padded};
use super::correction::subtract_two;
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};

/// `blocks` += Σ g_k α_k α_kᵀ: `columns` holds the α, [`padded`] numbers each with 0 in the padding, and `gain` tells g_k.
///
/// # Errors
/// Arrays of the wrong length.
#[inline(never)]
pub fn add_outer<R: Real>(
    blocks: &mut [Block<R>],
    order: usize,
    columns: &[R],
    gain: impl Fn(usize) -> R,
) -> Result<(), Error> {
    same_length(Array::MatrixValues, blocks.len(), count(order))?;
    let length = padded(order).max(1);
    same_length(Array::Load, columns.len() % length, 0)?;
    for (at, pair) in columns.chunks((2 * length).max(1)).enumerate() {
        let (a, b) = pair.split_at_checked(length).unwrap_or_default();
        // The last of an odd number has no partner.
        let (b, of_b) = if b.is_empty() { (a, R::ZERO) } else { (b, -gain(2 * at + 1)) };
        subtract_two(blocks, order, [groups(a), groups(b)], [-gain(2 * at), of_b]);
    }
    Ok(())
}

/// Entries off the diagonal that are more than 0, by rounding, become 0.
pub fn without_positive<R: Real>(blocks: &mut [Block<R>]) {
    let (mut rest, mut length) = (blocks, 1);
    while let Some((row, below)) = rest.split_at_mut_checked(length) {
        let Some((own, left)) = row.split_last_mut() else { return };
        left.as_flattened_mut().as_flattened_mut().iter_mut().for_each(not_positive);
        for (at, line) in own.iter_mut().enumerate() {
            let others = line.iter_mut().enumerate().filter(|(column, _)| *column != at);
            others.for_each(|(_, entry)| not_positive(entry));
        }
        (rest, length) = (below, length + 1);
    }
}

fn not_positive<R: Real>(entry: &mut R) {
    *entry = entry.or_smaller(R::ZERO);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::blocks::SIDE;

    #[test]
    fn sums_of_products_are_added_to_every_entry_stored() {
        const N: usize = 11;
        let number = |k: usize, i: usize| f64::from(((7 * k + 3 * i) % 13) as u8) / 16.0;
        for modes in 0..6 {
            let mut columns = [0.0; 6 * 16];
            for (at, entry) in columns.iter_mut().enumerate().filter(|(at, _)| at % 16 < N) {
                *entry = number(at / 16, at % 16);
            }
            let mut blocks = [[[-1.0; SIDE]; SIDE]; 3];
            let gain = |k: usize| 0.5 + k as f64;
            let used = columns.split_at(16 * modes).0;
            assert_eq!(add_outer(&mut blocks, N, used, gain), Ok(()));
            for (row, column) in (0..N).flat_map(|row| (0..=row).map(move |column| (row, column))) {
                let terms = (0..modes).map(|k| gain(k) * number(k, row) * number(k, column));
                let block = row / SIDE * (row / SIDE + 1) / 2 + column / SIDE;
                // Sixteenths are exact.
                let entries = blocks.as_flattened().as_flattened();
                let at = (block * SIDE + row % SIDE) * SIDE + column % SIDE;
                assert_eq!(entries.get(at), Some(&(-1.0 + terms.sum::<f64>())));
            }
        }
        let mut blocks = [[[0.0; SIDE]; SIDE]; 3];
        assert!(add_outer(&mut blocks, N, &[0.0; 17], |_| 1.0).is_err());
        assert!(add_outer(&mut blocks, 17, &[0.0; 24], |_| 1.0).is_err());
    }

    #[test]
    fn what_is_positive_off_the_diagonal_vanishes() {
        let mut blocks = [[[0.25; SIDE]; SIDE]; 3];
        blocks[1][2][2] = -0.5;
        without_positive(&mut blocks);
        for (at, block) in blocks.iter().enumerate() {
            for (row, line) in block.iter().enumerate() {
                for (column, &entry) in line.iter().enumerate() {
                    let is_diagonal = at != 1 && row == column;
                    let is_negative = (at, row, column) == (1, 2, 2);
                    let expected = match (is_diagonal, is_negative) {
                        (true, _) => 0.25,
                        (_, true) => -0.5,
                        _ => 0.0,
                    };
                    assert_eq!(entry, expected, "{at} {row} {column}");
                }
            }
        }
    }
}

//! What a tick of the condensed model looks at: the exact method and the bound leave out what is zero.

use signorini_contact::dense::blocks::SIDE;

/// Of one tick; products and norms cost by these.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Visited {
    /// Blocks that a product with S or with the tableau takes, each above the diagonal once more for its transpose.
    pub blocks: usize,
    /// Entries of the bound's factor in the columns that are not multiplied by 0.
    pub entries: usize,
    /// Order of that factor.
    pub order: usize,
    /// Whether the matrix was worked out anew, for another value of a transfer coefficient.
    pub follows: bool,
}

impl Visited {
    /// With these edges open, padded, and these multipliers of the factor's columns.
    pub(super) fn new<R: PartialEq + Default>(open: &[u8], multipliers: &[R]) -> Self {
        let (mut blocks, mut used) = (0, 0);
        for (row, group) in open.chunks(SIDE).enumerate() {
            blocks += used;
            if group.contains(&1) {
                (blocks, used) = (blocks + row + 1, used + 1);
            }
        }
        let zero = R::default();
        let columns = multipliers.iter().enumerate().filter(|(_, z)| **z != zero);
        let entries = columns.map(|(at, _)| at + 1).sum();
        Self { blocks, entries, order: multipliers.len(), follows: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_is_not_zero_counts() {
        let all = Visited::new(&[1; 24], &[1.0, 0.0, 2.0]);
        // The whole square of blocks, and columns of 1 and 3 entries.
        assert_eq!(all, Visited { blocks: 9, entries: 4, order: 3, follows: false });
        // The first of two groups: the half of the square that it meets.
        let mut half = [0; 16];
        half[3] = 1;
        assert_eq!(Visited::new(&half, &[0.0]).blocks, 2);
    }
}

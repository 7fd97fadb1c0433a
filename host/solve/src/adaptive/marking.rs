//! Which cells are refined: the fewest that hold a share of the whole (Dörfler's marking).
//!
//! ```text
//!   Σ_{T marked} η_T² ≥ θ² Σ_T η_T²,    the largest η_T first
//! ```
//! θ² is ½, so that levels grow by a factor near 2 where cells have nearly equal shares. A refined cell of a smooth part keeps a
//! quarter of its η_T². Where less is asked for than a whole level brings, less is marked:
//! ```text
//!   Σ η_T² − ¾ Σ_{T marked} η_T² ≤ ROOM · goal²
//! ```

/// θ²
const SHARE: f64 = 0.5;
/// What refinement takes of the square of a smooth cell's indicator.
const TAKEN: f64 = 0.75;
/// The goal is aimed at from below, since not all cells are smooth.
const ROOM: f64 = 0.85;

/// Whether each cell is marked; `goal` is what the root of the sum of the squares is to become.
pub(super) fn marked(squares: &[f64], goal: f64) -> Vec<bool> {
    let total: f64 = squares.iter().sum();
    let last = (total - ROOM * goal * goal) / TAKEN;
    // At least one cell: rounding may leave nothing to take.
    let wanted = (SHARE * total).min(last.max(0.0));
    let mut order: Vec<usize> = (0..squares.len()).collect();
    order.sort_by(|&a, &b| squares[b].total_cmp(&squares[a]).then(a.cmp(&b)));
    let (mut marked, mut sum) = (vec![false; squares.len()], 0.0);
    for (count, cell) in order.into_iter().enumerate() {
        if count > 0 && sum >= wanted {
            break;
        }
        marked[cell] = true;
        sum += squares[cell];
    }
    marked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_hold_half() {
        let squares = [1.0, 4.0, 2.0, 2.0, 1.0];
        assert_eq!(marked(&squares, 0.0), [false, true, true, false, false]);
    }

    #[test]
    fn less_is_marked_near_the_goal() {
        let squares = vec![1.0; 100];
        let count = |goal| marked(&squares, goal).iter().filter(|&&is| is).count();
        assert_eq!(count(0.0), 50);
        // 100 − ¾ n ≤ 0.85 · 100
        assert_eq!(count(10.0), 20);
        assert_eq!(count(1e3), 1);
        assert_eq!(marked(&[0.0, 0.0], 0.0), [true, false]);
    }
}
